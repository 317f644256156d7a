"""C_iso of a measured surface: all its measurements joined, continued beyond their band."""

from hardcontact.study.job import job
from hardcontact.surfaces.joined_spectrum import joined_spectrum
from hardcontact.surfaces.scans import read_measurement

with job(snakemake) as this:
    readings = this.parameters["measurements"]  # one for each input, in the same order
    measurements = [
        read_measurement(path, reading["dataset"], reading["undefined_pixels"])
        for path, reading in zip(this.input.scans, readings, strict=True)
    ]
    this.write(
        joined_spectrum(measurements, [reading["tip_radius"] for reading in readings]),
        title="power spectral density of a measured surface, joined of its measurements",
    )
