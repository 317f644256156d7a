"""The facts of the answer of own surfaces: verdict, edges, and what they were made from."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.band.critical_band import computed_cutoffs
from hardcontact.base.number import Number
from hardcontact.report.artificial import (
    artificial_bands,
    place_of_edge,
    reaches,
    share_at_edge,
)
from hardcontact.report.datasets import Datasets
from hardcontact.report.force_facts import (
    Row,
    force_rows,
    measured_rows,
    of_answer,
    pair_rows,
    with_reason,
)
from hardcontact.report.quantities import bare, between, ends
from hardcontact.surfaces.synthesis import SIDES

EDGES = dict(zip(SIDES, ("short_edge", "long_edge"), strict=True))
#: What an edge comes from, by its place among artificial wavelengths.
SOURCES = {
    "inside": "artificial",
    "partly": "partly_artificial",
    "interval": "interval_artificial",
    "outside": "measured",
}


def edge_fact(side_edges: xr.Dataset, name: str, source: str = "computed") -> Number:
    """Return the edge at one side in nm, or the bound of an open one, with the ends that are known.

    `side_edges` is the part of edges.nc at one side of one surface. An interval without ends is
    "not_bounded" if force ratios have intervals.
    """
    edge, bound = side_edges["edge"].item(), side_edges["edge_bound"].item()
    low, high = ends(side_edges, "edge")
    if np.isnan(edge):
        status = "open_above" if side_edges["edge_at_least"].item() else "open_below"
        return Number(name, bound, "nm", low, high, status, source)
    scatter = side_edges["scale_ratio_interval"]
    endless = not np.isfinite([low, high]).any() and np.isfinite(scatter).any()
    return Number(name, edge, "nm", low, high, "not_bounded" if endless else "", source)


def resolves_nothing(edges: xr.Dataset) -> bool:
    """Return whether the force changes at no cutoff, from either side: both edges are bounds then.

    It is the force on a smooth sphere. Edges are of one surface.
    """
    facts = (edge_fact(edges.sel(side=side), name) for side, name in EDGES.items())
    return [fact.status for fact in facts] == ["open_above", "open_below"]


def edge_rows(of: Datasets) -> list[Row]:
    """Return the edges of one surface, with those ends of intervals that scans are reliable at."""
    if resolves_nothing(of.edges):
        return [Row(Number(name, np.nan, "nm", status="no_band"), {}) for name in EDGES.values()]
    rows, bands = [], artificial_bands(of.spectra)
    for side, of_side in ((side, of.edges.sel(side=side)) for side in SIDES):
        edge = edge_fact(of_side, EDGES[side], SOURCES[place_of_edge(of, side)])
        low, high = (
            np.nan if edge.source == "artificial" or reaches(end, end, bands) else end
            for end in (edge.low, edge.high)
        )
        if np.isfinite([edge.low, edge.high]).any() and not np.isfinite([low, high]).any():
            edge = edge._replace(status=edge.status or "no_interval")
        edge = with_reason(edge._replace(low=low, high=high), of.edges["interval_source"])
        about = {
            "reason": str(of_side["edge_status"].item()),
            "measured_share": Number("measured_share", share_at_edge(of, side)),
        }
        if edge.status == "no_interval":
            cutoffs = computed_cutoffs(of_side["scale_ratio"])
            place = np.clip(np.searchsorted(cutoffs, edge.value), 1, len(cutoffs) - 1)
            about["cutoffs"] = between("cutoffs", cutoffs[place - 1], cutoffs[place], "nm")
        rows.append(Row(edge, about))
    return rows


def next_measurements(of: Datasets) -> list[Mapping[str, Any]]:
    """Return what to measure next: one measurement for each edge that is open or extrapolated.

    Each has the name of the ``edge``, a ``code``, "finer" or "larger", and as ``limit`` a
    wavelength (nm): measurements on that side of it would find the edge. The limit is the edge, or
    its bound, or the nearest wavelength beyond it at which no scan is reliable.
    """
    measured_ends = {"short_edge": "shortest_measured", "long_edge": "longest_measured"}
    bands = artificial_bands(of.spectra)
    measurements: list[Mapping[str, Any]] = []
    for edge in (row.fact for row in edge_rows(of)):
        is_open = edge.status in ("open_below", "open_above", "no_band")
        if not is_open and edge.source not in ("artificial", "partly_artificial"):
            continue
        wavelength, finer = edge.value, edge.name == "short_edge"
        if edge.status == "no_band":
            wavelength = float(of.spectra[measured_ends[edge.name]])
        elif is_open:
            finer = edge.status == "open_below"
        if finer:
            _, longest_below = max(band for band in bands if band[0] < wavelength)
            limit = Number("limit", min(wavelength, longest_below), "nm")
        else:
            shortest_above, _ = min(band for band in bands if wavelength < band[1])
            limit = Number("limit", max(wavelength, shortest_above), "nm")
        code = "finer" if finer else "larger"
        measurements.append({"edge": edge.name, "code": code, "limit": limit})
    return measurements


def answer_rows(of: Datasets, pairs: Sequence[Mapping[str, Any]] = ()) -> list[Row]:
    """Return the rows of one surface: its edges, its forces and, if it has any, its own forces.

    Forces are told at the `pairs` of range and work of adhesion too, as in `pair_rows`.
    """
    surface = str(of.edges["surface"].item())
    own = []
    if of.fit is not None and surface in of.fit["surface"].values:
        own = measured_rows(of_answer(of.fit).sel(surface=surface), of.spectra)
    return [*edge_rows(of), *force_rows(of), *pair_rows(of.force, pairs), *own]


def verdict(rows: Sequence[Row]) -> dict[str, Any]:
    """Return the answer of one surface at a glance, without intervals.

    `answer` is whether its scans can answer: "yes" if both edges, which are no bounds, and the fall
    of the one force from that of a smooth sphere come from wavelengths at which a scan is reliable,
    "no" if none does or there is no band, else "partly". `band` is "none" if nothing that they
    resolve changes the force, "overlapping" if the short edge is the longer one, else "found".
    `edges` are the short and the long one, `forces` that on the scans, then those with extrapolated
    roughness where it matters.
    """
    facts = [bare(row.fact) for row in rows]
    forces = [one for one in facts if one.name == "force_mean"]
    forces += [one for one in facts if one.name == "force_continued"]
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
    return {"answer": answer, "band": band, "edges": edges, "forces": forces}
