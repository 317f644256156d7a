"""Forces on a scan with random waves as its outermost octave, and with wider pixels."""

from hardcontact.base.dataset import read
from hardcontact.contact.contact import Contact
from hardcontact.contact.pull_off import make_force_function
from hardcontact.own.hindcast import RandomBody, hindcast_forces, outermost_octaves, pixel_forces
from hardcontact.records.job import run_job
from hardcontact.surfaces.height_map import load_height_map
from hardcontact.surfaces.spectrum import load_spectrum

with run_job(snakemake) as job:
    params = job.parameters
    contact = Contact(**params["contact"])
    mirrored = load_height_map(job.input.mirrored)
    sphere = load_height_map(job.input.sphere) if job.input.sphere else None
    measurements = read(job.input.spectrum).isel(measurement=params["measurement_indices"])
    octaves = outermost_octaves(measurements, params["transitions"])
    # The substrate's scan is half as wide as its mirrored map; a scan of the sphere may follow.
    sizes = [mirrored.size / 2, *measurements["size"].values[1:]]
    bodies = [
        RandomBody(load_spectrum(path), size, params["seed"], scan)
        for path, size, scan in zip(
            job.input.body_spectra, sizes, params["body_scans"], strict=True
        )
    ]
    forces = hindcast_forces(mirrored, octaves, bodies, make_force_function(contact, sphere))
    job.write(
        forces.merge(pixel_forces(mirrored, sphere, contact)).expand_dims(map=[params["scan"]]),
        title="pull-off forces of a scan with its outermost octave replaced, and with wider pixels",
    )
