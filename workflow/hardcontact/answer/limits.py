"""What limits the answer of a surface, as codes with values: edges, scans, pixels, intervals.

Each limit is a mapping with its `code`; the words for it stand in the template of the page.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.adhesion.finite_scan import LEAST_TRIED
from hardcontact.answer.artificial import (
    measurement_name,
    measurements,
    reliable_measurements,
    single,
)
from hardcontact.answer.datasets import Datasets, at_range
from hardcontact.answer.force_facts import continuation, continued_fact, differing_sides
from hardcontact.answer.quantities import between, number_of
from hardcontact.answer.surface_facts import EDGES, edge_fact, resolves_nothing
from hardcontact.numbers.number import Number
from hardcontact.scales.critical_band import computed_cutoffs
from hardcontact.surfaces.contradictions import contradictions

Limit = Mapping[str, Any]

#: Neighbouring cutoffs of a larger ratio leave edges between them uncertain: forces change as much.
SPARSE = 2.0
#: Share of the force on a smooth sphere that a window holds as good as whole.
WHOLE = 0.99
#: Pixels in contact below which their area, a whole number of them, may be off by more than 5 %.
FEW_PIXELS = 10
#: Kind of what stands for the measurements of a substitute.
DESCRIPTION = "description"


def limits(of: Datasets) -> list[Limit]:
    """Return what limits the answer of one surface, the gravest first."""
    substitute = of.topography["basis"].item() == "substitute"
    return [
        *([{"code": "substitute"}] if substitute else []),
        *_of_edges(of.edges),
        *_of_blind_scans(of),
        *_of_window(of.force),
        *_of_scan_size(of),
        *_of_continued_roughness(of.force),
        *_of_pixels(of.force),
        *_of_intervals(of.force),
        *_sparse_cutoffs(of.edges),
        *_of_spectrum(of.spectra, of.topography),
    ]


def grave_limits(of: Datasets) -> list[Limit]:
    """Return the limits that change the force of a surface by more than the tolerance of the band.

    Where edges lie the table of the answer says itself.
    """
    tolerance = of.edges.attrs["tolerance"]
    too_small = of.force["finite_scan_ratio"].values[0] > 1 + tolerance
    cut = at_range(of.force)["window_share"].item() < 1 - tolerance
    one_pixel = of.force.attrs["contact_area"] < of.force["pixel_area"].item()
    return [
        *_of_blind_scans(of),
        *(_of_window(of.force) if cut else []),
        *(_of_scan_size(of) if too_small else []),
        *([{"code": "window_and_small_scan"}] if cut and too_small else []),
        *(_of_pixels(of.force) if one_pixel else []),
    ]


def _of_edges(edges: xr.Dataset) -> list[Limit]:
    """Return that there are no edges, or which end of an interval lies beyond what was computed.

    What an edge rests on and why one is open its row tells.
    """
    if resolves_nothing(edges):
        return [{"code": "nothing_resolved"}]
    found: list[Limit] = []
    for side, name in EDGES.items():
        edge = edge_fact(edges.sel(side=side), name)
        unknown = [end for end in ("low", "high") if not np.isfinite(getattr(edge, end))]
        if len(unknown) == 1:
            found.append({"code": "open_interval", "side": side, "end": unknown[0]})
    return found


def _of_blind_scans(of: Datasets) -> list[Limit]:
    """Return that the scans of the contacts, which their pixels tell, are reliable nowhere."""
    all_scans = measurements(of.spectra)
    of_contact = (all_scans["kind"].values.astype(str) == "map") & np.isclose(
        all_scans["pixel_size"].values ** 2, of.force["pixel_area"].item()
    )
    reliable = (all_scans["reliable"].values == 1).any(axis=1)
    blind = of_contact.any() and not reliable[of_contact].any()
    return [{"code": "blind_scans"}] if blind else []


def _of_window(force: xr.Dataset) -> list[Limit]:
    """Return that the window holds too little of the force, at the range asked for or others."""
    rho, share, here = force["rho"].values, force["window_share"].values, at_range(force)
    if here["window_share"] < WHOLE:
        first, place, held = None, here["rho"].item(), here["window_share"].item()
    elif (share < WHOLE).any():
        first, place, held = float(rho[share < WHOLE].min()), float(rho.max()), float(share.min())
    else:
        return []
    return [
        {
            "code": "window",
            "share": Number("share", held),
            "window": Number("window", float(force.attrs["window"]), "nm"),
            "at": Number("at", place, "nm"),
            "from": None if first is None else Number("from", first, "nm"),
        }
    ]


def _of_scan_size(of: Datasets) -> list[Limit]:
    """Return that scans are smaller than contacts need, and by how much that raises forces."""
    least, most = map(float, of.force["finite_scan_ratio"].values)
    if most == 1:
        return []
    size, draw_size = of.topography["scan_size"].item(), of.force["draw_size"].item()
    share = size / draw_size
    return [
        {
            "code": "small_scan",
            "size": Number("size", size, "nm"),
            "draw_size": Number("draw_size", draw_size, "nm"),
            "share": Number("share", share),
            "ratio": between("ratio", least, most),
            "tried": Number("tried", LEAST_TRIED) if share < LEAST_TRIED else None,
        }
    ]


def _of_continued_roughness(force: xr.Dataset) -> list[Limit]:
    """Return where the force hangs on roughness that the scans do not show."""
    return [
        {"code": "continued", "force": continued_fact(force, side)} | continuation(force, side)
        for side in differing_sides(force)
    ]


def _of_pixels(force: xr.Dataset) -> list[Limit]:
    """Return that few pixels carry the preload, or one that is larger than need be."""
    area, pixel = float(force.attrs["contact_area"]), force["pixel_area"].item()
    if area >= FEW_PIXELS * pixel:
        return []
    return [
        {
            "code": "few_pixels" if area >= pixel else "one_pixel",
            "area": Number("area", area, "nm2"),
            "pixel_area": Number("pixel_area", pixel, "nm2"),
            "pixels": Number("pixels", area / pixel),
        }
    ]


def _of_intervals(force: xr.Dataset) -> list[Limit]:
    """Return that intervals are conditional on the scans at hand; why some miss their rows tell."""
    if not force["conditional"].item() or force["interval_source"].item() == "none":
        return []
    shared = number_of(force, "correlation_of_parts", name="correlation", strict=False)
    scans = int(force["interval_scans"].item())
    return [{"code": "conditional", "scans": scans, "correlation": shared}]


def _sparse_cutoffs(edges: xr.Dataset) -> list[Limit]:
    """Return which edges of a surface were found between cutoffs that lie far apart."""
    found: list[Limit] = []
    for side, of_side in ((side, edges.sel(side=side)) for side in EDGES):
        edge, cutoffs = of_side["edge"].item(), computed_cutoffs(of_side["scale_ratio"])
        if np.isnan(edge):
            continue
        shorter, longer = cutoffs[cutoffs <= edge].max(), cutoffs[cutoffs >= edge].min()
        if longer > SPARSE * shorter:
            cutoffs_beside = between("cutoffs", float(shorter), float(longer), "nm")
            found.append({"code": "sparse_cutoffs", "side": side, "between": cutoffs_beside})
    return found


def _rms_heights(topography: xr.Dataset) -> dict[str, Any]:
    """Return the rms height of all scales beside the mean of the scans."""
    scans = float(topography["rms_height"].mean())
    whole = number_of(topography, "all_scales_rms_height")
    return {
        "of_scans": Number("of_scans", scans, "nm"),
        "whole": whole,
        "less": whole.value < scans,
    }


def _of_spectrum(spectra: xr.Dataset, topography: xr.Dataset) -> list[Limit]:
    """Return what bounds the reliable wavelengths, what lies beyond, and which tips are unknown."""
    seen = reliable_measurements(spectra)
    finest = seen.isel(measurement=int(seen["shortest_reliable"].values.argmin()))
    widest = seen.isel(measurement=int(seen["longest_reliable"].values.argmax()))
    ends = {"small": (finest, "shortest"), "large": (widest, "longest")}
    found: list[Limit] = [
        {
            "code": "spectrum_end",
            "side": side,
            "at": Number("at", one[f"{end}_reliable"].item(), "nm"),
            "limited_by": str(one["limited_by"].item()) if side == "small" else "size",
            "measurement": measurement_name(one),
            "described": one["kind"].item() == DESCRIPTION,
        }
        for side, (one, end) in ends.items()
    ]
    found.append({"code": "tail"} | tail(spectra))
    if np.isfinite(spectra["rolloff"].item()):
        rolloff = Number("rolloff", spectra["rolloff"].item(), "nm", source="extrapolated")
        found.append(
            {
                "code": "long_waves",
                "rolloff": rolloff,
                "above": number_of(spectra, "longest_measured"),
            }
            | _rms_heights(topography)
        )
    blind = [
        measurement_name(one)
        for one in single(measurements(spectra))
        if not (one["reliable"].values == 1).any()
    ]
    unknown = [measurement_name(one) for one in scans_without_tip(spectra)]
    codes = {"blind_measurements": blind, "unknown_tips": unknown}
    listed = [{"code": code, "measurements": names} for code, names in codes.items() if names]
    return [*found, *_contradictions(spectra), *listed]


def _contradictions(spectra: xr.Dataset) -> list[Limit]:
    """Return the two measurements of a surface that contradict each other most, if any do."""
    all_scans = measurements(spectra)
    found = contradictions(
        *(all_scans[name].values for name in ("psd", "reliable", "kind", "size"))
    )
    return [
        {
            "code": "contradiction",
            "measurements": [
                measurement_name(all_scans.isel(measurement=place))
                for place in (first.higher, first.lower)
            ],
            "band": between("band", first.shortest, first.longest, "nm"),
            "factor": Number("factor", first.factor),
            "others": len(found) - 1,
        }
        for first in found[:1]
    ]


def scans_without_tip(spectra: xr.Dataset) -> list[xr.Dataset]:
    """Return the reliable measurements whose tip radius is not known; a description has none."""
    return [
        one
        for one in single(reliable_measurements(spectra))
        if one["kind"].item() != DESCRIPTION and np.isnan(one["tip_radius"].item())
    ]


def tail(spectra: xr.Dataset) -> dict[str, Any]:
    """Return how the spectrum goes on below the wavelengths measured: to where, with what H."""
    wavelength = 2 * np.pi / spectra["wavevector"].values[spectra["spectrum"].values > 0]
    shortest, longest = spectra["tail_fit_shortest"].item(), spectra["tail_fit_longest"].item()
    return {
        "hurst": Number("hurst", spectra["tail_hurst"].item(), source="extrapolated"),
        "fitted": between("fitted", shortest, longest, "nm"),
        "ends_at": Number("ends_at", float(wavelength.min()), "nm"),
        "ended_by": str(spectra["tail_ended_by"].item()),
    }
