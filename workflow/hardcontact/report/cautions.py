"""What makes the answer of a surface less sure, as codes with values: scans, pixels, intervals.

Each caution is a mapping with its `code`; the words for it stand in the template of the page. What
an edge or a force rests on, and what a measurement cannot see, stands in their own rows.
"""

from collections.abc import Collection, Mapping
from statistics import NormalDist
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.base.number import Number
from hardcontact.contact.finite_scan import LEAST_TRIED
from hardcontact.report.artificial import measurement_name, measurements, split_measurements
from hardcontact.report.datasets import Datasets, forces_at_range, tabor_number
from hardcontact.report.quantities import bounds_only, number_of
from hardcontact.surfaces.contradictions import contradictions
from hardcontact.surfaces.scan_defects import DEFECTS, defect_sentence
from hardcontact.theory.prediction import HARD

Caution = Mapping[str, Any]

#: Share of the force on a smooth sphere that a window holds as good as whole.
WHOLE = 0.99
#: Pixels in contact below which their area, a whole number of them, may be off by more than 5 %.
FEW_PIXELS = 10
#: Pixels in the shortest wavelength that a scan shows at all.
RESOLVED = 2
#: Added power over that of the scans beyond which it is named.
MUCH_MORE = 2.0
#: Defects of scans that change the highest points, and the force with them.
MISLEADING = frozenset({"spikes", "equal_lines", "highest"})


def cautions(of: Datasets) -> list[Caution]:
    """Return what makes the answer of one surface less sure, the gravest first.

    Those that change the force by more than the tolerance of the band are `grave`.
    """
    tolerance = of.edges.attrs["tolerance"]
    too_small = of.force["finite_scan_ratio"].values[0] > 1 + tolerance
    cut = forces_at_range(of.force)["window_share"].item() < 1 - tolerance
    one_pixel = of.force.attrs["contact_area"] < of.force["pixel_area"].item()
    window_and_scan = [{"code": "window_and_small_scan"}] if cut and too_small else []
    judged = [
        (_blind_scans(of), True),
        (_defects(of.spectra, MISLEADING), True),
        (_few_places(of.force), True),
        (_soft_bodies(of.force), True),
        (_window(of.force), cut),
        (_scan_size(of), too_small),
        (window_and_scan, True),
        (_pixels(of.force), one_pixel),
        (_intervals(of.force), False),
        (_defects(of.spectra, set(DEFECTS) - MISLEADING), False),
        (_contradictions(of.spectra), False),
        (_more_than_measured(of.spectra), False),
        (_beyond_scans(of), False),
    ]
    return [caution | {"grave": bool(grave)} for group, grave in judged for caution in group]


def _blind_scans(of: Datasets) -> list[dict[str, Any]]:
    """Return that the scans of the contacts, which their pixels tell, are reliable nowhere."""
    all_scans = measurements(of.spectra)
    makes_contacts = (all_scans["kind"].values.astype(str) == "map") & np.isclose(
        all_scans["pixel_size"].values ** 2, of.force["pixel_area"].item()
    )
    reliable = (all_scans["reliable"].values == 1).any(axis=1)
    blind = makes_contacts.any() and not reliable[makes_contacts].any()
    return [{"code": "blind_scans"}] if blind else []


def _defects(spectra: xr.Dataset, codes: Collection[str]) -> list[dict[str, Any]]:
    """Return the defects of these codes of the measurements of a surface, with sentences."""
    defects = []
    for measurement in split_measurements(measurements(spectra)):
        for code, defect in DEFECTS.items():
            numbers = {name: measurement[name].item() for name in defect.units}
            if code in codes and np.isfinite(list(numbers.values())).all():
                sentence = f"{measurement_name(measurement)}: {defect_sentence(code, numbers)}"
                defects.append(
                    {"code": code, "sentence": sentence}
                    | {
                        name: number_of(measurement, name, unit, source="file")
                        for name, unit in defect.units.items()
                    }
                )
    return defects


def _few_places(force: xr.Dataset) -> list[dict[str, Any]]:
    """Return that the contacts on a scan touch too few places for an interval."""
    if force["interval_source"].item() != "few_places":
        return []
    counts = {name: int(force[name].item()) for name in ("contacts", "touched_places")}
    return [{"code": "few_places"} | counts]


def _soft_bodies(force: xr.Dataset) -> list[dict[str, Any]]:
    """Return that the bodies are too soft for a hard contact, or may be."""
    number = tabor_number(force)
    return [] if number.status == HARD else [{"code": "soft_bodies", "tabor": number}]


def _window(force: xr.Dataset) -> list[dict[str, Any]]:
    """Return that the window holds too little of the force, at the range asked for or others."""
    rho, share, asked = force["rho"].values, force["window_share"].values, forces_at_range(force)
    if asked["window_share"] < WHOLE:
        shortest_range = np.nan
        range_shown, share_shown = asked["rho"].item(), asked["window_share"].item()
    elif (share < WHOLE).any():
        shortest_range = float(rho[share < WHOLE].min())
        range_shown, share_shown = float(rho.max()), float(share.min())
    else:
        return []
    return [
        {
            "code": "window",
            "share": Number("share", share_shown),
            "window": Number("window", float(force.attrs["window"]), "nm"),
            "at": Number("at", range_shown, "nm"),
            "from": Number("from", shortest_range, "nm"),
        }
    ]


