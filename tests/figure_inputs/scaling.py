"""Edges of the band over radii, ranges and contact areas, as numbers without meaning."""

import numpy as np
import xarray as xr

from figure_inputs.building import bounded, named
from hardcontact.insight.closed_form import MANY_POINTS, SINGLE_PEAKS
from hardcontact.insight.edge_scaling import CONTACT, LENGTHS, PARTS, RANGE, REACH, ROLL_OFF

RADII, AREAS, RANGES = [5e3, 250e3, 1e6], [50.0, 400.0, 3200.0], [1.4, 5.6, 11.2]
CASES = ("side", "surface", "radius", "area", "rho")


def scaling() -> xr.Dataset:
    """Return edges that differ by all they depend on; one of them is open."""
    edge = 40 + np.arange(2 * 4 * 27.0).reshape(2, 4, 3, 3, 3)
    edge[1] *= 20
    edge[1, 0, 0, 1, 0] = np.nan
    exponent = np.linspace(-0.2, 1.2, 2 * 4 * 3 * 3).reshape(2, 4, 3, 3)
    fits = ("side", "surface", "part")
    data = named().assign_coords(
        side=["small", "large"],
        radius=RADII,
        area=AREAS,
        rho=RANGES,
        part=PARTS,
        length=LENGTHS,
        cause=[CONTACT, RANGE],
    )
    data = data.assign(
        bounded("edge", CASES, edge, unit="nm")
        | bounded("exponent", (*fits, "length"), exponent)
        | bounded("reach_exponent", fits, exponent[..., 0])
        | bounded("cause_exponent", ("cause", "length"), np.array([[0.1, 0.2, 1], [0.1, 0.9, 0.3]]))
    )
    return data.assign(
        dependence=((*fits, "length"), np.full(exponent.shape, "independent", "<U12")),
        edges_found=(fits, np.full(exponent.shape[:3], 27)),
        reach=np.sqrt(2 * data["radius"] * data["rho"]),
        contact_area=(("side", "area"), [AREAS, AREAS]),
        rms_height=("surface", [4.0, 17, 97, 101]),
        roll_off=("surface", [740.0, 1000, 2500, 2700]),
        rough_height=("surface", [4.0, 17, 97, 101]),
        approach=("surface", [10.0, 60, 300, 330]),
        freezing=("surface", [0.3, 0.9, 5.6, 5.5]),
        regime=("surface", [MANY_POINTS, MANY_POINTS, SINGLE_PEAKS, SINGLE_PEAKS]),
        predicted_edge=(("surface", "side"), [[np.nan, 1200], [40, 1500], [50, 1600], [20, 1800]]),
        short_edge_from=("surface", ["", RANGE, RANGE, CONTACT]),
        long_edge_from=("surface", [ROLL_OFF, ROLL_OFF, REACH, REACH]),
        cause_edges=("cause", [20, 70]),
        contact_diameter=((), 22.6),
        attraction_reach=((), 1673.0),
    ).assign_attrs(sphere_radius=250e3, rho=5.6, area=400.0)
