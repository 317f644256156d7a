"""Classical models of rough adhesion, fitted to pull-off forces; power laws of the roughness.

Lengths in nm, forces in N, works of adhesion in J/m².
"""

from collections.abc import Mapping

import numpy as np
import xarray as xr
from scipy.stats import truncnorm

from hardcontact.base.arrays import Floats
from hardcontact.base.dataset import stack
from hardcontact.base.statistics import Sampling
from hardcontact.base.units import DIMENSIONLESS, NEWTON
from hardcontact.inference import fit
from hardcontact.paper.classical_models import MODELS, ClassicalModel, ElasticSphere, Roughness

#: Works of adhesion (J/m²) among which the best fit is searched first.
SEARCHED_WORKS = np.geomspace(1e-3, 10, 401)
#: Exponents of power laws of roughness parameters that are searched first.
EXPONENTS = np.linspace(-8, 8, 321)
#: Repeated searches, each on a 20 times finer grid about the best value: it is known to 1e-5.
REFINEMENTS = 3
#: Smallest force of a model, relative to the target, for which a work of adhesion is fitted.
MIN_FORCE_RATIO = 1e-3


def sample_roughness(
    rng: np.random.Generator, mean: Roughness, uncertainty: Roughness, samples: int
) -> Roughness:
    """Sample the roughness (samples, surface) within its uncertainty.

    Every number is sampled independently from a normal distribution, truncated at zero. The
    published ± is its standard deviation.
    """
    size = samples, len(mean.height)
    return Roughness(
        *(
            truncnorm.rvs(-centre / spread, np.inf, centre, spread, size=size, random_state=rng)
            for centre, spread in zip(mean, uncertainty, strict=True)
        )
    )


def fit_classical_work(
    model: ClassicalModel, roughness: Roughness, sphere: ElasticSphere, target: Floats
) -> tuple[Floats, Floats]:
    """Return the work (...) in J/m² that fits a model to forces (surface,) in N, and the error.

    The fit minimizes the mean over surfaces of |F/target - 1|. If the force of the model is not
    proportional to the work, works up to 10 J/m² are searched. If all forces vanish, the work is
    NaN and the error is 1.
    """
    if model.proportional:
        forces = model.force(1.0, roughness, sphere)
        _, work, error = fit.fit_range_and_work(forces[..., None], target)
        return work, error
    columns = Roughness(*(values[..., None] for values in roughness))  # (..., surface, 1)
    works = np.broadcast_to(SEARCHED_WORKS, (*roughness.height.shape[:-1], SEARCHED_WORKS.size))
    step = np.log(SEARCHED_WORKS[1] / SEARCHED_WORKS[0])
    for refinement in range(REFINEMENTS + 1):
        forces = model.force(works[..., None, :], columns, sphere)
        errors = fit.mean_relative_error(forces, target, np.ones(1))[..., 0]
        best, error = fit.minimum_along_axis(errors, works)
        if refinement < REFINEMENTS:
            finer_works = best[..., None] * np.exp(step * np.linspace(-1, 1, 41))
            works = np.clip(finer_works, SEARCHED_WORKS[0], SEARCHED_WORKS[-1])
            step /= 20
    return np.where(error < 1 - MIN_FORCE_RATIO, best, np.nan), error


def power_law_error(parameter: Floats, work: Floats) -> Floats:
    """Return the smallest error (...) of a power law for works of adhesion (surface,).

    The factor and the exponent of the parameter (..., surface) minimize the error. Exponents are
    searched among EXPONENTS, then around the best exponent.
    """
    logarithm = np.log(parameter / parameter.mean(axis=-1, keepdims=True))[..., None]
    step = EXPONENTS[1] - EXPONENTS[0]
    exponents = np.broadcast_to(EXPONENTS, (*parameter.shape[:-1], EXPONENTS.size))
    for _ in range(REFINEMENTS + 1):
        powers = np.exp(logarithm * exponents[..., None, :])  # (..., surface, exponent)
        best, error = fit.minimum_along_axis(fit.fit_work(powers, work)[1], exponents)
        exponents = best[..., None] + step * np.linspace(-1, 1, 41)
        step /= 20
    return error


def compare_models(
    mean: Roughness,
    samples: Roughness,
    sphere: ElasticSphere,
    work: float,
    targets: Mapping[str, Floats],
    sampling: Sampling,
) -> xr.Dataset:
    """Return the forces of every model, and the error of its fit to target forces.

    Samples (samples, surface) of the roughness give the intervals. The work of adhesion is fitted
    to the targets (surface,), in N, by name.
    """
    forces = {}
    fits = {}
    for name, model in MODELS.items():
        force = model.force(work, mean, sphere)
        force_samples = model.force(work, samples, sphere)
        variables = sampling.with_interval("model_force", "surface", force, force_samples, NEWTON)
        forces[(name,)] = xr.Dataset(variables)
        for force_source, target in targets.items():
            _, error = fit_classical_work(model, mean, sphere, target)
            _, error_samples = fit_classical_work(model, samples, sphere, target)
            variables = sampling.with_interval(
                "mean_relative_error", (), error, error_samples, DIMENSIONLESS
            )
            fits[name, force_source] = xr.Dataset(variables)
    return stack(forces, ["model"]).merge(stack(fits, ["model", "force_source"]))


def power_laws(
    mean: Roughness, samples: Roughness, works: Mapping[str, Floats], sampling: Sampling
) -> xr.Dataset:
    """Return ``power_law_error`` of single roughness parameters for effective works of adhesion.

    Samples (samples, surface) of the roughness give the intervals. The works (surface,), in J/m²,
    have the names of their forces.
    """
    fits = {}
    for parameter in Roughness._fields:
        for force_source, work in works.items():
            error = power_law_error(getattr(mean, parameter), work)
            error_samples = power_law_error(getattr(samples, parameter), work)
            variables = sampling.with_interval(
                "power_law_error", (), error, error_samples, DIMENSIONLESS
            )
            fits[parameter, force_source] = xr.Dataset(variables)
    return stack(fits, ["rms_parameter", "force_source"])
