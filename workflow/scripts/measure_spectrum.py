"""C_iso of a measured surface: all its measurements joined, continued beyond their band."""

from hardcontact.base.job import job
from hardcontact.surfaces.joined_spectrum import joined_spectrum
from hardcontact.surfaces.scans import flat_measurements

with job(snakemake) as job:
    params = job.parameters
    measurements = flat_measurements(
        job.input.measurements, params["sphere_radius"], params["levelling"]
    )
    job.write(
        joined_spectrum(measurements, params["tip_radii"]),
        title="power spectral density of a measured surface, joined of its measurements",
    )
