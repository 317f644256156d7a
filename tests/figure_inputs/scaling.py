"""Edges of the band over radii, ranges and contact areas, as numbers without meaning."""

import numpy as np
import xarray as xr

from figure_inputs.building import bounded, named
from hardcontact.insight.edge_scaling import (
    CLOSED_FORM,
    FORMULA,
    LENGTHS,
)

RADII, AREAS, RANGES = [5e3, 250e3, 1e6], [50.0, 400.0, 3200.0], [1.4, 5.6, 11.2]
CASES = ("side", "surface", "radius", "area", "rho")
DESIGNED = ["0", "1", "2", "crn_rougher", "crn_smoother"]


def scaling() -> xr.Dataset:
    """Return edges that differ by all they depend on; one of them is open."""
    edge = 40 + np.arange(2 * 4 * 27.0).reshape(2, 4, 3, 3, 3)
    edge[1] *= 20
    formula = 1.1 * edge
    edge[1, 0, 0, 1, 0] = np.nan
    exponent = np.linspace(-0.2, 1.2, 2 * 4 * 3).reshape(2, 4, 3)
    errors = np.linspace(0.5, 2, 2 * 2 * 5).reshape(2, 2, 5)
    errors[..., 3:] = np.nan
    data = named().assign_coords(
        side=["small", "large"],
        radius=RADII,
        area=AREAS,
        rho=RANGES,
        length=list(LENGTHS),
        prediction=[FORMULA, CLOSED_FORM],
        designed=DESIGNED,
    )
    data = data.assign(
        bounded("edge", CASES, edge, unit="nm")
        | bounded("exponent", ("side", "surface", "length"), exponent)
    )
    return data.assign(
        formula_edge=(CASES, formula),
        reach=np.sqrt(2 * data["radius"] * data["rho"]),
        over_range=("surface", [0.6, 3.2, 20.0, 23.0]),
        approach_level=("surface", [2.5, 3.2, 3.0, 3.0]),
        contact_over_rolloff=("surface", [0.03, 0.02, 0.01, 0.01]),
        designed_over_range=("designed", [0.5, 1.0, 9.0, 167.0, 1.8]),
        designed_level=("designed", [3.0, 2.0, 2.5, 1.5, 2.9]),
        designed_contact_over_rolloff=("designed", [0.03, 0.02, 0.01, 3e-4, 4e-3]),
        held_back=("designed", [1, 1, 1, 0, 0]),
        designed_error=(("prediction", "side", "designed"), errors),
        designed_bound=(("side", "designed"), [[0, 1, 0, 0, 0], [0] * 5]),
    ).assign_attrs(sphere_radius=250e3, rho=5.6, area=400.0, tolerance=0.1)
