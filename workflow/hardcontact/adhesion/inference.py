"""Range and work of adhesion, inferred from the published mean pull-off forces.

All forces are computed for a work of adhesion of 1 J/m², to which they are proportional.
"""

from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.adhesion.bootstrap import Bootstrap
from hardcontact.adhesion.force_curves import at_range, force_curves, mean_forces, on_fine_grid
from hardcontact.adhesion.force_distributions import force_statistics
from hardcontact.records import log
from hardcontact.statistics import percentile_interval

__all__ = [
    "WORK",
    "error_region",
    "fit",
    "fit_ratios",
    "infer",
    "infer_model",
    "mean_relative_error",
    "undecided",
]

#: Works of adhesion (J/m²) of the error map.
WORK = np.geomspace(0.005, 1.0, 301)

#: Ranges of adhesion of the error map, from the least to the greatest one computed.
FINE_RANGES = 401


def infer(
    adhesion: xr.Dataset,
    published: pd.DataFrame,
    reference_surface: str,
    error_threshold: float,
    force_floor: float,
    bootstrap: Bootstrap,
) -> xr.Dataset:
    """Infer range and work of adhesion of every contact model, and fit the forces it gives.

    Parameters
    ----------
    adhesion : xarray.Dataset
        All pull-off forces, as in adhesion.nc.
    published : pandas.DataFrame
        Measured forces, as from `published.pull_off`.
    reference_surface : str
        The surface that ratios are taken to.
    error_threshold : float
        The region of small error is where the mean relative error is below it.
    force_floor : float
        In N, of `force_statistics`.
    bootstrap : Bootstrap
        Of all intervals.

    Returns
    -------
    xarray.Dataset
        That of `infer_model` and `force_statistics` of each surface, over contact_model.
    """
    surfaces = adhesion.surface.values.tolist()
    target = published.mean_force.reindex(surfaces).to_numpy()
    parts = []
    for model in adhesion.contact_model.values.tolist():
        forces = adhesion.pull_off_force.sel(contact_model=model)
        inferred = infer_model(
            forces, target, surfaces.index(reference_surface), error_threshold, bootstrap
        )
        fitted = at_range(forces, float(inferred.range_of_adhesion))
        fitted = fitted * float(inferred.work_of_adhesion)
        parts.append(inferred.merge(_statistics(fitted, force_floor, bootstrap, model)))
    return (
        xr.concat(parts, pd.Index(adhesion.contact_model.values, name="contact_model"))
        .assign(label=adhesion.label, basis=adhesion.basis)
        .assign_attrs(
            error_threshold=error_threshold,
            force_floor=force_floor,
            confidence=bootstrap.confidence,
            sphere_radius=adhesion.attrs["sphere_radius"],
        )
    )


def _statistics(forces: xr.DataArray, floor: float, bootstrap: Bootstrap, model: str) -> xr.Dataset:
    """Return `force_statistics` of each surface of one contact model, over surface."""
    contacts = forces.stack(contact=["contact_y", "contact_x"])
    surfaces = forces.surface.values.tolist()
    parts = [
        force_statistics(contacts.sel(surface=surface).values, floor, bootstrap, model, surface)
        for surface in log.progress(surfaces, len(surfaces), f"force statistics, {model}")
    ]
    return xr.concat(parts, pd.Index(surfaces, name="surface"))


def infer_model(
    forces: xr.DataArray,
    published: np.ndarray,
    reference: int,
    threshold: float,
    bootstrap: Bootstrap,
) -> xr.Dataset:
    """Infer range and work of adhesion of one contact model, with error map and force curves.

    Parameters
    ----------
    forces : xarray.DataArray (surface, scan, sphere_scan, rho, contact_y, contact_x)
        In N at 1 J/m², NaN where a scan is missing.
    published : ndarray (surface,)
        Mean forces in N, NaN where there is none: such surfaces do not enter the fit.
    reference : int
        Index of the surface that ratios are taken to.
    threshold : float
        Of the mean relative error.
    bootstrap : Bootstrap
        Substrate and sphere scans are resampled.

    Returns
    -------
    xarray.Dataset
        Over surface, rho, rho_fine, work and sample.
    """
    rhos = forces.rho.values
    fine = np.geomspace(rhos[0], rhos[-1], FINE_RANGES)
    means, sampled = mean_forces(forces, bootstrap)
    known = np.isfinite(published)
    target, base = published[known], int(known[:reference].sum())
    curve = on_fine_grid(means[known], rhos, fine)
    sampled_curves = on_fine_grid(sampled[:, known], rhos, fine)
    best, work, error = fit(curve, target)
    sampled_best, sampled_work, _ = fit(sampled_curves, target)
    best_ratio, ratio_error = fit_ratios(curve, target, base)
    sampled_ratio, _ = fit_ratios(sampled_curves, target, base)
    interval = percentile_interval(fine[sampled_best], bootstrap.confidence)
    nm, energy, one = {"units": "nm"}, {"units": "J m-2"}, {"units": "1"}
    variables: dict[str, Any] = {
        "ratio_error": ("rho_fine", ratio_error, one),
        "best_error": ((), error, one),
        "bootstrap_range": ("sample", fine[sampled_best], nm),
        "bootstrap_work": ("sample", sampled_work, energy),
        "undecided": ((), undecided(float(error), threshold, interval, rhos)),
    }
    for name, value, samples, attributes in (
        ("range_of_adhesion", fine[best], fine[sampled_best], nm),
        ("work_of_adhesion", work, sampled_work, energy),
        ("range_from_ratios", fine[best_ratio], fine[sampled_ratio], nm),
    ):
        variables |= bootstrap.with_interval(name, (), value, samples, attributes)
    variables |= _error_map(curve, target, fine, threshold)
    variables |= force_curves(forces, means, sampled, reference, bootstrap)
    coordinates = {"rho_fine": ("rho_fine", fine, nm), "work": ("work", WORK, energy)}
    return xr.Dataset(variables, {"surface": forces.surface, "rho": forces.rho} | coordinates)


