"""Classical models of rough adhesion against published and computed pull-off forces.

What a model calls an asperity and Table 1 does not give is read from rms height, slope and
curvature; these readings are assumed and stand with each model. Lengths in nm, forces in N, works
of adhesion in J/m².
"""

from collections.abc import Callable
from decimal import Decimal
from typing import NamedTuple

import numpy as np
import xarray as xr
from scipy.stats import rankdata, truncnorm

from hardcontact import classical, inference
from hardcontact.dataset import stack
from hardcontact.statistics import with_interval

__all__ = [
    "MODELS",
    "Contact",
    "Roughness",
    "compare",
    "drawn",
    "effective_works",
    "fit_work",
    "half_unit",
    "power_laws",
    "transition",
]

#: Works of adhesion (J/m²) among which that of the best fit is searched for.
WORKS = np.geomspace(1e-3, 10, 401)
REFINEMENTS = 3

#: Least share of the measured forces that a model must yield for its work of adhesion to mean any.
PERCEPTIBLE = 1e-3

# Close-packed hemispheres of radius r, heights from their base: rms² = π r²/4√3.
HEMISPHERE_OVER_RMS = (4 * np.sqrt(3) / np.pi) ** 0.5


class Contact(NamedTuple):
    """What all models share: sphere radius (nm), E* (Pa), equilibrium spacing (nm)."""

    radius: float
    modulus: float
    spacing: float


class Roughness(NamedTuple):
    """Rms height (nm), slope (1) and curvature (nm⁻¹), each (..., surface)."""

    height: np.ndarray
    slope: np.ndarray
    curvature: np.ndarray


class Model(NamedTuple):
    """A model: its force (N) for a work of adhesion, a roughness and a contact."""

    label: str
    force: Callable
    proportional: bool  # whether the force is proportional to the work of adhesion
    roughness: str
    verified: str


def _rumpf_height(work, roughness, contact):
    radius = HEMISPHERE_OVER_RMS * roughness.height
    return classical.rumpf(work, contact.radius, radius, contact.spacing)


def _rumpf_curvature(work, roughness, contact):
    return classical.rumpf(work, contact.radius, 1 / roughness.curvature, contact.spacing)


def _rabinovich(work, roughness, contact):
    distance = 2 * np.pi * roughness.height / roughness.slope
    return classical.rabinovich(work, contact.radius, roughness.height, distance, contact.spacing)


def _fuller_tabor(work, roughness, contact):
    return classical.fuller_tabor(
        work, contact.radius, roughness.height, 1 / roughness.curvature, contact.modulus
    )


def _maugis(work, roughness, contact):
    return classical.maugis_rough_dmt(
        work, contact.radius, roughness.height, 1 / roughness.curvature, contact.modulus
    )


ASPERITIES = (
    "Gaussian asperity heights of standard deviation rms height, asperity radius 1/rms curvature "
    "(both assumed)"
)
UNVERIFIED = "unverified against the primary source"

MODELS = {
    "rumpf_height": Model(
        "Rumpf (height)",
        _rumpf_height,
        True,
        "hemispheres of radius 1.485 rms height (close-packed; assumed)",
        UNVERIFIED,
    ),
    "rumpf_curvature": Model(
        "Rumpf (curvature)",
        _rumpf_curvature,
        True,
        "hemispheres of radius 1/rms curvature (assumed)",
        UNVERIFIED,
    ),
    "rabinovich": Model(
        "Rabinovich",
        _rabinovich,
        True,
        "rms height; distance of peaks 2 pi rms height / rms slope, that of one wavelength "
        "(assumed)",
        f"definition of the asperity: abstract of the primary source; coefficients: {UNVERIFIED}",
    ),
    "fuller_tabor": Model(
        "Fuller–Tabor",
        _fuller_tabor,
        False,
        ASPERITIES,
        f"assumptions and JKR equations: Greenwood, Tribol. Lett. 65 (2017) 159; {UNVERIFIED}",
    ),
    "maugis": Model("Maugis", _maugis, False, ASPERITIES, UNVERIFIED),
}


