"""Posterior of range and work of adhesion, from scans and from whole surfaces: posterior.nc."""

from hardcontact.base import published
from hardcontact.base.dataset import read, read_all, stack
from hardcontact.base.job import job
from hardcontact.base.statistics import Sampling
from hardcontact.contact.contact import PLASTIC
from hardcontact.inference.octaves import join_maps
from hardcontact.inference.posterior import sampled_means, without_each_surface

with job(snakemake) as job:
    params = job.parameters
    sampling = Sampling(params["seed"], params["samples"], params["confidence"], ("posterior",))
    measured = published.pull_off(job.input.published_pull_off)
    sets = read(job.input.sets).sel(contact_model=PLASTIC)
    whole = join_maps(read_all(params["whole"], job.input.whole))
    maps = {
        surface: forces["pull_off_force"].sel(contact_model=PLASTIC)
        for surface, forces in whole.items()
    }
    # Whole surfaces meet a smooth sphere; the sets know what the roughness of the sphere does.
    sphere_factor = sets["sphere_factor"].interp(rho=next(iter(maps.values()))["rho"])
    forces = {"scans": sets["mean_force"].rename(set="draw")}
    if maps:
        forces["whole surfaces"] = sampled_means(maps, sampling) * sphere_factor
    posteriors = {
        (name,): without_each_surface(mean_forces, measured, sampling)
        for name, mean_forces in forces.items()
    }
    job.write(
        stack(posteriors, ["forces_on"])
        .assign_coords(surface=sets["surface"])
        .assign_attrs(confidence=params["confidence"]),
        title="range and work of adhesion that explain the published forces, by weight",
    )
