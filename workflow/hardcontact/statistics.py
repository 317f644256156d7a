"""Resampling of whole scans, and log-normal statistics of pull-off forces.

Uncertainty comes from resampling scans, not contacts: contacts on one scan see the same peaks.
"""

import warnings

import numpy as np
import xarray as xr
from scipy.stats import CensoredData, lognorm

__all__ = [
    "force_statistics",
    "interval",
    "lognormal_fit",
    "lognormal_shape",
    "resampling_counts",
    "with_interval",
]


def resampling_counts(rng, available, samples):
    """How often each scan is drawn, with replacement: (samples, scans); missing ones never.

    available: (scans,) bool.
    """
    counts = np.zeros((samples, len(available)))
    chance = np.full(available.sum(), 1 / available.sum())
    counts[:, available] = rng.multinomial(available.sum(), chance, samples)
    return counts


def interval(samples, confidence, axis=0):
    """Low and high end of the central `confidence` interval of bootstrap samples."""
    tail = 50 * (1 - confidence)
    with warnings.catch_warnings():  # where all samples are missing, so is the interval
        warnings.filterwarnings("ignore", "All-NaN slice", RuntimeWarning)
        return np.nanpercentile(samples, [tail, 100 - tail], axis=axis)


def with_interval(name, dimensions, value, samples, confidence, attributes):
    """Variables `name`, `name`_low and `name`_high of a value and its samples (first axis)."""
    low, high = interval(samples, confidence)
    return {
        name: (dimensions, value, attributes),
        f"{name}_low": (dimensions, low, attributes),
        f"{name}_high": (dimensions, high, attributes),
    }


def lognormal_shape(mean, median):
    """Shape (standard deviation of ln F) of the log-normal with this mean and median.

    mean/median = exp(s²/2). Where the low end was cut off at a force floor it is biased.
    """
    return np.sqrt(2 * np.log(np.asarray(mean) / np.asarray(median)))


def lognormal_fit(forces, floor):
    """Shape and median (N) of the log-normal of greatest likelihood, and the censored fraction.

    forces: (n,) N; those below `floor` (N) are left-censored: known to be below it, no more.
    """
    below = forces < floor
    if below.all():
        return np.nan, np.nan, 1.0
    data = CensoredData(uncensored=forces[~below], left=np.full(below.sum(), floor))
    shape, _, median = lognorm.fit(data, floc=0)
    return float(shape), float(median), float(below.mean())


def force_statistics(forces, floor, rng, samples, confidence):
    """Mean, median and censored log-normal fit of the computed forces of one surface.

    forces: (scan, sphere_scan, contact) in N, NaN where a scan is missing; floor: N; the interval
    resamples substrate and sphere scans together. Returns a dict of scalar variables, each with
    its _low and _high.
    """
    scans, spheres = (np.isfinite(forces).any(axis=axes) for axes in ((1, 2), (0, 2)))
    values = np.array(
        [
            _summary(
                forces[
                    np.ix_(
                        rng.choice(np.flatnonzero(scans), scans.sum()),
                        rng.choice(np.flatnonzero(spheres), spheres.sum()),
                    )
                ],
                floor,
            )
            for _ in range(samples)
        ]
    )
    summary = _summary(forces[np.ix_(scans, spheres)], floor)
    variables = {}
    for k, (name, unit) in enumerate(
        (
            ("force_mean", "N"),
            ("force_median", "N"),
            ("lognormal_shape", "1"),
            ("lognormal_median", "N"),
            ("censored_fraction", "1"),
        )
    ):
        variables |= with_interval(name, (), summary[k], values[:, k], confidence, {"units": unit})
    return xr.Dataset(variables)


def _summary(forces, floor):
    forces = forces.ravel()
    return (forces.mean(), np.median(forces), *lognormal_fit(forces, floor))
