"""Pull-off forces on some surfaces with rare protrusions."""

from hardcontact.base.job import job
from hardcontact.paper.pool import read_pool_sources
from hardcontact.paper.protruded_sets import compute_protruded

with job(snakemake) as job:
    params = job.parameters
    numbers = range(params["first"], params["last"] + 1)
    job.write(
        compute_protruded(numbers, params["scans"], read_pool_sources(job.input, params)),
        title=f"pull-off forces on {params['surface']} with protrusions",
    )
