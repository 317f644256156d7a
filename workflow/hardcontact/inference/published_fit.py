"""Range and work of adhesion that fit published mean pull-off forces, for fit.nc."""

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats
from hardcontact.base.dataset import stack
from hardcontact.base.progress import progress
from hardcontact.base.published import read_constants, read_published_forces
from hardcontact.base.statistics import Sampling, as_variables, student_log_interval
from hardcontact.base.units import DIMENSIONLESS, JOULE_PER_M2, NEWTON, NM
from hardcontact.contact.contact import PLASTIC, RIGID
from hardcontact.contact.pull_off import mean_over_contacts
from hardcontact.inference.fit import (
    FIT_ATTRS,
    WITHOUT_SURFACE,
    best_fit,
    fine_ranges,
    fit_work,
    interpolate_to_ranges,
    mean_relative_error,
)
from hardcontact.inference.force_statistics import sample_mean_forces, statistics_at_pair

#: Labels of the pairs of range and work of adhesion.
PAIRS = ["published", "fitted"]

#: Works of adhesion (J/m²) of the error map, in steps of 2 %.
MAPPED_WORKS = np.geomspace(1e-3, 10.0, 501)
#: Largest number of local minima of the error in fit.nc, the smallest first.
MAX_MINIMA = 3

#: Variables of the best fit, and the range that fits the ratios of forces best.
FITTED_ATTRS = FIT_ATTRS | {"range_from_ratios": NM}

#: Fitted variables whose samples fit.nc has, too: ``sampled_range`` holds those of the range.
SAMPLED_FITS = {"range": "range_of_adhesion", "work": "work_of_adhesion", "error": "best_error"}


class PublishedForces(NamedTuple):
    """Published forces, and how the paper inferred range and work of adhesion from them."""

    forces: pd.DataFrame  #: From `published.read_published_forces`.
    pair: tuple[float, float]  #: Published range (nm) and work of adhesion (J/m²).
    error_threshold: float  #: A pair fits if its mean relative error is below this threshold.

    @classmethod
    def read(cls, pull_off: str | Path, constants: str | Path) -> "PublishedForces":
        """Read `pull_off.csv` and `constants.csv`."""
        values = read_constants(constants)["value"]
        pair = values["range_of_adhesion"], values["work_of_adhesion"]
        return cls(read_published_forces(pull_off), pair, values["error_threshold"])


def fit_published(
    adhesion: xr.Dataset, published: PublishedForces, reference_surface: str, sampling: Sampling
) -> xr.Dataset:
    """Return the fit to adhesion.nc for every contact model, with statistics at both PAIRS."""
    surfaces = adhesion.surface.values.tolist()
    published_forces = published.forces.mean_force.loc[surfaces].to_numpy()
    reference_index = surfaces.index(reference_surface)
    threshold = published.error_threshold
    fits = {}
    for model in adhesion.contact_model.values.tolist():
        forces = adhesion.pull_off_force.sel(contact_model=model)
        fit = fit_contact_model(forces, published_forces, reference_index, threshold, sampling)
        fitted_pair = float(fit.range_of_adhesion), float(fit.work_of_adhesion)
        statistics = [
            statistics_at_pair(forces, pair, reference_index, sampling)
            for pair in progress([published.pair, fitted_pair], 2, f"force statistics, {model}")
        ]
        fits[(model,)] = fit.merge(xr.concat(statistics, pd.Index(PAIRS, name="pair")))
    fits_by_model = stack(fits, ["contact_model"])
    return (
        fits_by_model.assign(_model_error_ratio(fits_by_model, sampling))
        .assign(label=adhesion.label, source=adhesion.source)
        .assign_attrs(
            error_threshold=threshold,
            confidence=sampling.confidence,
            sphere_radius=adhesion.attrs["sphere_radius"],
        )
    )


def _model_error_ratio(fits_by_model: xr.Dataset, sampling: Sampling) -> dict[str, Any]:
    """Return the smallest error of rigid contact relative to plastic contact, with an interval."""
    errors = fits_by_model[["best_error", "sampled_error"]]
    ratio = errors.sel(contact_model=RIGID) / errors.sel(contact_model=PLASTIC)
    ratios = np.append(ratio["best_error"], ratio["sampled_error"])
    return sampling.sampled_variables("model_error_ratio", (), ratios, DIMENSIONLESS)


def fit_contact_model(
    forces: xr.DataArray,
    published_forces: Floats,
    reference_index: int,
    threshold: float,
    sampling: Sampling,
) -> xr.Dataset:
    """Return the fit of range and work for one contact model, its errors, and the mean forces.

    Forces (surface, scan, sphere_scan, rho, contact_y, contact_x) are in N at 1 J/m², NaN for a
    missing scan.
    """
    ranges = fine_ranges(forces.rho.values)
    means = sample_mean_forces(forces, sampling)
    force_curves = interpolate_to_ranges(means, forces.rho.values, ranges)
    # Index 0 of both is the mean itself, the others are samples of it.
    axes = ("surface", "rho")
    scan_means = mean_over_contacts(forces).transpose(..., *axes)
    interval = student_log_interval(scan_means, sampling.confidence, "scan")
    variables = (
        _error_variables(force_curves[0], published_forces, ranges, threshold)
        | _fitted_variables(force_curves, published_forces, ranges, reference_index, sampling)
        | _fits_without_surface(force_curves[0], published_forces, ranges)
        | as_variables("mean_force", axes, means[0], interval.values, NEWTON, sampling.confidence)
        | sampling.sampled_variables(
            "force_over_reference", axes, means / means[:, [reference_index]], DIMENSIONLESS
        )
    )
    coordinates = {
        "surface": forces.surface,
        "left_out": forces.surface.values,
        "rho": forces.rho,
        "rho_fine": ("rho_fine", ranges, NM),
        "work": ("work", MAPPED_WORKS, JOULE_PER_M2),
        "minimum": np.arange(1, MAX_MINIMA + 1),
    }
    return xr.Dataset(variables, coordinates)


