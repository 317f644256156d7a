"""Pull-off forces on scans of some surfaces with features, whose roughness is that of Table 1."""

from hardcontact.base.job import run_job
from hardcontact.paper.featured_samples import compute_samples, read_sample_inputs

with run_job(snakemake) as job:
    params = job.parameters
    numbers = range(params["first"], params["last"] + 1)
    job.write(
        compute_samples(params["features"], numbers, read_sample_inputs(job.input, params)),
        title=f"pull-off forces on surfaces of {params['surface']} with features: "
        f"{params['features']}",
    )
