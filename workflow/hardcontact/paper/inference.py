"""Range and work of adhesion, inferred from the published mean pull-off forces.

All forces are computed for a work of adhesion of 1 J/m², to which they are proportional. Force
statistics are given for two pairs of range and work of adhesion, the published and the fitted pair.
"""

from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.job import progress
from hardcontact.base.statistics import Sampling
from hardcontact.base.units import DIMENSIONLESS, JOULE_PER_M2, NM
from hardcontact.contact.force_curves import (
    force_curves,
    force_statistics,
    interpolate_to_range,
    interpolate_to_ranges,
    mean_forces,
)
from hardcontact.paper import error_map

#: Labels of the pairs of range and work of adhesion.
PAIRS = ["published", "fitted"]

#: Number of ranges of adhesion of the error map, from the smallest to the largest computed range.
FINE_RANGE_COUNT = 801

#: Largest number of local minima of the error.
MAX_MINIMA = 3


#: Variables fitted to mean forces, with their units.
INFERRED_UNITS = {
    "range_of_adhesion": NM,
    "work_of_adhesion": JOULE_PER_M2,
    "best_error": DIMENSIONLESS,
    "range_from_ratios": NM,
}

#: Fitted variables whose samples are returned, by a short name.
SAMPLED_VARIABLES = {
    "range": "range_of_adhesion",
    "work": "work_of_adhesion",
    "error": "best_error",
}


class Pair(NamedTuple):
    """A range of adhesion in nm and a work of adhesion in J/m²."""

    range_of_adhesion: float
    work_of_adhesion: float


class PublishedFit(NamedTuple):
    """Published forces, with the range and the work of adhesion that the paper inferred."""

    forces: pd.DataFrame  #: From `published.pull_off`.
    pair: Pair  #: Published range and work of adhesion.


def infer(
    adhesion: xr.Dataset,
    published: PublishedFit,
    reference_surface: str,
    error_threshold: float,
    force_floor: float,
    sampling: Sampling,
) -> xr.Dataset:
    """Infer range and work of adhesion for every contact model, and the resulting forces.

    adhesion: adhesion.nc: forces in N at 1 J/m².
    published: published forces, range and work of adhesion.
    reference_surface: surface to which force ratios are taken.
    error_threshold: mean relative error below which a pair counts as fitting.
    force_floor: smallest measurable force in N, for `force_statistics`.
    sampling: random numbers and confidence of the intervals.
    Returns the variables of `infer_model` have the dimension contact_model. The variables of
        `force_statistics` and ``ratio_at_pair`` also have pair and surface. ``model_error_ratio``
        is the smallest error of rigid contact relative to plastic contact.
    """
    surfaces = adhesion.surface.values.tolist()
    published_forces = published.forces.mean_force.reindex(surfaces).to_numpy()
    reference_index = surfaces.index(reference_surface)
    model_datasets = []
    for model in adhesion.contact_model.values.tolist():
        forces = adhesion.pull_off_force.sel(contact_model=model)
        fits = infer_model(forces, published_forces, reference_index, error_threshold, sampling)
        fitted = Pair(float(fits.range_of_adhesion), float(fits.work_of_adhesion))
        pair_statistics = [
            _forces_at_pair(forces, pair, reference_index, force_floor, sampling)
            for pair in progress([published.pair, fitted], 2, f"force statistics, {model}")
        ]
        model_datasets.append(fits.merge(xr.concat(pair_statistics, pd.Index(PAIRS, name="pair"))))
    models = xr.concat(
        model_datasets, pd.Index(adhesion.contact_model.values, name="contact_model")
    )
    return (
        models.assign(_model_error_ratio(models, sampling))
        .assign(label=adhesion.label, basis=adhesion.basis)
        .assign_attrs(
            error_threshold=error_threshold,
            force_floor=force_floor,
            confidence=sampling.confidence,
            sphere_radius=adhesion.attrs["sphere_radius"],
        )
    )


def _model_error_ratio(models: xr.Dataset, sampling: Sampling) -> dict[str, Any]:
    """Return the smallest error of rigid contact relative to plastic contact, with an interval."""
    rigid = models.sel(contact_model="rigid")
    plastic = models.sel(contact_model="plastic")
    value = rigid["best_error"].item() / plastic["best_error"].item()
    samples = rigid["sampled_error"].values / plastic["sampled_error"].values
    return sampling.with_interval("model_error_ratio", (), value, samples, DIMENSIONLESS)


def _forces_at_pair(
    forces: xr.DataArray, pair: Pair, reference_index: int, force_floor: float, sampling: Sampling
) -> xr.Dataset:
    """Return force statistics and ratios of mean forces of one contact model by surface."""
    pair_forces = interpolate_to_range(forces, pair.range_of_adhesion) * pair.work_of_adhesion
    means, mean_samples = mean_forces(pair_forces.expand_dims("rho"), sampling)
    ratio = means[:, 0] / means[reference_index, 0]
    ratio_samples = mean_samples[:, :, 0] / mean_samples[:, [reference_index], 0]
    contacts = pair_forces.stack(contact=["contact_y", "contact_x"])
    statistics = [
        force_statistics(contacts.sel(surface=surface).values, force_floor, sampling)
        for surface in forces.surface.values
    ]
    return xr.concat(statistics, pd.Index(forces.surface.values, name="surface")).assign(
        sampling.with_interval("ratio_at_pair", "surface", ratio, ratio_samples, DIMENSIONLESS)
    )


