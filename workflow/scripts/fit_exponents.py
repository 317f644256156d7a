"""How the pull-off force and the short edge of the band scale: scaling.nc."""

import xarray as xr

from hardcontact.base.job import job
from hardcontact.contact.all_surfaces import read_masters, with_names
from hardcontact.inference.scaling import force_exponent, short_edge_exponents

with job(snakemake) as job:
    params = job.parameters
    forces = read_masters(params["masters"], job.input.masters, params["realizations"])
    forces = forces.squeeze("rho", drop=True).swap_dims(load="area").drop_vars("load")
    exponents = xr.merge(
        [
            force_exponent(forces, params["area"], params["confidence"]),
            short_edge_exponents(forces, params["tolerance"], params["confidence"]),
        ]
    )
    job.write(
        with_names(exponents, params).assign_attrs(
            {name: params[name] for name in ("area", "tolerance", "confidence")}
        ),
        title="exponents of the pull-off force and of the short edge of the critical band",
    )
