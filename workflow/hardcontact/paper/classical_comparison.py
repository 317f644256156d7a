"""Effective works of adhesion and errors of classical models, for classical.nc.

At the effective work of adhesion a smooth sphere has the pull-off force of the rough sphere.
Lengths are in nm, forces in N, works of adhesion in J/m².
"""

from collections.abc import Callable, Mapping
from decimal import Decimal
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.dataset import stack
from hardcontact.base.published import effective_modulus
from hardcontact.base.statistics import Sampling, as_variables
from hardcontact.base.units import DIMENSIONLESS, JOULE_PER_M2, NEWTON, PASCAL
from hardcontact.contact import hertz_jkr_dmt
from hardcontact.contact.contact import PLASTIC
from hardcontact.inference.fit import fit_work, mean_relative_error, minimum_along_axis
from hardcontact.paper.classical_models import (
    CLASSICAL_MODELS,
    ClassicalModel,
    ElasticSphere,
    Roughness,
)

#: Prefixes of the rows of Table 1, for AFM scans and all scales.
METRIC_PREFIXES = {"afm": "afm", "all_scales": "all"}
#: Works of adhesion (J/m²) among which the best fit is searched first.
SEARCHED_WORKS = np.geomspace(1e-3, 10, 401)
#: Exponents of power laws of roughness parameters that are searched first.
SEARCHED_EXPONENTS = np.linspace(-8, 8, 321)
#: Repeated searches, each on a 20 times finer grid about the best value, to steps below 1e-5.
REFINEMENTS = 3


def apply_classical_models(
    fit: xr.Dataset,
    constants: Mapping[Any, float],
    table1: pd.DataFrame,
    published_forces: pd.DataFrame,
    sampling: Sampling,
) -> xr.Dataset:
    """Return classical.nc, from fit.nc and the tables of `published`.

    Intervals follow from the uncertainty of Table 1, the rounding of printed forces and the
    intervals of computed forces. NaN if the paper prints no force or no roughness of a surface.
    """
    rows = table1.pivot(index="surface", columns="quantity", values=["value", "uncertainty"])
    rows = rows.dropna()
    printed_means = published_forces["mean_force"].dropna()
    published_surfaces = rows.index.intersection(printed_means.index)
    surfaces = [name for name in fit["surface"].values.tolist() if name in published_surfaces]
    radius = fit.attrs["sphere_radius"]
    work = constants["work_of_adhesion"]
    sphere = ElasticSphere(radius, effective_modulus(constants), constants["equilibrium_spacing"])
    forces = _forces_by_source(fit, printed_means[surfaces])
    # The printed Tabor parameter counts; the computed one differs (departures.md, 5).
    effective_works = _effective_works(forces, radius, constants["tabor_parameter"])
    datasets_by_metrics = {}
    for metrics in METRIC_PREFIXES:
        roughness = _sample_roughness(rows.loc[surfaces], metrics, sampling)
        variables = _model_variables(roughness, sphere, work, forces, effective_works, sampling)
        datasets_by_metrics[(metrics,)] = xr.Dataset(variables)
    pressure = hertz_jkr_dmt.hertz_peak_pressure(constants["preload"], radius, sphere.modulus)
    tabor = hertz_jkr_dmt.tabor_parameter(work, radius, sphere.modulus, sphere.spacing)
    return (
        stack(datasets_by_metrics, ["metrics"])
        .merge(_forces_and_works(forces, effective_works, sampling.confidence))
        .assign_coords(
            surface=surfaces,
            force_source=list(forces),
            model=list(CLASSICAL_MODELS),
            rms_parameter=list(Roughness._fields),
        )
        .reindex(surface=fit["surface"].values)
        .assign(
            tabor_parameter=((), tabor, DIMENSIONLESS),
            hertz_peak_pressure=((), pressure, PASCAL),
            model_label=("model", [model.label for model in CLASSICAL_MODELS.values()]),
            label=fit["label"],
            source=fit["source"],
        )
        .assign_attrs(error_threshold=fit.attrs["error_threshold"], confidence=sampling.confidence)
    )


def _forces_by_source(fit: xr.Dataset, printed_means: "pd.Series[str]") -> dict[str, Floats]:
    """Return the mean forces (surface, 3) by source: the value, the low and high end of each."""
    surfaces = printed_means.index.tolist()
    plastic = fit.sel(surface=surfaces, contact_model=PLASTIC, pair="published")
    interval = plastic["mean_force_at_pair_interval"].transpose("surface", "end")
    return {
        "published": _rounded_numbers(printed_means),
        "computed": np.column_stack([plastic["mean_force_at_pair"].values, interval.values]),
    }


def _effective_works(forces: dict[str, Floats], radius: float, tabor: float) -> dict[str, Floats]:
    """Return the effective works of adhesion (surface, 3) of forces, by the same source."""
    coefficient = hertz_jkr_dmt.pull_off_coefficient(hertz_jkr_dmt.maugis_parameter(tabor))
    return {
        source: hertz_jkr_dmt.effective_work_of_adhesion(force_and_ends, radius, coefficient)
        for source, force_and_ends in forces.items()
    }


