"""Classical models of rough adhesion, fitted to pull-off forces; power laws of the roughness.

Lengths in nm, forces in N, works of adhesion in J/m².
"""

from collections.abc import Mapping

import numpy as np
import xarray as xr
from scipy.stats import truncnorm

from hardcontact.base.dataset import stack
from hardcontact.base.statistics import Sampling
from hardcontact.paper import error_map
from hardcontact.paper.classical_models import MODELS, ElasticSphere, Model, Roughness

#: Works of adhesion (J/m²) among which that of the best fit is searched for.
WORKS = np.geomspace(1e-3, 10, 401)
#: Exponents of powers of roughness parameters.
EXPONENTS = np.linspace(-8, 8, 321)
REFINEMENTS = 3

NEWTON, ONE = {"units": "N"}, {"units": "1"}

#: Least share of the given forces that a model must reach for its work of adhesion to mean any.
PERCEPTIBLE = 1e-3


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
    model: Model, roughness: Roughness, sphere: ElasticSphere, target: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the work of adhesion of the least mean relative error to all forces, and this error.

    Both (...) are of roughness (..., surface) and forces (surface,) in N to be met; the error is
    the mean over surfaces of |F/target - 1|. Forces that are not proportional to the work are
    searched up to 10 J/m². Where all of them vanish, the error is 1 and the work NaN.
    """
    if model.proportional:
        forces = model.force(1.0, roughness, sphere)
        _, work, error = error_map.fit(forces[..., None], target)
        return work, error
    columns = Roughness(*(values[..., None] for values in roughness))  # (..., surface, 1)
    works = np.broadcast_to(WORKS, (*roughness.height.shape[:-1], WORKS.size))
    step = np.log(WORKS[1] / WORKS[0])
    for refinement in range(REFINEMENTS + 1):
        forces = model.force(works[..., None, :], columns, sphere)
        errors = error_map.mean_relative_error(forces, target, np.ones(1))[..., 0]
        best, error = error_map.at_least(errors, works)
        if refinement < REFINEMENTS:
            finer = best[..., None] * np.exp(step * np.linspace(-1, 1, 41))
            works, step = np.clip(finer, WORKS[0], WORKS[-1]), step / 20
    return np.where(error < 1 - PERCEPTIBLE, best, np.nan), error


def power_law_error(parameter: np.ndarray, work: np.ndarray) -> np.ndarray:
    """Return the least mean relative error (...) of any power of a parameter (..., surface).

    The factor before the power and the exponent are those of the least error to the works
    (surface,). Exponents are searched within EXPONENTS, then about the best one.
    """
    logarithm = np.log(parameter / parameter.mean(axis=-1, keepdims=True))[..., None]
    step = EXPONENTS[1] - EXPONENTS[0]
    exponents = np.broadcast_to(EXPONENTS, (*parameter.shape[:-1], EXPONENTS.size))
    for _ in range(REFINEMENTS + 1):
        powers = np.exp(logarithm * exponents[..., None, :])  # (..., surface, exponent)
        best, error = error_map.at_least(error_map.fit_work(powers, work)[1], exponents)
        exponents, step = best[..., None] + step * np.linspace(-1, 1, 41), step / 20
    return error


def compare_models(
    mean: Roughness,
    drawn: Roughness,
    sphere: ElasticSphere,
    work: float,
    targets: Mapping[str, np.ndarray],
    sampling: Sampling,
) -> xr.Dataset:
    """Return the forces of every model, and how well it fits given forces.

    Parameters
    ----------
    mean, drawn : Roughness
        Of arrays (surface,), and samples of it (draws, surface), which give the intervals.
    sphere : ElasticSphere
        The sphere and its materials.
    work : float
        Work of adhesion (J/m²) of the forces that are returned.
    targets : mapping of str to numpy.ndarray
        Forces (surface,) in N that the work of adhesion is fitted to, by their name.
    sampling : Sampling
        Its confidence is that of the intervals.

    Returns
    -------
    xarray.Dataset
        ``pull_off_force`` (model, surface) in N and ``mean_relative_error`` (model, against).
    """
    forces, fits = {}, {}
    for name, model in MODELS.items():
        force, sampled = (model.force(work, roughness, sphere) for roughness in (mean, drawn))
        variables = sampling.with_interval("pull_off_force", "surface", force, sampled, NEWTON)
        forces[(name,)] = xr.Dataset(variables)
        for against, target in targets.items():
            error, errors = (
                fit_work(model, roughness, sphere, target)[1] for roughness in (mean, drawn)
            )
            variables = sampling.with_interval("mean_relative_error", (), error, errors, ONE)
            fits[name, against] = xr.Dataset(variables)
    return stack(forces, ["model"]).merge(stack(fits, ["model", "against"]))


def power_laws(
    mean: Roughness, drawn: Roughness, works: Mapping[str, np.ndarray], sampling: Sampling
) -> xr.Dataset:
    """Return how well a power of one roughness parameter gives the effective work of adhesion.

    Roughness is as of `compare_models`, `works` (surface,) are by the forces that they follow from;
    ``power_law_error`` is over rms_parameter and against.
    """
    parts = {}
    for parameter, value, samples in zip(Roughness._fields, mean, drawn, strict=True):
        for against, work in works.items():
            error, errors = (power_law_error(values, work) for values in (value, samples))
            variables = sampling.with_interval("power_law_error", (), error, errors, ONE)
            parts[parameter, against] = xr.Dataset(variables)
    return stack(parts, ["rms_parameter", "against"])
