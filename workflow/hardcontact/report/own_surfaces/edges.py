"""The edges of the band of your surface, the answer from them, and what to measure next."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import xarray as xr

from hardcontact.base.number import Number, NumberSource, NumberStatus
from hardcontact.base.statistics import interval_ends
from hardcontact.inference.edges import EDGE_NAMES, EdgeStatus, computed_cutoffs
from hardcontact.inference.scan_parts import IntervalSource
from hardcontact.report.own_surfaces.datasets import (
    Datasets,
    fails_hindcast,
    is_any_unreliable,
    unreliable_wavelengths,
)
from hardcontact.report.quantities import OPEN_WORDS, NoValue, number_without_value
from hardcontact.scans.both_bodies import sphere_share
from hardcontact.scans.reliable_wavelengths import MIN_PIXELS
from hardcontact.surfaces.synthesis import SIDES

#: Smallest share that counts as the whole: a choice.
NEARLY_ALL = 0.9


class Conclusion(NamedTuple):
    """The answer of one surface in short; intervals have both ends or none."""

    answered: str  #: Do reliable wavelengths decide edges and force: "yes", "partly" or "no".
    #: The first of these codes that holds:
    #: - few_patches: contacts touch too few patches;
    #: - unresolved: no cutoff changes the force;
    #: - unknown: a hindcast fails, or the filter makes ripples;
    #: - overlapping: short waves alone give the force, and so do long waves alone;
    #: - found: any other case, even if an edge is only a bound.
    band_status: str
    short_edge: Number
    long_edge: Number
    force: Number
    extrapolated_sides: list[str]  #: Sides with a known force with extrapolated roughness.


class NextScan(NamedTuple):
    """A measurement to make next: a scan that is reliable beyond `limit` would find an edge.

    With the code gap, `limit` has no value: a scan that is reliable between its ends would find it.
    """

    edge: str  #: short_edge or long_edge.
    code: str  #: finer, larger or gap.
    limit: Number
    body: str = ""  #: The rougher at `limit`, "sphere" or "surface"; "" for a smooth sphere.
    pixels_suffice: bool = False  #: Tip, noise or smoothing hide finer waves, not pixels.


def add_status(number: Number, interval_source: xr.DataArray) -> Number:
    """Return a number with a status that says why it has no interval, if it has none."""
    is_bounded = np.isfinite([number.low, number.high]).any()
    if is_bounded or number.status not in ("", NumberStatus.NO_INTERVAL):
        return number
    has_few_patches = interval_source.item() == IntervalSource.FEW_PATCHES
    status = IntervalSource.FEW_PATCHES if has_few_patches else NumberStatus.NO_INTERVAL
    return number._replace(status=status)


def edge_numbers(surface_data: Datasets) -> list[Number]:
    """Return the edges of one surface, and for each edge the share of reliable wavelengths.

    Edges without an interval have the computed cutoffs around them. Without a band all edges are
    NaN, and nothing else is returned.
    """
    statuses = surface_data.edges["edge_status"].sel(side=list(SIDES)).values.tolist()
    # No cutoff changes the force: the short edge is above all cutoffs, the long one below.
    if statuses == [EdgeStatus.OPEN_ABOVE, EdgeStatus.OPEN_BELOW]:
        return [Number(name, np.nan, "nm", status=NoValue.NO_BAND) for name in EDGE_NAMES.values()]
    numbers = []
    for side in SIDES:
        edge = _edge_without_unreliable_ends(surface_data, side)
        share = reliable_share_at_edge(surface_data, side)
        numbers += [edge, Number(f"{edge.name}_measured_share", share, source=edge.source)]
        if edge.status == NumberStatus.NO_INTERVAL:
            cutoffs = computed_cutoffs(surface_data.edges["filtered_force_ratio"].sel(side=side))
            index = np.clip(np.searchsorted(cutoffs, edge.value), 1, len(cutoffs) - 1)
            low, high = cutoffs[index - 1], cutoffs[index]
            numbers.append(number_without_value(f"{edge.name}_cutoffs", low, high, "nm"))
    return numbers


def _edge_without_unreliable_ends(surface_data: Datasets, side: str) -> Number:
    """Return an edge, or its bound if it is open, without interval ends where no scan is reliable.

    An unreliable edge has no interval. If the hindcast fails, the edge is NaN, because the
    unfiltered force rests on wrong roughness.
    """
    name = EDGE_NAMES[side]
    side_edges = surface_data.edges.sel(side=side)
    status = side_edges["edge_status"].item()
    # Ripples leave no edge whether the hindcast fails or not.
    if fails_hindcast(surface_data, side) and status != EdgeStatus.RIPPLES:
        return Number(name, np.nan, "nm", status=NoValue.NO_HINDCAST, source="extrapolated")
    ends = [end.item() for end in interval_ends(side_edges, "edge")]
    source = edge_source(surface_data, side)
    is_hidden = [is_any_unreliable(surface_data.spectra, end, end) for end in ends]
    low, high = np.where(np.logical_or(is_hidden, source == "extrapolated"), np.nan, ends).tolist()
    edge = Number(name, side_edges["edge"].item(), "nm", low, high, source=source)
    if not np.isfinite(edge.value):
        edge = edge._replace(value=side_edges["edge_bound"].item(), status=status)
    return add_status(edge, surface_data.edges["interval_source"])


def reliable_and_unreliable_change(
    surface_data: Datasets, side: str, shortest: float = 0.0, longest: float = np.inf
) -> tuple[float, float]:
    """Return how much reliable, and how much unreliable wavelengths change the force.

    Roughness is removed on the `side`. A change is the sum of |d ln F| between `shortest` and
    `longest` (nm); ln F is interpolated linearly over the logarithm of the cutoff.
    """
    side_edges = surface_data.edges.sel(side=side)
    cutoffs = computed_cutoffs(side_edges["filtered_force_ratio"])
    log_ratio = np.log(side_edges["filtered_force_ratio"].sel(cutoff_wavelength=cutoffs).values)
    # At the end of the extrapolated spectrum nothing is removed, and the ratio is one.
    end_index = 0 if side == "short" else len(cutoffs)
    end = surface_data.force["extrapolation_end"].sel(side=side).item()
    wavelength = np.insert(cutoffs, end_index, end)
    log_ratio = np.insert(log_ratio, end_index, 0.0)
    unreliable = unreliable_wavelengths(surface_data.spectra)
    limits = max(shortest, wavelength[0]), min(longest, wavelength[-1])
    # Between neighbouring ends all wavelengths are reliable, or none is.
    ends = np.unique(np.clip([*wavelength, *limits, *np.ravel(unreliable)], *limits))
    changes = np.abs(np.diff(np.interp(np.log(ends), np.log(wavelength), log_ratio)))
    middles = np.sqrt(ends[1:] * ends[:-1])
    is_unreliable = np.any([(low < middles) & (middles < high) for low, high in unreliable], axis=0)
    return float(changes[~is_unreliable].sum()), float(changes[is_unreliable].sum())


def reliable_share(reliable: float, unreliable: float) -> float:
    """Return the share of reliable wavelengths in a change of the force, NaN without a change."""
    return reliable / (reliable + unreliable) if reliable + unreliable > 0 else np.nan


def reliable_share_at_edge(surface_data: Datasets, side: str) -> float:
    """Return the share of reliable wavelengths in the change at an edge, NaN without an edge."""
    edge = surface_data.edges["edge"].sel(side=side).item()
    if np.isnan(edge):
        return np.nan
    removed_wavelengths = (0.0, edge) if side == "short" else (edge, np.inf)
    return reliable_share(*reliable_and_unreliable_change(surface_data, side, *removed_wavelengths))


def edge_source(surface_data: Datasets, side: str) -> NumberSource:
    """Return whether an edge rests on unreliable wavelengths, as the source of its number."""
    side_edges = surface_data.edges.sel(side=side)
    edge = float(side_edges["edge"].fillna(side_edges["edge_bound"]))
    share = reliable_share_at_edge(surface_data, side)
    if is_any_unreliable(surface_data.spectra, edge, edge) or share < 1 - NEARLY_ALL:
        return "extrapolated"
    if share < NEARLY_ALL:
        return "partly_extrapolated"
    ends = side_edges["edge_interval"].fillna(edge).values
    return "interval_extrapolated" if is_any_unreliable(surface_data.spectra, *ends) else "measured"


def surface_conclusion(numbers: Mapping[str, Number]) -> Conclusion:
    """Return the conclusion on one surface from its numbers by name."""
    short = _drop_partial_interval(numbers["short_edge"])
    long = _drop_partial_interval(numbers["long_edge"])
    force = _drop_partial_interval(numbers["mean_force"])
    differing_sides = [side for side in SIDES if f"extrapolated_force_{side}" in numbers]
    known_sides = [
        side for side in differing_sides if np.isfinite(numbers[f"extrapolated_force_{side}"].value)
    ]
    sources = {short.source, long.source, numbers["mean_force_measured_share"].source}
    band_status = _describe_band(short, long, numbers["mean_force"])
    if band_status in ("few_patches", "unresolved") or sources == {"extrapolated"}:
        answered = "no"
    elif sources == {"measured"} and not any([short.status, long.status, differing_sides]):
        answered = "yes"
    else:
        answered = "partly"
    return Conclusion(answered, band_status, short, long, force, known_sides)


def _describe_band(short: Number, long: Number, force: Number) -> str:
    """Return `Conclusion.band_status` from both edges and the mean force of one surface."""
    if force.status == IntervalSource.FEW_PATCHES:
        return "few_patches"
    if short.status == NoValue.NO_BAND:
        return "unresolved"
    if {NoValue.NO_HINDCAST, EdgeStatus.RIPPLES} & {short.status, long.status}:
        return "unknown"
    return "overlapping" if short.value >= long.value else "found"


def _drop_partial_interval(number: Number) -> Number:
    """Return a number for a sentence of several: without its interval if that lacks an end."""
    if np.isfinite([number.low, number.high]).all() or np.isnan(number.value):
        return number
    status = number.status if number.status in OPEN_WORDS else NumberStatus.PLAIN
    return number._replace(low=np.nan, high=np.nan, status=status)


def next_scans(numbers: Mapping[str, Number], spectra: xr.Dataset) -> list[NextScan]:
    """Return a measurement to make for each edge that is open, not found or (partly) unreliable."""
    # A surface that is only described may not exist yet.
    if (spectra["kind"] == "description").any():
        return []
    return [
        _next_scan(edge, numbers, spectra)
        for edge in (numbers["short_edge"], numbers["long_edge"])
        if edge.status in (*OPEN_WORDS, NoValue.NO_BAND)
        or edge.source in ("extrapolated", "partly_extrapolated")
    ]


def _rougher_body(spectra: xr.Dataset, wavelength: float) -> str:
    """Return `NextScan.body` at a wavelength (nm)."""
    share = sphere_share(spectra, wavelength)
    return "" if np.isnan(share) else "sphere" if share > 0.5 else "surface"


def _next_scan(edge: Number, numbers: Mapping[str, Number], spectra: xr.Dataset) -> NextScan:
    """Return the measurement that would find an edge.

    A hindcast without a ratio tested no octave, because the scan of the contacts shows none. If
    there is a gap between scans, a map of the gap can give the hindcast an octave.
    """
    unreliable = unreliable_wavelengths(spectra)
    gaps = unreliable[1:-1]
    ratio_name = f"hindcast_{edge.name.removesuffix('_edge')}_ratio"
    if gaps and edge.status == NoValue.NO_HINDCAST and np.isnan(numbers[ratio_name].value):
        low, high = max(gaps, key=lambda ends: ends[1] / ends[0])
        gap = number_without_value("limit", low, high, "nm")
        return NextScan(edge.name, "gap", gap, _rougher_body(spectra, np.sqrt(low * high)))
    wavelength = edge.value
    is_finer = edge.name == "short_edge"
    if np.isnan(wavelength):
        wavelength = spectra["shortest_measured" if is_finer else "longest_measured"].item()
    if edge.status in OPEN_WORDS:
        is_finer = edge.status == EdgeStatus.OPEN_BELOW
    if is_finer:
        _, longest_below = max(ends for ends in unreliable if ends[0] < wavelength)
        limit = min(wavelength, longest_below)
    else:
        shortest_above, _ = min(ends for ends in unreliable if wavelength < ends[1])
        limit = max(wavelength, shortest_above)
    body = _rougher_body(spectra, limit)
    code = "finer" if is_finer else "larger"
    pixels_suffice = is_finer and bool((MIN_PIXELS * spectra["pixel_size"] < limit).any())
    return NextScan(edge.name, code, Number("limit", limit, "nm"), body, pixels_suffice)
