"""Estimates, which are values with intervals, and their arithmetic, for claims of the paper.

An estimate is a dataset of `value` (...) and `value_interval` (..., end), NaN if not known.
"""

import numpy as np
import xarray as xr

from hardcontact.base.statistics import (
    interval_ends,
    join_ends,
    student_interval,
    student_log_interval,
)
from hardcontact.contact.contact import CONTACT_DIMENSIONS
from hardcontact.contact.pull_off import mean_over_contacts


def as_estimate(
    value: xr.DataArray, low: xr.DataArray | float = np.nan, high: xr.DataArray | float = np.nan
) -> xr.Dataset:
    """Return values and the ends of their intervals as an estimate; NaN for no interval."""
    zero = xr.zeros_like(value)  # adds the dimensions of the values to ends that are numbers
    return xr.Dataset({"value": value, "value_interval": join_ends(zero + low, zero + high)})


def variable_estimate(dataset: xr.Dataset, name: str) -> xr.Dataset:
    """Return a variable as an estimate, with the variable's interval if it has one.

    A variable of single contacts becomes its mean over contacts and scans, with an interval over
    scans. Raises KeyError if the variable or, for such an interval, ``confidence`` is missing.
    """
    value = dataset[name]
    if f"{name}_interval" in dataset:
        return as_estimate(value, *interval_ends(dataset, name))
    if "scan" in value.dims and set(CONTACT_DIMENSIONS) & set(value.dims):
        return mean_over_scans(mean_over_contacts(value), dataset.attrs["confidence"])
    return as_estimate(value)


def mean_over_scans(values: xr.DataArray, confidence: float, dim: str = "scan") -> xr.Dataset:
    """Return the mean over a dimension as an estimate, with `student_log_interval`.

    The interval is NaN if a value is not positive, but has zero width if several are all zero.
    """
    positive = ((values > 0) | values.isnull()).all(dim)
    interval = student_log_interval(values.where(positive), confidence, dim)
    mean = values.mean(dim)
    count = values.count(dim)
    are_all_zero = ((values == 0).sum(dim) == count) & (count > 1)
    return xr.Dataset({"value": mean, "value_interval": interval.where(~are_all_zero, mean)})


def signed_mean_over_scans(values: xr.DataArray, confidence: float) -> xr.Dataset:
    """Return the mean over scans (..., scan) of values of any sign, with `student_interval`."""
    interval = student_interval(values, confidence, "scan")
    return xr.Dataset({"value": values.mean("scan"), "value_interval": interval})


def quotient(numerator: xr.Dataset, denominator: xr.Dataset) -> xr.Dataset:
    """Return the ratio of two positive estimates, whose interval has all ratios of their intervals.

    Negative ends of intervals count as zero.
    """
    numerator_low, numerator_high = interval_ends(numerator, "value")
    denominator_low, denominator_high = interval_ends(denominator, "value")
    return as_estimate(
        numerator["value"] / denominator["value"],
        numerator_low.clip(0) / denominator_high,
        numerator_high / denominator_low.clip(0),
    )


def absolute_value(signed: xr.Dataset) -> xr.Dataset:
    """Return the absolute value of an estimate; an interval across zero then begins at zero."""
    low, high = interval_ends(signed, "value")
    # a.clip(b) is the larger of both.
    return as_estimate(abs(signed["value"]), low.clip(-high).clip(0), high.clip(-low))
