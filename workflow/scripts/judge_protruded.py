"""Range and work of adhesion of all sets if one surface had rare protrusions."""

import xarray as xr

from hardcontact.base import dataset, published
from hardcontact.base.job import job
from hardcontact.paper.inference import PLASTIC, Pair, Published
from hardcontact.paper.protruded_sets import judge_protruded, none_protruded

with job(snakemake) as this:
    constants = published.constants(this.input.published_constants)
    pair = Pair(*constants.loc[["range_of_adhesion", "work_of_adhesion"], "value"])
    sets = dataset.read(this.input.sets).sel(contact_model=PLASTIC)
    surfaces = [dataset.read(path) for path in this.input.protruded]
    none = none_protruded(sets["rho"].values)  # without substitutes
    protruded = xr.concat(surfaces, "variant") if surfaces else none
    fits = judge_protruded(
        protruded,
        this.parameters["surface"],
        sets,
        Published(published.pull_off(this.input.published_pull_off), pair),
    )
    this.write(
        fits.assign_attrs(this.parameters),
        title="range and work of adhesion if one surface had protrusions",
    )
