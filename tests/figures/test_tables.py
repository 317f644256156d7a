"""Values with bounds, published values with their uncertainty, labels of surfaces."""

import numpy as np
import pandas as pd
import xarray as xr
from figure_inputs.adhesion import WORK, inference
from figure_inputs.published_tables import published_constants

from hardcontact.figures.tables import (
    bounded,
    computed_rows,
    labelled,
    over_sets,
    published_edge,
    published_value,
    value_and_bounds,
)


def test_bounded_has_value_low_and_high():
    data = inference()
    curves = bounded(data, "mean_force")
    xr.testing.assert_equal(curves["value"], data["mean_force"].rename("value"))
    assert np.allclose(curves["low"], 0.8 * curves["value"])
    assert np.allclose(curves["high"], 1.2 * curves["value"])
    assert "bound" not in curves.coords


def test_rows_are_those_of_known_values():
    values = xr.Dataset(
        {"value": ("side", [3.0, np.nan]), "low": ("side", [2.0, 1.0])}, {"side": ["a", "b"]}
    )
    (row,) = computed_rows(values, panel="c", quantity="edge").to_dict("records")
    assert row == {
        "side": "a", "value": 3.0, "low": 2.0, "origin": "computed", "panel": "c",
        "quantity": "edge",
    }  # fmt: skip


def test_one_number_with_its_bounds():
    fit = inference().sel(contact_model="plastic")
    interval = fit["work_of_adhesion_interval"].values
    assert value_and_bounds(fit, "work_of_adhesion") == {
        "value": WORK,
        "low": interval[0],
        "high": interval[1],
    }


def test_published_values_have_the_ends_of_their_uncertainty():
    constants = published_constants()
    work = published_value(constants, "work_of_adhesion")
    assert np.allclose(list(work.values()), [0.0463, 0.0428, 0.0498])
    cutoff = published_value(constants, "critical_wavelength_small")
    assert cutoff["value"] == 43 and np.isnan([cutoff["low"], cutoff["high"]]).all()
    assert published_edge(constants, "small") == 43 and published_edge(constants, "large") == 1800


def test_rows_get_the_label_of_their_surface():
    rows = pd.DataFrame({"group": ["mcd", "pooled"]})
    table = labelled([rows], inference(), ["group", "label", "basis"], "group")
    assert table.iloc[0].tolist() == ["mcd", "MCD", "substitute"]
    assert table.loc[1, "group"] == "pooled" and table.loc[1, ["label", "basis"]].isna().all()


def test_sets_are_summed_up_by_values_of_their_own():
    values = xr.DataArray(np.arange(100.0), dims="set")
    summary = over_sets(values[::-1])
    numbers = {str(name): number.item() for name, number in summary.items()}
    assert numbers == {"value": 49.0, "low": 4.0, "high": 94.0}
