"""Pull-off forces of some scans of the pool of one substrate, at several heights of each."""

from hardcontact.base.job import job
from hardcontact.paper.pool import compute_pool, read_pool_sources

with job(snakemake) as job:
    params = job.parameters
    first, last = params["first"], params["last"]
    job.write(
        compute_pool(range(first, last + 1), read_pool_sources(job.input, params)),
        title=f"pull-off forces of scans {first} to {last} of the pool of {params['surface']}",
    )
