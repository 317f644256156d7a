"""Pull-off forces of some scans of the pool of one substrate, at several heights of each."""

from hardcontact.base.job import run_job
from hardcontact.paper.pool import compute_pool, read_pool_inputs

with run_job(snakemake) as job:
    params = job.parameters
    surface = params["surface"]
    numbers = range(params["first"], params["last"] + 1)
    job.write(
        compute_pool(numbers, read_pool_inputs(job.input, params)),
        title=f"pull-off forces of scans {numbers[0]} to {numbers[-1]} of the pool of {surface}",
    )
