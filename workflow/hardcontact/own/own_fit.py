"""Range and work of adhesion that the user's measured forces permit: fit.nc.

Forces F are measured, and forces f are computed at 1 J/m². At every range, the work W = F/f(rho)
makes them agree. One surface gives a curve W(rho). For several surfaces, the region contains the
pairs of range and work within the intervals of all surfaces at once. Tests scatter log-normally.
"""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.dataset import stack
from hardcontact.base.statistics import (
    Sampling,
    bounds,
    lognormal_shape,
    percentile_interval,
    with_interval,
)
from hardcontact.base.units import DIMENSIONLESS, JOULE_PER_M2, NEWTON, NM
from hardcontact.contact.contact import PLASTIC
from hardcontact.contact.force_curves import interpolate_to_ranges
from hardcontact.own.predicted_force import (
    SurfaceForces,
    fewest_places,
    forces_of_surface,
)
from hardcontact.own.scan_parts import sampled_deviations
from hardcontact.paper.error_map import fit_range_and_work

#: Largest deviation of the logarithm of a sampled mean; larger ones are clipped.
MAX_LOG_DEVIATION = 50.0
#: Number of ranges of adhesion on the curves, from the shortest to the longest computed range.
CURVE_RANGE_COUNT = 401


class MeasuredTests(NamedTuple):
    """Tests on one surface."""

    mean: float  #: Mean force in N.
    log_std: float  #: Standard deviation of the logarithm of a force; NaN for a single test.
    test_count: int  #: Number of tests.


def measured_tests(forces: pd.DataFrame) -> MeasuredTests:
    """Return the tests on one surface from its rows of the table of measured forces."""
    count = int(forces["count"].sum())
    mean = float(np.average(forces["mean"], weights=forces["count"]))
    if count < 2:
        return MeasuredTests(mean, np.nan, count)
    if len(forces) == 1:
        return MeasuredTests(mean, float(lognormal_shape(mean, forces["median"].iloc[0])), count)
    return MeasuredTests(mean, float(np.log(forces["mean"]).std(ddof=1)), count)


def sampled_means(rng: np.random.Generator, tests: MeasuredTests, samples: int) -> np.ndarray:
    """Sample mean forces (samples,) in N of a log-normal distribution from a few tests.

    The generalized pivot of the logarithm of the mean, mu + sigma²/2, is y - z s*/sqrt(n) + s*²/2
    with s*² = (n - 1) s²/chi²(n - 1). Here z is normal, and y and s are mean and standard deviation
    of the logarithms of n tests, mu and sigma their true values. The deviation of the pivot from
    y + s²/2 is added to the logarithm of the measured mean. NaN for a single test, whose scatter is
    unknown. Source: Krishnamoorthy and Mathew, J. Stat. Plan. Inference 115 (2003) 103.
    """
    if tests.test_count < 2:
        return np.full(samples, np.nan)
    freedom = tests.test_count - 1
    variance = tests.log_std**2
    sampled_variance = variance * freedom / rng.chisquare(freedom, samples)
    normal = rng.standard_normal(samples)
    deviation = (sampled_variance - variance) / 2 - normal * np.sqrt(
        sampled_variance / tests.test_count
    )
    return np.asarray(
        tests.mean * np.exp(np.clip(deviation, -MAX_LOG_DEVIATION, MAX_LOG_DEVIATION))
    )


