"""Numbers of the page on what decides the band: the band, scaling, size of scans, closed form.

Every function returns what a template shows of one question: `rows` of facts and codes for a table,
and what is said of all of them. Codes have their words in the template.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.answer.facts import (
    Cells,
    against,
    between,
    count,
    ends,
    number,
    number_of,
    on_scans,
    percent,
    span,
    surfaces,
)
from hardcontact.insight.closed_form import MANY_POINTS, SINGLE_PEAKS, SMOOTH, at_transition
from hardcontact.insight.edge_scaling import (
    CLOSED_FORM,
    COMPUTED,
    FORMULA,
    LENGTHS,
)
from hardcontact.numbers.number import Number
from hardcontact.numbers.printing import is_boundless
from hardcontact.numbers.statistics import bounds
from hardcontact.scales.critical_band import POOLED
from hardcontact.surfaces.synthesis import SIDES

#: Forces divided by what the rule says, and as they are.
KINDS = ("corrected", "uncorrected")

#: A regime of the closed form beside those of `closed_form`.
AT_TRANSITION = "transition"

#: Factor between a predicted and a computed edge from which on the prediction is wrong.
MAX_ERROR_FACTOR = 2.0


def band_facts(band: xr.Dataset, constants: pd.DataFrame) -> dict[str, Any]:
    """Return the edges of every substrate, of their mean, and those of the paper."""
    published = {
        name: Number(name, float(constants["value"][name]), "nm", source="given")
        for name in ("critical_wavelength_small", "critical_wavelength_large", "range_of_adhesion")
    }
    rows = [row | _band_edges(band.sel(group=one["surface"].item())) for row, one in surfaces(band)]
    rows.append({"surface": "", "basis": POOLED} | _band_edges(band.sel(group=POOLED)))
    edges = {side: published[f"critical_wavelength_{side}"] for side in SIDES}
    rows.append({"surface": "", "basis": "published"} | edges)
    return {"rows": rows, "range": published["range_of_adhesion"]}


def _band_edges(of_group: xr.Dataset) -> Cells:
    return {
        side: number_of(of_group.sel(side=side), "critical_wavelength", "nm", "no_edge")
        for side in SIDES
    }


def scaling_facts(scaling: xr.Dataset) -> dict[str, Any]:
    """Return local exponents of both edges, and how far the formulas are off."""
    low, high = bounds(scaling, "exponent")
    changes = (low > 0) | (high < 0)
    # An interval that holds 1 as well as 0 does not decide.
    undecided = (~((low <= 0) & (high < 1)) & ~changes).any()
    return {
        "verdict": "changes" if changes.any() else "open" if undecided else "not_seen",
        "counts": {
            side: [int(changes.sel(side=side, length=one).sum()) for one in LENGTHS]
            for side in SIDES
        },
        "surfaces": scaling.sizes["surface"],
        "rows": [
            row | {"edge": side} | _local_exponents(one.sel(side=side), scaling.attrs)
            for row, one in surfaces(scaling)
            for side in SIDES
        ],
        "errors": list(_edge_errors(scaling)),
        "tolerance": percent(Number("tolerance", scaling.attrs["tolerance"])),
    }


def _local_exponents(edge: xr.Dataset, place: dict[str, float]) -> Cells:
    """Return the exponents of one edge of one surface at both sides of the paper's combination."""
    axes = {"radius": place["sphere_radius"], "rho": place["rho"], "area": place["area"]}
    row: Cells = {}
    for length, axis in LENGTHS.items():
        others = {name: value for name, value in axes.items() if name != axis}
        along = edge.sel(length=length).sel(others, method="nearest")
        middle = int(abs(along[axis].values - axes[axis]).argmin())
        beside = along.isel({axis: slice(middle, middle + 2)})
        value, bound = beside["local_exponent"], beside["local_bound"]
        row[length] = _both(value.sel(origin=COMPUTED).values, bound.values)
        row[f"{length}_formula"] = _both(value.sel(origin=FORMULA).values, 0 * bound.values)
    return row


