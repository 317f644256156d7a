"""Range and work of adhesion, inferred from the published mean pull-off forces.

All forces are computed for a work of adhesion of 1 J/m², to which they are proportional. What
depends on both stands at two pairs of them, the published one and the fitted one.
"""

from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.job import progress
from hardcontact.base.statistics import Sampling
from hardcontact.contact.force_curves import (
    at_range,
    force_curves,
    force_statistics,
    mean_forces,
    on_fine_grid,
)
from hardcontact.paper import error_map

#: The contact model that the paper's conclusions rest on.
PLASTIC = "plastic"
#: Of range and work of adhesion.
PAIRS = ["published", "fitted"]

#: Ranges of adhesion of the error map, from the least to the greatest one computed.
FINE_RANGES = 801

#: Local minima of the error that are kept.
MINIMA = 3

NM, ENERGY, ONE = {"units": "nm"}, {"units": "J m-2"}, {"units": "1"}

#: What is fitted to mean forces, with its units.
UNITS = {
    "range_of_adhesion": NM,
    "work_of_adhesion": ENERGY,
    "best_error": ONE,
    "range_from_ratios": NM,
}

#: Of these the samples are kept, by a short name.
SAMPLED = {"range": "range_of_adhesion", "work": "work_of_adhesion", "error": "best_error"}


class Pair(NamedTuple):
    """A range of adhesion in nm and a work of adhesion in J/m²."""

    range_of_adhesion: float
    work_of_adhesion: float


class Published(NamedTuple):
    """What the paper measured, and what it inferred from that."""

    forces: pd.DataFrame  #: As from `published.pull_off`.
    pair: Pair  #: Its range and work of adhesion.


def infer(
    adhesion: xr.Dataset,
    published: Published,
    reference_surface: str,
    error_threshold: float,
    force_floor: float,
    sampling: Sampling,
) -> xr.Dataset:
    """Infer range and work of adhesion of every contact model, and describe the forces they give.

    Adhesion is as in adhesion.nc; ratios are taken to the reference surface, the error is small
    below its threshold, the floor in N is that of `force_statistics`. Over contact_model follow
    `infer_model`, and `force_statistics` and `ratio_at_pair` over pair and surface, at the pair as
    it stands; and `model_error_ratio`, the least error of rigid over that of plastic contact.
    """
    surfaces = adhesion.surface.values.tolist()
    target = published.forces.mean_force.reindex(surfaces).to_numpy()
    reference = surfaces.index(reference_surface)
    parts = []
    for model in adhesion.contact_model.values.tolist():
        forces = adhesion.pull_off_force.sel(contact_model=model)
        inferred = infer_model(forces, target, reference, error_threshold, sampling)
        fitted = Pair(float(inferred.range_of_adhesion), float(inferred.work_of_adhesion))
        pairs = [
            _at_pair(forces, pair, reference, force_floor, sampling)
            for pair in progress([published.pair, fitted], 2, f"force statistics, {model}")
        ]
        parts.append(inferred.merge(xr.concat(pairs, pd.Index(PAIRS, name="pair"))))
    models = xr.concat(parts, pd.Index(adhesion.contact_model.values, name="contact_model"))
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
    """Return the least error of rigid over that of plastic contact, of the same samples."""
    value, samples = (
        models[name].sel(contact_model="rigid") / models[name].sel(contact_model="plastic")
        for name in ("best_error", "sampled_error")
    )
    return sampling.with_interval("model_error_ratio", (), value.item(), samples.values, ONE)


def _at_pair(
    forces: xr.DataArray, pair: Pair, reference: int, floor: float, sampling: Sampling
) -> xr.Dataset:
    """Return force statistics and ratios of mean forces of one contact model, over surface."""
    rho, work = pair
    at_pair = at_range(forces, rho) * work
    means, sampled = (
        values[..., 0] for values in mean_forces(at_pair.expand_dims("rho"), sampling)
    )
    ratio, ratios = means / means[reference], sampled / sampled[:, [reference]]
    contacts = at_pair.stack(contact=["contact_y", "contact_x"])
    statistics = [
        force_statistics(contacts.sel(surface=surface).values, floor, sampling)
        for surface in forces.surface.values
    ]
    return xr.concat(statistics, pd.Index(forces.surface.values, name="surface")).assign(
        sampling.with_interval("ratio_at_pair", "surface", ratio, ratios, ONE)
    )


