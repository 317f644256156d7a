"""Values with bounds, published values with their uncertainty, labels of surfaces."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from hardcontact.report.figures import tables

FITS = xr.Dataset(
    {
        "force": ("surface", [1.0, 2.0]),
        "force_interval": (("surface", "bound"), [[0.8, 1.2], [1.6, np.nan]]),
        "label": ("surface", ["UNCD", "MCD"]),
        "basis": ("surface", ["measured", "substitute"]),
    },
    {"surface": ["uncd", "mcd"], "bound": ["low", "high"]},
)
CONSTANTS = pd.DataFrame(
    {"value": [0.05, 43.0], "uncertainty": [0.01, np.nan]},
    index=["work_of_adhesion", "edge_small"],
)


def test_values_have_the_ends_of_their_interval():
    curves = tables.value_and_interval(FITS, "force")
    assert list(curves["low"]) == [0.8, 1.6] and curves["high"].isnull().values.tolist() == [0, 1]
    assert "bound" not in curves.coords
    assert tables.value_and_bounds(FITS.sel(surface="uncd"), "force") == {
        "value": 1.0, "low": 0.8, "high": 1.2,
    }  # fmt: skip


def test_published_values_have_the_ends_of_their_uncertainty():
    assert tables.published_edge(CONSTANTS, "small") == 43
    (row,) = tables.published_rows(CONSTANTS, {"work_of_adhesion": "J/m2"}, "b").to_dict("records")
    assert row["origin"] == "published" and row["unit"] == "J/m2"
    assert np.allclose([row[end] for end in ("value", "low", "high")], [0.05, 0.04, 0.06])


def test_rows_have_the_label_of_their_surface():
    rows = pd.DataFrame({"group": ["mcd", "pooled"]})
    table = tables.label_rows([rows], FITS, ["group", "label", "basis"], "group")
    assert table.iloc[0].tolist() == ["mcd", "MCD", "substitute"]
    assert table.loc[1, "group"] == "pooled" and table.loc[1, ["label", "basis"]].isna().all()


def test_sets_are_summarized_by_the_median_and_the_central_nine_tenths():
    values = xr.DataArray(np.arange(101.0), dims="set")
    summary = tables.summarize_sets(values[::-1])
    numbers = {str(name): number.item() for name, number in summary.items()}
    assert numbers == pytest.approx({"value": 50.0, "low": 5.0, "high": 95.0})
