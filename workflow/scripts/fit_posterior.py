"""Posterior of range and work of adhesion, from scans and from whole surfaces: posterior.nc."""

from hardcontact.base import published
from hardcontact.base.dataset import concatenate, read, read_all
from hardcontact.base.statistics import Sampling
from hardcontact.contact.contact import PLASTIC
from hardcontact.paper.posterior import study_posteriors
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    sampling = Sampling.from_parameters(params["sampling"], "posterior")
    published_forces = published.read_published_forces(job.input.published_pull_off)
    sets = read(job.input.sets).sel(contact_model=PLASTIC)
    files = read_all(params["whole_surfaces"], job.input.whole_surfaces)
    whole_surfaces = {
        surface: maps["pull_off_force"].sel(contact_model=PLASTIC)
        for (surface,), maps in concatenate(files, "map", 1).items()
    }
    job.write(
        study_posteriors(sets, whole_surfaces, published_forces, sampling),
        title="range and work of adhesion that explain the published forces, by weight",
    )
