"""Range and work of adhesion of every contact model, and statistics of its forces: fit.nc."""

from hardcontact.base.dataset import read_dataset
from hardcontact.base.statistics import Sampling
from hardcontact.inference.published_fit import PublishedForces, fit_published
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    job.write(
        fit_published(
            read_dataset(job.input.adhesion),
            PublishedForces.read(job.input.published_pull_off, job.input.published_constants),
            params["reference_surface"],
            Sampling.from_parameters(params["sampling"]),
        ),
        title="range and work of adhesion and force statistics",
    )
