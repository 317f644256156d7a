"""How the edges of the critical band scale with R, rho and the contact area: scaling.nc."""

import pandas as pd
import xarray as xr

from hardcontact.base.dataset import read
from hardcontact.base.job import job
from hardcontact.base.statistics import Sampling
from hardcontact.contact.all_surfaces import single_masters
from hardcontact.contact.contact import contact_of_area
from hardcontact.contact.pull_off import WORK_OF_ADHESION
from hardcontact.surfaces.spectrum import read_spectrum
from hardcontact.theory.edge_scaling import (
    designed_edge_errors,
    edge_scaling,
    force_exponent,
    stack_scaling,
)

with job(snakemake) as job:
    params = job.parameters
    paths = zip(params["surfaces"], job.input.spectra, strict=True)
    spectra = {surface: read_spectrum(path) for surface, path in paths}
    keys = [[surface] for surface in params["masters"]]
    masters = zip(keys, map(read, job.input.masters), strict=True)
    scaling = stack_scaling(
        single_masters(masters, params["realizations"]),
        {"labels": params["labels"], "basis": params["basis"]},
    )
    contact = contact_of_area(
        params["sphere_radius"], params["rho"], WORK_OF_ADHESION, params["area"]
    )
    edges = edge_scaling(
        scaling,
        spectra,
        contact,
        params["tolerance"],
        Sampling(params["seed"], params["samples"], params["confidence"]),
    )
    forces = force_exponent(scaling, contact, params["confidence"])
    designed = designed_edge_errors(
        pd.read_csv(job.input.computed), pd.read_csv(job.input.formulas)
    )
    job.write(
        xr.merge([edges, forces, designed]).assign_attrs(
            {name: params[name] for name in ("sphere_radius", "rho", "area")}
        ),
        title="edges of the critical band over radii, ranges of adhesion and contact areas",
    )