def _both(values: np.ndarray, bound: np.ndarray) -> Number:
    """Return the least and the greatest of known values; 1 marks one that is at least that."""
    known = np.isfinite(values)
    low = np.where(bound < 0, -np.inf, values)[known].min(initial=np.inf)
    high = np.where(bound > 0, np.inf, values)[known].max(initial=-np.inf)
    # Hundredths: what is far below them is no dependence.
    return between("local_exponent", round(low, 2) + 0.0, round(high, 2) + 0.0)


def _edge_errors(scaling: xr.Dataset) -> Iterator[Cells]:
    """Yield how far edges of designed surfaces that were held back are off, by regime."""
    held_back = scaling.sel(designed=scaling["held_back"] == 1)
    modulus = held_back["designed_level"] / held_back["designed_over_range"]
    many = modulus > 1
    for side in SIDES:
        for regime, chosen in ((MANY_POINTS, many), (SINGLE_PEAKS, ~many)):
            found = held_back["designed_bound"].sel(side=side) == 0
            errors = held_back["designed_error"].sel(side=side, designed=chosen & found)
            wrong = np.abs(np.log(errors.sel(prediction=FORMULA))) > np.log(MAX_ERROR_FACTOR)
            last = modulus.where(wrong).max().item()
            row: Cells = {
                "edge": side,
                "regime": regime,
                "wrong": number("wrong", last, "1", "none"),
            }
            for prediction in (FORMULA, CLOSED_FORM):
                known = errors.sel(prediction=prediction).dropna("designed")
                low, median, high = known.quantile([0.05, 0.5, 0.95]).values
                row[prediction] = Number("error", median, "1", low, high)
            yield row | {"surfaces": Number("surfaces", known.size)}


def scan_size_facts(scan_size: xr.Dataset) -> dict[str, Any]:
    """Return forces and long edges on small scans, the sizes needed, and the rule for these."""
    at_range = scan_size.sel(rho=scan_size.attrs["rho"], method="nearest")
    rows = [row | _sizes(one) for row, one in surfaces(at_range)]
    spans = [row["from_scan"].high / row["from_scan"].low for row in rows]
    allowed = scan_size.attrs["allowed_excess"] - 1
    errors = {
        tested: {
            kind: Number(kind, np.exp(scan_size["error"].sel(tested=tested, kind=kind).item()))
            for kind in KINDS
        }
        for tested in scan_size["tested"].values.tolist()
    }
    smallest = scan_size.isel(scan_size=0)
    trends = [smallest[one].isel(rho=-1) - smallest[one].isel(rho=0)
              for one in ("excess", "predicted_excess")]  # fmt: skip
    powers = zip(scan_size["ratio"].values.tolist(), scan_size["exponent"].values, strict=True)
    return {
        "rows": rows,
        "size": number_of(on_scans(scan_size), "edge_size", "nm"),
        "whole": number_of(scan_size.isel(edge_size=-1), "edge_size", "nm"),
        "range": Number("range", scan_size.attrs["rho"], "nm"),
        "sphere": Number("sphere", scan_size.attrs["sphere_radius"], "nm"),
        "smaller": number_of(scan_size.isel(edge_size=-2), "edge_size", "nm"),
        "allowed": percent(Number("allowed", allowed)),
        "needed": span("needed", at_range["size_needed"].values, "nm"),
        "rough": errors["surfaces"]["corrected"].value - 1 > allowed,
        "differ": count(rows, "edges_say", "differ"),
        "widest": Number("widest", float(np.fmax.reduce(spans, initial=np.nan))),
        "strength": number_of(scan_size, "strength"),
        "exponents": [(ratio, Number("exponent", power)) for ratio, power in powers],
        "errors": errors,
        "against": int((trends[0] * trends[1] < 0).sum()),
    }


