"""Effective works of adhesion and classical models, for the published and the computed forces.

At the effective work of adhesion a smooth sphere has the pull-off force of the rough sphere.
Lengths in nm, forces in N, works of adhesion in J/m².
"""

from decimal import Decimal
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.dataset import stack
from hardcontact.base.statistics import Sampling, with_interval
from hardcontact.base.units import DIMENSIONLESS, JOULE_PER_M2, NEWTON
from hardcontact.contact import smooth_sphere
from hardcontact.contact.smooth_sphere import Material
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
    """Return effective works of adhesion, and forces and errors of classical models.

    fit: fit.nc of the study: mean forces of plastic contact at the published pair.
    constants, table1, printed: from `published.constants`, `published.table1` and
        `published.printed_pull_off`.
    sampling: samples the roughness of Table 1 within its uncertainty.
    Returns by surface, NaN if the paper prints no force or no roughness: ``published_mean_force``
        in N, whose interval contains all numbers rounded to it, and ``computed_mean_force`` in N.
        By (force_source, surface): ``effective_work_of_adhesion`` in J/m² with the printed Tabor
        parameter. By metrics: the variables of `compare_models` and `power_laws`. By model: its
        description. ``tabor_parameter`` at the published work, and ``hertz_peak_pressure`` of the
        sphere in Pa.
    """
    value = constants["value"].to_dict()
    confidence = sampling.confidence
    bodies = [
        Material(
            modulus=value[f"{body}_youngs_modulus"], poisson_ratio=value[f"{body}_poisson_ratio"]
        )
        for body in ("sphere", "substrate")
    ]
    sphere = ElasticSphere(
        fit.attrs["sphere_radius"],
        smooth_sphere.effective_modulus(*bodies),
        value["equilibrium_spacing"],
    )
    rows = table1.pivot(index="surface", columns="quantity", values=["value", "uncertainty"])
    rows = rows.dropna()
    printed = printed.dropna(subset="mean_force")
    published = rows.index.intersection(printed.index)
    surfaces = [name for name in fit["surface"].values.tolist() if name in published]
    rows = rows.loc[surfaces]
    plastic = fit.sel(contact_model="plastic", pair="published", surface=surfaces)
    interval = plastic["mean_force_at_pair_interval"].transpose("surface", "bound")
    forces = {
        "published": rounding_intervals(printed.loc[surfaces, "mean_force"]),
        "computed": (plastic["mean_force_at_pair"].values, interval.values),
    }
    maugis = smooth_sphere.maugis_parameter(value["tabor_parameter"])
    coefficient = smooth_sphere.transition_coefficient(maugis)
    mean_forces: dict[str, Any] = {}
    works = {}
    effective = {}
    for force_source, (force, force_interval) in forces.items():
        name = f"{force_source}_mean_force"
        mean_forces |= with_interval(name, "surface", force, force_interval, NEWTON, confidence)
        works[force_source] = smooth_sphere.effective_work_of_adhesion(
            force, sphere.radius, coefficient
        )
        work_interval = smooth_sphere.effective_work_of_adhesion(
            force_interval, sphere.radius, coefficient
        )
        name = "effective_work_of_adhesion"
        variables = with_interval(
            name, "surface", works[force_source], work_interval, JOULE_PER_M2, confidence
        )
        effective[(force_source,)] = xr.Dataset(variables)
    targets = {force_source: force for force_source, (force, _) in forces.items()}
    models = {}
    for metrics, prefix in METRIC_PREFIXES.items():
        mean = _roughness(rows, "value", prefix)
        uncertainty = _roughness(rows, "uncertainty", prefix)
        rng = sampling.generator(metrics)
        samples = sample_roughness(rng, mean, uncertainty, sampling.samples)
        comparison = compare_models(
            mean, samples, sphere, value["work_of_adhesion"], targets, sampling
        )
        models[(metrics,)] = comparison.merge(power_laws(mean, samples, works, sampling))
    hertz = smooth_sphere.hertz_contact(value["preload"], sphere.radius, sphere.modulus)
    tabor = smooth_sphere.tabor_parameter(value["work_of_adhesion"], *sphere)
    descriptions: dict[str, Any] = {
        f"model_{field}": ("model", [getattr(model, field) for model in MODELS.values()])
        for field in ("label", "roughness", "verified")
    }
    return (
        stack(models, ["metrics"])
        .merge(stack(effective, ["force_source"]))
        .assign(mean_forces)
        .assign_coords(surface=surfaces)
        .reindex(surface=fit["surface"].values)
        .assign(descriptions)
        .assign(
            tabor_parameter=((), tabor, DIMENSIONLESS),
            hertz_peak_pressure=((), hertz.peak_pressure, {"units": "Pa"}),
            label=fit["label"],
            basis=fit["basis"],
        )
        .assign_attrs(error_threshold=fit.attrs["error_threshold"], confidence=confidence)
    )


def _roughness(rows: pd.DataFrame, column: str, prefix: str) -> Roughness:
    """Return the values or uncertainties of three rows of Table 1, arrays (surface,)."""
    names = [(column, f"{prefix}_rms_{name}") for name in Roughness._fields]
    return Roughness(*(rows[name].to_numpy() for name in names))


def rounding_intervals(printed: "pd.Series[str]") -> tuple[np.ndarray, np.ndarray]:
    """Return printed numbers (n,) and the intervals (n, 2) of the numbers rounded to them."""
    value = printed.astype(float).to_numpy()
    half = printed.map(_half_unit).astype(float).to_numpy()
    return value, np.stack([value - half, value + half], axis=-1)


def _half_unit(printed: str) -> float:
    """Return half a unit of the last digit of a printed number: 5e-8 of "8.8e-6"."""
    exponent = Decimal(printed).as_tuple().exponent
    return float(Decimal(5).scaleb(int(exponent) - 1))
