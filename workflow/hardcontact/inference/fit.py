"""Range and work of adhesion that fit mean forces best: errors of all pairs, and the best pair.

All forces are computed for a work of adhesion of 1 J/m², to which they are proportional.
"""

from collections.abc import Sequence

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.units import DIMENSIONLESS, JOULE_PER_M2, NM
from hardcontact.contact.force_curves import interpolate_to_ranges

#: Works of adhesion (J/m²) of the error map.
WORKS = np.geomspace(1e-3, 10.0, 501)
#: Number of ranges of adhesion of a fit, from the shortest to the longest computed range.
RANGE_COUNT = 801
#: Variables of the best fit, with their units.
FIT_UNITS = {
    "range_of_adhesion": NM,
    "work_of_adhesion": JOULE_PER_M2,
    "best_error": DIMENSIONLESS,
}
#: Names of the variables of the best fit without one surface.
WITHOUT_SURFACE = {
    "range_of_adhesion": "range_without_surface",
    "work_of_adhesion": "work_without_surface",
    "best_error": "error_without_surface",
}


def mean_relative_error(
    mean_forces: np.ndarray, measured_forces: np.ndarray, works: np.ndarray
) -> np.ndarray:
    """Return the mean over surfaces of |W f/F - 1|.

    mean_forces: computed forces f (..., surface, rho) in N at 1 J/m².
    measured_forces: measured forces F (surface,) in N.
    works: works of adhesion W (k,) in J/m².
    Returns errors (..., rho, k).
    """
    relative = mean_forces / measured_forces[:, None]
    return np.asarray(np.abs(relative[..., None] * works - 1).mean(axis=-3))


def minimum_along_axis(
    errors: np.ndarray, values: np.ndarray, axis: int = -1
) -> tuple[np.ndarray, np.ndarray]:
    """Return the values at the minima of the errors along an axis, and these minima.

    errors, values: arrays of the same shape.
    Returns values and errors at the minima, without the axis.
    """
    best_index = np.expand_dims(errors.argmin(axis=axis), axis)
    value = np.take_along_axis(values, best_index, axis).squeeze(axis)
    error = np.take_along_axis(errors, best_index, axis).squeeze(axis)
    return value, error