def fit_measured(
    adhesion: xr.Dataset, forces: pd.DataFrame, scan_sizes: Mapping[str, float], sampling: Sampling
) -> xr.Dataset:
    """Fit range and work of adhesion to measured forces, with the roughness of the scans.

    Intervals come from random samples of the mean of the tests and of the mean over scans.

    adhesion: computed forces at 1 J/m², as in adhesion.nc.
    forces: measured forces in N, from `config.tables.measured_forces`.
    scan_sizes: side of the scans of each surface in nm.
    sampling: seed, number of samples and confidence.
    Returns ``measured_force`` (surface) in N with its interval, ``test_count``, label and
        ``interval_source``, for the surfaces with forces; ``work_of_adhesion`` (contact_model,
        surface, rho) in J/m² with its interval, on a fine grid of ranges; ``region``
        (contact_model, rho, bound), the lowest and highest work in J/m² that all surfaces allow, or
        NaN; its extent ``region_range`` in nm and ``region_work``, NaN if the region reaches the
        shortest or longest computed range, and ``region_status``: found, open or none. For several
        surfaces, ``best_range``, ``best_work`` and ``best_error`` are the best fit. For two
        surfaces, ``exact_pairs`` counts the pairs that give both forces. If there are any, two
        unknowns fit two numbers by construction, and ``best_error`` is NaN.
    """
    radius = float(adhesion.attrs["sphere_radius"])
    rhos = adhesion.rho.values
    surfaces = [name for name in adhesion.surface.values.tolist() if name in set(forces.surface)]
    tests = [measured_tests(forces[forces.surface == name]) for name in surfaces]
    measured_forces = np.array([test.mean for test in tests])
    measured_samples = [
        sampled_means(sampling.generator("tests", name), test, sampling.samples)
        for name, test in zip(surfaces, tests, strict=True)
    ]
    models = {}
    sources = []
    touched_places = fewest_places(adhesion)
    for model in adhesion.contact_model.values.tolist():
        model_forces = adhesion.pull_off_force.sel(contact_model=model)
        forces_by_surface = [
            forces_of_surface(
                model_forces.sel(surface=name), scan_sizes[name], radius, touched_places[name]
            )
            for name in surfaces
        ]
        works = [
            mean[:, None] / _sampled_forces(surface_forces, name, sampling)
            for mean, surface_forces, name in zip(
                measured_samples, forces_by_surface, surfaces, strict=True
            )
        ]
        computed_forces = np.array([surface_forces.mean for surface_forces in forces_by_surface])
        models[(model,)] = _fit_model(
            computed_forces, measured_forces, np.stack(works, axis=1), rhos, sampling.confidence
        )
        # Tests and parts of scans, and so the sources of intervals, are the same for all models.
        sources = [
            surface_forces.scan_parts[0].source if test.test_count > 1 else "one_test"
            for surface_forces, test in zip(forces_by_surface, tests, strict=True)
        ]
    variables = sampling.with_interval(
        "measured_force",
        "surface",
        measured_forces.tolist(),
        np.stack(measured_samples, axis=1),
        NEWTON,
    ) | {
        "test_count": ("surface", [test.test_count for test in tests], DIMENSIONLESS),
        "interval_source": ("surface", sources),
        "label": adhesion.label.sel(surface=surfaces),
    }
    fitted = stack(models, ["contact_model"]).assign_coords(surface=surfaces).assign(variables)
    return fitted.assign_attrs(
        basis="measured",
        confidence=sampling.confidence,
        sphere_radius=adhesion.attrs["sphere_radius"],
    )


def _sampled_forces(surface_forces: SurfaceForces, surface: str, sampling: Sampling) -> np.ndarray:
    """Sample mean forces (sample, rho) of a surface: the same random numbers at every range."""
    deviations = [
        sampled_deviations(
            sampling.generator("scans", surface), delete_one_log_means, scan_parts, sampling.samples
        )
        for delete_one_log_means, scan_parts in zip(
            surface_forces.delete_one_log_means.T, surface_forces.scan_parts, strict=True
        )
    ]
    return np.asarray(surface_forces.mean * np.exp(np.stack(deviations, axis=1)))


def _fit_model(
    computed_forces: np.ndarray,
    measured_forces: np.ndarray,
    sampled_works: np.ndarray,
    rhos: np.ndarray,
    confidence: float,
) -> xr.Dataset:
    """Return the fit of one contact model.

    Computed forces (surface, rho) at 1 J/m² and measured forces (surface,) are in N. Sampled works
    (sample, surface, rho) in J/m² come from resampled tests and scans. The region takes the
    intervals of n independent surfaces at the confidence c^(1/n), so that all intervals together
    contain the true pair with the confidence c.
    """
    count = len(measured_forces)
    # A single computed range is not interpolated.
    range_count = CURVE_RANGE_COUNT if len(rhos) > 1 else 1
    fine_ranges = np.union1d(np.geomspace(rhos[0], rhos[-1], range_count), rhos)
    fine_forces = interpolate_to_ranges(computed_forces, rhos, fine_ranges)

    def work_intervals(confidence_level: float) -> np.ndarray:
        """Return the central intervals of the works (surface, fine rho, 2)."""
        ends = np.moveaxis(percentile_interval(sampled_works, confidence_level), -1, 0)
        return np.moveaxis(interpolate_to_ranges(ends, rhos, fine_ranges), 0, -1)

    joint_intervals = work_intervals(confidence ** (1 / count))
    region = np.stack(
        [joint_intervals[..., 0].max(axis=0), joint_intervals[..., 1].min(axis=0)], axis=-1
    )
    region[~(region[:, 0] < region[:, 1])] = np.nan
    work_of_adhesion = measured_forces[:, None] / fine_forces
    best_range = np.nan
    best_work = np.nan
    best_error = np.nan
    exact_pairs = 0
    if count > 1:
        best_index, work, error = fit_range_and_work(fine_forces, measured_forces)
        best_range = fine_ranges[best_index]
        best_work = float(work)
        best_error = float(error)
    if count == 2:
        second_exceeds_first = np.diff(np.log(work_of_adhesion), axis=0)[0] > 0
        exact_pairs = int(np.count_nonzero(np.diff(second_exceeds_first)))
    if exact_pairs:
        best_error = np.nan  # The remaining error comes from the grid of ranges alone.
    variables = with_interval(
        "work_of_adhesion", ("surface", "rho"), work_of_adhesion, work_intervals(confidence),
        JOULE_PER_M2, confidence,
    ) | {
        "region": (("rho", "bound"), region, JOULE_PER_M2),
        "best_range": ((), best_range, NM),
        "best_work": ((), best_work, JOULE_PER_M2),
        "best_error": ((), best_error, DIMENSIONLESS),
        "exact_pairs": ((), exact_pairs, DIMENSIONLESS),
    }  # fmt: skip
    return xr.Dataset(variables, {"rho": ("rho", fine_ranges, NM)}).assign(
        _extent(region, fine_ranges)
    )


