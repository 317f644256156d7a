"""C_iso of a measured surface: all its measurements joined, continued beyond their band."""

from functools import partial

from hardcontact.records.job import job
from hardcontact.surfaces.joined_spectrum import joined_spectrum
from hardcontact.surfaces.scans import flattened, read_measurement
from hardcontact.surfaces.topography import LEVELLING, flat_map

with job(snakemake) as this:
    given = this.parameters
    flat = partial(
        flat_map,
        sphere_radius=given["sphere_radius"],
        levelled=LEVELLING[given["levelling"]],
    )
    measurements = [
        flattened(read_measurement(path, dataset, given["undefined_pixels"]), flat)
        for path, dataset in zip(this.input.scans, given["datasets"], strict=True)
    ]
    this.write(
        joined_spectrum(measurements, given["tip_radii"]),
        title="power spectral density of a measured surface, joined of its measurements",
    )