def fit_work(mean_forces: np.ndarray, measured_forces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Find the work of adhesion that minimizes the mean relative error, at every range.

    The error is piecewise linear in W. Its minimum is therefore at a W that matches the force on
    one of the surfaces exactly, and all these W are compared.

    mean_forces: computed forces (..., surface, rho) in N at 1 J/m².
    measured_forces: measured forces (surface,) in N.
    Returns work of adhesion (..., rho) in J/m² and its error (..., rho).
    """
    relative = mean_forces / measured_forces[:, None]
    candidates = 1 / relative
    errors = np.stack(
        [
            np.abs(candidates[..., [surface], :] * relative - 1).mean(axis=-2)
            for surface in range(len(measured_forces))
        ],
        axis=-2,
    )  # (..., candidate, rho)
    return minimum_along_axis(errors, candidates, axis=-2)


def fit_range_and_work(
    mean_forces: np.ndarray, measured_forces: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Find the range and the work of adhesion that minimize the mean relative error.

    mean_forces, measured_forces: as for `fit_work`.
    Returns index into rho, work of adhesion in J/m² and error, each (...).
    """
    work, error = fit_work(mean_forces, measured_forces)
    return error.argmin(axis=-1), *minimum_along_axis(error, work)


def local_minima(errors: np.ndarray, count: int) -> np.ndarray:
    """Return the indices of the local minima of errors, the smallest error first.

    An end of the ranges is a minimum if the error grows from it inwards.

    errors: errors (rho,).
    count: largest number of minima.
    Returns indices into rho, at most `count`.
    """
    run_starts = np.flatnonzero(np.diff(errors, prepend=np.inf))  # the first of equal neighbours
    change = np.diff(errors[run_starts], prepend=np.inf, append=np.inf)
    minima = run_starts[(change[:-1] < 0) & (change[1:] > 0)]
    return np.asarray(minima[np.argsort(errors[minima], kind="stable")[:count]])


def fit_ratios(
    mean_forces: np.ndarray, measured_forces: np.ndarray, reference: int
) -> tuple[np.ndarray, np.ndarray]:
    """Find the range that minimizes the error of the force ratios to a reference surface.

    The work of adhesion cancels in these ratios.

    mean_forces: computed forces (..., surface, rho) in N.
    measured_forces: measured forces (surface,) in N.
    Returns index (...) into rho, and the mean relative errors (..., rho) of the ratios.
    """
    ratios = mean_forces / mean_forces[..., [reference], :]
    measured_ratios = (measured_forces / measured_forces[reference])[:, None]
    is_other = np.arange(len(measured_forces)) != reference
    errors = np.abs(ratios / measured_ratios - 1)[..., is_other, :].mean(axis=-2)
    return errors.argmin(axis=-1), errors


def error_region(
    errors: np.ndarray, rhos: np.ndarray, works: np.ndarray, threshold: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return the extent in range and work of adhesion of the region of small error.

    errors: error map (rho, work).
    rhos, works: ranges of adhesion (rho,) in nm and works of adhesion (work,) in J/m².
    threshold: error below which a pair counts as fitting.
    Returns smallest and largest range (2,) and work (2,) of these pairs, NaN if there are none.
    """
    rows, columns = np.nonzero(errors < threshold)
    if not rows.size:
        return np.full(2, np.nan), np.full(2, np.nan)
    return rhos[[rows.min(), rows.max()]], works[[columns.min(), columns.max()]]


def fine_ranges(ranges: np.ndarray) -> np.ndarray:
    """Return the ranges (nm) of a fit, from the shortest to the longest of the computed ranges."""
    if len(ranges) == 1:
        return ranges
    return np.geomspace(ranges[0], ranges[-1], RANGE_COUNT)


def best_fit(curves: np.ndarray, targets: np.ndarray, ranges: np.ndarray) -> dict[str, np.ndarray]:
    """Return the variables (...) of FIT_UNITS, NaN where a curve has NaN.

    curves: computed mean forces (..., surface, range) in N at these ranges (nm).
    targets: measured mean forces (surface,) in N.
    """
    best_index, work, error = fit_range_and_work(curves, targets)
    best_range = np.where(np.isfinite(error), ranges[best_index], np.nan)
    return {"range_of_adhesion": best_range, "work_of_adhesion": work, "best_error": error}


def fit_mean_forces(mean_forces: xr.DataArray, measured_forces: pd.Series) -> xr.Dataset:
    """Return the `best_fit` (...) to mean forces (..., surface, rho) in N.

    Surfaces without a measured mean force (N, by surface) do not enter the fit.
    """
    targets = measured_forces.reindex(mean_forces["surface"].values).dropna()
    dimensions = [dim for dim in mean_forces.dims if dim not in ("surface", "rho")]
    forces = mean_forces.sel(surface=targets.index).transpose(*dimensions, "surface", "rho")
    ranges = fine_ranges(forces["rho"].values)
    curves = interpolate_to_ranges(forces.values, forces["rho"].values, ranges)
    fit = best_fit(curves, targets.to_numpy(), ranges)
    return xr.Dataset(
        {name: (dimensions, fit[name], attributes) for name, attributes in FIT_UNITS.items()},
        {dim: forces[dim] for dim in dimensions},
    )


def fit_without_each_surface(mean_forces: xr.DataArray, measured_forces: pd.Series) -> xr.Dataset:
    """Return the variables of WITHOUT_SURFACE (left_out, ...): fits without one surface at a time.

    The arguments are those of `fit_mean_forces`.
    """
    surfaces: Sequence[str] = mean_forces["surface"].values.tolist()
    fits = [
        fit_mean_forces(mean_forces.drop_sel(surface=name), measured_forces) for name in surfaces
    ]
    return xr.concat(fits, pd.Index(surfaces, name="left_out")).rename(WITHOUT_SURFACE)