def _extent(region: np.ndarray, ranges: np.ndarray) -> dict[str, Any]:
    """Return the extent of a region (rho, bound), and the status of its ends.

    If the region reaches the shortest or longest computed range, it may extend beyond. Then range
    and work have no limit there.
    """
    allowed = np.flatnonzero(np.isfinite(region).all(axis=-1))
    region_range, region_work = np.full(2, np.nan), np.full(2, np.nan)
    status = np.full(2, "none", "<U5")
    if len(allowed):
        ends = allowed[[0, -1]]
        is_open = ends == [0, len(ranges) - 1]
        region_range = np.where(is_open, np.nan, ranges[ends])
        status = np.where(is_open, "open", "found")
        if not is_open.any():
            region_work = np.array([np.nanmin(region[:, 0]), np.nanmax(region[:, 1])])
    return {
        "region_range": ("bound", region_range, NM),
        "region_work": ("bound", region_work, JOULE_PER_M2),
        "region_status": ("bound", status),
    }


def add_extrapolated_work(fitted: xr.Dataset, force: xr.Dataset) -> xr.Dataset:
    """Return a fit to measured forces with the work of adhesion from extrapolated roughness.

    The work is the measured force divided by the force computed at 1 J/m². Extrapolated roughness
    changes the computed force by a factor and the work by the inverse of this factor. Forces on
    masters are computed at one range and in plastic contact only, so the result is one value, not a
    curve over ranges.

    fitted: the fit, from `fit_measured`.
    force: predicted forces, as in force.nc, over the surfaces of the fit and possibly others.
    Returns the fit with ``extrapolated_work`` (surface, side) in J/m² and its interval, in which
        the independent errors of the logarithms of measured and computed force are added in
        squares; ``extrapolation_matters`` and ``transition`` of the forces; the attribute
        ``range_of_adhesion``, at which ``work_of_adhesion`` can be compared.
    """
    surface_force = force.sel(surface=fitted.surface)
    measured_force = fitted.measured_force
    computed_force = surface_force.extrapolated_force
    measured_low, measured_high = bounds(fitted, "measured_force")
    measured_log_low = np.log(measured_low / measured_force)
    measured_log_high = np.log(measured_high / measured_force)
    low, high = bounds(surface_force, "extrapolated_force")
    computed_log_high = np.log(high / computed_force)
    # A lower end of zero is no bound: its logarithm is minus infinity.
    computed_log_low = np.log(low.where(low > 0) / computed_force).where(low != 0, -np.inf)
    work = (measured_force / (computed_force / force.attrs["work_of_adhesion"])).transpose(
        "surface", "side"
    )
    ends = [
        -np.hypot(measured_log_low, computed_log_high),
        np.hypot(measured_log_high, computed_log_low),
    ]
    interval = xr.concat([work * np.exp(end) for end in ends], "bound")
    variables = with_interval(
        "extrapolated_work",
        work.dims,
        work.values,
        interval.transpose(*work.dims, "bound").values,
        JOULE_PER_M2 | {"long_name": f"work with extrapolated roughness, {PLASTIC} contact"},
        fitted.attrs["confidence"],
    )
    return (
        fitted.assign(variables)
        .assign(
            extrapolation_matters=surface_force.extrapolation_matters,
            transition=surface_force.transition,
        )
        .assign_attrs(range_of_adhesion=force.attrs["range_of_adhesion"])
    )
