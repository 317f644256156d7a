"""The facts of the answer of own surfaces: its edges, its forces, and what they were made from."""

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from hardcontact.answer.artificial import (
    NEARLY_ALL,
    artificial_bands,
    measurements,
    parts_of_change,
    place_of_edge,
    reliable_share,
    share_at_edge,
    share_inside,
    single,
)
from hardcontact.answer.datasets import Datasets, Setting, at_range, model_of
from hardcontact.answer.facts import bare, between, ends, number_of
from hardcontact.numbers.number import Number
from hardcontact.surfaces.synthesis import SIDES

EDGES = dict(zip(SIDES, ("short_edge", "long_edge"), strict=True))
#: What an edge comes from, by its place among artificial wavelengths.
SOURCES = {
    "inside": "artificial",
    "partly": "partly_artificial",
    "interval": "interval_artificial",
    "outside": "measured",
}
#: The upper end of an interval is called open where it lies this many times farther, in the
#: logarithm, than the lower one: the scatter of few tests may be much larger than it appears.
LOPSIDED = 2.0
#: J/m², to part diamond along (111): no known solids adhere more strongly. Source: J. E. Field, The
#: Properties of Diamond (Academic Press, 1979).
STRONGEST = 10.6
#: Endings of the names of surfaces that are described by the quartiles of a source.
QUARTILES = ("_lower", "_upper")


class Row(NamedTuple):
    """A row of the table of an answer: a number whose name and source are codes.

    What else is known of it is `reason` of an open edge, `change`, the share of an edge or a force
    that comes from reliable wavelengths, `side`, `start` and `end` of continued roughness, `tests`
    of a measured force.
    """

    fact: Number
    about: dict[str, Any]


def edge_fact(of_side: xr.Dataset, name: str, source: str = "computed", prefix: str = "") -> Number:
    """Return the edge at one side in nm, or the bound of an open one, with the ends that are known.

    `of_side` is the part of edges.nc at one side, of one surface or, with the prefix "pooled_" of
    its variables, of all. An interval without ends is "not_bounded" if force ratios have intervals.
    """
    edge, bound = (of_side[f"{prefix}{part}"].item() for part in ("edge", "edge_bound"))
    low, high = ends(of_side, f"{prefix}edge")
    if np.isnan(edge):
        status = "open_above" if of_side[f"{prefix}edge_at_least"].item() else "open_below"
        return Number(name, bound, "nm", low, high, status, source)
    scatter = of_side["pooled_change_interval" if prefix else "scale_ratio_interval"]
    endless = not np.isfinite([low, high]).any() and np.isfinite(scatter).any()
    return Number(name, edge, "nm", low, high, "not_bounded" if endless else "", source)


def _with_reason(fact: Number, source: str) -> Number:
    """Return a number whose interval has no ends with the reason for that as its status.

    The source of the interval is that of the dataset: "none" if every contact feels all of a scan.
    """
    if np.isfinite([fact.low, fact.high]).any() or fact.status not in ("", "not_bounded"):
        return fact
    return fact._replace(status="whole_scan" if source == "none" else "few_parts")


def resolves_nothing(edges: xr.Dataset) -> bool:
    """Return whether the force of a surface changes at no cutoff, from either side.

    It is that on a smooth sphere then, and both edges are open the wrong way.
    """
    codes = [edge_fact(edges.sel(side=side), name).status for side, name in EDGES.items()]
    return codes == ["open_above", "open_below"]


def edge_rows(of: Datasets) -> list[Row]:
    """Return the edges of one surface, with those ends of intervals that scans are reliable at."""
    if resolves_nothing(of.edges):
        return [Row(Number(name, np.nan, "nm", status="no_edge"), {}) for name in EDGES.values()]
    rows, bands = [], artificial_bands(of.spectra)
    source = str(of.edges["interval_source"].item())
    for side, of_side in ((side, of.edges.sel(side=side)) for side in SIDES):
        edge = edge_fact(of_side, EDGES[side], SOURCES[place_of_edge(of, side)])
        low, high = (
            np.nan if edge.source == "artificial" or share_inside(end, end, bands) else end
            for end in (edge.low, edge.high)
        )
        if np.isfinite([edge.low, edge.high]).any() and not np.isfinite([low, high]).any():
            edge = edge._replace(status=edge.status or "no_interval")
        edge = _with_reason(edge._replace(low=low, high=high), source)
        change = Number("change", share_at_edge(of, side))
        rows.append(Row(edge, {"reason": str(of_side["edge_status"].item()), "change": change}))
    return rows


