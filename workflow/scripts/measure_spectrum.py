"""C_iso of a measured surface: joined from all its measurements, and extrapolated beyond them."""

from hardcontact.base.job import run_job
from hardcontact.surfaces.height_map import read_height_map
from hardcontact.surfaces.joined_spectrum import joined_spectrum
from hardcontact.surfaces.scan_defects import scan_with_defects

with run_job(snakemake) as job:
    params = job.parameters
    measurements = [
        scan_with_defects(read_height_map(file), params["sphere_radius"], params["levelling"])
        for file in job.input.measurements
    ]
    job.write(
        joined_spectrum(measurements, params["tip_radii"]),
        title="power spectral density of a measured surface, joined from its measurements",
    )
