"""How the edges of the critical band scale with R, rho and the contact area: scaling.nc."""

import pandas as pd

from hardcontact.adhesion.pull_off import WORK_OF_ADHESION
from hardcontact.insight.closed_form import Contact
from hardcontact.insight.edge_scaling import (
    designed_edges,
    edge_scaling,
    formula_scaling,
    stacked_scaling,
)
from hardcontact.numbers.statistics import Sampling
from hardcontact.records.dataset import read_all
from hardcontact.records.job import job
from hardcontact.surfaces.spectrum import read_spectrum

with job(snakemake) as this:
    given = this.parameters
    paths = zip(given["surfaces"], this.input.spectra, strict=True)
    spectra = {surface: read_spectrum(path) for surface, path in paths}
    scaling = stacked_scaling(
        read_all(given["masters"], this.input.masters),
        spectra,
        {"labels": given["labels"], "basis": given["basis"]},
    )
    edges = edge_scaling(
        scaling,
        given["tolerance"],
        Sampling(given["seed"], given["samples"], given["confidence"]),
    )
    contact = Contact(given["sphere_radius"], given["rho"], WORK_OF_ADHESION, given["area"])
    tables = (pd.read_csv(path) for path in (this.input.computed, this.input.formulas))
    this.write(
        edges.merge(formula_scaling(edges, spectra, contact))
        .merge(designed_edges(*tables))
        .assign_attrs({name: given[name] for name in ("sphere_radius", "rho", "area")}),
        title="edges of the critical band over radii, ranges of adhesion and contact areas",
    )
