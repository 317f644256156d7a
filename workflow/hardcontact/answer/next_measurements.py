"""What would narrow the answer of a surface, as codes with values, the most telling first.

What settles an open or an artificial edge comes first, then what changes the force, then tips and
forces of one's own.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.adhesion.finite_scan import LARGE_ENOUGH
from hardcontact.answer.artificial import artificial_bands, place_of_edge
from hardcontact.answer.datasets import Datasets
from hardcontact.answer.facts import between
from hardcontact.answer.force_facts import differing_sides
from hardcontact.answer.limits import FEW_PIXELS, scans_without_tip
from hardcontact.answer.surface_facts import resolves_nothing
from hardcontact.numbers.number import Number

#: What a measurement settles, in the order of what it is worth.
WORTH = ("edge", "force", "input")


def next_measurements(of: Datasets) -> list[Mapping[str, Any]]:
    """Return what to measure next on one surface, each with what it `settles`, of `WORTH`."""
    found = [
        *_shorter_waves(of),
        *_longer_waves(of),
        *_larger_scans(of),
        *_finer_pixels(of.force),
        *_more_places(of.force),
        *([{"code": "tips", "settles": "input"}] if scans_without_tip(of.spectra) else []),
        *([{"code": "forces", "settles": "input"}] if of.fit is None else []),
    ]
    return sorted(found, key=lambda one: WORTH.index(one["settles"]))


def _is_open(edges: xr.Dataset, side: str) -> bool:
    return bool(edges["edge_status"].sel(side=side).item() != "found")


def _shorter_waves(of: Datasets) -> list[dict[str, Any]]:
    """Return the wavelengths between short edge and contact scans that no scan shows."""
    edge = of.edges.sel(side="small")
    shortest = float(np.nanmin([edge["edge_bound"], edge["edge"], *edge["edge_interval"].values]))
    open_below = _is_open(of.edges, "small") or np.isnan(edge["edge_interval"].sel(bound="low"))
    longest = float(of.force["transition"].sel(side="small"))
    gaps = [
        (max(low, shortest), min(high, longest))
        for low, high in artificial_bands(of.spectra)
        if max(low, shortest) < min(high, longest)
    ]
    nothing_resolved = resolves_nothing(of.edges)
    if nothing_resolved:  # what decides is shorter than all that is measured
        gaps = [(np.nan, float(of.spectra["shortest_measured"]))]
    if not gaps:
        return []
    bands = [between("band", *gap, "nm")._replace(source="artificial") for gap in gaps]
    return [
        {
            "code": "shorter_waves",
            "settles": "edge",
            "bands": bands,
            "and_below": bool(open_below) and not nothing_resolved,
            "settles_force": nothing_resolved or "small" in differing_sides(of.force),
        }
    ]


def _longer_waves(of: Datasets) -> list[dict[str, Any]]:
    """Return that a larger map or a line scan tells where the long edge lies."""
    at_large = of.edges.sel(side="large")
    shorter = _is_open(of.edges, "large") and not at_large["edge_at_least"].item()
    known = not _is_open(of.edges, "large") and place_of_edge(of, "large") == "outside"
    if shorter or known:
        return []
    return [{"code": "longer_waves", "settles": "edge"}]


def _larger_scans(of: Datasets) -> list[dict[str, Any]]:
    """Return how wide a map must be to hold the peaks of a contact."""
    needed = LARGE_ENOUGH * of.force["draw_size"].item()
    if of.topography["scan_size"].item() >= needed or resolves_nothing(of.edges):
        return []
    return [{"code": "larger_map", "settles": "force", "size": Number("size", needed, "nm")}]


def _finer_pixels(force: xr.Dataset) -> list[dict[str, Any]]:
    """Return the pixels that resolve the area in contact, if those of the scans do not."""
    area = force.attrs["contact_area"]
    if area >= FEW_PIXELS * force["pixel_area"].item():
        return []
    size = Number("size", float(np.sqrt(area / FEW_PIXELS)), "nm")
    return [{"code": "finer_pixels", "settles": "force", "size": size, "pixels": FEW_PIXELS}]


def _more_places(force: xr.Dataset) -> list[dict[str, Any]]:
    """Return that scans of other places are needed, if intervals come from parts of a scan."""
    if np.isfinite(force["force_interval"]).all() and not force["conditional"].item():
        return []
    return [{"code": "more_places", "settles": "force"}]
