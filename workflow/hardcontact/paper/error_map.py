"""How far computed mean forces are from measured ones, by range and work of adhesion.

All forces are computed for a work of adhesion of 1 J/m², to which they are proportional.
"""

import numpy as np
from scipy.signal import find_peaks

#: Works of adhesion (J/m²) of the error map.
WORK = np.geomspace(1e-3, 10.0, 501)


def mean_relative_error(
    mean_forces: np.ndarray, published: np.ndarray, work: np.ndarray
) -> np.ndarray:
    """Return the mean over surfaces of |W f/F - 1|: (..., rho, k).

    Forces f (..., surface, rho) in N are at 1 J/m², F (surface,) is measured, W (k,) is in J/m².
    """
    relative = mean_forces / published[:, None]
    return np.asarray(np.abs(relative[..., None] * work - 1).mean(axis=-3))


def at_least(
    errors: np.ndarray, values: np.ndarray, axis: int = -1
) -> tuple[np.ndarray, np.ndarray]:
    """Return values and errors, of one shape, where these are least along an axis."""
    best = np.expand_dims(errors.argmin(axis=axis), axis)
    value, error = (np.take_along_axis(one, best, axis).squeeze(axis) for one in (values, errors))
    return value, error


def fit_work(mean_forces: np.ndarray, published: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Find the work of adhesion of the least mean relative error at every range.

    The error is piecewise linear in W, so that its minimum lies at one of the W that match a
    surface exactly; all are tried. Of mean forces (..., surface, rho) at 1 J/m² and published ones
    (surface,), in N, follow the work in J/m² and the error, both (..., rho).
    """
    relative = mean_forces / published[:, None]
    candidates = 1 / relative
    errors = np.stack(
        [
            np.abs(candidates[..., [surface], :] * relative - 1).mean(axis=-2)
            for surface in range(len(published))
        ],
        axis=-2,
    )  # (..., candidate, rho)
    return at_least(errors, candidates, axis=-2)


def fit(
    mean_forces: np.ndarray, published: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Find the range and work of adhesion of the least mean relative error.

    Of forces as in `fit_work` follow the index into rho, the work in J/m² and the error, all (...).
    """
    work, error = fit_work(mean_forces, published)
    return error.argmin(axis=-1), *at_least(error, work)


def least_errors(errors: np.ndarray, count: int) -> np.ndarray:
    """Return where errors (rho,) have their local minima, the least first: (count,) at most.

    An end of the ranges counts where the error grows from it inwards.
    """
    minima = find_peaks(-np.concatenate([[np.inf], errors, [np.inf]]))[0] - 1
    return np.asarray(minima[np.argsort(errors[minima], kind="stable")[:count]])


def fit_ratios(
    mean_forces: np.ndarray, published: np.ndarray, reference: int
) -> tuple[np.ndarray, np.ndarray]:
    """Find the range of the least mean relative error of the ratios to a reference surface.

    The work of adhesion cancels. Of forces (..., surface, rho) and measured ones (surface,) in N
    follow the index (...) into rho, and the errors (..., rho).
    """
    ratios = mean_forces / mean_forces[..., [reference], :]
    expected = (published / published[reference])[:, None]
    others = np.arange(len(published)) != reference
    errors = np.abs(ratios / expected - 1)[..., others, :].mean(axis=-2)
    return errors.argmin(axis=-1), errors


def error_region(
    errors: np.ndarray, rhos: np.ndarray, work: np.ndarray, threshold: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return least and greatest rho, and W, where the error map (rho, work) is below `threshold`.

    Two arrays (2,), NaN where there is no such place.
    """
    rows, columns = np.nonzero(errors < threshold)
    if not rows.size:
        return np.full(2, np.nan), np.full(2, np.nan)
    return rhos[[rows.min(), rows.max()]], work[[columns.min(), columns.max()]]
