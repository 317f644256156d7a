"""Cautions about the answer of a surface, as codes with values: scans, pixels, intervals.

Each caution is a mapping with its `code`. The template of the page has the sentence for each code.
The sources of edges and forces, and the limits of measurements, are in tables of their own.
"""

from collections.abc import Collection, Mapping
from statistics import NormalDist
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.base.number import Number
from hardcontact.contact.finite_scan import SMALLEST_TESTED
from hardcontact.report.artificial import measurement_name, measurements, split_measurements
from hardcontact.report.datasets import Datasets, forces_at_range, tabor_number
from hardcontact.report.quantities import bounds_only, number_of
from hardcontact.surfaces.contradictions import contradictions
from hardcontact.surfaces.scan_defects import DEFECTS, defect_sentence
from hardcontact.theory.hard_contact import HARD

Caution = Mapping[str, Any]

#: Smallest share of the force on a smooth sphere in a window without a caution.
MIN_WINDOW_SHARE = 0.99
#: Fewest pixels in contact: below, rounding to whole pixels may change the area by over 5 %.
MIN_CONTACT_PIXELS = 10
#: Number of pixels in the shortest wavelength of a scan.
MIN_WAVELENGTH_PIXELS = 2
#: Largest ratio of added power to the power in the scans without a caution.
MAX_POWER_RATIO = 2.0
#: Codes of defects that change the highest points, and thus the force.
MISLEADING_DEFECTS = frozenset({"spikes", "equal_lines", "highest"})


def cautions(datasets: Datasets) -> list[Caution]:
    """Return the cautions about the answer of one surface, the gravest first.

    A caution is `grave` if its cause changes the force by more than the tolerance of the band.

    Returns each has `code`, `grave` and the values of its sentence.
    """
    tolerance = datasets.edges.attrs["tolerance"]
    too_small = datasets.force["finite_scan_ratio"].values[0] > 1 + tolerance
    is_window_small = forces_at_range(datasets.force)["window_share"].item() < 1 - tolerance
    one_pixel = datasets.force.attrs["contact_area"] < datasets.force["pixel_area"].item()
    window_and_scan = [{"code": "window_and_small_scan"}] if is_window_small and too_small else []
    groups = [
        (_blind_scans(datasets), True),
        (_defects(datasets.spectra, MISLEADING_DEFECTS), True),
        (_few_places(datasets.force), True),
        (_soft_bodies(datasets.force), True),
        (_small_window(datasets.force), is_window_small),
        (_small_scans(datasets), too_small),
        (window_and_scan, True),
        (_few_pixels(datasets.force), one_pixel),
        (_conditional_intervals(datasets.force), False),
        (_defects(datasets.spectra, set(DEFECTS) - MISLEADING_DEFECTS), False),
        (_contradictions(datasets.spectra), False),
        (_excess_roughness(datasets.spectra), False),
        (_extrapolations(datasets), False),
    ]
    return [caution | {"grave": bool(grave)} for group, grave in groups for caution in group]


def _blind_scans(datasets: Datasets) -> list[dict[str, Any]]:
    """Return a caution if the scans in contact, known by their pixels, are reliable nowhere."""
    all_scans = measurements(datasets.spectra)
    makes_contacts = (all_scans["kind"].values.astype(str) == "map") & np.isclose(
        all_scans["pixel_size"].values ** 2, datasets.force["pixel_area"].item()
    )
    reliable = (all_scans["reliable"].values == 1).any(axis=1)
    blind = makes_contacts.any() and not reliable[makes_contacts].any()
    return [{"code": "blind_scans"}] if blind else []


def _defects(spectra: xr.Dataset, codes: Collection[str]) -> list[dict[str, Any]]:
    """Return the defects with these codes in the measurements of a surface, with sentences."""
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
    """Return a caution if the contacts on a scan touch too few places for an interval."""
    if force["interval_source"].item() != "few_places":
        return []
    counts = {name: int(force[name].item()) for name in ("contacts", "touched_places")}
    return [{"code": "few_places"} | counts]


def _soft_bodies(force: xr.Dataset) -> list[dict[str, Any]]:
    """Return a caution if the bodies are, or may be, too soft for a hard contact."""
    number = tabor_number(force)
    return [] if number.status == HARD else [{"code": "soft_bodies", "tabor": number}]