def differing_sides(data: xr.Dataset) -> list[str]:
    """Return the sides on which continued roughness changes the force beyond its interval."""
    return [side for side in SIDES if data["continued_differs"].sel(side=side).item() == 1]


def continuation(force: xr.Dataset, side: str) -> dict[str, Any]:
    """Return between which wavelengths roughness continues that of the scans at one side."""
    of_side = force.sel(side=side)
    start, end = (
        number_of(of_side, variable, "nm", name=name, strict=False)
        for name, variable in (("start", "transition"), ("end", "continued_end"))
    )
    return {"side": side, "start": start, "end": end}


def continued_fact(
    data: xr.Dataset, side: str, variable: str = "continued_force", name: str = "force_continued"
) -> Number:
    """Return the force, or the work of adhesion, with roughness continued at one side."""
    of_side = data.sel(side=side)
    return number_of(of_side, variable, name=name, source="extrapolated", strict=False)


def force_rows(of: Datasets) -> list[Row]:
    """Return the predicted forces of one surface at the range asked for, and the smooth limit."""
    force, here = of.force, at_range(of.force)
    quantiles = here["force_quantile"]
    least, median, most = (
        quantiles.sel(quantile=share, method="nearest").item() for share in (0, 0.5, 1)
    )
    radius, work = (force.attrs[name] for name in ("sphere_radius", "work_of_adhesion"))
    smooth = 2 * np.pi * 1e-9 * radius * work
    continued = [
        Row(
            _with_reason(
                continued_fact(force, side), str(force["continued_source"].sel(side=side).item())
            ),
            continuation(force, side),
        )
        for side in differing_sides(force)
    ]
    share = Number("share", float(np.ptp(quantiles["quantile"].values)))
    mean = number_of(here, "force", name="force_mean", strict=False)
    bounded = np.nanmax([mean.value, mean.high]) >= here["smooth_bound"].item()
    about = {"model": model_of(force), "bounded": bool(bounded)} | _origin_of_force(of)
    return [
        Row(_with_reason(mean, str(force["interval_source"].item())), about),
        Row(Number("force_median", median, "N"), {}),
        *continued,
        Row(between("force_middle", least, most, "N"), {"share": share}),
        Row(Number("smooth_sphere", float(smooth), "N"), {}),
        Row(Number("range_sensitivity", _sensitivity(force)), {}),
    ]


def _origin_of_force(of: Datasets) -> dict[str, Any]:
    """Return the share of the fall of the force from a smooth sphere that is reliable, and a code.

    The fall is measured if artificial wavelengths change the force by no more than the tolerance.
    """
    parts = parts_of_change(of, "small")
    share = reliable_share(parts)
    origin = "artificial" if share < 1 - NEARLY_ALL else "partly_artificial"
    if parts[1] <= np.log1p(of.edges.attrs["tolerance"]):
        origin = "measured"
    return {"change": Number("change", share), "origin": origin}


def _sensitivity(force: xr.Dataset) -> float:
    """Return d ln F/d ln rho at the range asked for, NaN if no other was computed."""
    of_model = force.sel(contact_model=model_of(force))
    rho, forces = np.log(of_model["rho"].values), np.log(of_model["force"].values)
    if len(rho) < 2:
        return np.nan
    asked = np.abs(rho - np.log(force.attrs["range_of_adhesion"])).argmin()
    return float(np.gradient(forces, rho)[asked])


def pair_rows(force: xr.Dataset, pairs: Sequence[Mapping[str, Any]]) -> list[Row]:
    """Return the force of one surface at other pairs of range and work of adhesion.

    A pair is a row of resources/adhesion/pairs.csv. Forces are interpolated between the ranges
    computed, in logarithms; beyond them a force is "not_computed". The pair asked for has no row.
    """
    asked = force.attrs["range_of_adhesion"], force.attrs["work_of_adhesion"]
    of_model, rows = force.sel(contact_model=model_of(force)), []
    ranges, forces = np.log(of_model["rho"].values), np.log(of_model["force"].values)
    for pair in pairs:
        rho, work = pair["range_of_adhesion_nm"], pair["work_of_adhesion_J_m2"]
        if np.allclose(asked, (rho, work), rtol=1e-6):
            continue
        value = np.interp(np.log(rho), ranges, forces, np.nan, np.nan)
        newton = float(np.exp(value) * work / asked[1])
        status = "not_computed" if np.isnan(newton) else ""
        about = {
            "pair": pair["pair"],
            "range": Number("range", rho, "nm"),
            "work": Number("work", work, "J m-2"),
            "share": Number("share", pair["share_of_sets"]),
        }
        rows.append(Row(Number("force_of_pair", newton, "N", status=status), about))
    return rows


