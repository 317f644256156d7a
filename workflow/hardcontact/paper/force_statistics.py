"""Statistics of pull-off forces for fit.nc: means over scans, ratios and distribution."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.statistics import (
    Sampling,
    jackknife_interval,
    student_interval,
    student_log_interval,
    with_interval,
)
from hardcontact.base.units import DIMENSIONLESS, NEWTON
from hardcontact.contact.contact import CONTACT_AXES
from hardcontact.contact.pull_off import interpolate_to_range, mean_over_contacts


def mean_forces(forces: xr.DataArray, sampling: Sampling) -> tuple[Floats, Floats]:
    """Return mean forces over all scans of each surface, and samples of this mean.

    Forces (surface, scan, rho, ...) are in N, NaN for a missing scan. Samples (sample, surface,
    rho) are NaN for a surface with a single scan. Random numbers depend on the surface alone:
    contact models share them.
    """
    scans = mean_over_contacts(forces).transpose("surface", "scan", "rho")
    values = {
        surface: scans.sel(surface=surface).dropna("scan").values
        for surface in scans.surface.values.tolist()
    }
    return scans.mean("scan").values, sampling.sample_means("adhesion", values)


def forces_at_pair(
    forces: xr.DataArray,
    pair: tuple[float, float],
    reference_index: int,
    force_floor: float,
    sampling: Sampling,
) -> xr.Dataset:
    """Return force statistics and ratios of mean forces of one contact model by surface.

    The pair is a range of adhesion in nm and a work of adhesion in J/m².
    """
    rho, work = pair
    pair_forces = interpolate_to_range(forces, rho) * work
    means, mean_samples = mean_forces(pair_forces.expand_dims("rho"), sampling)
    contact_forces = pair_forces.transpose("surface", "scan", "sphere_scan", *CONTACT_AXES).values
    contact_forces = contact_forces.reshape(*contact_forces.shape[:3], -1)
    statistics = [
        force_statistics(surface_forces, force_floor, sampling) for surface_forces in contact_forces
    ]
    ratios = forces_over_reference(
        "ratio_at_pair", "surface", means[:, 0], mean_samples[..., 0], reference_index, sampling
    )
    return xr.concat(statistics, pd.Index(forces.surface.values, name="surface")).assign(ratios)


def forces_over_reference(
    name: str,
    dimensions: str | Sequence[str],
    means: Floats,
    samples: Floats,
    reference_index: int,
    sampling: Sampling,
) -> dict[str, Any]:
    """Return mean forces (surface, ...) relative to the reference surface, with intervals."""
    ratio = means / means[reference_index]
    ratio_samples = samples / samples[:, [reference_index]]
    return sampling.with_interval(name, dimensions, ratio, ratio_samples, DIMENSIONLESS)


#: Statistics of the forces on one surface, with their attributes. Intervals of the first and the
#: last are Student's t over scans, those of the others come from the jackknife over scans.
STATISTIC_ATTRS = {
    "mean_force_at_pair": NEWTON,
    "median_force_at_pair": NEWTON,
    "log_force_std": DIMENSIONLESS,
    "lognormal_median": NEWTON,
    "censored_fraction": DIMENSIONLESS,
}


def force_statistics(forces: Floats, force_floor: float, sampling: Sampling) -> xr.Dataset:
    """Return STATISTIC_ATTRS of the computed forces of one surface, with intervals.

    Forces (scan, sphere_scan, contact) are in N, censored below the floor, NaN for a missing scan.
    Intervals are NaN if `sampling.sample_count` is 0.
    """
    is_finite = np.isfinite(forces)
    scan_count = int(is_finite.any(axis=(1, 2)).sum())
    finite_forces = forces[is_finite].reshape(scan_count, is_finite.sum() // max(scan_count, 1))
    scan_forces = xr.DataArray(finite_forces, dims=("scan", "contact"))
    mean = scan_forces.mean("contact")
    censored = (scan_forces < force_floor).mean("contact")
    jackknife_values = _jackknife_statistics(finite_forces, force_floor)
    values = [float(mean.mean()), *jackknife_values, float(censored.mean())]
    intervals = [np.full(2, np.nan)] * len(values)
    confidence = sampling.confidence
    if sampling.sample_count:
        leave_one_out = [
            _jackknife_statistics(np.delete(finite_forces, scan, axis=0), force_floor)
            for scan in range(scan_count)
        ]
        intervals = [
            student_log_interval(mean, confidence, "scan").values,
            *jackknife_interval(jackknife_values, leave_one_out, confidence),
            student_interval(censored, confidence, "scan").clip(0, 1).values,
        ]
    variables: dict[str, Any] = {}
    for (name, unit), value, interval in zip(
        STATISTIC_ATTRS.items(), values, intervals, strict=True
    ):
        variables |= with_interval(name, (), value, interval, unit, confidence)
    return xr.Dataset(variables)


def _jackknife_statistics(forces: Floats, floor: float) -> Floats:
    """Return median, deviation of ln F and log-normal median (3,) of all forces; NaN without."""
    if not forces.size:
        return np.full(3, np.nan)
    log_std, median = fit_lognormal(forces.ravel(), floor)
    return np.array([np.median(forces), log_std, median])


def fit_lognormal(forces: Floats, floor: float) -> tuple[float, float]:
    """Return deviation of ln F and median (N) of the likeliest log-normal; NaN if all are censored.

    Forces (n,) in N are censored below the floor.
    """
    is_censored = forces < floor
    if is_censored.all():
        return np.nan, np.nan
    logarithms = np.log(forces[~is_censored])
    centre = logarithms.mean()
    log_std = logarithms.std()
    if is_censored.any() and log_std > 0:
        limit = (np.log(floor) - centre) / log_std
        shift, stretch = _censored_normal_fit(limit, is_censored.mean())
        centre, log_std = centre + shift * log_std, stretch * log_std
    return float(log_std), float(np.exp(centre))


def _censored_normal_fit(limit: float, censored: float) -> tuple[float, float]:
    """Return mean and deviation of the maximum-likelihood normal distribution.

    Values above `limit` have the mean 0 and the deviation 1; a share `censored` of all is below.
    Only these numbers enter the likelihood.
    """
    from scipy import optimize, special

    def negative_log_likelihood(parameters: Floats) -> tuple[float, Floats]:
        """Return the mean over forces at mean and log deviation, and its gradient."""
        mean, log_deviation = parameters
        deviation = np.exp(log_deviation)
        reduced = (limit - mean) / deviation
        log_below = special.log_ndtr(reduced)
        hazard = np.exp(-(reduced**2) / 2 - log_below) / np.sqrt(2 * np.pi)
        square = (1 + mean**2) / deviation**2
        uncensored = 1 - censored
        value = uncensored * (log_deviation + square / 2) - censored * log_below
        mean_gradient = uncensored * mean / deviation**2 + censored * hazard / deviation
        log_deviation_gradient = uncensored * (1 - square) + censored * hazard * reduced
        return value, np.array([mean_gradient, log_deviation_gradient])

    fit = optimize.minimize(negative_log_likelihood, np.zeros(2), jac=True, options={"gtol": 1e-9})
    return float(fit.x[0]), float(np.exp(fit.x[1]))