def drawn(rng, mean, uncertainty, draws):
    """Roughness drawn `draws` times within its uncertainty: each array (draws, surface).

    Every number is drawn by itself from a normal distribution of this mean and standard deviation,
    cut off at zero; the published ± is read as the standard deviation. mean, uncertainty:
    Roughness of (surface,).
    """
    return Roughness(
        *(
            truncnorm.rvs(
                -centre / spread,
                np.inf,
                loc=centre,
                scale=spread,
                size=(draws, len(centre)),
                random_state=rng,
            )
            for centre, spread in zip(mean, uncertainty, strict=True)
        )
    )


def fit_work(model, roughness, contact, target):
    """Work of adhesion (J/m²) of the least mean relative error to all forces, and this error.

    roughness: arrays (..., surface); target: (surface,) N. Returns two arrays (...). Forces that
    are not proportional to the work are searched up to 10 J/m²; where all of them vanish up to
    there, the error is 1 and the work NaN: none is better than another.
    """
    if model.proportional:
        forces = model.force(1.0, roughness, contact)
        return inference.fit(forces[..., None], target)[1:]
    work = np.broadcast_to(WORKS, (*roughness.height.shape[:-1], WORKS.size))
    step = np.log(WORKS[1] / WORKS[0])
    for _ in range(REFINEMENTS):
        best, error = _best_work(model, roughness, contact, target, work)
        finer = best[..., None] * np.exp(step * np.linspace(-1, 1, 41))
        work, step = np.clip(finer, WORKS[0], WORKS[-1]), step / 20
    best, error = _best_work(model, roughness, contact, target, work)
    return np.where(error < 1 - PERCEPTIBLE, best, np.nan), error


def _best_work(model, roughness, contact, target, work):
    """The best of the works (..., k), and its error."""
    columns = Roughness(*(values[..., None] for values in roughness))  # (..., surface, 1)
    forces = model.force(work[..., None, :], columns, contact)
    errors = inference.mean_relative_error(forces, target, np.ones(1))[..., 0]
    best = errors.argmin(axis=-1)[..., None]
    return (np.take_along_axis(values, best, -1)[..., 0] for values in (work, errors))


def compare(mean, samples, contact, work, targets, confidence):
    """Forces of every model, and the work of adhesion that fits them to measured or computed ones.

    mean: Roughness of (surface,), with `drawn` ones that the intervals are taken over; work: J/m²
    of `pull_off_force`; targets: forces (N) by what they are, each (surface,). Returns a Dataset
    over model, against and surface.
    """
    index, indices = (
        classical.adhesion_index(work, given.height, 1 / given.curvature, contact.modulus)
        for given in (mean, samples)
    )
    one, newton = {"units": "1"}, {"units": "N"}
    common = with_interval("adhesion_index", "surface", index, indices, confidence, one)
    forces, fits = {}, {}
    for name, model in MODELS.items():
        force, drawn_forces = (model.force(work, given, contact) for given in (mean, samples))
        given = "surface", force, drawn_forces, confidence, newton
        forces[(name,)] = xr.Dataset(with_interval("pull_off_force", *given))
        for against, target in targets.items():
            fitted = (fit_work(model, given, contact, target) for given in (mean, samples))
            errors = (np.abs(f / target - 1).mean(axis=-1) for f in (force, drawn_forces))
            fits[name, against] = _fit(*fitted, *errors, confidence)
    return stack(forces, ["model"]).merge(stack(fits, ["model", "against"])).assign(common)


def _fit(best, drawn_best, error, drawn_errors, confidence):
    """Work of adhesion and error of the best fit, and error at the given work, with intervals."""
    (work, least), (works, leasts) = best, drawn_best
    works = np.where(np.isnan(work), np.nan, works)  # few draws stick where the mean does not
    one, energy = {"units": "1"}, {"units": "J m-2"}
    return xr.Dataset(
        with_interval("fitted_work_of_adhesion", (), work, works, confidence, energy)
        | with_interval("mean_relative_error", (), least, leasts, confidence, one)
        | with_interval("error_at_published_work", (), error, drawn_errors, confidence, one)
    )


