"""Effective works of adhesion and classical models, for the published and the computed forces.

The effective work of adhesion is that of the smooth sphere with the pull-off force of a rough one.
Lengths in nm, forces in N, works of adhesion in J/m².
"""

from collections.abc import Mapping
from decimal import Decimal
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.contact import smooth_sphere
from hardcontact.contact.smooth_sphere import Material
from hardcontact.inference.classical_fits import (
    RoughnessSamples,
    compare_models,
    power_laws,
    sample_roughness,
)
from hardcontact.inference.classical_models import MODELS, Contact, Roughness
from hardcontact.numbers.statistics import Sampling, with_interval
from hardcontact.records.dataset import stack

NEWTON, ONE, ENERGY = {"units": "N"}, {"units": "1"}, {"units": "J m-2"}

#: Prefix of the rows of Table 1 with the roughness of the scans alone, and of all scales.
METRICS = {"afm": "afm", "all_scales": "all"}

#: Tabor parameters from DMT to JKR for which the transition is tabulated.
TABOR_AXIS = np.geomspace(0.01, 10, 121)


class PerSurface(NamedTuple):
    """A number of each surface, with its interval."""

    value: np.ndarray  #: (surface,)
    interval: np.ndarray  #: (surface, 2), low and high end.


def effective_works(
    force: PerSurface, contact: Contact, value: Mapping[Any, float], confidence: float
) -> xr.Dataset:
    """Return the effective work of adhesion with three Tabor parameters.

    These are the printed one, that of the published work of adhesion, both in `value`, and the
    self-consistent one, that of the effective work itself. The work is computed with the fit of the
    transition between JKR and DMT. Over tabor and surface.
    """
    forces = np.column_stack([force.value, force.interval])
    own = smooth_sphere.self_consistent_work_of_adhesion(forces, *contact)
    given = smooth_sphere.tabor_parameter(value["work_of_adhesion"], *contact)
    tabor = np.stack(
        [
            np.full(forces.shape, value["tabor_parameter"]),
            np.full(forces.shape, given),
            smooth_sphere.tabor_parameter(own, *contact),
        ]
    )
    fitted = smooth_sphere.transition_coefficient(smooth_sphere.maugis_parameter(tabor))
    work = smooth_sphere.effective_work_of_adhesion(forces, contact.radius, fitted)
    over, name = ("tabor", "surface"), "effective_work_of_adhesion"
    return xr.Dataset(
        with_interval(name, over, work[..., 0], work[..., 1:], ENERGY, confidence),
        {"tabor": ["printed", "computed", "self_consistent"]},
    )


def pull_off_coefficients(tabor: xr.DataArray) -> xr.DataArray:
    """Return the pull-off force over πRW (transition, ...) of Tabor parameters (...).

    The transition between JKR and DMT is that of the fit and of the exact pair of equations.
    """
    maugis = smooth_sphere.maugis_parameter(tabor.values)
    both = {
        "fit": smooth_sphere.transition_coefficient(maugis),
        "maugis_dugdale": smooth_sphere.maugis_dugdale_coefficient(maugis),
    }
    return xr.DataArray(
        np.stack(list(both.values())),
        {"transition": list(both)} | dict(tabor.coords),
        ("transition", *tabor.dims),
        attrs=ONE,
    )


class _Published(NamedTuple):
    """What the paper prints of the surfaces of which it prints both roughness and forces."""

    surfaces: list[str]
    force: PerSurface
    work: PerSurface
    roughness: dict[str, tuple[Roughness, Roughness]]  # mean and uncertainty by metrics


def apply_classical_models(
    inference: xr.Dataset,
    constants: pd.DataFrame,
    table1: pd.DataFrame,
    printed: pd.DataFrame,
    sampling: Sampling,
) -> xr.Dataset:
    """Return effective works of adhesion and the forces and fits of classical models.

    Of the inference of the study the mean forces of plastic contact at the published pair are
    taken; the tables are those of `published.constants`, `table1` and `printed_pull_off`. Roughness
    is drawn within its uncertainty. Surfaces of which the paper prints no force or no roughness are
    NaN; the interval of a printed number holds whatever is rounded to it.
    """
    value, confidence = constants["value"].to_dict(), sampling.confidence
    contact = _contact(inference.attrs["sphere_radius"], value)
    published = _published(inference["surface"].values.tolist(), table1, printed)
    plastic = inference.sel(contact_model="plastic", pair="published", surface=published.surfaces)
    interval = plastic["force_mean_interval"].transpose("surface", "bound")
    computed = PerSurface(plastic["force_mean"].values, interval.values)
    descriptions = {
        f"model_{field}": ("model", [getattr(model, field) for model in MODELS.values()])
        for field in ("label", "roughness", "verified")
    }
    forces = {"published": published.force, "computed": computed}
    return (
        _works_and_models(forces, published.roughness, contact, value, sampling)
        .assign(_forces_and_works(published, computed, contact.radius, confidence))
        .assign_coords(surface=published.surfaces)
        .reindex(surface=inference["surface"].values)
        .assign(_smooth_sphere(contact, value) | descriptions)
        .assign(label=inference["label"], basis=inference["basis"])
        .assign_attrs(
            sphere_radius=contact.radius,
            equilibrium_spacing=contact.spacing,
            error_threshold=inference.attrs["error_threshold"],
            preload=value["preload"],
            confidence=confidence,
        )
    )


