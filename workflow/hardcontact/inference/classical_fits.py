"""Classical models of rough adhesion, fitted to pull-off forces; power laws of the roughness.

Lengths in nm, forces in N, works of adhesion in J/m².
"""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from scipy.stats import rankdata, truncnorm

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


class PowerLaw(NamedTuple):
    """How well a power of one roughness parameter gives the effective work of adhesion.

    All are arrays (...); errors are means over surfaces of relative errors.
    """

    #: Spearman's; of four points it is 1 or -1 by chance in one case of twelve.
    rank_correlation: np.ndarray
    power_law_exponent: np.ndarray  #: Of the least-squares line through the logarithms.
    power_law_error: np.ndarray  #: At the surfaces fitted to.
    #: At each surface when the fit leaves it out: two parameters nearly always fit four points.
    prediction_error: np.ndarray


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


def fit_power_law(parameter: np.ndarray, work: np.ndarray) -> PowerLaw:
    """Fit a power of a roughness parameter (..., surface) to effective works (surface,)."""
    x, y = (rankdata(values, axis=-1) - (len(work) + 1) / 2 for values in (parameter, work))
    correlation = (x * y).sum(axis=-1) / np.sqrt((x**2).sum(axis=-1) * (y**2).sum())
    exponent, fitted = _line(np.log(parameter), np.log(work), np.log(parameter))
    left_out = []
    for surface in range(len(work)):
        others = np.arange(len(work)) != surface
        known = np.log(parameter[..., others]), np.log(work[others])
        left_out.append(_line(*known, np.log(parameter[..., [surface]]))[1][..., 0])
    predicted = np.stack(left_out, axis=-1)
    errors = (np.abs(np.exp(line) / work - 1).mean(axis=-1) for line in (fitted, predicted))
    return PowerLaw(correlation, exponent, *errors)


def _line(x: np.ndarray, y: np.ndarray, at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the slope (...) of the least-squares line along the last axis, and values `at`."""
    centre = x.mean(axis=-1, keepdims=True)
    deviation = x - centre
    with np.errstate(invalid="ignore"):  # one point has no slope
        slope = (deviation * y).sum(axis=-1) / (deviation**2).sum(axis=-1)
    return slope, y.mean() + slope[..., None] * (at - centre)


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
            error, errors = (np.abs(one / target - 1).mean(axis=-1) for one in (force, drawn))
            fits[name, against] = xr.Dataset(
                sampling.with_interval("fitted_work_of_adhesion", (), fitted, works, ENERGY)
                | sampling.with_interval("mean_relative_error", (), least, leasts, ONE)
                | sampling.with_interval("error_at_published_work", (), error, errors, ONE)
            )
    return stack(forces, ["model"]).merge(stack(fits, ["model", "against"])).assign(common)


def power_laws(samples: RoughnessSamples, works: Mapping[str, np.ndarray]) -> xr.Dataset:
    """Return how well a power of one roughness parameter gives the effective work of adhesion.

    `works` (surface,) are by the forces that they follow from; the fields of `PowerLaw` are over
    rms_parameter and against.
    """
    parts = {}
    for parameter, *both in zip(Roughness._fields, samples.mean, samples.drawn, strict=True):
        for against, work in works.items():
            laws = [fit_power_law(values, work) for values in both]
            variables: dict[str, Any] = {}
            for name, value, drawn in zip(PowerLaw._fields, *laws, strict=True):
                variables |= samples.sampling.with_interval(name, (), value, drawn, ONE)
            parts[parameter, against] = xr.Dataset(variables)
    return stack(parts, ["rms_parameter", "against"])
