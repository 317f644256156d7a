"""Forces between the computed ranges, and the range and work that fit measured forces best.

`mean_forces` (..., surface, rho), computed at 1 J/m², are proportional to the work of adhesion.
They are compared with `measured_forces` (surface,). Forces are in N.
"""

import numpy as np
import xarray as xr
from scipy.interpolate import make_interp_spline

from hardcontact.base.arrays import Floats
from hardcontact.base.units import DIMENSIONLESS, JOULE_PER_M2, NM

#: Number of ranges of adhesion of a fit: steps between 0.05 and 40 nm are 0.8 %, far below the
#: interval of a fitted range.
FINE_RANGE_COUNT = 801
#: Variables of the best fit, with their units.
FIT_ATTRS = {"range_of_adhesion": NM, "work_of_adhesion": JOULE_PER_M2, "best_error": DIMENSIONLESS}
#: Names of these variables in a fit without one surface.
WITHOUT_SURFACE = {
    "range_of_adhesion": "range_without_surface",
    "work_of_adhesion": "work_without_surface",
    "best_error": "error_without_surface",
}


def spline_weights(points: Floats, targets: Floats | float, *, extrapolate: bool = False) -> Floats:
    """Return the weights (..., point) of a spline through ascending points at targets (...).

    The degree is at most three. Beyond the points, weights are NaN unless `extrapolate` is True.
    """
    spline = make_interp_spline(points, np.eye(len(points)), k=min(3, len(points) - 1))
    return np.asarray(spline(targets, extrapolate=extrapolate))


def interpolate_to_ranges(
    forces: Floats, computed_ranges: Floats, new_ranges: Floats | float
) -> Floats:
    """Return forces (..., rho) at new ranges, by `spline_weights` in log F and log rho."""
    weights = spline_weights(np.log(computed_ranges), np.log(new_ranges))
    return np.asarray(np.exp(np.log(forces) @ weights.T))


def interpolate_forces(forces: xr.DataArray, rho: float) -> xr.DataArray:
    """Return forces (...) at one range (nm) by `interpolate_to_ranges`."""
    interpolated: xr.DataArray = xr.apply_ufunc(
        interpolate_to_ranges, forces, forces["rho"], rho, input_core_dims=[["rho"], ["rho"], []]
    )
    return interpolated


def fine_ranges(ranges: Floats) -> Floats:
    """Return FINE_RANGE_COUNT ranges between the ends of ascending ranges, or the only range."""
    if len(ranges) == 1:
        return ranges
    return np.geomspace(ranges[0], ranges[-1], FINE_RANGE_COUNT)


def mean_relative_error(mean_forces: Floats, measured_forces: Floats, works: Floats) -> Floats:
    """Return the mean relative error (..., rho, k) over surfaces for works (k,) in J/m²."""
    relative_forces = mean_forces / measured_forces[:, None]
    return np.asarray(np.abs(relative_forces[..., None] * works - 1).mean(axis=-3))


def minimum_along_axis(errors: Floats, values: Floats, axis: int = -1) -> tuple[Floats, Floats]:
    """Return the values at the minima of errors along an axis, and these minima."""
    best_index = np.expand_dims(errors.argmin(axis=axis), axis)
    value = np.take_along_axis(values, best_index, axis).squeeze(axis)
    return value, np.take_along_axis(errors, best_index, axis).squeeze(axis)


def fit_work(mean_forces: Floats, measured_forces: Floats) -> tuple[Floats, Floats]:
    """Return the work of adhesion (..., rho) in J/m² with the smallest error, and this error.

    The mean relative error is piecewise linear in the work, so that at its minimum the force on one
    surface matches exactly.
    """
    relative_forces = mean_forces / measured_forces[:, None]
    matching_works = 1 / relative_forces
    errors = [
        np.abs(matching_works[..., [index], :] * relative_forces - 1).mean(axis=-2)
        for index in range(len(measured_forces))
    ]
    return minimum_along_axis(np.stack(errors, axis=-2), matching_works, axis=-2)


def best_fit(mean_forces: Floats, measured_forces: Floats, ranges: Floats) -> dict[str, Floats]:
    """Return the variables of FIT_ATTRS (...); NaN if a computed force is NaN. Ranges are in nm."""
    works, errors = fit_work(mean_forces, measured_forces)
    work, error = minimum_along_axis(errors, works)
    is_finite = np.isfinite(error)
    return {
        "range_of_adhesion": np.where(is_finite, ranges[errors.argmin(axis=-1)], np.nan),
        "work_of_adhesion": np.where(is_finite, work, np.nan),
        "best_error": error,
    }
