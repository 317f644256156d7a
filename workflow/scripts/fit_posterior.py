"""Posterior of range and work of adhesion, from scans and from whole surfaces: posterior.nc."""

from hardcontact.base import published
from hardcontact.base.dataset import concatenate, read, read_all, stack
from hardcontact.base.statistics import Sampling
from hardcontact.contact.contact import PLASTIC
from hardcontact.paper.posterior import means_on_whole_surfaces, posteriors_without_each_surface
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    sampling = Sampling.from_parameters(params["sampling"], "posterior")
    published_forces = published.read_measured_statistics(job.input.published_pull_off)
    sets = read(job.input.sets).sel(contact_model=PLASTIC)
    forces = {"scans": sets["mean_force"].rename(set="replicate")}
    files = read_all(params["whole_surfaces"], job.input.whole_surfaces)
    if files:
        surfaces = {
            surface: maps["pull_off_force"].sel(contact_model=PLASTIC)
            for (surface,), maps in concatenate(files, "map", 1).items()
        }
        forces["whole surfaces"] = means_on_whole_surfaces(
            surfaces, sets["sphere_factor"], sampling
        )
    posteriors = {
        (name,): posteriors_without_each_surface(mean_forces, published_forces, sampling)
        for name, mean_forces in forces.items()
    }
    job.write(
        stack(posteriors, ["forces_on"])
        .assign_coords(surface=sets["surface"])
        .assign_attrs(confidence=sampling.confidence),
        title="range and work of adhesion that explain the published forces, by weight",
    )
