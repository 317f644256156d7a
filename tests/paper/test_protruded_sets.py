"""Protruded surfaces in sets: forces of their scans, and fits with these in place of others."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from small_pool import SOURCES

from hardcontact.paper.inference import Pair, Published
from hardcontact.paper.protruded_sets import (
    compute_protruded,
    judge_protruded,
    none_protruded,
)

RANGES = np.geomspace(0.5, 20, 9)
PAIR = Pair(5.0, 0.05)


def test_a_surface_does_not_depend_on_those_computed_with_it():
    both = compute_protruded([1, 2], 2, SOURCES)
    alone = compute_protruded([2], 2, SOURCES)
    assert both["pull_off_force"].sizes == {"variant": 2, "rho": 3, "contact": 2 * 2 * 2}
    xr.testing.assert_equal(both.sel(variant=[2]), alone)


def test_the_pair_is_that_of_forces_that_agree():
    """Forces that fall as exp(-m/rho) give the pair that the measured ones were made with."""
    heights = {"smooth": 12.0, "rough": 40.0, "rougher": 70.0}
    curves = {name: 1e-3 * np.exp(-height / RANGES) for name, height in heights.items()}
    measured = {
        name: PAIR[1] * 1e-3 * np.exp(-height / PAIR[0]) for name, height in heights.items()
    }
    forces = pd.DataFrame({"mean_force": measured, "median_force": measured})
    curves["smooth"] = curves["smooth"] * 3  # what the protruded surface replaces
    sets = xr.Dataset(
        {
            "mean_force": (("set", "surface", "rho"), [list(curves.values())] * 2),
            "sphere_factor": (("surface", "rho"), np.full((3, RANGES.size), 0.5)),
        },
        {"set": [1, 2], "surface": list(heights), "rho": RANGES},
    )
    # Two contacts with this mean on a smooth sphere, which roughness of the sphere halves.
    on_smooth = 2 * 1e-3 * np.exp(-heights["smooth"] / RANGES)
    protruded = xr.Dataset(
        {
            "pull_off_force": (
                ("variant", "rho", "contact"),
                (on_smooth[:, None] * [0.5, 1.5])[None],
            ),
            "density": ("variant", [1.0]),
            "height": ("variant", [4.0]),
            "width": ("variant", [50.0]),
        },
        {"variant": [7], "rho": RANGES},
    )
    judged = judge_protruded(protruded, "smooth", sets, Published(forces, PAIR)).sel(variant=7)
    np.testing.assert_allclose(judged["range_of_adhesion"], PAIR[0], rtol=0.01)
    np.testing.assert_allclose(judged["work_of_adhesion"], PAIR[1], rtol=0.03)
    np.testing.assert_allclose(judged["mean_force"], measured["smooth"], rtol=0.03)
    assert judged["agrees"].values.tolist() == [1, 1]
    forces.loc["smooth", "median_force"] /= 3  # the two contacts have a median that is the mean
    other = judge_protruded(protruded, "smooth", sets, Published(forces, PAIR))
    assert other["agrees"].values.tolist() == [[0, 0]]
    assert judged["mean_at_published"].item() == pytest.approx(measured["smooth"], rel=1e-3)
    assert judged["spread_at_published"].item() == pytest.approx(np.log(3) / 2)
    none = judge_protruded(none_protruded(RANGES), "smooth", sets, Published(forces, PAIR))
    assert none["agrees"].sizes == {"variant": 0, "set": 2}