def _error_map(
    curve: np.ndarray, published: np.ndarray, fine: np.ndarray, threshold: float
) -> dict[str, Any]:
    """Return the error over range and work of adhesion, and the region where it is small."""
    errors = mean_relative_error(curve, published, WORK)
    ranges, works = error_region(errors, fine, WORK, threshold)
    return {
        "mean_relative_error": (("rho_fine", "work"), errors, {"units": "1"}),
        "region_range": ("bound", ranges, {"units": "nm"}),
        "region_work": ("bound", works, {"units": "J m-2"}),
    }


def mean_relative_error(
    mean_forces: np.ndarray, published: np.ndarray, work: np.ndarray
) -> np.ndarray:
    """Return the mean over surfaces of |W f/F - 1|.

    Parameters
    ----------
    mean_forces : ndarray (..., surface, rho)
        In N at 1 J/m².
    published : ndarray (surface,)
        In N.
    work : ndarray (k,)
        In J/m².

    Returns
    -------
    ndarray (..., rho, k)
        The error.
    """
    relative = mean_forces / published[:, None]
    error: np.ndarray = np.abs(relative[..., None] * work - 1).mean(axis=-3)
    return error


def fit(
    mean_forces: np.ndarray, published: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Find the range and work of adhesion of the least mean relative error.

    The error is piecewise linear in W, so that its minimum lies at one of the W that match a
    surface exactly; all are tried.

    Parameters
    ----------
    mean_forces : ndarray (..., surface, rho)
        In N at 1 J/m².
    published : ndarray (surface,)
        In N.

    Returns
    -------
    rho, work, error : ndarray (...)
        Index into rho, work of adhesion in J/m², and the error.
    """
    relative = mean_forces / published[:, None]
    candidates = 1 / relative  # (..., candidate, rho)
    errors = np.abs(candidates[..., :, None, :] * relative[..., None, :, :] - 1).mean(axis=-2)
    flat = errors.reshape(*errors.shape[:-2], -1)
    best = flat.argmin(axis=-1)
    rho = best % mean_forces.shape[-1]
    work = np.take_along_axis(candidates.reshape(flat.shape), best[..., None], -1)[..., 0]
    return rho, work, np.take_along_axis(flat, best[..., None], -1)[..., 0]


def fit_ratios(
    mean_forces: np.ndarray, published: np.ndarray, reference: int
) -> tuple[np.ndarray, np.ndarray]:
    """Find the range of the least mean relative error of the ratios to a reference surface.

    The work of adhesion cancels.

    Parameters
    ----------
    mean_forces : ndarray (..., surface, rho)
        In N at any work of adhesion.
    published : ndarray (surface,)
        In N.
    reference : int
        Index of the surface.

    Returns
    -------
    rho : ndarray (...)
        Index into rho.
    errors : ndarray (..., rho)
        At every range.
    """
    ratios = mean_forces / mean_forces[..., [reference], :]
    expected = (published / published[reference])[:, None]
    others = np.arange(len(published)) != reference
    errors = np.abs(ratios / expected - 1)[..., others, :].mean(axis=-2)
    return errors.argmin(axis=-1), errors


def error_region(
    errors: np.ndarray, rhos: np.ndarray, work: np.ndarray, threshold: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return least and greatest rho, and W, where the error map (rho, work) is below `threshold`.

    Two arrays (2,), NaN where there is no such place.
    """
    small = errors < threshold
    if not small.any():
        return np.full(2, np.nan), np.full(2, np.nan)
    rows, columns = np.nonzero(small)
    return rhos[[rows.min(), rows.max()]], work[[columns.min(), columns.max()]]


def undecided(best_error: float, threshold: float, interval: np.ndarray, rhos: np.ndarray) -> str:
    """Return the limits of what the scans say about the range of adhesion, in one sentence.

    `interval` (2,) is that of the range; `rhos` are the ranges computed; all in nm.
    """
    low, high = interval
    limits = []
    if best_error >= threshold:
        limits.append(
            f"no range and work of adhesion bring the mean relative error below "
            f"{threshold:g} (least {best_error:.2f})"
        )
    if high >= 0.99 * rhos[-1]:
        limits.append(
            f"the interval reaches the largest range computed, {rhos[-1]:g} nm: "
            "there is no upper bound"
        )
    if low <= 1.02 * rhos[0]:
        limits.append(
            f"the interval reaches the smallest range computed, {rhos[0]:g} nm: "
            "there is no lower bound"
        )
    limits.append(
        f"ranges of adhesion between {low:.1f} and {high:.1f} nm cannot be told apart "
        "by these scans"
    )
    return "; ".join(limits)
