"""Posterior of range and work of adhesion: pairs that explain published mean forces, by weight.

A draw is one possible computation of the mean forces, such as a set of scans. All draws have the
same prior weight, range and work a uniform prior of their logarithms.
"""

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from hardcontact.base.statistics import percentile_interval, with_interval
from hardcontact.base.units import JOULE_PER_M2, NM

Floats = NDArray[np.float64]

#: Independent tests that a published mean averages: the paper used at least six spheres, and two
#: tests with one sphere share its summits. Each sphere then scatters as much as a single test.
SPHERE_COUNT = 6


def log_mean_error(shape: ArrayLike, count: int) -> Floats:
    """Return the standard deviation of the logarithm of a mean of log-normal forces.

    shape: standard deviation of the logarithm of a single force.
    count: number of independent forces.
    """
    return np.sqrt(np.log1p(np.expm1(np.square(shape)) / count))


def posterior_samples(
    log_curves: Floats,
    log_targets: Floats,
    errors: Floats,
    rng: np.random.Generator,
    count: int,
) -> tuple[NDArray[np.int_], Floats]:
    """Return samples of the index of the range, and of the logarithm of the work of adhesion.

    log_curves: logarithms of computed forces (draw, surface, range) at 1 J/m², at ranges that are
        evenly spaced in their logarithm.
    log_targets, errors: logarithms of measured mean forces and their errors (surface,).
    """
    precision = 1 / errors**2
    log_works = log_targets[:, None] - log_curves
    best_log_works = np.average(log_works, axis=1, weights=precision)
    misfit = np.einsum(
        "drs,s->dr", (log_works - best_log_works[:, None]).swapaxes(1, 2) ** 2, precision
    )
    weights = np.exp((misfit.min() - misfit) / 2).ravel()
    pairs = rng.choice(weights.size, count, p=weights / weights.sum())
    work_deviation = 1 / np.sqrt(precision.sum())
    log_work = best_log_works.ravel()[pairs] + work_deviation * rng.standard_normal(count)
    return pairs % log_curves.shape[2], log_work


def describe_samples(ranges: Floats, works: Floats, confidence: float) -> xr.Dataset:
    """Return samples of range (nm) and work (J/m²), their medians and intervals."""
    variables = {}
    for name, samples, units in (
        ("range_of_adhesion", ranges, NM),
        ("work_of_adhesion", works, JOULE_PER_M2),
    ):
        variables[f"sampled_{name}"] = ("sample", samples, units)
        interval = percentile_interval(samples, confidence)
        variables |= with_interval(name, (), np.median(samples), interval, units, confidence)
    return xr.Dataset(variables)