def _scan_size(of: Datasets) -> list[dict[str, Any]]:
    """Return that scans are smaller than contacts need, and by how much that raises forces."""
    low, high = map(float, of.force["finite_scan_ratio"].values)
    if high == 1:
        return []
    size, draw_size = of.topography["scan_size"].item(), of.force["draw_size"].item()
    return [
        {
            "code": "small_scan",
            "size": Number("size", size, "nm"),
            "draw_size": Number("draw_size", draw_size, "nm"),
            "share": Number("share", size / draw_size),
            "ratio": bounds_only("ratio", low, high),
            "tried": Number("tried", LEAST_TRIED if size / draw_size < LEAST_TRIED else np.nan),
        }
    ]


def _pixels(force: xr.Dataset) -> list[dict[str, Any]]:
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


def _intervals(force: xr.Dataset) -> list[dict[str, Any]]:
    """Return that intervals are conditional on the scans at hand; why some miss their rows tell."""
    without = force["interval_source"].item() in ("none", "few_places")
    if not force["conditional"].item() or without:
        return []
    shared = number_of(force, "correlation_of_parts", name="correlation", strict=False)
    scans = int(force["interval_scans"].item())
    return [{"code": "conditional", "scans": scans, "correlation": shared}]


def _contradictions(spectra: xr.Dataset) -> list[dict[str, Any]]:
    """Return the two measurements of a surface that contradict each other most, if any do."""
    all_scans = measurements(spectra)
    pairs = contradictions(
        *(all_scans[name].values for name in ("psd", "reliable", "kind", "size"))
    )
    return [
        {
            "code": "contradiction",
            "measurements": [
                measurement_name(all_scans.isel(measurement=number))
                for number in (pair.higher, pair.lower)
            ],
            "band": bounds_only("band", pair.shortest, pair.longest, "nm"),
            "factor": Number("factor", pair.factor),
            "others": len(pairs) - 1,
        }
        for pair in pairs[:1]
    ]


def _more_than_measured(spectra: xr.Dataset) -> list[dict[str, Any]]:
    """Return where more roughness is added than the scans show, which is taken for smoothing."""
    q, shortest = spectra["bin_wavevector"].values, spectra["shortest_measured"].item()
    wavelength = 2 * np.pi / q
    scans = measurements(spectra)
    resolved = wavelength >= RESOLVED * scans["pixel_size"].values[:, None]
    measured = np.where(resolved & np.isfinite(scans["psd"].values), scans["psd"].values, 0.0)
    measured = measured.max(axis=0, initial=0.0)
    added = np.interp(q, spectra["wavevector"].values, spectra["spectrum"].values)
    more = (wavelength < shortest) & (measured > 0) & (added > MUCH_MORE * measured)
    if not more.any():
        return []
    factor = float((added[more] / measured[more]).max())
    shortest_more, longest_more = float(wavelength[more].min()), float(wavelength[more].max())
    return [
        {
            "code": "more_than_measured",
            "band": bounds_only("band", shortest_more, longest_more, "nm"),
            "factor": Number("factor", factor),
        }
    ]


def _beyond_scans(of: Datasets) -> list[dict[str, Any]]:
    """Return how the spectrum continues below the wavelengths measured, and above them."""
    spectra, topography = of.spectra, of.topography
    wavelength = 2 * np.pi / spectra["wavevector"].values[spectra["spectrum"].values > 0]
    shortest, longest = spectra["tail_fit_shortest"].item(), spectra["tail_fit_longest"].item()
    hurst = spectra["tail_hurst"].item()
    errors = NormalDist().inv_cdf((1 + of.edges.attrs["confidence"]) / 2)
    half_width = errors * spectra["tail_hurst_error"].item()
    low, high = max(hurst - half_width, 0.0), min(hurst + half_width, 1.0)
    tail = {
        "code": "tail",
        "hurst": Number("hurst", hurst, "1", low, high, source="extrapolated"),
        "known": bool(spectra["tail_known"].item() == 1),
        "fitted": bounds_only("fitted", shortest, longest, "nm"),
        "ends_at": Number("ends_at", float(wavelength.min()), "nm"),
        "ended_by": str(spectra["tail_ended_by"].item()),
    }
    if not np.isfinite(spectra["rolloff"].item()):
        return [tail]
    long_waves = {
        "code": "long_waves",
        "rolloff": Number("rolloff", spectra["rolloff"].item(), "nm", source="extrapolated"),
        "above": number_of(spectra, "longest_measured"),
        "of_scans": Number("of_scans", float(topography["rms_height"].mean()), "nm"),
        "whole": number_of(topography, "all_scales_rms_height"),
    }
    return [tail, long_waves]