def effective_works(forces, contact, tabor, work):
    """Effective work of adhesion with three Tabor parameters: printed, computed, self-consistent.

    forces: by the end of the names of variables ("", "_low", "_high"), each (surface,) N; tabor:
    the printed parameter; work: J/m² of the computed one. The self-consistent one is that of the
    effective work itself. The work rests on the transition fit; `pull_off_coefficient`, F/πRW, is
    given by it and by the exact pair. Returns a Dataset over transition, tabor and surface.
    """
    one, energy, dimensions = {"units": "1"}, {"units": "J m-2"}, ("tabor", "surface")
    variables = {}
    for end, force in forces.items():
        tabors = _tabor_parameters(force, contact, tabor, work)
        coefficient = classical.transition_coefficient(classical.maugis_parameter(tabors))
        effective = classical.effective_work_of_adhesion(force, contact.radius, coefficient)
        variables[f"effective_work_of_adhesion{end}"] = dimensions, effective, energy
    tabors = _tabor_parameters(forces[""], contact, tabor, work)
    variables["effective_tabor_parameter"] = dimensions, tabors, one
    names = {"tabor": ["printed", "computed", "self_consistent"]}
    found = xr.Dataset(variables, names)
    return found.assign(pull_off_coefficient=transition(found.effective_tabor_parameter))


def transition(tabor):
    """Pull-off force over πRW by the fit and by the exact pair, along a new first dimension.

    tabor: DataArray of Tabor parameters.
    """
    maugis = classical.maugis_parameter(tabor)
    both = {
        "fit": classical.transition_coefficient(maugis.values),
        "maugis_dugdale": classical.maugis_dugdale_coefficient(maugis.values),
    }
    return xr.DataArray(
        np.stack(list(both.values())),
        {"transition": list(both)} | dict(tabor.coords),
        ("transition", *tabor.dims),
        attrs={"units": "1"},
    )


def _tabor_parameters(force, contact, printed, work):
    """Tabor parameters (3, surface): printed, of the given work, of the effective work itself."""
    own = classical.self_consistent_work_of_adhesion(force, *contact)
    return np.stack(
        [
            np.full(len(force), printed),
            np.full(len(force), classical.tabor_parameter(work, *contact)),
            classical.tabor_parameter(own, *contact),
        ]
    )


def half_unit(printed):
    """Half a unit of the last digit of a printed number: 5e-8 of "8.8e-6"."""
    return float(Decimal(5).scaleb(Decimal(printed).as_tuple().exponent - 1))


def power_laws(mean, samples, works, confidence):
    """How well a power of one roughness parameter gives the effective work of adhesion.

    mean: Roughness of (surface,), with `drawn` ones that the intervals are taken over; works: J/m²
    by what they follow from, each (surface,). Least squares of the logarithms. `power_law_error` is
    the mean relative error at the surfaces fitted to, `prediction_error` that at each surface left
    out in turn: with four points two parameters nearly always fit. `rank_correlation` is
    Spearman's; of four points it is 1 or -1 by chance in one case of twelve. Returns a Dataset over
    rms_parameter and against.
    """
    names = ("rank_correlation", "power_law_exponent", "power_law_error", "prediction_error")
    parts = {}
    for parameter, value, values in zip(mean._fields, mean, samples, strict=True):
        for against, work in works.items():
            found = zip(names, _power_law(value, work), _power_law(values, work), strict=True)
            variables = {}
            for name, number, numbers in found:
                one = {"units": "1"}
                variables |= with_interval(name, (), number, numbers, confidence, one)
            parts[parameter, against] = xr.Dataset(variables)
    return stack(parts, ["rms_parameter", "against"])


def _power_law(parameter, work):
    """Rank correlation, exponent, error and left-out error (...) for parameters (..., surface)."""
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
    return correlation, exponent, *errors


def _line(x, y, at):
    """Slope (...) of the least-squares line through (x, y) along the last axis; values `at`."""
    centre = x.mean(axis=-1, keepdims=True)
    deviation = x - centre
    with np.errstate(invalid="ignore"):  # one point has no slope
        slope = (deviation * y).sum(axis=-1) / (deviation**2).sum(axis=-1)
    return slope, y.mean() + slope[..., None] * (at - centre)
