"""Pull-off forces of some scans of the pool of one substrate, at several heights of each."""

from hardcontact.base import dataset, published
from hardcontact.base.job import job
from hardcontact.paper.pool import compute_pool, pool_sources

with job(snakemake) as job:
    params = job.parameters
    sources = pool_sources(
        dataset.read(job.input.spectrum),
        published.table1(job.input.published_table1),
        published.constants(job.input.published_constants),
        params,
    )
    first, last = params["first"], params["last"]
    job.write(
        compute_pool(range(first, last + 1), sources),
        title=f"pull-off forces of scans {first} to {last} of the pool of {params['surface']}",
    )