def _sizes(one: xr.Dataset) -> Cells:
    """Return forces and long edges of a surface, on scans and on large surfaces, and sizes needed.

    A window whose interval lies above the allowed excess is too small; one below it is enough.
    """
    windows = one.sel(edge_size=one["mirrored"] == 1)
    low, high = bounds(windows, "force_over_largest")
    sizes, allowed = windows["edge_size"], one.attrs["allowed_excess"]
    above = sizes.where(low > allowed).max().item()
    enough = sizes.where(high < allowed).min().item()
    needed = one["size_needed"].item()
    from_scan, smaller, whole = on_scans(one), one.isel(edge_size=-2), one.isel(edge_size=-1)
    low_of_scan, high_of_scan = ends(from_scan, "long_edge")
    low_of_whole, high_of_whole = ends(whole, "long_edge")
    differ = low_of_scan > high_of_whole or high_of_scan < low_of_whole
    return {
        "force": number_of(from_scan, "force_over_largest"),
        "force_says": against(1, from_scan, "force_over_largest"),
        "smaller": number_of(smaller, "force_over_largest"),
        "smaller_says": against(1, smaller, "force_over_largest"),
        "needed": Number("needed", needed, "nm"),
        "needed_says": "refuted" if needed <= above or needed > enough else "none",
        "asked": between("asked", above, enough, "nm"),
        "from_scan": _long_edge(from_scan),
        "from_whole": _long_edge(whole),
        "edges_say": "differ" if differ else "alike",
    }


def _long_edge(of_size: xr.Dataset) -> Number:
    """Return a long edge, or the bound on one that is open."""
    bound = of_size["long_edge_bound"].item()
    if np.isfinite(of_size["long_edge"]) or np.isnan(bound):
        return number_of(of_size, "long_edge", "nm", "no_edge")
    status = "open_above" if of_size["long_edge_at_least"] else "open_below"
    return Number("long_edge", bound, "nm", status=status)


def closed_form_facts(closed_form: xr.Dataset, band: xr.Dataset) -> dict[str, Any]:
    """Return how far the closed form is off, in which regime surfaces are, and its edges."""
    largest = closed_form.isel(map_size=-1).sel(source="spectrum")
    errors = np.abs(np.log(largest["error"].values))
    rho = closed_form.attrs["range_of_adhesion"]
    rows = []
    for (row, one), of_surface in zip(surfaces(largest), errors, strict=True):
        farthest = one.isel(rho=int(of_surface.argmax()))
        row |= {"farthest": _ratio(farthest), "farthest_at": number_of(farthest, "rho", "nm")}
        edges = _predicted_edges(one, band.sel(group=one["surface"].item()))
        rows.append(row | _regime(one.sel(rho=rho)) | edges)
    return {
        "rows": rows,
        "within": {side: count(rows, f"{side}_says", "within") for side in SIDES},
        "half": Number("half", np.exp(np.median(errors))),
        "cases": errors.size,
        "ranges": span("ranges", largest["rho"], "nm"),
        "size": number_of(largest, "map_size", "nm"),
        "first_term": span("first_term", largest["first_term_force"] / largest["computed_force"]),
        "range": Number("range", rho, "nm"),
    }


def _ratio(case: xr.Dataset) -> Number:
    """Return the closed form over one computed force, with the interval of that."""
    error = case["error"].item()
    # The longer of both ends of the force gives the smaller ratio.
    high, low = (case["predicted_force"].item() / end for end in ends(case, "computed_force"))
    if is_boundless(error, low, high, "1"):
        return Number("error", error, status="not_bounded")
    return Number("error", error, low=low, high=high)


def _regime(one: xr.Dataset) -> Cells:
    """Return (sigma/rho)/(m/sigma) of a surface with all scales, and the regime it says."""
    # As freezing is σ²/(mρ), of the map, which tells m/σ.
    level = (one["predicted_approach"] / (one["freezing"] * one["rho"])) ** 0.5
    regime = str(one["regime"].item())
    if regime != SMOOTH and at_transition(level * one["whole_freezing"], level):
        regime = AT_TRANSITION
    return {"freezing": Number("freezing", one["whole_freezing"].item()), "regime": regime}


def _predicted_edges(one: xr.Dataset, band: xr.Dataset) -> Cells:
    """Return predicted beside computed edges, and which lie within the interval of the latter."""
    row: Cells = {}
    for side, computed in _band_edges(band).items():
        predicted = number_of(one.sel(side=side), "edge", "nm", "no_edge")
        low, high = ends(band.sel(side=side), "critical_wavelength")
        within = low <= predicted.value <= high
        row |= {f"{side}_predicted": predicted, f"{side}_computed": computed}
        row[f"{side}_says"] = "within" if within else "outside"
    return row
