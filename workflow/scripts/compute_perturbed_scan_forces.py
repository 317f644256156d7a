"""Forces on perturbed scans: each octave of waves amplified, the last replaced, pixels widened."""

import xarray as xr

from hardcontact.base.dataset import read
from hardcontact.contact.contact import Contact
from hardcontact.contact.pull_off import make_force_function
from hardcontact.inference.hindcast import RandomBody, hindcast_forces, last_octaves
from hardcontact.inference.octaves import octave_force_dataset, octave_limits
from hardcontact.inference.wide_pixels import pixel_forces
from hardcontact.records.job import run_job
from hardcontact.surfaces.height_map import load_height_map
from hardcontact.surfaces.spectrum import load_spectrum

with run_job(snakemake) as job:
    params = job.parameters
    contact = Contact(**params["contact"])
    mirrored = load_height_map(job.input.stitched)
    sphere = load_height_map(job.input.sphere) if job.input.sphere else None
    compute_forces = make_force_function(contact, sphere)
    # A mirrored scan is twice as long as the scan, whose mirror images add no longer waves.
    scan_size = mirrored.size / 2
    limits = octave_limits(2 * mirrored.pixel_size, scan_size)
    measurements = read(job.input.spectrum).isel(measurement=params["measurements"])
    last = last_octaves(measurements, params["transitions"])
    sizes = [scan_size, *measurements["size"].values[1:]]
    bodies = [
        RandomBody(load_spectrum(path), size, params["seed"], scan)
        for path, size, scan in zip(job.input.body_spectra, sizes, params["bodies"], strict=True)
    ]
    job.write(
        xr.merge(
            [
                octave_force_dataset(mirrored, limits, compute_forces),
                hindcast_forces(mirrored, last, bodies, compute_forces),
                pixel_forces(mirrored, sphere, contact),
            ]
        )
        .expand_dims(map=[params["scan"]])
        .assign_attrs(map_size=scan_size),
        title="pull-off forces of one scan with each octave amplified, or the last replaced",
    )