def _sample_roughness(rows: pd.DataFrame, metrics: str, sampling: Sampling) -> Roughness:
    """Return a roughness (1 + sample, surface): the values of Table 1, then samples of them.

    Samples are normal with the printed ± as standard deviation, truncated at zero.
    """
    from scipy.stats import truncnorm

    rng = sampling.generator(metrics)
    size = sampling.sample_count, len(rows)
    fields = []
    for field in Roughness._fields:
        quantity = f"{METRIC_PREFIXES[metrics]}_rms_{field}"
        mean, std = rows["value", quantity].to_numpy(), rows["uncertainty", quantity].to_numpy()
        samples = truncnorm.rvs(-mean / std, np.inf, mean, std, size=size, random_state=rng)
        fields.append(np.vstack([mean, samples]))
    return Roughness(*fields)


def _rounded_numbers(printed: "pd.Series[str]") -> Floats:
    """Return printed numbers, and the smallest and largest number that round to each, (n, 3)."""
    values = printed.astype(float).to_numpy()
    exponents = [int(Decimal(number).as_tuple().exponent) for number in printed]
    # Half a unit of the last printed digit.
    half_units = np.array([float(f"5e{exponent - 1}") for exponent in exponents])
    return np.stack([values, values - half_units, values + half_units], axis=-1)


def _forces_and_works(
    forces: Mapping[str, Floats], effective_works: Mapping[str, Floats], confidence: float
) -> xr.Dataset:
    """Return mean forces and effective works (surface, 3) as variables with intervals."""
    works_and_ends = np.stack(list(effective_works.values()))
    variables = as_variables(
        "effective_work_of_adhesion", ("force_source", "surface"),
        works_and_ends[..., 0], works_and_ends[..., 1:], JOULE_PER_M2, confidence,
    )  # fmt: skip
    for source, force in forces.items():
        name = f"{source}_mean_force"
        variables |= as_variables(name, "surface", force[:, 0], force[:, 1:], NEWTON, confidence)
    return xr.Dataset(variables)


def _model_variables(
    roughness: Roughness,
    sphere: ElasticSphere,
    work: float,
    forces: Mapping[str, Floats],
    effective_works: Mapping[str, Floats],
    sampling: Sampling,
) -> dict[str, Any]:
    """Return forces of models, and errors of models and power laws, with sampled intervals."""
    model_forces = [model.force(work, roughness, sphere) for model in CLASSICAL_MODELS.values()]
    errors = [
        [classical_error(model, roughness, sphere, force[:, 0]) for force in forces.values()]
        for model in CLASSICAL_MODELS.values()
    ]
    power_law_errors = [
        [power_law_error(parameter, works[:, 0]) for works in effective_works.values()]
        for parameter in roughness
    ]
    return (
        sampling.sampled_variables(
            "model_force", ("model", "surface"), np.stack(model_forces, axis=-2), NEWTON
        )
        | sampling.sampled_variables(
            "mean_relative_error",
            ("model", "force_source"),
            np.moveaxis(np.array(errors), (0, 1), (-2, -1)),
            DIMENSIONLESS,
        )
        | sampling.sampled_variables(
            "power_law_error",
            ("rms_parameter", "force_source"),
            np.moveaxis(np.array(power_law_errors), (0, 1), (-2, -1)),
            DIMENSIONLESS,
        )
    )


def classical_error(
    model: ClassicalModel, roughness: Roughness, sphere: ElasticSphere, target: Floats
) -> Floats:
    """Return the mean over surfaces of |F/target - 1| (...) at the best work of adhesion.

    If the force F is proportional to the work, `fit_work` finds the best work exactly. Otherwise it
    is searched.
    """
    if model.is_proportional:
        _, error = fit_work(model.force(1.0, roughness, sphere)[..., None], target)
        return error[..., 0]
    roughness_columns = Roughness(*(field[..., None] for field in roughness))  # (..., surface, 1)
    log_work_limits = np.log(SEARCHED_WORKS[[0, -1]])

    def error_at(log_works: Floats) -> Floats:
        trial_works = np.exp(np.clip(log_works, *log_work_limits))
        # Forces (..., surface, k) include their works, so the factor is 1.
        forces = model.force(trial_works[..., None, :], roughness_columns, sphere)
        return mean_relative_error(forces, target, np.ones(1))[..., 0]

    return _search_minimum(error_at, np.log(SEARCHED_WORKS), roughness.height.shape[:-1])


def power_law_error(parameter: Floats, effective_works: Floats) -> Floats:
    """Return the mean over surfaces of |prediction/work - 1| (...) of the best power law."""
    logarithm = np.log(parameter / parameter.mean(axis=-1, keepdims=True))[..., None]

    def error_at(exponents: Floats) -> Floats:
        powers = np.exp(logarithm * exponents[..., None, :])  # (..., surface, exponent)
        return fit_work(powers, effective_works)[1]

    return _search_minimum(error_at, SEARCHED_EXPONENTS, parameter.shape[:-1])


def _search_minimum(
    error_at: Callable[[Floats], Floats], grid: Floats, shape: tuple[int, ...]
) -> Floats:
    """Return the smallest error (...) on an even grid that is refined about the best value.

    `error_at` returns the errors (..., k) at values (..., k); `shape` is that of the result. Each
    refinement covers one old step to both sides of the best value with 41 values.
    """
    step = grid[1] - grid[0]
    values = np.broadcast_to(grid, (*shape, grid.size))
    for _ in range(REFINEMENTS + 1):
        best_value, error = minimum_along_axis(error_at(values), values)
        values = best_value[..., None] + step * np.linspace(-1, 1, 41)
        step /= 20
    return error
