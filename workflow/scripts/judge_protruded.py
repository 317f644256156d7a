"""Range and work of adhesion of all sets if one surface had rare protrusions."""

import xarray as xr

from hardcontact.base import dataset, published
from hardcontact.base.job import job
from hardcontact.paper.inference import PLASTIC, Pair, Published
from hardcontact.paper.protruded_sets import judge_protruded, none_protruded

with job(snakemake) as job:
    constants = published.constants(job.input.published_constants)
    pair = Pair(*constants.loc[["range_of_adhesion", "work_of_adhesion"], "value"])
    sets = dataset.read(job.input.sets).sel(contact_model=PLASTIC)
    surfaces = [dataset.read(path) for path in job.input.protruded]
    none = none_protruded(sets["rho"].values)  # without substitutes
    protruded = xr.concat(surfaces, "variant") if surfaces else none
    fits = judge_protruded(
        protruded,
        job.parameters["surface"],
        sets,
        Published(published.pull_off(job.input.published_pull_off), pair),
    )
    job.write(
        fits.assign_attrs(job.parameters),
        title="range and work of adhesion if one surface had protrusions",
    )
