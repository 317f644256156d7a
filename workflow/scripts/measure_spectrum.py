"""C_iso of a measured surface: all its measurements joined, continued beyond their band."""

from hardcontact.base.job import job
from hardcontact.surfaces.joined_spectrum import joined_spectrum
from hardcontact.surfaces.scans import flat_measurements

with job(snakemake) as this:
    params = this.parameters
    measurements = flat_measurements(
        this.input.measurements, params["sphere_radius"], params["levelling"]
    )
    this.write(
        joined_spectrum(measurements, params["tip_radii"]),
        title="power spectral density of a measured surface, joined of its measurements",
    )
