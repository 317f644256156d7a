"""Posterior of range and work of adhesion, from scans and from whole surfaces: posterior.nc."""

from hardcontact.base import published
from hardcontact.base.dataset import concatenate, read_by_key, read_dataset, stack
from hardcontact.base.statistics import Sampling
from hardcontact.contact.contact import PLASTIC
from hardcontact.paper.posterior import posterior_dataset
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    sampling = Sampling.from_parameters(params["sampling"], "posterior")
    published_forces = published.read_published_forces(job.input.published_pull_off)
    sets = read_dataset(job.input.sets).sel(contact_model=PLASTIC)
    whole_surfaces = read_by_key(params["whole_surfaces"], job.input.whole_surfaces)
    forces_by_surface = concatenate(whole_surfaces, "map")
    plastic_forces = {
        surface: forces[["pull_off_force"]].sel(contact_model=PLASTIC)
        for surface, forces in forces_by_surface.items()
    }
    whole_surface_forces = None
    if plastic_forces:  # Only substitutes have whole surfaces.
        whole_surface_forces = stack(plastic_forces, ["surface"])["pull_off_force"]
    posterior = posterior_dataset(sets, whole_surface_forces, published_forces, sampling)
    job.write(posterior, title="range and work of adhesion that explain the published forces")
