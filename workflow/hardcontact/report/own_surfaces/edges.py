"""The edges of the band of a user's surface, and what to measure next to find them."""

from collections.abc import Iterable
from enum import StrEnum
from typing import NamedTuple

import numpy as np
import xarray as xr

from hardcontact.base.number import Number, NumberStatus
from hardcontact.base.statistics import interval_ends
from hardcontact.inference.edges import EdgeStatus, computed_cutoffs
from hardcontact.inference.scan_parts import IntervalSource
from hardcontact.report.own_surfaces.datasets import Datasets, fails_hindcast
from hardcontact.report.own_surfaces.reliable_wavelengths import (
    artificial_bands,
    edge_source,
    measured_share_at_edge,
    overlaps_any,
)
from hardcontact.report.quantities import EDGE_NAMES, OPEN_WORDS, NoValue, number_without_value
from hardcontact.scans.both_bodies import sphere_share
from hardcontact.surfaces.synthesis import SIDES


class NextScan(NamedTuple):
    """A measurement to make next: a scan that is reliable beyond `limit` would find an edge."""

    edge: str  #: short_edge or long_edge.
    code: str  #: finer or larger.
    limit: Number
    body: str = ""  #: "sphere" or "surface", the rougher one there; "" under a smooth sphere.


def interval_status(interval_source: xr.DataArray) -> StrEnum:
    """Return the status of a number without interval: few patches touch, or no scan bounds it."""
    has_few_patches = interval_source.item() == IntervalSource.FEW_PATCHES
    return IntervalSource.FEW_PATCHES if has_few_patches else NumberStatus.NO_INTERVAL


def edge_numbers(data: Datasets) -> list[Number]:
    """Return the edges of one surface, each with its measured share and the cutoffs around it."""
    statuses = data.edges["edge_status"].sel(side=list(SIDES)).values.tolist()
    if statuses == [EdgeStatus.OPEN_ABOVE, EdgeStatus.OPEN_BELOW]:  # No cutoff changes the force.
        return [Number(name, np.nan, "nm", status=NoValue.NO_BAND) for name in EDGE_NAMES.values()]
    numbers = []
    for side in SIDES:
        edge = _edge_without_artificial_ends(data, side)
        share = measured_share_at_edge(data, side)
        numbers += [edge, Number(f"{edge.name}_measured_share", share, source=edge.source)]
        if edge.status == NumberStatus.NO_INTERVAL:
            numbers.append(_cutoffs_around(edge, data.edges.sel(side=side)))
    return numbers


def _edge_without_artificial_ends(data: Datasets, side: str) -> Number:
    """Return an edge without the ends of its interval at artificial wavelengths.

    The edge is NaN if the filter makes ripples, or if the hindcast fails, because the unfiltered
    force then rests on wrong roughness.
    """
    name = EDGE_NAMES[side]
    side_edges = data.edges.sel(side=side)
    status = side_edges["edge_status"].item()
    if fails_hindcast(data, side) and status != EdgeStatus.RIPPLES:
        return Number(name, np.nan, "nm", status=NoValue.NO_HINDCAST, source="artificial")
    low, high = (end.item() for end in interval_ends(side_edges, "edge"))
    source = edge_source(data, side)
    edge = Number(name, side_edges["edge"].item(), "nm", low, high, source=source)
    if not np.isfinite(edge.value):
        edge = edge._replace(value=side_edges["edge_bound"].item(), status=status)
    bands = artificial_bands(data.spectra)
    if edge.source == "artificial" or overlaps_any(edge.low, edge.low, bands):
        edge = edge._replace(low=np.nan)
    if edge.source == "artificial" or overlaps_any(edge.high, edge.high, bands):
        edge = edge._replace(high=np.nan)
    if edge.status or np.isfinite([edge.low, edge.high]).any():
        return edge
    return edge._replace(status=interval_status(data.edges["interval_source"]))


def _cutoffs_around(edge: Number, side_edges: xr.Dataset) -> Number:
    """Return the two cutoffs between which an edge was found."""
    cutoffs = computed_cutoffs(side_edges["filtered_force_ratio"])
    index = np.clip(np.searchsorted(cutoffs, edge.value), 1, len(cutoffs) - 1)
    return number_without_value(f"{edge.name}_cutoffs", cutoffs[index - 1], cutoffs[index], "nm")


def next_scans(edges: Iterable[Number], spectra: xr.Dataset) -> list[NextScan]:
    """Return a measurement to make next for each edge that is open or extrapolated."""
    return [
        _next_scan(edge, spectra)
        for edge in edges
        if edge.status in (*OPEN_WORDS, NoValue.NO_BAND)
        or edge.source in ("artificial", "partly_artificial")
    ]


def _next_scan(edge: Number, spectra: xr.Dataset) -> NextScan:
    """Return the measurement that would find an edge.

    Its limit is the edge, or its bound, or the nearest wavelength beyond it at which no scan is
    reliable.
    """
    bands = artificial_bands(spectra)
    wavelength = edge.value
    is_finer = edge.name == "short_edge"
    if np.isnan(wavelength):
        measured_end = "shortest_measured" if is_finer else "longest_measured"
        wavelength = spectra[measured_end].item()
    if edge.status in OPEN_WORDS:
        is_finer = edge.status == EdgeStatus.OPEN_BELOW
    if is_finer:
        _, longest_below = max(band for band in bands if band[0] < wavelength)
        limit = min(wavelength, longest_below)
    else:
        shortest_above, _ = min(band for band in bands if wavelength < band[1])
        limit = max(wavelength, shortest_above)
    share = sphere_share(spectra, limit)
    body = "" if np.isnan(share) else "sphere" if share > 0.5 else "surface"
    code = "finer" if is_finer else "larger"
    return NextScan(edge.name, code, Number("limit", limit, "nm"), body)