def of_answer(fit: xr.Dataset) -> xr.Dataset:
    """Return the fit of the contact model of the answer."""
    return fit.sel(contact_model=model_of(fit))


def measured_rows(fit: xr.Dataset) -> list[Row]:
    """Return the force measured on one surface, and what works of adhesion it means."""
    here = fit.sel(rho=fit.attrs["range_of_adhesion"], method="nearest")
    force = number_of(fit, "measured_force", source="measured", strict=False)
    lopsided = np.log(force.high / force.value) > LOPSIDED * np.log(force.value / force.low)
    work = number_of(
        here, "work_of_adhesion", name="measured_work", source="from_measured", strict=False
    )
    rows = [
        Row(force, {"tests": int(fit["tests"].item()), "lopsided": bool(lopsided)}),
        Row(work, {"beyond_solids": work.value > STRONGEST}),
    ]
    for side in differing_sides(fit):
        start = number_of(fit.sel(side=side), "transition", name="start")
        continued = continued_fact(fit, side, "continued_work", "continued_work")
        rows.append(Row(continued, {"side": side, "start": start}))
    return rows


def answer_rows(of: Datasets, pairs: Sequence[Mapping[str, Any]] = ()) -> list[Row]:
    """Return the rows of one surface: its edges, its forces and, if it has any, its own forces.

    Forces are told at the `pairs` of range and work of adhesion too, as in `pair_rows`.
    """
    surface = str(of.edges["surface"].item())
    own = []
    if of.fit is not None and surface in of.fit["surface"].values:
        own = measured_rows(of_answer(of.fit).sel(surface=surface))
    return [*edge_rows(of), *force_rows(of), *pair_rows(of.force, pairs), *own]


def pooled_rows(edges: xr.Dataset) -> list[Row]:
    """Return the edges of the mean change over several surfaces, none of a single one."""
    if "pooled_edge" not in edges:
        return []
    return [
        Row(edge_fact(edges.sel(side=side), f"pooled_{EDGES[side]}", prefix="pooled_"), {})
        for side in SIDES
    ]


def _by_value(numbers: Sequence[Number]) -> list[Number]:
    """Return numbers from the least to the greatest; one without a value counts as zero."""
    return sorted(numbers, key=lambda one: np.nan_to_num(one.value))


def verdict(rows: Sequence[Row]) -> dict[str, Any]:
    """Return the answer of one surface at a glance, without intervals.

    `answer` is whether its scans can answer: "yes" if both edges, which are no bounds, and the fall
    of the one force from that of a smooth sphere come from wavelengths at which a scan is reliable,
    "no" if none does or there is no band, else "partly". `band` is "none" if nothing that they
    resolve changes the force, "overlapping" if the short edge is the longer one, else "found".
    `edges` are the short and the long one, `forces` the least and the greatest, the same where the
    scans say all.
    """
    facts = [bare(row.fact) for row in rows]
    forces = _by_value([one for one in facts if one.name in ("force_mean", "force_continued")])
    edges = [one for one in facts if one.name in EDGES.values()]
    short, long = edges
    origins = {row.about["origin"] for row in rows if "origin" in row.about}
    origins |= {one.source for one in edges}
    settled = not any(one.status for one in edges) and len(forces) == 1
    band = "overlapping" if short.value >= long.value else "found"
    answer = "yes" if origins == {"measured"} and settled else "partly"
    if np.isnan(short.value):
        band = "none"
    if band == "none" or origins == {"artificial"}:
        answer = "no"
    return {"answer": answer, "band": band, "edges": edges, "forces": [forces[0], forces[-1]]}


class Span(NamedTuple):
    """A quantity of a surface and how far it differs over the quartiles of its source."""

    surface: str  #: Its label.
    fact: Number  #: Of the median, without an interval.
    least: Number  #: Of the median and both quartiles.
    most: Number  #: The same.
    intervals: Number  #: The span of all their intervals; unknown where one of them is.


def surfaces_with_quartiles(given: Datasets) -> dict[str, list[str]]:
    """Return, by surface, itself and both quartiles; only substitutes have quartiles.

    A surface with the id `x` is described by a median if surfaces `x_lower` and `x_upper` stand
    beside it, described by the quartiles of the same source. How far these lie apart is how far
    measurements of one surface differ between laboratories, which no number of realizations shows.
    """
    ids = given.topography["surface"].values[given.topography["basis"].values == "substitute"]
    groups = {name: [name, *(name + ending for ending in QUARTILES)] for name in map(str, ids)}
    return {name: group for name, group in groups.items() if groups.keys() >= set(group)}


