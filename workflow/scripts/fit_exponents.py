"""How the pull-off force and the short edge of the band scale: scaling.nc."""

import xarray as xr

from hardcontact.base.dataset import read
from hardcontact.base.job import job
from hardcontact.contact.all_surfaces import Described, single_masters, stacked_forces, with_names
from hardcontact.inference.scaling import force_exponent, short_edge_exponents

with job(snakemake) as job:
    params = job.parameters
    keys = [[surface] for surface in params["masters"]]
    masters = zip(keys, map(read, job.input.masters), strict=True)
    forces = stacked_forces(single_masters(masters, params["realizations"]))
    forces = forces.squeeze("rho", drop=True).swap_dims(load="area").drop_vars("load")
    exponents = xr.merge(
        [
            force_exponent(forces, params["area"], params["confidence"]),
            short_edge_exponents(forces, params["tolerance"], params["confidence"]),
        ]
    )
    job.write(
        with_names(
            exponents, Described(labels=params["labels"], basis=params["basis"])
        ).assign_attrs({name: params[name] for name in ("area", "tolerance", "confidence")}),
        title="exponents of the pull-off force and of the short edge of the critical band",
    )
