"""Intervals, resampling of whole scans, and log-normal fits.

Uncertainty comes from scans, not from contacts: contacts on one scan see the same peaks. A variable
`name` has its interval in a second variable, `name_interval`, of one more dimension `bound`.
"""

import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import ArrayLike
from scipy import stats

__all__ = [
    "bounds",
    "interval_between",
    "lognormal_fit",
    "lognormal_shape",
    "percentile_interval",
    "resampling_counts",
    "student_interval",
    "with_interval",
]

#: The ends of an interval, in their order along the dimension `bound`.
BOUNDS = ["low", "high"]


# --- variables with intervals -----------------------------------------------------------------


def with_interval(
    name: str,
    dimensions: str | Sequence[str],
    value: ArrayLike,
    interval: ArrayLike,
    attributes: dict[str, Any],
    confidence: float,
) -> dict[str, Any]:
    """Return the variables `name` and `name_interval` of a Dataset.

    Parameters
    ----------
    name : str
        Of the variable.
    dimensions : str or sequence of str
        Those of the value.
    value : array_like (...)
        The value.
    interval : array_like (..., 2)
        Its low and its high end.
    attributes : dict
        Units and the like, of both variables.
    confidence : float
        Of the interval; an attribute of it.

    Returns
    -------
    dict
        The two variables, ready for `xarray.Dataset`; the coordinate `bound` comes with them.
    """
    named = (dimensions,) if isinstance(dimensions, str) else tuple(dimensions)
    return {
        name: (named, value, attributes),
        f"{name}_interval": xr.DataArray(
            interval, {"bound": BOUNDS}, (*named, "bound"), attrs=attributes
        ).assign_attrs(confidence=confidence),
    }


def bounds(dataset: xr.Dataset, name: str) -> tuple[xr.DataArray, xr.DataArray]:
    """Return the low and the high end of a variable's interval, without the dimension `bound`."""
    interval = dataset[f"{name}_interval"]
    return interval.sel(bound="low", drop=True), interval.sel(bound="high", drop=True)


def percentile_interval(samples: ArrayLike, confidence: float) -> np.ndarray:
    """Return the central interval of bootstrap samples.

    Parameters
    ----------
    samples : array_like (samples, ...)
        NaN where a sample is missing.
    confidence : float
        Share of the samples inside.

    Returns
    -------
    ndarray (..., 2)
        Low and high end; NaN where all samples are missing.
    """
    tail = 50 * (1 - confidence)
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "All-NaN slice", RuntimeWarning)
        ends = np.nanpercentile(np.asarray(samples), [tail, 100 - tail], axis=0)
    return np.moveaxis(ends, 0, -1)


def student_interval(values: xr.DataArray, confidence: float, dim: str) -> xr.DataArray:
    """Return the interval of a mean by Student's t.

    Parameters
    ----------
    values : xarray.DataArray
        Independent values along `dim`, NaN where one is missing.
    confidence : float
        Probability that the interval holds the mean.
    dim : str
        Dimension the mean is taken along.

    Returns
    -------
    xarray.DataArray
        Low and high end along the last dimension `bound`; NaN of fewer than two values.
    """
    mean, count = values.mean(dim), values.count(dim)
    quantile = xr.apply_ufunc(stats.t.ppf, (1 + confidence) / 2, count - 1)
    half = quantile * values.std(dim, ddof=1) / np.sqrt(count)
    return interval_between(mean - half, mean + half).assign_attrs(confidence=confidence)


def interval_between(low: xr.DataArray, high: xr.DataArray) -> xr.DataArray:
    """Return both ends of an interval in one array, along a new last dimension `bound`."""
    ends = xr.concat([low, high], pd.Index(BOUNDS, name="bound"))
    return ends.transpose(..., "bound")


# --- resampling and fits ----------------------------------------------------------------------


def resampling_counts(rng: np.random.Generator, available: np.ndarray, samples: int) -> np.ndarray:
    """Return how often each scan is drawn, with replacement.

    Parameters
    ----------
    rng : numpy.random.Generator
        Source of the samples.
    available : ndarray of bool (scans,)
        Whether a scan may be drawn.
    samples : int
        Number of bootstrap samples.

    Returns
    -------
    ndarray (samples, scans)
        Each row adds up to the number of available scans.
    """
    counts = np.zeros((samples, len(available)))
    chance = np.full(available.sum(), 1 / available.sum())
    counts[:, available] = rng.multinomial(available.sum(), chance, samples)
    return counts


def lognormal_shape(mean: ArrayLike, median: ArrayLike) -> np.ndarray:
    """Return the shape (standard deviation of ln F) of the log-normal with this mean and median.

    mean/median = exp(s²/2). It is biased if forces below a floor were not measured.
    """
    shape: np.ndarray = np.sqrt(2 * np.log(np.asarray(mean) / np.asarray(median)))
    return shape


def lognormal_fit(forces: np.ndarray, floor: float) -> tuple[float, float, float]:
    """Fit the log-normal of greatest likelihood to forces of which some are below a floor.

    Parameters
    ----------
    forces : ndarray (n,)
        In N.
    floor : float
        In N. Forces below it are left-censored.

    Returns
    -------
    shape, median, censored : float
        The median in N. Shape and median are NaN if all forces are below the floor.
    """
    below = forces < floor
    if below.all():
        return np.nan, np.nan, 1.0
    data = stats.CensoredData(uncensored=forces[~below], left=np.full(below.sum(), floor))
    shape, _, median = stats.lognorm.fit(data, floc=0)
    return float(shape), float(median), float(below.mean())
