"""Exponents of forces and edges (exponents.nc), and causes of short edges (enhancement.nc)."""

import xarray as xr

from hardcontact.base.job import run_job
from hardcontact.base.statistics import Sampling
from hardcontact.contact.stacked_datasets import add_names
from hardcontact.inference.master_datasets import read_master_forces
from hardcontact.paper.enhancement import edges_by_contact
from hardcontact.paper.exponents import edge_exponents, force_exponent

with run_job(snakemake) as job:
    params = job.parameters
    area, tolerance = params["area"], params["tolerance"]
    sampling = Sampling.from_parameters(params["sampling"])
    confidence = sampling.confidence
    forces = {
        purpose: read_master_forces(surfaces, job.input[purpose], params["realizations"])
        for purpose, surfaces in params["surfaces"].items()
    }
    scaled = forces["exponents"].squeeze("rho", drop=True).swap_dims(load="area").drop_vars("load")
    exponents = xr.merge(
        [
            force_exponent(scaled, area, confidence),
            edge_exponents(scaled, tolerance, confidence),
        ]
    )
    job.write(
        add_names(exponents, params).assign_attrs(
            area=area, tolerance=tolerance, confidence=confidence
        ),
        title="exponents of the pull-off force and of the edges of the critical band",
        output="exponents",
    )
    edges = edges_by_contact(forces["enhancement"], tolerance, sampling)
    job.write(
        add_names(edges, params).assign_attrs(tolerance=tolerance, confidence=confidence),
        title="short edges of plastic and rigid contact at two ranges of adhesion",
        output="enhancement",
    )
