"""Your measured forces, and the ranges and works of adhesion that agree with them: fit.nc.

At each range rho a measured force F and a computed force f, at 1 J/m², agree for the work
W = F/f(rho). One surface gives a curve W(rho); several give a region, the pairs within the
intervals of all. The dimension ``rho_fine`` holds the computed ranges and ranges between them.
"""

from collections.abc import Mapping
from statistics import NormalDist
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.arrays import SEED_WORDS, Floats
from hardcontact.base.dataset import stack
from hardcontact.base.statistics import (
    MAX_LOG_DEVIATION,
    Sampling,
    as_variables,
    interval_ends,
    join_ends,
    log_std_of_lognormal,
    percentile_interval,
)
from hardcontact.base.units import DIMENSIONLESS, JOULE_PER_M2, NEWTON, NM
from hardcontact.inference.fit import FIT_ATTRS, best_fit, fine_ranges, interpolate_to_ranges
from hardcontact.inference.mean_forces import SurfaceForces, forces_by_surface
from hardcontact.inference.scan_parts import IntervalSource, sample_deviations

#: Chance that forces at different sites are mistaken for forces at repeated sites.
REPEATED_BY_CHANCE = 1e-3


class ForceSummary(NamedTuple):
    """Mean and scatter of the forces measured on one surface, log-normal between sites."""

    mean: float  #: Mean over sites in N.
    log_std: float  #: Standard deviation of ln F between sites; NaN for a single site.
    site_count: int  #: Number of sites, each an independent sample.
    force_count: int  #: Number of forces.
    look_repeated: bool = False  #: Whether forces without sites look as if several share a site.


def summarize_forces(forces: pd.DataFrame) -> ForceSummary:
    """Return mean and scatter of one surface's rows of the table of measured forces.

    Forces at one site are one sample, their mean; a force without a site is one, too.
    """
    force_count = int(forces["count"].sum())
    if len(forces) == 1:
        mean, median = float(forces["mean"].iloc[0]), forces["median"].iloc[0]
        log_std = float(log_std_of_lognormal(mean, median)) if force_count > 1 else np.nan
        # A row does not name the sites of its forces, so each force counts as a site.
        return ForceSummary(mean, log_std, site_count=force_count, force_count=force_count)
    has_site = forces["site"] != ""
    sites = forces["site"].where(has_site, forces.index)
    means = forces["mean"].groupby(sites, sort=False).mean()
    log_std = float(np.log(means).std(ddof=1))
    mean, site_count = float(means.mean()), len(means)
    return ForceSummary(mean, log_std, site_count, force_count, look_repeated(forces))


