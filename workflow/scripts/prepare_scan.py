"""A measured scan: levelled, the sphere subtracted if there is one; stitched."""

from hardcontact.records.job import run_job
from hardcontact.surfaces.height_map import load_height_map
from hardcontact.surfaces.levelling import LEVELLED, STITCHED, level_and_stitch

with run_job(snakemake) as job:
    scan = load_height_map(job.input.measurement)
    levelled, stitched = level_and_stitch(scan, **job.parameters)
    job.write(levelled, LEVELLED, "scan")
    job.write(stitched, STITCHED, "stitched")