def infer_model(
    forces: xr.DataArray,
    published: np.ndarray,
    reference: int,
    threshold: float,
    sampling: Sampling,
) -> xr.Dataset:
    """Infer range and work of adhesion of one contact model, with error map and force curves.

    Forces (surface, scan, sphere_scan, rho, contact_y, contact_x) are in N at 1 J/m², NaN where a
    scan is missing; surfaces without a published mean force (surface,) do not enter the fit;
    `reference` is the index of the surface that ratios are taken to, `threshold` that of the mean
    relative error. `minimum` counts the local minima along the range of the error at its best work,
    the least first; NaN where there is none.
    """
    rhos = forces.rho.values
    fine = np.geomspace(rhos[0], rhos[-1], FINE_RANGES)
    means, sampled = mean_forces(forces, sampling)
    known = np.isfinite(published)
    target, base = published[known], int(known[:reference].sum())
    curve = on_fine_grid(means[known], rhos, fine)
    sampled_curves = on_fine_grid(sampled[:, known], rhos, fine)
    fits, samples = (_fits(curves, target, base, fine) for curves in (curve, sampled_curves))
    variables: dict[str, Any] = {
        f"sampled_{name}": ("sample", samples[variable], UNITS[variable])
        for name, variable in SAMPLED.items()
    }
    for name, attributes in UNITS.items():
        variables |= sampling.with_interval(name, (), fits[name], samples[name], attributes)
    variables |= _errors(curve, target, fine, threshold)
    variables["ratio_error"] = ("rho_fine", error_map.fit_ratios(curve, target, base)[1], ONE)
    variables |= force_curves(forces, means, sampled, reference, sampling)
    coordinates = {
        "rho_fine": ("rho_fine", fine, NM),
        "work": ("work", error_map.WORK, ENERGY),
        "minimum": np.arange(1, MINIMA + 1),
    }
    return xr.Dataset(variables, {"surface": forces.surface, "rho": forces.rho} | coordinates)


def _fits(
    curves: np.ndarray, published: np.ndarray, reference: int, fine: np.ndarray
) -> dict[str, np.ndarray]:
    """Return what is fitted to curves (..., surface, rho): arrays (...), NaN where a curve is."""
    best, work, error = error_map.fit(curves, published)
    from_ratios, _ = error_map.fit_ratios(curves, published, reference)
    known = np.isfinite(error)
    return {
        "range_of_adhesion": np.where(known, fine[best], np.nan),
        "work_of_adhesion": work,
        "best_error": error,
        "range_from_ratios": np.where(known, fine[from_ratios], np.nan),
    }


def _errors(
    curve: np.ndarray, published: np.ndarray, fine: np.ndarray, threshold: float
) -> dict[str, Any]:
    """Return the error over range and work of adhesion, its minima, and where it is small."""
    errors = error_map.mean_relative_error(curve, published, error_map.WORK)
    ranges, works = error_map.error_region(errors, fine, error_map.WORK, threshold)
    work, least = error_map.fit_work(curve, published)
    at_minima = error_map.least_errors(least, MINIMA)
    missing = (0, MINIMA - len(at_minima))
    return {
        "mean_relative_error": (("rho_fine", "work"), errors, ONE),
        "error_of_range": ("rho_fine", least, ONE),
        "region_range": ("bound", ranges, NM),
        "region_work": ("bound", works, ENERGY),
    } | {
        f"minimum_{name}": (
            "minimum",
            np.pad(values[at_minima], missing, constant_values=np.nan),
            attributes,
        )
        for name, values, attributes in (
            ("range", fine, NM),
            ("work", work, ENERGY),
            ("error", least, ONE),
        )
    }
