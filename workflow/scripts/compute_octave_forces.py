"""Forces on a scan with each octave of waves changed."""

from hardcontact.contact.contact import Contact
from hardcontact.contact.pull_off import make_force_function
from hardcontact.inference.octaves import octave_force_dataset, octave_limits
from hardcontact.records.job import run_job
from hardcontact.surfaces.height_map import load_height_map

with run_job(snakemake) as job:
    params = job.parameters
    mirrored = load_height_map(job.input.mirrored)
    sphere = load_height_map(job.input.sphere) if job.input.sphere else None
    compute_forces = make_force_function(Contact(**params["contact"]), sphere)
    # Longer waves of the mirrored scan are not in the scan, so octaves end at its size.
    scan_size = mirrored.size / 2
    limits = octave_limits(2 * mirrored.pixel_size, scan_size)
    forces = octave_force_dataset(mirrored, limits, compute_forces)
    # The dimension `map` holds whole surfaces in studies of substitutes, and scans here.
    forces = forces.expand_dims(map=[params["scan"]]).assign_attrs(map_size=scan_size)
    job.write(forces, title="pull-off forces of one scan with each octave changed")
