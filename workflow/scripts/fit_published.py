"""Range and work of adhesion of every contact model, and statistics of its forces: fit.nc."""

from hardcontact.base.dataset import read_dataset
from hardcontact.base.statistics import Sampling
from hardcontact.inference.published_fit import PublishedForces, fit_published
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    fit = fit_published(
        read_dataset(job.input.adhesion),
        PublishedForces.read(job.input.published_pull_off, job.input.published_constants),
        job.parameters["reference_surface"],
        Sampling.from_parameters(job.parameters["sampling"]),
    )
    job.write(fit, title="range and work of adhesion and force statistics")