def _small_window(force: xr.Dataset) -> list[dict[str, Any]]:
    """Return a caution if the window has too little of the force, at any range."""
    rho = force["rho"].values
    share = force["window_share"].values
    study_force = forces_at_range(force)
    if study_force["window_share"] < MIN_WINDOW_SHARE:
        shortest_range = np.nan
        range_shown, share_shown = study_force["rho"].item(), study_force["window_share"].item()
    elif (share < MIN_WINDOW_SHARE).any():
        shortest_range = float(rho[share < MIN_WINDOW_SHARE].min())
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


def _small_scans(datasets: Datasets) -> list[dict[str, Any]]:
    """Return a caution if scans are smaller than contacts need, with its effect on forces."""
    low, high = datasets.force["finite_scan_ratio"].values.tolist()
    if high == 1:
        return []
    size = datasets.topography["scan_size"].item()
    search_size = datasets.force["search_size"].item()
    return [
        {
            "code": "small_scan",
            "size": Number("size", size, "nm"),
            "search_size": Number("search_size", search_size, "nm"),
            "share": Number("share", size / search_size),
            "ratio": bounds_only("ratio", low, high),
            "tried": Number(
                "tried", SMALLEST_TESTED if size / search_size < SMALLEST_TESTED else np.nan
            ),
        }
    ]


def _few_pixels(force: xr.Dataset) -> list[dict[str, Any]]:
    """Return a caution if few pixels, or only a part of a pixel, carry the preload."""
    area = float(force.attrs["contact_area"])
    pixel = force["pixel_area"].item()
    if area >= MIN_CONTACT_PIXELS * pixel:
        return []
    return [
        {
            "code": "few_pixels" if area >= pixel else "one_pixel",
            "area": Number("area", area, "nm2"),
            "pixel_area": Number("pixel_area", pixel, "nm2"),
            "pixels": Number("pixels", area / pixel),
        }
    ]


def _conditional_intervals(force: xr.Dataset) -> list[dict[str, Any]]:
    """Return a caution if intervals are conditional on the scans at hand."""
    has_no_interval = force["interval_source"].item() in ("none", "few_places")
    if not force["interval_is_conditional"].item() or has_no_interval:
        return []
    shared = number_of(force, "correlation_of_parts", name="correlation", strict=False)
    scans = int(force["interval_scans"].item())
    return [{"code": "conditional_intervals", "scans": scans, "correlation": shared}]


def _contradictions(spectra: xr.Dataset) -> list[dict[str, Any]]:
    """Return a caution about the two measurements that contradict each other most, if any do."""
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


def _excess_roughness(spectra: xr.Dataset) -> list[dict[str, Any]]:
    """Return a caution if the added roughness exceeds that in the scans, which may be smoothed."""
    q = spectra["bin_wavevector"].values
    shortest = spectra["shortest_measured"].item()
    wavelength = 2 * np.pi / q
    scans = measurements(spectra)
    is_resolved = wavelength >= MIN_WAVELENGTH_PIXELS * scans["pixel_size"].values[:, None]
    densities = np.where(is_resolved & np.isfinite(scans["psd"].values), scans["psd"].values, 0.0)
    scan_density = densities.max(axis=0, initial=0.0)
    added_density = np.interp(q, spectra["wavevector"].values, spectra["spectrum"].values)
    is_excess = (
        (wavelength < shortest)
        & (scan_density > 0)
        & (added_density > MAX_POWER_RATIO * scan_density)
    )
    if not is_excess.any():
        return []
    factor = float((added_density[is_excess] / scan_density[is_excess]).max())
    shortest_excess, longest_excess = (
        float(wavelength[is_excess].min()),
        float(wavelength[is_excess].max()),
    )
    return [
        {
            "code": "more_than_measured",
            "band": bounds_only("band", shortest_excess, longest_excess, "nm"),
            "factor": Number("factor", factor),
        }
    ]


def _extrapolations(datasets: Datasets) -> list[dict[str, Any]]:
    """Return the extrapolations of the spectrum below and above the wavelengths measured."""
    spectra = datasets.spectra
    topography = datasets.topography
    wavelength = 2 * np.pi / spectra["wavevector"].values[spectra["spectrum"].values > 0]
    shortest, longest = spectra["tail_fit_shortest"].item(), spectra["tail_fit_longest"].item()
    hurst = spectra["tail_hurst"].item()
    quantile = NormalDist().inv_cdf((1 + datasets.edges.attrs["confidence"]) / 2)
    half_width = quantile * spectra["tail_hurst_error"].item()
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
