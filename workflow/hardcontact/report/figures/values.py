"""Values as figures draw them: with their intervals, over sets, published, about a mean."""

from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.statistics import interval_ends

#: Share of the sets of substitutes between `low` and `high`: the middle of all sets.
SHARE_OF_SETS = 0.9


def value_and_interval(data: xr.Dataset, name: str) -> xr.Dataset:
    """Return a variable as `value`, with the ends of its interval, if any, as `low` and `high`."""
    value = data[[name]].rename({name: "value"})
    if f"{name}_interval" not in data:
        return value
    low, high = interval_ends(data, name)
    return value.assign(low=low, high=high)


def value_and_bounds(data: xr.Dataset, name: str) -> dict[str, Any]:
    """Return `value`, `low` and `high` of a variable with a single number."""
    return {str(end): number.item() for end, number in value_and_interval(data, name).items()}


def summarize_sets(values: xr.DataArray) -> xr.Dataset:
    """Return the median over the sets as `value`, and SHARE_OF_SETS as `low` and `high`."""
    tail = (1 - SHARE_OF_SETS) / 2
    quantiles = values.quantile([0.5, tail, 1 - tail], "set", skipna=False)
    ends = zip(("value", "low", "high"), quantiles, strict=True)
    return xr.Dataset({name: quantile.drop_vars("quantile") for name, quantile in ends})


def published_edge(constants: pd.DataFrame, side: str) -> float:
    """Return the published edge (nm) of one side of the band."""
    return float(constants["value"][f"{side}_edge"])


def mean_free_heights(heights: xr.DataArray) -> np.ndarray:
    """Return the heights (row, column) of one map minus their mean, without padding."""
    unpadded = heights.dropna("row", how="all").dropna("column", how="all").values
    return np.asarray(unpadded - unpadded.mean())
