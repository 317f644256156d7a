"""Intervals of means over scans, and random samples of uncertain quantities.

Scans are the samples, not contacts, because contacts on one scan touch the same summits. A mean
over scans gets the interval of Student's t. A number that follows from several means gets its
interval from random samples of these means.
"""

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy
import xarray as xr
from numpy.typing import ArrayLike

from hardcontact.base.arrays import Floats, generator

#: Largest deviation of ln(sample) from ln(mean): e^50 is as good as infinite. Larger ones are
#: clipped, because products of the extremes of Student's t would leave the range of floats.
MAX_LOG_DEVIATION = 50.0
#: Median distance of normal values from their mean, in standard deviations.
MEDIAN_DEVIATION = 0.6745
#: The ends of an interval, in their order along the dimension `end`.
ENDS = ["low", "high"]


def as_variables(
    name: str,
    dimensions: str | Sequence[str],
    value: ArrayLike,
    interval: ArrayLike,
    attributes: dict[str, Any],
    confidence: float,
) -> dict[str, Any]:
    """Return a value (...) and its interval (..., 2) as variables `name` and `name_interval`."""
    names = (dimensions,) if isinstance(dimensions, str) else tuple(dimensions)
    return {
        name: (names, value, attributes),
        f"{name}_interval": xr.DataArray(
            interval, {"end": ENDS}, (*names, "end"), attrs=attributes
        ).assign_attrs(confidence=confidence),
    }


def interval_ends(dataset: xr.Dataset, name: str) -> tuple[xr.DataArray, xr.DataArray]:
    """Return the low and the high end of a variable's interval, without the dimension `end`."""
    interval = dataset[f"{name}_interval"]
    return interval.sel(end="low", drop=True), interval.sel(end="high", drop=True)


def percentile_interval(samples: ArrayLike, confidence: float) -> Floats:
    """Return the central interval (..., 2) of samples (n, ...); missing samples are NaN."""
    samples = np.asarray(samples)
    tail = 50 * (1 - confidence)
    if not len(samples):
        return np.full((*samples.shape[1:], 2), np.nan)
    # `nanpercentile` is a hundred times slower, so it serves only where values are missing.
    percentile = np.nanpercentile if np.isnan(samples).any() else np.percentile
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "All-NaN slice", RuntimeWarning)
        # Between infinite samples an end is NaN: the interval is unknown.
        warnings.filterwarnings("ignore", "invalid value encountered", RuntimeWarning)
        ends = percentile(samples, [tail, 100 - tail], axis=0)
    return np.moveaxis(ends, 0, -1)


def widen_interval(dataset: xr.Dataset, name: str, error: xr.DataArray) -> xr.Dataset:
    """Return a dataset with a wider interval of a positive variable, by an independent error.

    The error is a factor, NaN if there is none. On either side its logarithm and that of the
    interval add in squares.
    """
    value = dataset[name]
    log_error = abs(np.log(error.fillna(1)))
    low, high = interval_ends(dataset, name)
    low = value * np.exp(-np.hypot(np.log(value / low), log_error))
    high = value * np.exp(np.hypot(np.log(high / value), log_error))
    interval = dataset[f"{name}_interval"]
    ends = xr.concat([low, high], interval["end"]).transpose(*interval.dims)
    return dataset.assign({f"{name}_interval": ends.assign_attrs(interval.attrs)})


def student_quantile(degrees_of_freedom: Any, confidence: float) -> Any:
    """Return the high end of the central interval of Student's t."""
    return scipy.special.stdtrit(degrees_of_freedom, (1 + confidence) / 2)


def student_interval(values: xr.DataArray, confidence: float, dim: str) -> xr.DataArray:
    """Return Student's interval (..., end) of a mean along a dimension; missing values are NaN."""
    mean = values.mean(dim)
    count = values.count(dim)
    half_width = student_quantile(count - 1, confidence) * values.std(dim, ddof=1) / np.sqrt(count)
    interval = join_ends(mean - half_width, mean + half_width)
    return interval.assign_attrs(confidence=confidence)


def student_log_interval(values: xr.DataArray, confidence: float, dim: str) -> xr.DataArray:
    """Return Student's interval (..., end) of a mean logarithm, moved to the mean of the values.

    Logarithms of values that scatter by factors are nearly normal, as Student's t assumes. But
    exp(mean logarithm) is less than the mean. So the mean is multiplied by the ratios of the ends
    to exp(mean logarithm).
    """
    logarithms: xr.DataArray = xr.apply_ufunc(np.log, values)
    about_zero = student_interval(logarithms, confidence, dim) - logarithms.mean(dim)
    interval: xr.DataArray = values.mean(dim) * xr.apply_ufunc(np.exp, about_zero)
    return interval.transpose(..., "end").assign_attrs(confidence=confidence)


