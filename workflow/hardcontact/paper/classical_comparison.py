"""Effective works of adhesion and classical models, for the published and the computed forces.

At the effective work of adhesion a smooth sphere has the pull-off force of the rough sphere.
Lengths in nm, forces in N, works of adhesion in J/m².
"""

from collections.abc import Mapping
from decimal import Decimal
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.dataset import stack
from hardcontact.base.published import effective_modulus
from hardcontact.base.statistics import Sampling, with_interval
from hardcontact.base.units import DIMENSIONLESS, JOULE_PER_M2, NEWTON, PASCAL
from hardcontact.contact import hertz_jkr_dmt
from hardcontact.contact.contact import PLASTIC
from hardcontact.paper.classical_fits import compare_models, power_laws, sample_roughness
from hardcontact.paper.classical_models import MODELS, ElasticSphere, Roughness

#: Prefixes of the rows of Table 1: roughness of the AFM scans, and roughness of all scales.
METRIC_PREFIXES = {"afm": "afm", "all_scales": "all"}


def apply_classical_models(
    fit: xr.Dataset,
    constants: pd.DataFrame,
    table1: pd.DataFrame,
    printed: pd.DataFrame,
    sampling: Sampling,
) -> xr.Dataset:
    """Return effective works of adhesion, and forces and errors of classical models (classical.nc).

    The fit (fit.nc) has mean forces of plastic contact at the published pair; the tables come from
    `published`. Roughness of Table 1 is sampled within its uncertainty. The interval of
    ``published_mean_force`` contains all forces that round to the printed number. NaN if the paper
    prints no force or no roughness of a surface.
    """
    value = constants["value"].to_dict()
    sphere = _elastic_sphere(fit.attrs["sphere_radius"], value)
    rows = table1.pivot(index="surface", columns="quantity", values=["value", "uncertainty"])
    rows = rows.dropna()
    printed = printed.dropna(subset="mean_force")
    published = rows.index.intersection(printed.index)
    surfaces = [name for name in fit["surface"].values.tolist() if name in published]
    forces = {
        "published": rounded_numbers(printed.loc[surfaces, "mean_force"]),
        "computed": _forces_at_published_pair(fit.sel(surface=surfaces)),
    }
    maugis = hertz_jkr_dmt.maugis_parameter(value["tabor_parameter"])
    coefficient = hertz_jkr_dmt.pull_off_coefficient(maugis)
    works = {
        source: hertz_jkr_dmt.effective_work_of_adhesion(ends, sphere.radius, coefficient)
        for source, ends in forces.items()
    }
    models = {}
    for metrics, prefix in METRIC_PREFIXES.items():
        mean = _roughness(rows.loc[surfaces], "value", prefix)
        uncertainty = _roughness(rows.loc[surfaces], "uncertainty", prefix)
        rng = sampling.generator(metrics)
        samples = sample_roughness(rng, mean, uncertainty, sampling.sample_count)
        comparison = compare_models(
            mean, samples, sphere, value["work_of_adhesion"], _first_columns(forces), sampling
        )
        laws = power_laws(mean, samples, _first_columns(works), sampling)
        models[(metrics,)] = comparison.merge(laws)
    return (
        stack(models, ["metrics"])
        .merge(_forces_and_works(forces, works, sampling.confidence))
        .assign_coords(surface=surfaces)
        .reindex(surface=fit["surface"].values)
        .merge(_smooth_contact(sphere, value))
        .assign(
            model_label=("model", [model.label for model in MODELS.values()]),
            label=fit["label"],
            source=fit["source"],
        )
        .assign_attrs(error_threshold=fit.attrs["error_threshold"], confidence=sampling.confidence)
    )


def _elastic_sphere(radius: float, constants: Mapping[Any, float]) -> ElasticSphere:
    """Return the sphere (radius in nm) with the published materials."""
    return ElasticSphere(radius, effective_modulus(constants), constants["equilibrium_spacing"])


def _smooth_contact(sphere: ElasticSphere, constants: Mapping[Any, float]) -> xr.Dataset:
    """Return Tabor parameter and Hertz pressure of the sphere, if it is smooth."""
    hertz = hertz_jkr_dmt.hertz_contact(constants["preload"], sphere.radius, sphere.modulus)
    tabor = hertz_jkr_dmt.tabor_parameter(constants["work_of_adhesion"], *sphere)
    return xr.Dataset(
        {
            "tabor_parameter": ((), tabor, DIMENSIONLESS),
            "hertz_peak_pressure": ((), hertz.peak_pressure, PASCAL),
        }
    )


def _forces_at_published_pair(fit: xr.Dataset) -> Floats:
    """Return the mean forces of plastic contact and the ends of their intervals, (surface, 3)."""
    plastic = fit.sel(contact_model=PLASTIC, pair="published")
    interval = plastic["mean_force_at_pair_interval"].transpose("surface", "end")
    return np.column_stack([plastic["mean_force_at_pair"].values, interval.values])


def _first_columns(with_ends: Mapping[str, Floats]) -> dict[str, Floats]:
    """Return the first columns of arrays (surface, 3), which hold value, low and high end."""
    return {source: ends[:, 0] for source, ends in with_ends.items()}


def _forces_and_works(
    forces: Mapping[str, Floats], works: Mapping[str, Floats], confidence: float
) -> xr.Dataset:
    """Return mean forces and effective works from arrays (surface, 3): value, low and high end."""
    variables: dict[str, Any] = {}
    effective = {}
    for source, ends in forces.items():
        name = f"{source}_mean_force"
        variables |= with_interval(name, "surface", ends[:, 0], ends[:, 1:], NEWTON, confidence)
        name = "effective_work_of_adhesion"
        work, interval = works[source][:, 0], works[source][:, 1:]
        effective[(source,)] = xr.Dataset(
            with_interval(name, "surface", work, interval, JOULE_PER_M2, confidence)
        )
    return stack(effective, ["force_source"]).assign(variables)


def _roughness(rows: pd.DataFrame, column: str, prefix: str) -> Roughness:
    """Return the values or uncertainties of three rows of Table 1, arrays (surface,)."""
    names = [(column, f"{prefix}_rms_{name}") for name in Roughness._fields]
    return Roughness(*(rows[name].to_numpy() for name in names))


def rounded_numbers(printed: "pd.Series[str]") -> Floats:
    """Return printed numbers, and the smallest and largest number rounded to them, (n, 3)."""
    value = printed.astype(float).to_numpy()
    half = printed.map(_half_unit).astype(float).to_numpy()
    return np.stack([value, value - half, value + half], axis=-1)


def _half_unit(printed: str) -> float:
    """Return half a unit of the last digit of a printed number: 5e-8 of "8.8e-6"."""
    exponent = Decimal(printed).as_tuple().exponent
    return float(Decimal(5).scaleb(int(exponent) - 1))
