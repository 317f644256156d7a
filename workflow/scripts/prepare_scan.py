"""A measured scan: levelled, the sphere subtracted if there is one; then mirrored."""

from hardcontact.records.job import run_job
from hardcontact.surfaces.height_map import load_height_map
from hardcontact.surfaces.levelling import LEVELLED_TITLE, MIRRORED_TITLE, level_and_mirror

with run_job(snakemake) as job:
    scan = load_height_map(job.input.measurement)
    levelled, mirrored = level_and_mirror(scan, **job.parameters)
    job.write(levelled, LEVELLED_TITLE, "levelled")
    job.write(mirrored, MIRRORED_TITLE, "mirrored")
