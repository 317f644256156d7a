"""A measured scan: levelled, the sphere subtracted if there is one; then mirrored."""

from hardcontact.records.job import run_job
from hardcontact.surfaces.height_map import load_height_map
from hardcontact.surfaces.levelling import LEVELLED, MIRRORED, level_and_mirror

with run_job(snakemake) as job:
    scan = load_height_map(job.input.measurement)
    levelled, mirrored = level_and_mirror(scan, **job.parameters)
    job.write(levelled, LEVELLED, "levelled")
    job.write(mirrored, MIRRORED, "mirrored")
