"""Range and work of adhesion fitted without one surface, of the study and of all sets."""

import xarray as xr

from hardcontact.base import dataset, published
from hardcontact.base.job import job
from hardcontact.paper.leave_one_out import leave_one_out_fits

with job(snakemake) as job:
    measured = published.pull_off(job.input.published_pull_off)["mean_force"]
    inference = dataset.read(job.input.inference)
    fits = leave_one_out_fits(inference["mean_force"], measured)
    set_fits = leave_one_out_fits(dataset.read(job.input.sets)["mean_force"], measured)
    set_fits = set_fits.rename({name: f"set_{name}" for name in set_fits.data_vars})
    job.write(
        xr.merge([fits, set_fits, inference[["label", "basis"]]], combine_attrs="drop_conflicts"),
        title="range and work of adhesion fitted without one surface",
    )
