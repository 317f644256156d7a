"""Exponents of the pull-off force and of the edges of the band: exponents.nc."""

import xarray as xr

from hardcontact.base.dataset import add_surface_names
from hardcontact.inference.filtered_masters import read_master_forces
from hardcontact.paper.exponents import edge_exponents, force_exponent
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    tolerance, confidence = params["tolerance"], params["confidence"]
    forces = read_master_forces(params["surfaces"], job.input.masters, params["realizations"])
    scaled = forces.squeeze("rho", drop=True).swap_dims(loading="contact_area").drop_vars("loading")
    exponents = xr.merge(
        [
            force_exponent(scaled, params["contact_area"], confidence),
            edge_exponents(scaled, tolerance, confidence),
        ]
    )
    job.write(
        add_surface_names(exponents, params).assign_attrs(
            contact_area=params["contact_area"], tolerance=tolerance, confidence=confidence
        ),
        title="exponents of the pull-off force and of the edges of the critical band",
    )