def _fitted_variables(
    force_curves: Floats,
    published_forces: Floats,
    ranges: Floats,
    reference_index: int,
    sampling: Sampling,
) -> dict[str, Any]:
    """Return FITTED_ATTRS with intervals, samples of SAMPLED_FITS, and ``ratio_error`` (rho_fine).

    Force curves (1 + sample, surface, rho_fine) are the mean forces, then samples of them.
    """
    fits = best_fit(force_curves, published_forces, ranges)
    errors = ratio_errors(force_curves, published_forces, reference_index)
    best_ranges = ranges[errors.argmin(axis=-1)]
    fits["range_from_ratios"] = np.where(np.isfinite(fits["best_error"]), best_ranges, np.nan)
    variables: dict[str, Any] = {"ratio_error": ("rho_fine", errors[0], DIMENSIONLESS)}
    for name, attributes in FITTED_ATTRS.items():
        variables |= sampling.sampled_variables(name, (), fits[name], attributes)
    for name, variable in SAMPLED_FITS.items():
        variables[f"sampled_{name}"] = ("sample", fits[variable][1:], FITTED_ATTRS[variable])
    return variables


def _fits_without_surface(
    force_curves: Floats, published_forces: Floats, ranges: Floats
) -> dict[str, Any]:
    """Return the variables of WITHOUT_SURFACE (left_out,): the best pair without each surface."""
    are_kept = ~np.eye(len(published_forces), dtype=bool)
    fits = [best_fit(force_curves[kept], published_forces[kept], ranges) for kept in are_kept]
    return {
        WITHOUT_SURFACE[name]: ("left_out", [fit[name] for fit in fits], attributes)
        for name, attributes in FIT_ATTRS.items()
    }


def _error_variables(
    force_curves: Floats, published_forces: Floats, ranges: Floats, threshold: float
) -> dict[str, Any]:
    """Return the error map, the region of small error, and the local minima along the range."""
    errors = mean_relative_error(force_curves, published_forces, MAPPED_WORKS)
    region_range, region_work = error_region(errors, ranges, MAPPED_WORKS, threshold)
    works, smallest_errors = fit_work(force_curves, published_forces)
    minima = smallest_minima(smallest_errors)
    # Rows of range, work and error; NaN without a further minimum.
    values_at_minima = np.full((3, MAX_MINIMA), np.nan)
    values_at_minima[:, : len(minima)] = ranges[minima], works[minima], smallest_errors[minima]
    return {
        "mean_relative_error": (("rho_fine", "work"), errors, DIMENSIONLESS),
        "best_error_by_range": ("rho_fine", smallest_errors, DIMENSIONLESS),
        "region_range": ("end", region_range, NM),
        "region_work": ("end", region_work, JOULE_PER_M2),
        "range_at_minimum": ("minimum", values_at_minima[0], NM),
        "work_at_minimum": ("minimum", values_at_minima[1], JOULE_PER_M2),
        "error_at_minimum": ("minimum", values_at_minima[2], DIMENSIONLESS),
    }


def smallest_minima(errors: Floats) -> NDArray[np.int_]:
    """Return the indices of the MAX_MINIMA smallest local minima of errors (rho,), smallest first.

    A minimum may lie at an end of the ranges. There may be fewer.
    """
    run_starts = np.flatnonzero(np.diff(errors, prepend=np.inf))  # the first of equal neighbours
    change = np.diff(errors[run_starts], prepend=np.inf, append=np.inf)
    minima = run_starts[(change[:-1] < 0) & (change[1:] > 0)]
    return np.asarray(minima[np.argsort(errors[minima], kind="stable")[:MAX_MINIMA]])


def ratio_errors(computed_forces: Floats, published_forces: Floats, reference_index: int) -> Floats:
    """Return the mean relative errors (..., rho) of forces relative to a reference surface.

    Computed forces are (..., surface, rho), published forces (surface,).
    """
    ratios = computed_forces / computed_forces[..., [reference_index], :]
    published_ratios = (published_forces / published_forces[reference_index])[:, None]
    is_other = np.arange(len(published_forces)) != reference_index
    errors = np.abs(ratios / published_ratios - 1)[..., is_other, :]
    return np.asarray(errors.mean(axis=-2))


def error_region(
    errors: Floats, ranges: Floats, works: Floats, threshold: float
) -> tuple[Floats, Floats]:
    """Return the ends of ranges (2,) in nm and works (2,) in J/m² of pairs that fit, or NaN."""
    rows, columns = np.nonzero(errors < threshold)
    if not rows.size:
        return np.full(2, np.nan), np.full(2, np.nan)
    return ranges[[rows.min(), rows.max()]], works[[columns.min(), columns.max()]]
