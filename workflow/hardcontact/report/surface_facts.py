"""The verdict on each own surface, the edges of its band, and what to measure next."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.base.number import Number
from hardcontact.inference.edges import computed_cutoffs
from hardcontact.report.artificial import (
    artificial_bands,
    classify_edge,
    measured_share_at_edge,
    overlaps_any,
)
from hardcontact.report.datasets import Datasets
from hardcontact.report.force_facts import (
    AnswerRow,
    force_rows,
    measured_rows,
    pair_rows,
    preferred_fit,
    with_reason,
)
from hardcontact.report.quantities import bare, bounds_only, ends
from hardcontact.surfaces.synthesis import SIDES

EDGES = dict(zip(SIDES, ("short_edge", "long_edge"), strict=True))
#: Source of an edge by the code of `classify_edge`.
EDGE_SOURCES = {
    "inside": "artificial",
    "partly": "partly_artificial",
    "interval": "interval_artificial",
    "outside": "measured",
}


def edge_fact(side_edges: xr.Dataset, name: str, source: str = "computed") -> Number:
    """Return an edge in nm with its interval, or the bound on an open edge.

    `side_edges` is the part of edges.nc at one side of one surface. The status is "not_bounded" if
    the edge has no interval though the force ratios have.
    """
    edge = side_edges["edge"].item()
    bound = side_edges["edge_bound"].item()
    low, high = ends(side_edges, "edge")
    if np.isnan(edge):
        return Number(name, bound, "nm", low, high, side_edges["edge_status"].item(), source)
    scatter = side_edges["filtered_force_ratio_interval"]
    is_unbounded = not np.isfinite([low, high]).any() and np.isfinite(scatter).any()
    return Number(name, edge, "nm", low, high, "not_bounded" if is_unbounded else "", source)


def resolves_nothing(edges: xr.Dataset) -> bool:
    """Return whether no cutoff changes the force on one surface, so that both edges are bounds.

    The force is then that of a smooth sphere.
    """
    facts = (edge_fact(edges.sel(side=side), name) for side, name in EDGES.items())
    return [fact.status for fact in facts] == ["open_above", "open_below"]


def edge_rows(data: Datasets) -> list[AnswerRow]:
    """Return the edges of one surface; ends of intervals at artificial wavelengths are dropped."""
    if resolves_nothing(data.edges):
        return [
            AnswerRow(Number(name, np.nan, "nm", status="no_band"), {}) for name in EDGES.values()
        ]
    rows = []
    bands = artificial_bands(data.spectra)
    for side in SIDES:
        side_edges = data.edges.sel(side=side)
        edge = edge_fact(side_edges, EDGES[side], EDGE_SOURCES[classify_edge(data, side)])
        low, high = [
            np.nan if edge.source == "artificial" or overlaps_any(end, end, bands) else end
            for end in (edge.low, edge.high)
        ]
        if np.isfinite([edge.low, edge.high]).any() and not np.isfinite([low, high]).any():
            edge = edge._replace(status=edge.status or "no_interval")
        edge = with_reason(edge._replace(low=low, high=high), data.edges["interval_source"])
        about = {
            "measured_share": Number("measured_share", measured_share_at_edge(data, side)),
        }
        if edge.status == "no_interval":
            cutoffs = computed_cutoffs(side_edges["filtered_force_ratio"])
            index = np.clip(np.searchsorted(cutoffs, edge.value), 1, len(cutoffs) - 1)
            about["cutoffs"] = bounds_only("cutoffs", cutoffs[index - 1], cutoffs[index], "nm")
        rows.append(AnswerRow(edge, about))
    return rows


def next_measurements(data: Datasets) -> list[Mapping[str, Any]]:
    """Return one measurement to make next for each edge that is open or extrapolated.

    A measurement has the name of the ``edge``, the ``code`` "finer" or "larger" and a wavelength
    as ``limit`` (nm): scans that are finer, or larger, than the limit would find the edge. The
    limit is the edge, or its bound, or the nearest wavelength beyond it at which no scan is
    reliable.
    """
    measured_ends = {"short_edge": "shortest_measured", "long_edge": "longest_measured"}
    bands = artificial_bands(data.spectra)
    measurements: list[Mapping[str, Any]] = []
    for edge in (row.fact for row in edge_rows(data)):
        is_open = edge.status in ("open_below", "open_above", "no_band")
        if not is_open and edge.source not in ("artificial", "partly_artificial"):
            continue
        wavelength = edge.value
        finer = edge.name == "short_edge"
        if edge.status == "no_band":
            wavelength = float(data.spectra[measured_ends[edge.name]])
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


def answer_rows(data: Datasets, pairs: Sequence[Mapping[str, Any]] = ()) -> list[AnswerRow]:
    """Return the rows of one surface: edges, predicted forces and, if there are any, own forces.

    The `pairs` of range and work of adhesion are those of `pair_rows`.
    """
    surface = str(data.edges["surface"].item())
    measured = []
    if data.fit is not None and surface in data.fit["surface"].values:
        measured = measured_rows(preferred_fit(data.fit).sel(surface=surface), data.spectra)
    return [*edge_rows(data), *force_rows(data), *pair_rows(data.force, pairs), *measured]


def surface_verdict(rows: Sequence[AnswerRow]) -> dict[str, Any]:
    """Return the answer of one surface in short; intervals have both ends.

    `answer` says whether the scans answer the question. It is "yes" if there is one force, neither
    edge is a bound, and all three come from wavelengths at which a scan is reliable. It is "no" if
    none of them does, if contacts touch too few places, or if there is no band. Otherwise it is
    "partly". `band` is "few_places" if contacts touch too few places, "none" if no resolved
    wavelength changes the force, "overlapping" if the short edge is the longer one, and otherwise
    "found". `edges` are the short and the long edge. `forces` are rows, first that of the force on
    the scans; forces with extrapolated roughness follow if they matter and are known.
    """
    short_rows = [
        row
        if np.isfinite([row.fact.low, row.fact.high]).all()
        else row._replace(fact=bare(row.fact))
        for row in rows
    ]
    on_scans = [row for row in short_rows if row.fact.name == "force_mean"]
    extrapolated = [row for row in short_rows if row.fact.name == "force_extrapolated"]
    edges = [row.fact for row in short_rows if row.fact.name in EDGES.values()]
    short, long = edges
    origins = {row.about["origin"] for row in rows if "origin" in row.about}
    origins |= {fact.source for fact in edges}
    settled = not any(fact.status for fact in edges) and not extrapolated
    band = "overlapping" if short.value >= long.value else "found"
    answer = "yes" if origins == {"measured"} and settled else "partly"
    if np.isnan(short.value):
        band = "none"
    if any(row.fact.status == "few_places" for row in rows if row.fact.name == "force_mean"):
        band = "few_places"
    if band in ("few_places", "none") or origins == {"artificial"}:
        answer = "no"
    forces = on_scans + [row for row in extrapolated if np.isfinite(row.fact.value)]
    return {"answer": answer, "band": band, "edges": edges, "forces": forces}
