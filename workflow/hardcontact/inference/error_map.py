"""Errors of computed mean forces relative to measured forces, by range and work of adhesion.

All forces are computed for a work of adhesion of 1 J/m², to which they are proportional.
"""

import numpy as np

#: Works of adhesion (J/m²) of the error map.
WORKS = np.geomspace(1e-3, 10.0, 501)


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