def infer_model(
    forces: xr.DataArray,
    published_forces: np.ndarray,
    reference_index: int,
    threshold: float,
    sampling: Sampling,
) -> xr.Dataset:
    """Infer range and work of adhesion for one contact model, with error map and force curves.

    forces: forces (surface, scan, sphere_scan, rho, contact_y, contact_x) in N at 1 J/m², NaN for a
        missing scan.
    published_forces: published mean forces (surface,) in N. Surfaces with NaN do not enter the fit.
    reference_index: index of the surface to which force ratios are taken.
    threshold: mean relative error below which a pair counts as fitting.
    sampling: random numbers and confidence of the intervals.
    Returns INFERRED_UNITS with intervals and samples, the error map, and the variables of
        `force_curves`. At the best work for each range the error has local minima along the range.
        ``minimum`` numbers them in the order of their errors; missing minima are NaN.
    """
    rhos = forces.rho.values
    fine_ranges = np.geomspace(rhos[0], rhos[-1], FINE_RANGE_COUNT)
    means, mean_samples = mean_forces(forces, sampling)
    is_published = np.isfinite(published_forces)
    targets = published_forces[is_published]
    fitted_reference_index = int(is_published[:reference_index].sum())
    curves = interpolate_to_ranges(means[is_published], rhos, fine_ranges)
    curve_samples = interpolate_to_ranges(mean_samples[:, is_published], rhos, fine_ranges)
    fits = _fit_curves(curves, targets, fitted_reference_index, fine_ranges)
    sampled_fits = _fit_curves(curve_samples, targets, fitted_reference_index, fine_ranges)
    variables: dict[str, Any] = {
        f"sampled_{name}": ("sample", sampled_fits[variable], INFERRED_UNITS[variable])
        for name, variable in SAMPLED_VARIABLES.items()
    }
    for name, attributes in INFERRED_UNITS.items():
        variables |= sampling.with_interval(name, (), fits[name], sampled_fits[name], attributes)
    variables |= _error_variables(curves, targets, fine_ranges, threshold)
    _, ratio_errors = error_map.fit_ratios(curves, targets, fitted_reference_index)
    variables["ratio_error"] = ("rho_fine", ratio_errors, DIMENSIONLESS)
    variables |= force_curves(forces, means, mean_samples, reference_index, sampling)
    coordinates = {
        "rho_fine": ("rho_fine", fine_ranges, NM),
        "work": ("work", error_map.WORKS, JOULE_PER_M2),
        "minimum": np.arange(1, MAX_MINIMA + 1),
    }
    return xr.Dataset(variables, {"surface": forces.surface, "rho": forces.rho} | coordinates)


def _fit_curves(
    curves: np.ndarray, targets: np.ndarray, reference_index: int, fine_ranges: np.ndarray
) -> dict[str, np.ndarray]:
    """Return the variables (...) fitted to curves (..., surface, rho), NaN if a curve has NaN."""
    best_index, work, error = error_map.fit_range_and_work(curves, targets)
    best_index_of_ratios, _ = error_map.fit_ratios(curves, targets, reference_index)
    is_fitted = np.isfinite(error)
    return {
        "range_of_adhesion": np.where(is_fitted, fine_ranges[best_index], np.nan),
        "work_of_adhesion": work,
        "best_error": error,
        "range_from_ratios": np.where(is_fitted, fine_ranges[best_index_of_ratios], np.nan),
    }


def _error_variables(
    curves: np.ndarray, targets: np.ndarray, fine_ranges: np.ndarray, threshold: float
) -> dict[str, Any]:
    """Return the error map, its local minima, and the region of small error."""
    errors = error_map.mean_relative_error(curves, targets, error_map.WORKS)
    ranges, works = error_map.error_region(errors, fine_ranges, error_map.WORKS, threshold)
    work, smallest_errors = error_map.fit_work(curves, targets)
    minima = error_map.local_minima(smallest_errors, MAX_MINIMA)
    padding = (0, MAX_MINIMA - len(minima))
    return {
        "mean_relative_error": (("rho_fine", "work"), errors, DIMENSIONLESS),
        "best_error_by_range": ("rho_fine", smallest_errors, DIMENSIONLESS),
        "low_error_range": ("bound", ranges, NM),
        "low_error_work": ("bound", works, JOULE_PER_M2),
    } | {
        f"{name}_at_minimum": (
            "minimum",
            np.pad(values[minima], padding, constant_values=np.nan),
            attributes,
        )
        for name, values, attributes in (
            ("range", fine_ranges, NM),
            ("work", work, JOULE_PER_M2),
            ("error", smallest_errors, DIMENSIONLESS),
        )
    }
