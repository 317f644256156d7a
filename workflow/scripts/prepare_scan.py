"""A measured scan: levelled, the sphere subtracted if there is one; stitched."""

from hardcontact.base.job import job
from hardcontact.surfaces.scans import LEVELLED, STITCHED, level_and_stitch, read_stored

with job(snakemake) as job:
    levelled, stitched = level_and_stitch(
        read_stored(job.input.measurement), "measured", **job.parameters
    )
    job.write(levelled, LEVELLED, "scan")
    job.write(stitched, STITCHED, "stitched")