def look_repeated(forces: pd.DataFrame) -> bool:
    """Return whether forces on one surface without sites look as if several share a site.

    They do if at most half of the values are distinct, or if rows near each other resemble each
    other. This is tested by von Neumann's ratio at each lag of rows: half the mean squared
    difference of ln F between rows at this lag, divided by the variance of ln F. For independent
    forces it is about 1; if forces repeat or drift, it is far below 1 at some lag.
    """
    logs = np.log(forces["mean"].to_numpy(float))
    if (forces["site"] != "").any() or len(logs) < 3:
        return False
    if 2 * len(np.unique(logs)) <= len(logs):
        return True
    lags = np.arange(1, len(logs) // 2 + 1)
    ratios = [np.mean((logs[lag:] - logs[:-lag]) ** 2) / (2 * logs.var(ddof=1)) for lag in lags]
    # For independent forces the ratio scatters about 1 by 1/sqrt(n - lag). All lags share a chance.
    quantile = NormalDist().inv_cdf(REPEATED_BY_CHANCE / len(lags))
    return bool((ratios < 1 + quantile / np.sqrt(len(logs) - lags)).any())


def sample_measured_mean(
    rng: np.random.Generator, summary: ForceSummary, sample_count: int
) -> np.ndarray:
    """Return the mean force in N, then samples of the true mean (1 + sample,).

    The mean of a log-normal F is exp(m + s²/2), with the mean m and the variance s² of ln F. Both
    are sampled: s² from a chi-squared distribution, m from a normal one of the sampled variance
    (Krishnamoorthy and Mathew, J. Stat. Plan. Inference 115 (2003) 103). NaN for a single site.
    """
    if summary.site_count < 2:
        return np.append(summary.mean, np.full(sample_count, np.nan))
    degrees_of_freedom = summary.site_count - 1
    variance = summary.log_std**2
    chi_squared = rng.chisquare(degrees_of_freedom, sample_count)
    sampled_variance = variance * degrees_of_freedom / chi_squared
    errors = rng.standard_normal(sample_count) * np.sqrt(sampled_variance / summary.site_count)
    deviation = (sampled_variance - variance) / 2 - errors
    deviation = np.clip(deviation, -MAX_LOG_DEVIATION, MAX_LOG_DEVIATION)
    return np.append(summary.mean, summary.mean * np.exp(deviation))


def fit_measured(
    adhesion: xr.Dataset,
    force_table: pd.DataFrame,
    scan_sizes: Mapping[str, float],
    pixel_divisors: Mapping[str, float],
    sampling: Sampling,
) -> xr.Dataset:
    """Return the ranges and works of adhesion that agree with measured forces.

    `adhesion` holds the computed forces, `force_table` the measured forces in N. Scan sizes are in
    nm. On finer pixels the computed force may be as low as itself divided by the pixel divisor of
    the surface (`own.wide_pixels`), which raises only the high end of the work.
    """
    tables = dict(list(force_table.groupby("surface")))
    surfaces = [name for name in adhesion["surface"].values.tolist() if name in tables]
    summaries = {name: summarize_forces(tables[name]) for name in surfaces}
    rngs = {name: sampling.generator(SEED_WORDS["measured forces"], name) for name in surfaces}
    sampled_means = [
        sample_measured_mean(rngs[name], summary, sampling.sample_count)
        for name, summary in summaries.items()
    ]
    measured_forces = np.stack(sampled_means, axis=1)
    measured_adhesion = adhesion.sel(surface=surfaces)
    fits = {}
    for model in adhesion["contact_model"].values.tolist():
        model_forces = forces_by_surface(measured_adhesion.sel(contact_model=model), scan_sizes)
        fits[(model,)] = _fit_contact_model(model_forces, measured_forces, pixel_divisors, sampling)
    # All contact models have the same parts of scans, so that those of the last one serve.
    interval_sources = [
        model_forces[name].scan_parts[0].interval_source
        if summary.site_count > 1
        else IntervalSource.ONE_SITE
        for name, summary in summaries.items()
    ]
    variables = sampling.sampled_variables("measured_force", "surface", measured_forces, NEWTON)
    variables["interval_source"] = ("surface", interval_sources)
    for name in ("force_count", "site_count", "look_repeated"):
        numbers = [int(getattr(summary, name)) for summary in summaries.values()]
        variables[name] = ("surface", numbers, DIMENSIONLESS)
    return (
        stack(fits, ["contact_model"])
        .assign(variables)
        .assign(label=measured_adhesion["label"], source=measured_adhesion["source"])
        .assign_attrs(confidence=sampling.confidence, sphere_radius=adhesion.attrs["sphere_radius"])
    )


def _sample_forces(surface_forces: SurfaceForces, surface: str, sampling: Sampling) -> Floats:
    """Sample the mean forces (sample, rho) of a surface in N at 1 J/m².

    All ranges share random numbers. All surfaces share those of the position of the sphere.
    """
    count = sampling.sample_count
    log_means_and_parts = zip(
        surface_forces.delete_one_log_means, surface_forces.scan_parts, strict=True
    )
    scan_deviations = [
        sample_deviations(sampling.generator("scans", surface), log_means, scan_parts, count)
        for log_means, scan_parts in log_means_and_parts
    ]
    deviations = np.stack(scan_deviations, axis=1)
    position_variance = surface_forces.position_variance
    if position_variance is not None:
        rng = sampling.generator(SEED_WORDS["position of the sphere"])
        samples = rng.standard_t(position_variance.degrees_of_freedom, (count, 1))
        deviations += samples * np.sqrt(position_variance.value)
    return surface_forces.mean * np.exp(deviations)


def _fit_contact_model(
    computed_forces: Mapping[str, SurfaceForces],
    measured_forces: Floats,
    pixel_divisors: Mapping[str, float],
    sampling: Sampling,
) -> xr.Dataset:
    """Return the fit of one contact model to measured forces (1 + sample, surface) in N."""
    computed_ranges = next(iter(computed_forces.values())).ranges
    # The fine ranges include the computed ones, so that works at these are not interpolated.
    ranges = np.union1d(fine_ranges(computed_ranges), computed_ranges)
    means = np.stack([surface_forces.mean for surface_forces in computed_forces.values()])
    force_curves = interpolate_to_ranges(means, computed_ranges, ranges)
    sampled_forces = [
        _sample_forces(surface_forces, name, sampling)
        for name, surface_forces in computed_forces.items()
    ]
    measured_means, measured_samples = measured_forces[0], measured_forces[1:]
    sampled_works = measured_samples[:, :, None] / np.stack(sampled_forces, axis=1)
    # Finer pixels lower the computed force, so that the high end of the work rises.
    pixel_widening = np.array([[[1.0, pixel_divisors[name]]] for name in computed_forces])
    # All intervals of n independent surfaces contain the true pair with the confidence c if each
    # has the confidence c^(1/n).
    joint_confidence = sampling.confidence ** (1 / len(computed_forces))
    intervals = pixel_widening * _work_intervals(
        sampled_works, computed_ranges, ranges, sampling.confidence
    )
    joint_intervals = pixel_widening * _work_intervals(
        sampled_works, computed_ranges, ranges, joint_confidence
    )
    works = measured_means[:, None] / force_curves
    region = _common_region(joint_intervals)
    dimensions = ("surface", "rho_fine")
    return xr.Dataset(
        as_variables(
            "work_by_range", dimensions, works, intervals, JOULE_PER_M2, sampling.confidence
        )
        | {"region": (("rho_fine", "end"), region, JOULE_PER_M2)}
        | _region_extent(region, ranges)
        | _best_pair(force_curves, measured_means, ranges),
        {"surface": list(computed_forces), "rho_fine": ("rho_fine", ranges, NM)},
    )


def _work_intervals(
    sampled_works: Floats, computed_ranges: Floats, ranges: Floats, confidence: float
) -> Floats:
    """Return intervals (surface, rho_fine, 2) at `ranges` of works (sample, surface, rho)."""
    ends = np.moveaxis(percentile_interval(sampled_works, confidence), -1, 0)
    return np.moveaxis(interpolate_to_ranges(ends, computed_ranges, ranges), 0, -1)


def _common_region(intervals: Floats) -> Floats:
    """Return the common part (rho_fine, 2) of intervals (surface, rho_fine, 2), or NaN."""
    region = np.stack([intervals[..., 0].max(axis=0), intervals[..., 1].min(axis=0)], axis=-1)
    is_empty = ~(region[:, 0] < region[:, 1])
    return np.where(is_empty[:, None], np.nan, region)


def _best_pair(force_curves: Floats, measured_forces: Floats, ranges: Floats) -> dict[str, Any]:
    """Return the `best_fit` of mean forces (surface, rho_fine), and how many pairs fit exactly."""
    fit = best_fit(force_curves, measured_forces, ranges)
    exact_pairs = 0
    if len(force_curves) == 1:  # One surface fits at every range.
        fit = {name: np.array(np.nan) for name in fit}
    if len(force_curves) == 2:
        first_work, second_work = measured_forces[:, None] / force_curves
        # A pair fits exactly where the curves of work cross; more curves hardly cross at one pair.
        exact_pairs = int(np.count_nonzero(np.diff(second_work > first_work)))
    if exact_pairs:  # The remaining error comes from the grid of ranges.
        fit["best_error"] = np.array(np.nan)
    variables = {name: ((), fit[name], attributes) for name, attributes in FIT_ATTRS.items()}
    return variables | {"exact_pairs": ((), exact_pairs, DIMENSIONLESS)}


def _region_extent(region: Floats, ranges: Floats) -> dict[str, Any]:
    """Return the lowest and the highest range and work of adhesion in a region (rho_fine, 2).

    If a region may extend beyond the computed ranges, its range is NaN at this end, its work at
    both. All are NaN for an empty region.
    """
    allowed_indices = np.flatnonzero(np.isfinite(region).all(axis=-1))
    region_range, region_work = np.full(2, np.nan), np.full(2, np.nan)
    if len(allowed_indices):
        end_indices = allowed_indices[[0, -1]]
        is_open = end_indices == [0, len(ranges) - 1]
        region_range = np.where(is_open, np.nan, ranges[end_indices])
        if not is_open.any():
            region_work = np.array([np.nanmin(region[:, 0]), np.nanmax(region[:, 1])])
    return {
        "region_range": ("end", region_range, NM),
        "region_work": ("end", region_work, JOULE_PER_M2),
    }


def add_extrapolated_work(fitted: xr.Dataset, force: xr.Dataset) -> xr.Dataset:
    """Return a fit to measured forces with the work of adhesion for extrapolated roughness.

    ``extrapolated_work`` (surface, side) is at the range ``rho`` of `force`, which is force.nc.
    """
    surface_force = force.sel(surface=fitted.surface)
    computed_force = surface_force.extrapolated_force / force.attrs["work_of_adhesion"]
    work = (fitted.measured_force / computed_force).transpose("surface", "side")
    measured_below, measured_above = _logarithmic_errors(fitted, "measured_force")
    computed_below, computed_above = _logarithmic_errors(surface_force, "extrapolated_force")
    low = work * np.exp(-np.hypot(measured_below, computed_above))
    high = work * np.exp(np.hypot(measured_above, computed_below))
    interval = join_ends(low, high).transpose(*work.dims, "end").values
    confidence = fitted.attrs["confidence"]
    variables = as_variables(
        "extrapolated_work", work.dims, work.values, interval, JOULE_PER_M2, confidence
    )
    variables |= {name: surface_force[name] for name in ("extrapolation_matters", "transition")}
    return fitted.assign(variables).assign_attrs(rho=force.attrs["rho"])


def _logarithmic_errors(dataset: xr.Dataset, name: str) -> tuple[xr.DataArray, xr.DataArray]:
    """Return the logarithmic distances of a value from its interval's ends; infinite from zero."""
    low, high = interval_ends(dataset, name)
    with np.errstate(divide="ignore"):
        return xr.ufuncs.log(dataset[name] / low), xr.ufuncs.log(high / dataset[name])
