"""Substitute scans that are made together: levelled, and mirrored."""

from hardcontact.records.job import run_job
from hardcontact.surfaces.features import make_featured_scans
from hardcontact.surfaces.levelling import LEVELLED_TITLE, MIRRORED_TITLE, level_and_mirror
from hardcontact.surfaces.substitutes import condition_batch, conditioned_scan, read_substitute

with run_job(snakemake) as job:
    params = job.parameters
    substitute = read_substitute(
        params["surface"], job.input.substitute, params["scan_grid"], params["seed"]
    )
    scan_numbers = params["scan_numbers"]
    if params["has_features"]:
        conditioning, scans = make_featured_scans(substitute, scan_numbers)
    else:
        conditioning = condition_batch(substitute, substitute.targets, scan_numbers)
        scans = [
            conditioned_scan(substitute, number, conditioning, params["sphere_radius"])
            for number in scan_numbers
        ]
    title = f"how substitute scans of {params['surface']} meet Table 1"
    job.write(conditioning, title, "conditioning")
    for number, scan in zip(scan_numbers, scans, strict=True):
        levelled, mirrored = level_and_mirror(scan, params["sphere_radius"])
        job.write(levelled, LEVELLED_TITLE, f"levelled_{number}")
        job.write(mirrored, MIRRORED_TITLE, f"mirrored_{number}")
