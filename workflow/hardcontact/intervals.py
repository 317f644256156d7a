"""Numbers with their 95 % intervals.

A number travels as a dataset of three variables, `value`, `low` and `high`; `low` and `high`, the
ends of its 95 % interval, are NaN where no interval is known.
"""

import numpy as np
import xarray as xr
from scipy import stats

__all__ = [
    "attribute",
    "decades",
    "interval",
    "magnitude",
    "mean_over_contacts",
    "mean_over_scans",
    "quotient",
    "variable",
]

CONFIDENCE = 0.95  # of intervals over scans

#: Dimensions of single contacts: those on one scan see the same peaks.
CONTACTS = ("sphere_scan", "contact", "contact_y", "contact_x")


def attribute(dataset: xr.Dataset, name: str):
    if name not in dataset.attrs:
        raise KeyError(f"no attribute named {name!r}")
    return dataset.attrs[name]


def interval(value: xr.DataArray, low, high) -> xr.Dataset:
    """Bundle a value with the ends of its interval: arrays of its shape, or NaN for none."""
    broadcast = xr.zeros_like(value)
    return xr.Dataset({"value": value, "low": low + broadcast, "high": high + broadcast})


def variable(dataset: xr.Dataset, name: str) -> xr.Dataset:
    """A variable with its interval: its own one, or over scans if it is of single contacts."""
    value = dataset[name]
    if f"{name}_low" in dataset:
        return interval(value, dataset[f"{name}_low"], dataset[f"{name}_high"])
    if "scan" in value.dims and set(CONTACTS) & set(value.dims):
        return mean_over_scans(mean_over_contacts(value))
    return interval(value, np.nan, np.nan)


def mean_over_contacts(values: xr.DataArray) -> xr.DataArray:
    """Mean over the contacts of one scan, and over the scans of the sphere."""
    return values.mean([dim for dim in CONTACTS if dim in values.dims])


def mean_over_scans(values: xr.DataArray, dim: str = "scan") -> xr.Dataset:
    """Mean over scans, or along another dimension, with the interval of Student's t.

    Fewer than two values have no interval.
    """
    mean, count = values.mean(dim), values.count(dim)
    quantile = xr.apply_ufunc(stats.t.ppf, (1 + CONFIDENCE) / 2, count - 1)
    half = quantile * values.std(dim, ddof=1) / np.sqrt(count)
    return interval(mean, mean - half, mean + half)


def quotient(upper: xr.Dataset, lower: xr.Dataset) -> xr.Dataset:
    """Ratio of two numbers that are positive, whatever the ends of their intervals say.

    Its interval divides the ends of theirs: it is wider than 95 % if the two are independent.
    """
    return interval(
        upper["value"] / lower["value"],
        upper["low"].clip(0) / lower["high"],
        upper["high"] / lower["low"].clip(0),
    )


def magnitude(signed: xr.Dataset) -> xr.Dataset:
    """Absolute value: its interval begins at zero where that of the signed number spans it."""
    nearest = np.maximum(np.maximum(signed["low"], -signed["high"]), 0)
    return interval(np.abs(signed["value"]), nearest, np.maximum(signed["high"], -signed["low"]))


def decades(found: xr.Dataset, dim: str) -> xr.Dataset:
    """Decades between the smallest and the largest number along a dimension."""
    return np.log10(quotient(found.max(dim), found.min(dim)))
