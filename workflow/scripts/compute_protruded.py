"""Pull-off forces on some surfaces with rare protrusions on them or on the sphere."""

from hardcontact.base import published
from hardcontact.base.job import job
from hardcontact.paper.pool import read_pool_sources
from hardcontact.paper.protruded_sets import compute_protruded_forces, published_roughness

with job(snakemake) as job:
    params = job.parameters
    roughness = published_roughness(
        published.table1(job.input.published_table1),
        published.constants(job.input.published_constants),
        params["coating"],
    )
    sources = read_pool_sources(job.input, params)
    numbers = range(params["first"], params["last"] + 1)
    job.write(
        compute_protruded_forces(
            numbers, params["scans"], sources, roughness, params["protruded_body"]
        ),
        title=f"pull-off forces on {params['surface']} with protrusions of "
        f"{params['protruded_body']}",
    )