def quartile_spans(given: Datasets) -> list[Span]:
    """Return the spans of both edges and of the force of each surface with quartiles."""
    labels, spans = given.labels(), []
    for name, group in surfaces_with_quartiles(given).items():
        edges, force = (part.sel(surface=group) for part in (given.edges, at_range(given.force)))
        for side, of_side in ((side, edges.sel(side=side)) for side in EDGES):
            facts = [edge_fact(of_side.sel(surface=one), EDGES[side]) for one in group]
            spans.append(_span(labels[name], facts, of_side["edge_interval"]))
        forces = [number_of(force.sel(surface=one), "force", name="force_mean") for one in group]
        spans.append(_span(labels[name], forces, force["force_interval"]))
    return spans


def _span(label: str, facts: Sequence[Number], intervals: xr.DataArray) -> Span:
    """Return the span of facts, and that of their intervals (surface, bound).

    An end of the latter is bounded if that of every interval is: zero and infinity bound nothing.
    """
    bounded = intervals.where((intervals > 0) & np.isfinite(intervals))
    low, high = bounded.min("surface", skipna=False), bounded.max("surface", skipna=False)
    low, high = low.sel(bound="low").item(), high.sel(bound="high").item()
    known = [bare(one) for one in facts]
    least, *_, most = _by_value(known)
    whole = between("intervals", low, high, facts[0].unit, "not_bounded")
    return Span(label, known[0], least, most, whole)


def contact_inputs(setting: Setting) -> list[dict[str, str]]:
    """Return what contacts were computed for, as printed, and whether the user gave it."""
    return [
        {"name": name, "text": text, "source": _source(name, text, setting.of_paper)}
        for name, text in setting.contact.items()
    ]


def _source(name: str, text: str, of_paper: Sequence[str]) -> str:
    if name == "sphere":
        return "assumed" if text == "smooth" else "file"
    return "assumed" if name in of_paper else "given"


def scan_inputs(spectra: xr.Dataset) -> list[dict[str, Any]]:
    """Return the measurements of one surface: those alike are counted together."""
    names = ("size", "pixel_size", "tip_radius")
    alike = Counter(
        # What is not a number would not equal itself.
        (str(one["kind"].item()), *(np.nan_to_num(one[name].item()) for name in names))
        for one in single(measurements(spectra))
    )
    return [
        {"kind": kind, "count": count}
        | {
            name: Number(name, value or np.nan, "nm", source="file")
            for name, value in zip(names, values, strict=True)
        }
        for (kind, *values), count in alike.items()
    ]


def fit_facts(fit: xr.Dataset) -> dict[str, Any]:
    """Return what the forces measured on several surfaces allow together, as a status and facts.

    The fit is a part of fit.nc of one contact model. `status` is "one_surface", "no_interval" (of a
    surface, so that there is no region), "none" (no pair agrees with all forces) or "region";
    `best_range`, `best_work`, `best_error`, `region_range` and `region_work` are numbers, `gaps`
    pairs of ranges (nm) between which the region has none.
    """
    allowed = np.isfinite(fit["region"].values).all(axis=-1)
    status = "region" if allowed.any() else "none"
    if fit["work_of_adhesion_interval"].isnull().any():
        status = "no_interval"
    if fit.sizes["surface"] == 1:
        status = "one_surface"
    units = {"best_range": "nm", "best_work": "J m-2", "best_error": "1"}
    found = {name: Number(name, fit[name].item(), unit) for name, unit in units.items()}
    for name, unit in {"region_range": "nm", "region_work": "J m-2"}.items():
        low, high = fit[name].values.tolist()
        found[name] = between(name, low, high, unit)
    return {"status": status, "gaps": _gaps(fit["rho"].values, allowed)} | found


def _gaps(rho: np.ndarray, allowed: np.ndarray) -> list[list[float]]:
    """Return the pairs of ranges between which a region has gaps."""
    change = np.diff(allowed.astype(int))
    ends, begins = np.flatnonzero(change == -1), np.flatnonzero(change == 1) + 1
    begins = begins[begins > ends[0]] if len(ends) else begins[:0]
    return [[float(rho[end]), float(rho[begin])] for end, begin in zip(ends, begins, strict=False)]
