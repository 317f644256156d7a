"""Forces on a scan with random waves as its shortest or longest octave, and on wider pixels."""

from hardcontact.base.dataset import read_dataset
from hardcontact.contact.contact import Contact
from hardcontact.contact.pull_off import make_force_function
from hardcontact.own.hindcast import RandomBody, hindcast_forces, outermost_octaves
from hardcontact.own.wide_pixels import forces_by_pixel_width
from hardcontact.records.job import run_job
from hardcontact.surfaces.height_map import load_height_map
from hardcontact.surfaces.spectrum import load_spectrum

with run_job(snakemake) as job:
    params = job.parameters
    contact = Contact(**params["contact"])
    mirrored = load_height_map(job.input.mirrored)
    sphere = load_height_map(job.input.sphere) if job.input.sphere else None
    measurements = read_dataset(job.input.spectrum).isel(measurement=params["measurement_indices"])
    octaves = outermost_octaves(measurements, params["transitions"])
    # Widths of the scans: of the substrate, and of the sphere if the map has its roughness.
    scan_sizes = [mirrored.size / 2, *measurements["size"].values[1:]]
    bodies = [
        RandomBody(load_spectrum(path), size, params["seed"], scan_id)
        for path, size, scan_id in zip(
            job.input.body_spectra, scan_sizes, params["body_scans"], strict=True
        )
    ]
    compute_forces = make_force_function(contact, sphere)
    octave_forces = hindcast_forces(
        mirrored, octaves, bodies, compute_forces, contact.contacts_per_row
    )
    forces = octave_forces.merge(forces_by_pixel_width(mirrored, sphere, contact))
    job.write(
        forces.expand_dims(map=[params["scan"]]),
        title="pull-off forces of a scan with its outermost octave replaced, and with wider pixels",
    )
