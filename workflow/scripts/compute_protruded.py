"""Pull-off forces on some surfaces with rare protrusions."""

from hardcontact.base import dataset, published
from hardcontact.base.job import job
from hardcontact.paper.pool import pool_sources
from hardcontact.paper.protruded_sets import compute_protruded

with job(snakemake) as job:
    params = job.parameters
    sources = pool_sources(
        dataset.read(job.input.spectrum),
        published.table1(job.input.published_table1),
        published.constants(job.input.published_constants),
        params,
    )
    numbers = range(params["first"], params["last"] + 1)
    job.write(
        compute_protruded(numbers, params["scans"], sources),
        title=f"pull-off forces on {params['surface']} with protrusions",
    )
