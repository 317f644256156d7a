"""Classical models of rough adhesion, fitted to pull-off forces; power laws of the roughness.

Lengths in nm, forces in N, works of adhesion in J/m².
"""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import xarray as xr
from scipy.stats import truncnorm

from hardcontact.inference import error_map
from hardcontact.inference.classical_models import MODELS, Contact, Model, Roughness, adhesion_index
from hardcontact.numbers.statistics import Sampling
from hardcontact.records.dataset import stack

#: Works of adhesion (J/m²) among which that of the best fit is searched for.
WORKS = np.geomspace(1e-3, 10, 401)
REFINEMENTS = 3

NEWTON, ONE, ENERGY = {"units": "N"}, {"units": "1"}, {"units": "J m-2"}

#: Least share of the given forces that a model must reach for its work of adhesion to mean any.
PERCEPTIBLE = 1e-3


class RoughnessSamples(NamedTuple):
    """Roughness and random samples of it within its uncertainty."""

    mean: Roughness  #: Of arrays (surface,).
    drawn: Roughness  #: Of arrays (draws, surface).
    sampling: Sampling  #: How they were drawn; its confidence is that of intervals over them.


def sample_roughness(
    rng: np.random.Generator, mean: Roughness, uncertainty: Roughness, draws: int
) -> Roughness:
    """Draw roughness (draws, surface) within its uncertainty, about its mean (surface,).

    Every number is drawn by itself from a normal distribution of this mean and standard deviation,
    cut off at zero; the published ± is read as the standard deviation.
    """
    size = draws, len(mean.height)
    return Roughness(
        *(
            truncnorm.rvs(-centre / spread, np.inf, centre, spread, size=size, random_state=rng)
            for centre, spread in zip(mean, uncertainty, strict=True)
        )
    )


def fit_work(
    model: Model, roughness: Roughness, contact: Contact, target: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the work of adhesion of the least mean relative error to all forces, and this error.

    Both (...) are of roughness (..., surface) and forces (surface,) in N to be met; the error is
    the mean over surfaces of |F/target - 1|. Forces that are not proportional to the work are
    searched up to 10 J/m²; where all of them vanish up to there, the error is 1 and the work NaN,
    because no work fits better than another.
    """
    if model.proportional:
        forces = model.force(1.0, roughness, contact)
        _, work, error = error_map.fit(forces[..., None], target)
        return work, error
    work = np.broadcast_to(WORKS, (*roughness.height.shape[:-1], WORKS.size))
    step = np.log(WORKS[1] / WORKS[0])
    for _ in range(REFINEMENTS):
        best, error = _best_work(model, roughness, contact, target, work)
        finer = best[..., None] * np.exp(step * np.linspace(-1, 1, 41))
        work, step = np.clip(finer, WORKS[0], WORKS[-1]), step / 20
    best, error = _best_work(model, roughness, contact, target, work)
    return np.where(error < 1 - PERCEPTIBLE, best, np.nan), error


def _best_work(
    model: Model, roughness: Roughness, contact: Contact, target: np.ndarray, work: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the best of the works (..., k), and its error."""
    columns = Roughness(*(values[..., None] for values in roughness))  # (..., surface, 1)
    forces = model.force(work[..., None, :], columns, contact)
    errors = error_map.mean_relative_error(forces, target, np.ones(1))[..., 0]
    return error_map.at_least(errors, work)


def power_law_error(parameter: np.ndarray, work: np.ndarray) -> np.ndarray:
    """Return the mean relative error (...) of a power of a parameter (..., surface), fitted.

    The line of least squares goes through the logarithms of parameters and works (surface,).
    """
    deviation = np.log(parameter) - np.log(parameter).mean(axis=-1, keepdims=True)
    logarithm = np.log(work)
    with np.errstate(invalid="ignore"):  # one surface has no exponent
        exponent = (deviation * logarithm).sum(axis=-1) / (deviation**2).sum(axis=-1)
    fitted = logarithm.mean() + exponent[..., None] * deviation
    return np.asarray(np.abs(np.exp(fitted) / work - 1).mean(axis=-1))


def compare_models(
    samples: RoughnessSamples, contact: Contact, work: float, targets: Mapping[str, np.ndarray]
) -> xr.Dataset:
    """Return the forces of every model, and the work of adhesion of its best fit to given forces.

    `pull_off_force` is at the work given; the targets (surface,) in N are published or computed.
    Over model, against and surface.
    """
    both, sampling = (samples.mean, samples.drawn), samples.sampling
    index, indices = (
        adhesion_index(work, roughness.height, 1 / roughness.curvature, contact.modulus)
        for roughness in both
    )
    common = sampling.with_interval("adhesion_index", "surface", index, indices, ONE)
    forces, fits = {}, {}
    for name, model in MODELS.items():
        force, drawn = (model.force(work, roughness, contact) for roughness in both)
        variables = sampling.with_interval("pull_off_force", "surface", force, drawn, NEWTON)
        forces[(name,)] = xr.Dataset(variables)
        for against, target in targets.items():
            (fitted, least), (works, leasts) = (
                fit_work(model, roughness, contact, target) for roughness in both
            )
            # Where the mean does not adhere, there is no interval.
            works = np.where(np.isnan(fitted), np.nan, works)
            fits[name, against] = xr.Dataset(
                sampling.with_interval("fitted_work_of_adhesion", (), fitted, works, ENERGY)
                | sampling.with_interval("mean_relative_error", (), least, leasts, ONE)
            )
    return stack(forces, ["model"]).merge(stack(fits, ["model", "against"])).assign(common)


def power_laws(samples: RoughnessSamples, works: Mapping[str, np.ndarray]) -> xr.Dataset:
    """Return how well a power of one roughness parameter gives the effective work of adhesion.

    `works` (surface,) are by the forces that they follow from; ``power_law_error`` is over
    rms_parameter and against.
    """
    parts = {}
    for parameter, *both in zip(Roughness._fields, samples.mean, samples.drawn, strict=True):
        for against, work in works.items():
            error, errors = (power_law_error(values, work) for values in both)
            variables = samples.sampling.with_interval("power_law_error", (), error, errors, ONE)
            parts[parameter, against] = xr.Dataset(variables)
    return stack(parts, ["rms_parameter", "against"])