def join_ends(low: xr.DataArray, high: xr.DataArray) -> xr.DataArray:
    """Return both ends of an interval in one array, along a new last dimension `end`."""
    low, high = xr.broadcast(low, high)
    ends = np.stack([low.values, high.values], axis=-1)  # xr.concat takes five times as long
    return xr.DataArray(ends, {**low.coords, "end": ENDS}, (*low.dims, "end"))


def student_log_samples(rng: np.random.Generator, values: Floats, sample_count: int) -> Floats:
    """Sample the mean (samples, ...) of positive values (n, ...) on n independent scans.

    A sample is the mean of the values times exp(log_deviation). With x for the values of a scan,

        log_deviation = sum over scans of normal/scale (ln x - mean of ln x)/sqrt(n (n - 1)).

    With normal weights alone its standard deviation would be the standard error of the mean of
    ln x. The random `scale` makes it a variable of Student's t, as in `student_log_interval`.
    All elements of a scan have the same weight, so that they stay correlated. NaN for n < 2.
    """
    count = len(values)
    if count < 2:
        return np.full((sample_count, *values.shape[1:]), np.nan)
    logarithms = np.log(values)
    deviations = (logarithms - logarithms.mean(axis=0)) / np.sqrt(count * (count - 1))
    normal = rng.standard_normal((sample_count, count))
    scale = np.sqrt(rng.chisquare(count - 1, sample_count) / (count - 1))
    log_deviation = np.tensordot(normal / scale[:, None], deviations, axes=1)
    log_deviation = np.clip(log_deviation, -MAX_LOG_DEVIATION, MAX_LOG_DEVIATION)
    return np.asarray(values.mean(axis=0) * np.exp(log_deviation))


def jackknife_interval(value: ArrayLike, leave_one_out: ArrayLike, confidence: float) -> Floats:
    """Return the interval (..., 2) of a positive statistic by the jackknife.

    `leave_one_out` (n, ...) has the statistic without each of n independent scans or masters.
    Without one of n scans a mean changes by only 1/(n - 1) of the distance of this scan from it, so
    that the squared error of the statistic's logarithm is n - 1 times the variance of these
    logarithms. NaN for fewer than two scans, or if a statistic is not positive. Quarters
    of a scan correlate, so they need the correction in `inference.scan_parts.jackknife_variance`.
    """
    statistics = np.asarray(leave_one_out, float)
    logarithms = np.log(np.where(statistics > 0, statistics, np.nan))
    count = len(logarithms)
    if count < 2:
        return np.full((*np.shape(value), 2), np.nan)
    error = np.sqrt((count - 1) * logarithms.var(axis=0))
    half_width = student_quantile(count - 1, confidence) * error
    return np.stack([value * np.exp(-half_width), value * np.exp(half_width)], axis=-1)


def log_std_of_lognormal(mean: ArrayLike, median: ArrayLike) -> Floats:
    """Return the standard deviation s of ln x for a log-normal x: mean/median = exp(s²/2)."""
    return np.asarray(np.sqrt(2 * np.log(np.asarray(mean) / np.asarray(median))))


@dataclass(frozen=True)
class Sampling:
    """Number, seed and confidence of the random samples of an uncertain quantity."""

    seed: int
    sample_count: int  #: If it is 0, all intervals are NaN.
    confidence: float
    #: Purpose of the random numbers: the first names of `base.arrays.generator`.
    stream: tuple[str, ...] = ("sampling",)

    @classmethod
    def from_parameters(cls, parameters: Mapping[str, Any], *stream: str) -> "Sampling":
        """Return the sampling of a job."""
        seed, sample_count = parameters["seed"], parameters["samples"]
        return cls(seed, sample_count, parameters["confidence"], stream or cls.stream)

    def generator(self, *names: str) -> np.random.Generator:
        """Return the random generator of one sampled quantity."""
        return generator(self.seed, *self.stream, *names)

    def sample_means(self, name: str, values: xr.DataArray, dim: str) -> xr.DataArray:
        """Return means over scans along `dim` (sample, surface, ...). Missing scans are NaN.

        The first is the mean itself, the others are random samples of it.
        """
        values = values.transpose("surface", dim, ...)
        means = values.mean(dim)
        samples = [
            student_log_samples(
                self.generator(name, surface),
                values.sel(surface=surface).dropna(dim, how="all").values,
                self.sample_count,
            )
            for surface in values["surface"].values.tolist()
        ]
        sampled_means = np.concatenate([means.values[None], np.stack(samples, axis=1)])
        return xr.DataArray(sampled_means, means.coords, ("sample", *means.dims))

    def sampled_variables(
        self,
        name: str,
        dimensions: str | Sequence[str],
        sampled_values: Floats,
        attributes: dict[str, Any],
    ) -> dict[str, Any]:
        """Return variables of a value, the first of (sample, ...), and its interval."""
        interval = percentile_interval(sampled_values[1:], self.confidence)
        value = sampled_values[0]
        return as_variables(name, dimensions, value, interval, attributes, self.confidence)