def _contact(radius: float, value: Mapping[Any, float]) -> Contact:
    """Return the contact of the published sphere and substrate."""
    bodies = (
        Material(
            modulus=value[f"{body}_youngs_modulus"], poisson_ratio=value[f"{body}_poisson_ratio"]
        )
        for body in ("sphere", "substrate")
    )
    return Contact(radius, smooth_sphere.effective_modulus(*bodies), value["equilibrium_spacing"])


def _published(names: list[str], table1: pd.DataFrame, printed: pd.DataFrame) -> _Published:
    """Return what the paper prints of those surfaces of which it prints roughness and forces."""
    rows = table1.pivot(index="surface", columns="quantity", values=["value", "uncertainty"])
    rows, printed = rows.dropna(), printed.dropna(subset="mean_force")
    surfaces = [name for name in names if name in printed.index and name in rows.index]
    rows, printed = rows.loc[surfaces], printed.loc[surfaces]
    roughness = {
        metrics: (_roughness(rows, "value", prefix), _roughness(rows, "uncertainty", prefix))
        for metrics, prefix in METRICS.items()
    }
    force, work = (_rounded(printed[name]) for name in ("mean_force", "effective_work_of_adhesion"))
    return _Published(surfaces, force, work, roughness)


def _roughness(rows: pd.DataFrame, column: str, prefix: str) -> Roughness:
    """Return three rows of Table 1: `value` or `uncertainty` of each."""
    names = [(column, f"{prefix}_rms_{name}") for name in Roughness._fields]
    return Roughness(*(rows[name].to_numpy() for name in names))


def _rounded(printed: "pd.Series[str]") -> PerSurface:
    """Return printed numbers and the ends of what is rounded to them; NaN where none is printed."""
    value = printed.astype(float).to_numpy()
    half = printed.map(_half_unit, na_action="ignore").astype(float).to_numpy()
    return PerSurface(value, np.stack([value - half, value + half], axis=-1))


def _half_unit(printed: str) -> float:
    """Return half a unit of the last digit of a printed number: 5e-8 of "8.8e-6"."""
    exponent = Decimal(printed).as_tuple().exponent
    return float(Decimal(5).scaleb(int(exponent) - 1))


def _works_and_models(
    forces: Mapping[str, PerSurface],
    roughness: Mapping[str, tuple[Roughness, Roughness]],
    contact: Contact,
    value: Mapping[Any, float],
    sampling: Sampling,
) -> xr.Dataset:
    """Return effective works, models and power laws against published and computed forces."""
    of_forces = {
        (against,): effective_works(force, contact, value, sampling.confidence)
        for against, force in forces.items()
    }
    effective = stack(of_forces, ["against"])
    by_printed_tabor = effective["effective_work_of_adhesion"].sel(tabor="printed")
    works = {against: by_printed_tabor.sel(against=against).values for against in forces}
    targets = {against: force.value for against, force in forces.items()}
    parts = {}
    for metrics, (mean, uncertainty) in roughness.items():
        rng = sampling.generator(metrics)
        drawn = sample_roughness(rng, mean, uncertainty, sampling.samples)
        samples = RoughnessSamples(mean, drawn, sampling)
        models = compare_models(samples, contact, value["work_of_adhesion"], targets)
        parts[(metrics,)] = models.merge(power_laws(samples, works))
    return stack(parts, ["metrics"]).merge(effective)


def _forces_and_works(
    published: _Published, computed: PerSurface, radius: float, confidence: float
) -> dict[str, Any]:
    """Return forces and works of each surface, and the coefficients that the printed ones imply."""
    force, work = published.force, published.work
    # F/πRW, which is least for the least force and the greatest work.
    implied, ends = (
        smooth_sphere.effective_work_of_adhesion(forces, radius, works)
        for forces, works in zip(force, (work.value, work.interval[..., ::-1]), strict=True)
    )
    variables: dict[str, Any] = {}
    for name, numbers, units in (
        ("implied_pull_off_coefficient", PerSurface(implied, ends), ONE),
        ("published_effective_work_of_adhesion", work, ENERGY),
        ("published_mean_force", force, NEWTON),
        ("computed_mean_force", computed, NEWTON),
    ):
        variables |= with_interval(name, "surface", *numbers, units, confidence)
    return variables


def _smooth_sphere(contact: Contact, value: Mapping[Any, float]) -> dict[str, Any]:
    """Return parameters of the smooth sphere, and its transition between JKR and DMT."""
    tabor = smooth_sphere.tabor_parameter(value["work_of_adhesion"], *contact)
    pressed = smooth_sphere.hertz_contact(value["preload"], contact.radius, contact.modulus)
    axis = xr.DataArray(TABOR_AXIS, {"tabor_axis": ("tabor_axis", TABOR_AXIS, ONE)})
    return {
        "transition_coefficient": pull_off_coefficients(axis),
        "tabor_parameter": ((), tabor, ONE),
        "printed_tabor_parameter": ((), value["tabor_parameter"], ONE),
        "effective_modulus": ((), contact.modulus, {"units": "Pa"}),
        "hertz_peak_pressure": ((), pressed.peak_pressure, {"units": "Pa"}),
    }
