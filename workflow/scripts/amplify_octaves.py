"""Forces on a measured scan with each octave of its own waves amplified, or the last replaced."""

from functools import partial

import xarray as xr

from hardcontact.base.dataset import read
from hardcontact.base.job import run_job
from hardcontact.base.random import generator
from hardcontact.contact.contact import Contact
from hardcontact.inference.hindcast import (
    RandomBody,
    hindcast_forces,
    last_octave,
    reliable_wavelengths,
)
from hardcontact.inference.octaves import make_force_function, octave_force_dataset, octave_limits
from hardcontact.inference.wide_pixels import pixel_forces
from hardcontact.surfaces.height_map import read_height_map
from hardcontact.surfaces.spectrum import read_spectrum

with run_job(snakemake) as job:
    params = job.parameters
    stitched = read_height_map(job.input.stitched)
    sphere = read_height_map(job.input.sphere) if job.input.sphere else None
    contact = Contact(**params["contact"])
    forces = make_force_function(contact, sphere)
    # A stitched scan is twice as long as the scan, whose mirror images add no longer waves.
    limits = octave_limits(2 * stitched.pixel_size, stitched.size / 2)
    octave_forces = octave_force_dataset(stitched, limits, forces)
    spectrum = read(job.input.spectrum)
    measurements = spectrum.isel(measurement=params["measurements"])
    sizes = [stitched.size / 2, *measurements["size"].values[1:]]
    names = [(params["surface"], params["scan"]), *params["sphere_scan"]]
    bodies = [
        RandomBody(
            read_spectrum(path),
            round(size / stitched.pixel_size),
            partial(generator, params["seed"], *name, "hindcast"),
        )
        for path, size, name in zip(job.input.body_spectra, sizes, names, strict=True)
    ]
    band = reliable_wavelengths(measurements)
    octaves = {
        side: last_octave(side, transition, *band)
        for side, transition in params["transitions"].items()
    }
    hindcast = hindcast_forces(stitched, octaves, bodies, forces)
    job.write(
        xr.merge([octave_forces, hindcast, pixel_forces(stitched, sphere, contact)])
        .expand_dims(map=[params["scan"]])
        .assign_attrs(map_size=stitched.size / 2),
        title="pull-off forces of one scan with each octave amplified, or the last replaced",
    )
