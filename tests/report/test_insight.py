"""Numbers of the chapter about the causes of the band that no dataset has."""

import numpy as np
import pytest
import xarray as xr

from hardcontact.report.insight import edge_errors, half_factor, long_edge, scatter_errors


def test_half_of_the_forces_lie_within_the_median_factor():
    errors = [[[[0.5, 1.1, 0.8]], [[9, 9, 9]]]]
    data = xr.Dataset(
        {"predicted_over_computed": (("map_size", "source", "surface", "rho"), errors)},
        {"source": ["spectrum", "computed"]},
    )
    assert half_factor(data) == pytest.approx(1.25)


def test_an_open_long_edge_is_a_bound():
    data = xr.Dataset(
        {"long_edge": np.nan, "long_edge_bound": 4e3, "long_edge_bound_is_lower": 1,
         "long_edge_interval": ("bound", [np.nan, np.nan])},
        {"bound": ["low", "high"]},
    )  # fmt: skip
    assert long_edge(data)[1:3] == (4e3, "nm") and long_edge(data).status == "open_above"
    assert long_edge(data.assign(long_edge_bound_is_lower=0)).status == "open_below"
    closed = data.assign(long_edge=1e3, long_edge_bound=np.nan)
    assert (long_edge(closed).value, long_edge(closed).status) == (1e3, "no_interval")


def test_errors_of_edges_come_from_held_out_surfaces_by_regime():
    error = np.array([1.0, 2.0, 3.0, 9.0, 9.0])  # the last two: looked at, and a bound
    data = xr.Dataset(
        {
            "held_out": ("designed", [1, 1, 1, 0, 1]),
            "designed_level": ("designed", [2.0, 2, 1, 1, 1]),
            "designed_rms_height_over_range": ("designed", [1.0, 1, 2, 2, 2]),
            "designed_bound": (("side", "designed"), [[0, 0, 0, 0, 1]] * 2),
            "designed_computed_over_predicted": (
                ("prediction", "side", "designed"),
                [[error] * 2, [error**2] * 2],
            ),
        },
        {"side": ["small", "large"], "prediction": ["formula", "closed form"]},
    )
    rows = list(edge_errors(data))
    assert [(row["side"], row["regime"], row["surfaces"]) for row in rows] == [
        ("small", "many points", 2), ("small", "single peaks", 1),
        ("large", "many points", 2), ("large", "single peaks", 1),
    ]  # fmt: skip
    assert rows[0]["formula"].value == 1.5 and rows[0]["formula"].low == pytest.approx(1.05)
    assert rows[1]["closed form"].value == 9


def test_errors_of_the_law_come_from_held_out_gaussian_surfaces():
    names = ("law", "weibull", "lognormal_fitted", "lognormal_of_law")
    columns = {
        "held_out": [1, 1, 0, 1],
        "skew_parameter": [0, 0, 0, 1],
        "level": [5.0] * 4,
        "weibull_modulus": [0.5, 2, 2, 2],
        "log_force_std": [1.1, 0.5, 9, 9],
        "predicted_log_force_std": [1.0, 1, 1, 1],
    }
    columns |= {f"distance_{name}": [0.1, 0.2, 9, 9] for name in names}
    data = xr.Dataset({f"designed_{name}": ("case", values) for name, values in columns.items()})
    low_modulus, high_modulus = scatter_errors(data)
    assert (low_modulus["cases"], low_modulus["law"].value, high_modulus["weibull"].value) == (
        1,
        0.1,
        0.2,
    )
    assert (low_modulus["error"].value, high_modulus["error"].value) == pytest.approx((0.1, 1.0))
