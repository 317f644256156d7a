"""Forces whose fit has two minima, as those of the study: near 1.5 nm and near 10 nm."""

import numpy as np
from paper_numbers import MEAN_FORCE
from scipy.special import log_ndtr

from figure_inputs.building import RADIUS

CONTACT_MODELS = ["rigid", "plastic"]
RHO = np.array(
    [0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 1, 1.4, 2, 2.8, 4, 5, 5.6, 7, 8, 10, 14, 20, 28, 40]
)
FINE = np.geomspace(RHO[0], RHO[-1], 201)
PUBLISHED_RANGE, PUBLISHED_WORK = 5.6, 0.0463
MINIMA = 3
#: Heights (nm) of each surface: their rms, and that of closest approach over their mean.
ROUGHNESS = np.array([3.2, 17.4, 24.0, 27.0])
APPROACH = np.array([[10.6, 57.0, 77.0, 90.0], [8.6, 55.0, 75.0, 88.0]])
TOUCHING = np.array([24.0, 400.0])  # nm², by contact model


def mean_forces(rho: np.ndarray, approach: np.ndarray = APPROACH) -> np.ndarray:
    """Return forces (..., contact_model, surface, rho) in N at 1 J/m² of Gaussian heights.

    `approach` (..., contact_model, surface) is in nm, as `rho`.
    """
    height, rms = approach[..., None], ROUGHNESS[:, None]
    exponent = rms**2 / (2 * rho**2) - height / rho + log_ndtr(height / rms - rms / rho)
    return 1e-9 * (2 * np.pi * RADIUS * np.exp(exponent) + TOUCHING[:, None, None] / rho)


def least_errors(forces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the error least over W, and that W (J/m²), (..., rho) of (..., surface, rho)."""
    relative = forces / MEAN_FORCE[:, None]
    works = 1 / relative
    errors = abs(works[..., None, :] * relative[..., None, :, :] - 1).mean(axis=-2)
    best = errors.argmin(axis=-2)[..., None, :]
    return (
        np.take_along_axis(errors, best, -2)[..., 0, :],
        np.take_along_axis(works, best, -2)[..., 0, :],
    )


def minima(errors: np.ndarray, works: np.ndarray) -> np.ndarray:
    """Return range, work and error (..., 3, minimum) of the minima of errors (..., rho) on FINE."""
    found = np.full((*errors.shape[:-1], 3, MINIMA), np.nan)
    for place in np.ndindex(errors.shape[:-1]):
        error = errors[place]
        lowest = (error[1:-1] < error[:-2]) & (error[1:-1] < error[2:])
        at = 1 + np.flatnonzero(lowest)
        at = at[error[at].argsort()][:MINIMA]
        found[place][:, : at.size] = FINE[at], works[place][at], error[at]
    return found
