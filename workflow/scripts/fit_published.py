"""Range and work of adhesion and force statistics of every contact model."""

from hardcontact.base import dataset, published
from hardcontact.base.statistics import Sampling
from hardcontact.paper.published_fit import PublishedForces, fit_published
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    constants = published.read_constants(job.input.published_constants)["value"]
    job.write(
        fit_published(
            dataset.read(job.input.adhesion),
            PublishedForces.read(job.input.published_pull_off, job.input.published_constants),
            params["reference_surface"],
            constants["error_threshold"],
            constants["force_floor"],
            Sampling.from_parameters(params["sampling"]),
        ),
        title="range and work of adhesion and force statistics",
    )
