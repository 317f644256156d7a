"""Effective works of adhesion and classical models, for the published and the computed forces.

The effective work of adhesion is that of the smooth sphere with the pull-off force of a rough one.
Lengths in nm, forces in N, works of adhesion in J/m².
"""

from decimal import Decimal
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.dataset import stack
from hardcontact.base.statistics import Sampling, with_interval
from hardcontact.contact import smooth_sphere
from hardcontact.contact.smooth_sphere import Material
from hardcontact.paper.classical_fits import compare_models, power_laws, sample_roughness
from hardcontact.paper.classical_models import MODELS, ElasticSphere, Roughness

NEWTON, ONE, ENERGY = {"units": "N"}, {"units": "1"}, {"units": "J m-2"}

#: Prefix of the rows of Table 1 with the roughness of the scans alone, and of all scales.
METRICS = {"afm": "afm", "all_scales": "all"}


def apply_classical_models(
    inference: xr.Dataset,
    constants: pd.DataFrame,
    table1: pd.DataFrame,
    printed: pd.DataFrame,
    sampling: Sampling,
) -> xr.Dataset:
    """Return effective works of adhesion, and forces and errors of classical models.

    Parameters
    ----------
    inference : xarray.Dataset
        Of the study; the mean forces of plastic contact at the published pair count.
    constants, table1, printed : pandas.DataFrame
        Of `published.constants`, `published.table1` and `published.printed_pull_off`.
    sampling : Sampling
        Of the roughness of Table 1 within its uncertainty.

    Returns
    -------
    xarray.Dataset
        Over surface, NaN where the paper prints no force or no roughness: ``published_mean_force``,
        whose interval holds whatever is rounded to it, and ``computed_mean_force`` in N. Over
        (against, surface) ``effective_work_of_adhesion`` with the printed Tabor parameter. Over
        metrics the variables of `compare_models` and `power_laws`. Over model how it is described.
        ``tabor_parameter`` of the published work and ``hertz_peak_pressure`` (Pa) of the sphere.
    """
    value, confidence = constants["value"].to_dict(), sampling.confidence
    bodies = (
        Material(
            modulus=value[f"{body}_youngs_modulus"], poisson_ratio=value[f"{body}_poisson_ratio"]
        )
        for body in ("sphere", "substrate")
    )
    sphere = ElasticSphere(
        inference.attrs["sphere_radius"],
        smooth_sphere.effective_modulus(*bodies),
        value["equilibrium_spacing"],
    )
    rows = table1.pivot(index="surface", columns="quantity", values=["value", "uncertainty"])
    rows, printed = rows.dropna(), printed.dropna(subset="mean_force")
    known = rows.index.intersection(printed.index)
    surfaces = [name for name in inference["surface"].values.tolist() if name in known]
    rows = rows.loc[surfaces]
    plastic = inference.sel(contact_model="plastic", pair="published", surface=surfaces)
    interval = plastic["force_mean_interval"].transpose("surface", "bound")
    forces = {
        "published": rounded(printed.loc[surfaces, "mean_force"]),
        "computed": (plastic["force_mean"].values, interval.values),
    }
    maugis = smooth_sphere.maugis_parameter(value["tabor_parameter"])
    coefficient = smooth_sphere.transition_coefficient(maugis)
    mean_forces: dict[str, Any] = {}
    works, effective = {}, {}
    for against, force in forces.items():
        name = f"{against}_mean_force"
        mean_forces |= with_interval(name, "surface", *force, NEWTON, confidence)
        works[against], ends = (
            smooth_sphere.effective_work_of_adhesion(newtons, sphere.radius, coefficient)
            for newtons in force
        )
        name = "effective_work_of_adhesion"
        variables = with_interval(name, "surface", works[against], ends, ENERGY, confidence)
        effective[(against,)] = xr.Dataset(variables)
    targets = {against: force for against, (force, _) in forces.items()}
    models = {}
    for metrics, prefix in METRICS.items():
        mean, uncertainty = (
            _roughness(rows, column, prefix) for column in ("value", "uncertainty")
        )
        drawn = sample_roughness(sampling.generator(metrics), mean, uncertainty, sampling.samples)
        compared = compare_models(mean, drawn, sphere, value["work_of_adhesion"], targets, sampling)
        models[(metrics,)] = compared.merge(power_laws(mean, drawn, works, sampling))
    pressed = smooth_sphere.hertz_contact(value["preload"], sphere.radius, sphere.modulus)
    tabor = smooth_sphere.tabor_parameter(value["work_of_adhesion"], *sphere)
    descriptions: dict[str, Any] = {
        f"model_{field}": ("model", [getattr(model, field) for model in MODELS.values()])
        for field in ("label", "roughness", "verified")
    }
    return (
        stack(models, ["metrics"])
        .merge(stack(effective, ["against"]))
        .assign(mean_forces)
        .assign_coords(surface=surfaces)
        .reindex(surface=inference["surface"].values)
        .assign(descriptions)
        .assign(
            tabor_parameter=((), tabor, ONE),
            hertz_peak_pressure=((), pressed.peak_pressure, {"units": "Pa"}),
            label=inference["label"],
            basis=inference["basis"],
        )
        .assign_attrs(error_threshold=inference.attrs["error_threshold"], confidence=confidence)
    )


def _roughness(rows: pd.DataFrame, column: str, prefix: str) -> Roughness:
    """Return the value or uncertainty of three rows of Table 1 as arrays over surfaces."""
    names = [(column, f"{prefix}_rms_{name}") for name in Roughness._fields]
    return Roughness(*(rows[name].to_numpy() for name in names))


def rounded(printed: "pd.Series[str]") -> tuple[np.ndarray, np.ndarray]:
    """Return printed numbers (n,) and the ends (n, 2) of what is rounded to them."""
    value = printed.astype(float).to_numpy()
    half = printed.map(_half_unit).astype(float).to_numpy()
    return value, np.stack([value - half, value + half], axis=-1)


def _half_unit(printed: str) -> float:
    """Return half a unit of the last digit of a printed number: 5e-8 of "8.8e-6"."""
    exponent = Decimal(printed).as_tuple().exponent
    return float(Decimal(5).scaleb(int(exponent) - 1))
