"""Substitute scans that are made together: levelled, and stitched."""

from hardcontact.base.job import run_job
from hardcontact.surfaces.conditioning import conditioned_group
from hardcontact.surfaces.featured_scans import featured_group
from hardcontact.surfaces.height_map import LEVELLED, STITCHED, level_and_stitch

with run_job(snakemake) as job:
    params = job.parameters
    make_group = featured_group if params["has_features"] else conditioned_group
    conditioning, scans = make_group(job.input, params)
    title = f"how substitute scans of {params['surface']} meet Table 1"
    job.write(conditioning, title, "conditioning")
    for number, scan in zip(params["scans"], scans, strict=True):
        levelled, stitched = level_and_stitch(scan, params["sphere_radius"])
        job.write(levelled, LEVELLED, f"levelled_{number}")
        job.write(stitched, STITCHED, f"stitched_{number}")
