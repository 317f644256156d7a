"""Numbers with intervals: the arithmetic of what claims are about.

A number is a dataset of `value` and `value_interval`, which is NaN where no interval is known.
"""

import numpy as np
import xarray as xr

from hardcontact.base.statistics import (
    bounds,
    interval_between,
    student_interval,
    student_log_interval,
)

#: Dimensions of single contacts, and of the sphere scans they are made with.
CONTACTS = ("sphere_scan", "contact", "contact_y", "contact_x")


def number(
    value: xr.DataArray, low: xr.DataArray | float = np.nan, high: xr.DataArray | float = np.nan
) -> xr.Dataset:
    """Return the Dataset of a value and its interval; the ends are of its shape or one for all."""
    zero = xr.zeros_like(value)
    return xr.Dataset({"value": value, "value_interval": interval_between(zero + low, zero + high)})


def variable_as_number(dataset: xr.Dataset, name: str) -> xr.Dataset:
    """Return a variable as a number, with its own interval, or that over scans, or none.

    A variable of single contacts becomes its mean over contacts and scans, with the attribute
    `confidence` of its dataset. It is a KeyError if the variable, or the confidence it needs, is
    not there.
    """
    value = dataset[name]
    if f"{name}_interval" in dataset:
        return number(value, *bounds(dataset, name))
    if "scan" in value.dims and set(CONTACTS) & set(value.dims):
        if "confidence" not in dataset.attrs:
            raise KeyError("expected an attribute named 'confidence', found none")
        return mean_over_scans(mean_over_contacts(value), dataset.attrs["confidence"])
    return number(value)


def mean_over_contacts(values: xr.DataArray) -> xr.DataArray:
    """Return the mean over the contacts of one scan and over the scans of the sphere."""
    return values.mean([dim for dim in CONTACTS if dim in values.dims])


def mean_over_scans(values: xr.DataArray, confidence: float, dim: str = "scan") -> xr.Dataset:
    """Return the mean over scans, or along another dimension, with `student_log_interval`.

    Without an interval where some of the values are not positive; of zero width where all are zero.
    """
    positive = ((values > 0) | values.isnull()).all(dim)
    interval = student_log_interval(values.where(positive), confidence, dim)
    mean, count = values.mean(dim), values.count(dim)
    zeros = ((values == 0).sum(dim) == count) & (count > 1)
    return xr.Dataset({"value": mean, "value_interval": interval.where(~zeros, mean)})


def signed_mean_over_scans(values: xr.DataArray, confidence: float) -> xr.Dataset:
    """Return the mean over scans of values of either sign, with `student_interval`."""
    interval = student_interval(values, confidence, "scan")
    return xr.Dataset({"value": values.mean("scan"), "value_interval": interval})


def quotient(upper: xr.Dataset, lower: xr.Dataset) -> xr.Dataset:
    """Return the ratio of two positive numbers; negative ends of their intervals count as zero.

    The ends of the interval are ratios of the ends of theirs: it is wider than its confidence
    says if the two numbers are independent.
    """
    (upper_low, upper_high), (lower_low, lower_high) = (
        bounds(given, "value") for given in (upper, lower)
    )
    return number(
        upper["value"] / lower["value"],
        upper_low.clip(0) / lower_high,
        upper_high / lower_low.clip(0),
    )


def absolute_value(signed: xr.Dataset) -> xr.Dataset:
    """Return the absolute value of a number; an interval that spans zero becomes one from zero."""
    low, high = bounds(signed, "value")
    return number(abs(signed["value"]), low.clip(-high).clip(0), high.clip(-low))


def least(first: xr.Dataset, second: xr.Dataset) -> xr.Dataset:
    """Return the smaller of two numbers of the same dimensions, and of their intervals' ends."""
    return xr.concat([first, second], dim="of_two").min("of_two", skipna=False)


def decades(numbers: xr.Dataset, dim: str) -> xr.Dataset:
    """Return the decades between the smallest and the largest number along a dimension."""
    return quotient(numbers.max(dim), numbers.min(dim)).map(np.log10)
