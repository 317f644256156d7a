"""How forces and short edges scale (scaling.nc), and what moves these edges (enhancement.nc)."""

import xarray as xr

from hardcontact.base.dataset import read
from hardcontact.base.job import job
from hardcontact.base.statistics import Sampling
from hardcontact.contact.all_surfaces import Described, single_masters, stacked_forces, with_names
from hardcontact.inference.enhancement import edges_by_contact
from hardcontact.inference.scaling import force_exponent, short_edge_exponents

with job(snakemake) as job:
    params = job.parameters
    area, tolerance, confidence = params["area"], params["tolerance"], params["confidence"]
    names = Described(labels=params["labels"], basis=params["basis"])
    forces = {}
    for purpose, surfaces in params["masters"].items():
        keys = [[surface] for surface in surfaces]
        masters = zip(keys, map(read, job.input[purpose]), strict=True)
        forces[purpose] = stacked_forces(single_masters(masters, params["realizations"]))
    scaled = forces["scaling"].squeeze("rho", drop=True).swap_dims(load="area").drop_vars("load")
    exponents = xr.merge(
        [
            force_exponent(scaled, area, confidence),
            short_edge_exponents(scaled, tolerance, confidence),
        ]
    )
    job.write(
        with_names(exponents, names).assign_attrs(
            area=area, tolerance=tolerance, confidence=confidence
        ),
        title="exponents of the pull-off force and of the short edge of the critical band",
        output="scaling",
    )
    edges = edges_by_contact(
        forces["enhancement"], tolerance, Sampling(params["seed"], params["samples"], confidence)
    )
    job.write(
        with_names(edges, names).assign_attrs(tolerance=tolerance, confidence=confidence),
        title="short edges of plastic and rigid contact at two ranges of adhesion",
        output="enhancement",
    )
