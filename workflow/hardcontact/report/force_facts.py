"""Predicted and measured forces of own surfaces as rows of the answer, and the fit to them."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from hardcontact.base.number import Number
from hardcontact.contact.smooth_sphere import STRONGEST_WORK
from hardcontact.report.artificial import NEARLY_ALL, parts_of_change, reliable_share
from hardcontact.report.datasets import Datasets, forces_at_range, preferred_model
from hardcontact.report.quantities import bounds_only, number_of
from hardcontact.surfaces.synthesis import SIDES

#: Largest distance of the upper end of an interval, relative to that of the lower end, in the
#: logarithm. Beyond it the upper end is called open: few tests may scatter much more than it seems.
MAX_LOPSIDEDNESS = 2.0


class AnswerRow(NamedTuple):
    """A row of the table of an answer: a number, and facts about it by their names.

    Facts are the `measured_share` of an edge or a force that comes
    from reliable wavelengths, `side`, `start` and `end` of extrapolated roughness, and the number
    of `tests` of a measured force.
    """

    fact: Number
    about: dict[str, Any]


def with_reason(fact: Number, source: xr.DataArray) -> Number:
    """Return a number; if it has no interval, its status says why.

    The source of intervals is that of the dataset: "none" if every contact feels the whole scan,
    "few_places" if contacts touch too few places.
    """
    if np.isfinite([fact.low, fact.high]).any() or fact.status not in ("", "not_bounded"):
        return fact
    reasons = {"none": "whole_scan", "few_places": "few_places"}
    return fact._replace(status=reasons.get(source.item(), "few_parts"))


def differing_sides(data: xr.Dataset) -> list[str]:
    """Return the sides on which extrapolated roughness changes the force beyond its interval."""
    return [side for side in SIDES if data["extrapolation_matters"].sel(side=side).item() == 1]


def extrapolated_wavelengths(force: xr.Dataset, side: str) -> dict[str, Any]:
    """Return the wavelengths between which roughness is extrapolated at one side."""
    side_force = force.sel(side=side)
    start = number_of(side_force, "transition", "nm", name="start", strict=False)
    end = number_of(side_force, "extrapolation_end", "nm", name="end", strict=False)
    return {"side": side, "start": start, "end": end}


def extrapolated_fact(
    data: xr.Dataset,
    side: str,
    spectra: xr.Dataset,
    variable: str = "extrapolated_force",
    name: str = "force_extrapolated",
) -> Number:
    """Return the force, or the work of adhesion, with roughness extrapolated at one side.

    At the small side it has no value if the scans do not tell how the spectrum goes on.
    """
    side_data = data.sel(side=side)
    fact = number_of(side_data, variable, name=name, source="extrapolated", strict=False)
    if side == "small" and spectra["tail_known"].item() != 1:
        return Number(name, np.nan, fact.unit, status="no_exponent", source=fact.source)
    return fact


def force_rows(data: Datasets) -> list[AnswerRow]:
    """Return the predicted forces of one surface at the configured range, and the smooth limit."""
    force = data.force
    forces = forces_at_range(data.force)
    quantiles = forces["force_quantile"]
    lowest, median, highest = quantiles.sel(quantile=[0, 0.5, 1], method="nearest").values.tolist()
    smooth = 2 * np.pi * 1e-9 * force.attrs["sphere_radius"] * force.attrs["work_of_adhesion"]
    sources = force["extrapolated_force_interval_source"]
    extrapolated_rows = []
    for side in differing_sides(force):
        fact = with_reason(extrapolated_fact(force, side, data.spectra), sources.sel(side=side))
        extrapolated_rows.append(AnswerRow(fact, extrapolated_wavelengths(force, side)))
    share = Number("share", float(np.ptp(quantiles["quantile"].values)))
    mean = number_of(forces, "force", name="force_mean", strict=False)
    bounded = np.nanmax([mean.value, mean.high]) >= forces["smooth_bound"].item()
    about = {"model": preferred_model(force), "bounded": bool(bounded)} | _origin_of_force(data)
    return [
        AnswerRow(with_reason(mean, force["interval_source"]), about),
        *extrapolated_rows,
        AnswerRow(Number("force_median", median, "N"), {}),
        AnswerRow(bounds_only("force_middle", lowest, highest, "N"), {"share": share}),
        AnswerRow(Number("smooth_sphere", float(smooth), "N"), {}),
        AnswerRow(number_of(force, "log_force_std", "1", name="force_scatter"), _scatter(force)),
        AnswerRow(Number("range_sensitivity", _sensitivity(force)), {}),
    ]


def _scatter(force: xr.Dataset) -> dict[str, Any]:
    """Return the modulus k of a surface, and the number and distance of contacts for a mean."""
    names = ("weibull_modulus", "contacts_needed")
    numbers = {name: number_of(force, name, "1", strict=False) for name in names}
    return numbers | {"search_size": number_of(force, "search_size", "nm")}


def _origin_of_force(data: Datasets) -> dict[str, Any]:
    """Return the share of the decrease of the force that reliable wavelengths cause, its origin.

    The force decreases from that of a smooth sphere. The origin is "measured" if artificial
    wavelengths change the force by no more than the tolerance.
    """
    parts = parts_of_change(data, "small")
    share = reliable_share(parts)
    origin = "artificial" if share < 1 - NEARLY_ALL else "partly_artificial"
    if parts[1] <= np.log1p(data.edges.attrs["tolerance"]):
        origin = "measured"
    return {"change": Number("measured_share", share), "origin": origin}


def _sensitivity(force: xr.Dataset) -> float:
    """Return d ln F/d ln rho at the configured range, NaN if no other range was computed."""
    model_forces = force.sel(contact_model=preferred_model(force))
    rho = np.log(model_forces["rho"].values)
    forces = np.log(model_forces["force"].values)
    if len(rho) < 2:
        return np.nan
    nearest = np.abs(rho - np.log(force.attrs["range_of_adhesion"])).argmin()
    return float(np.gradient(forces, rho)[nearest])


def pair_rows(force: xr.Dataset, pairs: Sequence[Mapping[str, Any]]) -> list[AnswerRow]:
    """Return the force of one surface at other pairs of range and work of adhesion.

    A pair is a row of resources/adhesion/pairs.csv. The logarithm of the force is interpolated over
    the logarithm of the range; beyond the computed ranges a force is "not_computed". The configured
    pair has no row.
    """
    configured = force.attrs["range_of_adhesion"], force.attrs["work_of_adhesion"]
    model_forces = force.sel(contact_model=preferred_model(force))
    rows = []
    ranges = np.log(model_forces["rho"].values)
    forces = np.log(model_forces["force"].values)
    for pair in pairs:
        rho, work = pair["range_of_adhesion_nm"], pair["work_of_adhesion_J_m2"]
        if np.allclose(configured, (rho, work), rtol=1e-6):
            continue
        value = np.interp(np.log(rho), ranges, forces, np.nan, np.nan)
        pair_force = float(np.exp(value) * work / configured[1])
        status = "not_computed" if np.isnan(pair_force) else ""
        about = {
            "pair": pair["pair"],
            "range": Number("range", rho, "nm"),
            "work": Number("work", work, "J m-2"),
            "share": Number("share", pair["share_of_sets"]),
        }
        rows.append(AnswerRow(Number("force_of_pair", pair_force, "N", status=status), about))
    return rows


def preferred_fit(fit: xr.Dataset) -> xr.Dataset:
    """Return the fit of the preferred contact model."""
    return fit.sel(contact_model=preferred_model(fit))


def measured_rows(fit: xr.Dataset, spectra: xr.Dataset) -> list[AnswerRow]:
    """Return the force measured on one surface, and the works of adhesion that fit it.

    Both datasets hold this surface alone.
    """
    fit_at_range = fit.sel(rho_fine=fit.attrs["assumed_range"], method="nearest")
    force = number_of(fit, "measured_force", source="measured", strict=False)
    lopsided = np.log(force.high / force.value) > MAX_LOPSIDEDNESS * np.log(force.value / force.low)
    work = number_of(
        fit_at_range, "work_by_range", name="measured_work", source="from_measured", strict=False
    )
    rows = [
        AnswerRow(force, {"tests": int(fit["test_count"].item()), "lopsided": bool(lopsided)}),
        AnswerRow(work, {"beyond_solids": work.value > STRONGEST_WORK}),
    ]
    for side in differing_sides(fit):
        start = number_of(fit.sel(side=side), "transition", name="start")
        work = extrapolated_fact(fit, side, spectra, "extrapolated_work", "extrapolated_work")
        rows.append(AnswerRow(work, {"side": side, "start": start}))
    return rows


def fit_facts(fit: xr.Dataset) -> dict[str, Any]:
    """Return which ranges and works of adhesion agree with all measured forces, as facts.

    The fit is the part of fit.nc for one contact model. `status` is "one_surface", "no_interval" (a
    surface has none, so there is no region), "none" (no pair agrees with all forces) or "region".
    `exact_pairs` counts the pairs that give the forces of two surfaces by construction.
    `best_range`, `best_work`, `best_error`, `region_range` and `region_work` are numbers. `gaps`
    are pairs of ranges (nm) between which the region has a gap. `allows_range` is whether the
    region contains the `range` of the predicted forces.
    """
    allowed = np.isfinite(fit["region"].values).all(axis=-1)
    status = "region" if allowed.any() else "none"
    if fit["work_by_range_interval"].isnull().any():
        status = "no_interval"
    if fit.sizes["surface"] == 1:
        status = "one_surface"
    best = {
        "best_range": Number("best_range", fit["range_of_adhesion"].item(), "nm"),
        "best_work": Number("best_work", fit["work_of_adhesion"].item(), "J m-2"),
        "best_error": Number("best_error", fit["best_error"].item()),
    }
    numbers = {}
    for name, unit in {"region_range": "nm", "region_work": "J m-2"}.items():
        low, high = fit[name].values.tolist()
        numbers[name] = bounds_only(name, low, high, unit)
    rho = fit["rho_fine"].values
    configured_range = fit.attrs["assumed_range"]
    return (
        best
        | numbers
        | {
            "status": status,
            "exact_pairs": int(fit["exact_pairs"].item()),
            "gaps": _gaps(rho, allowed),
            "range": Number("range", configured_range, "nm"),
            "allows_range": bool(allowed[np.abs(rho - configured_range).argmin()]),
        }
    )


def _gaps(rho: np.ndarray, allowed: np.ndarray) -> list[list[float]]:
    """Return the pairs of ranges (nm) that bound the gaps of a region."""
    change = np.diff(allowed.astype(int))
    ends = np.flatnonzero(change == -1)
    begins = np.flatnonzero(change == 1) + 1
    begins = begins[begins > ends[0]] if len(ends) else begins[:0]
    return [[float(rho[end]), float(rho[begin])] for end, begin in zip(ends, begins, strict=False)]
