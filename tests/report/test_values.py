"""Values with bounds, values over sets, published edges, maps without padding."""

import numpy as np
import pytest
import xarray as xr

from hardcontact.report.figures import values

FITS = xr.Dataset(
    {
        "force": ("surface", [1.0, 2.0]),
        "force_interval": (("surface", "bound"), [[0.8, 1.2], [1.6, np.nan]]),
    },
    {"surface": ["uncd", "mcd"], "bound": ["low", "high"]},
)


def test_values_have_the_ends_of_their_interval():
    curves = values.value_and_interval(FITS, "force")
    assert list(curves["low"]) == [0.8, 1.6] and curves["high"].isnull().values.tolist() == [0, 1]
    assert "bound" not in curves.coords
    numbers = values.value_and_bounds(FITS.sel(surface="uncd"), "force")
    assert numbers == {"value": 1.0, "low": 0.8, "high": 1.2}


def test_sets_are_summarized_by_the_median_and_the_central_nine_tenths():
    summary = values.summarize_sets(xr.DataArray(np.arange(101.0)[::-1], dims="set"))
    numbers = {str(name): number.item() for name, number in summary.items()}
    assert numbers == pytest.approx({"value": 50.0, "low": 5.0, "high": 95.0})


def test_maps_lose_their_padding_and_their_mean():
    padded = xr.DataArray([[1.0, 3, np.nan], [2, 6, np.nan], [np.nan] * 3], dims=("row", "column"))
    assert values.mean_free_heights(padded).tolist() == [[-2, 0], [-1, 3]]
