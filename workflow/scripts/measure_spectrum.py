"""The spectrum of a measured surface: joined from its scans, and extrapolated beyond them."""

from hardcontact.records.job import run_job
from hardcontact.scans.defects import level_and_list_defects
from hardcontact.scans.joined_spectrum import joined_spectrum
from hardcontact.surfaces.height_map import load_height_map

with run_job(snakemake) as job:
    params = job.parameters
    scans = [
        level_and_list_defects(load_height_map(path), params["sphere_radius"], params["levelling"])
        for path in job.input.measurements
    ]
    title = "power spectral density of a measured surface, joined from its measurements"
    job.write(joined_spectrum(scans, params["tip_radii"]), title)
