"""Cautions about the answer of a surface, and those on its forces, tests and intervals.

A caution is a code with numbers; the template own_caution.txt has the sentence for each code.
"""

from collections.abc import Iterator, Mapping

import numpy as np
import xarray as xr

from hardcontact.base.number import Number
from hardcontact.contact.hertz_jkr_dmt import STRONGEST_WORK
from hardcontact.contact.numerical_limits import MIN_WINDOW_SHARE, SMALLEST_SIZE_RATIO
from hardcontact.inference.edges import EdgeStatus
from hardcontact.inference.scan_parts import IntervalSource
from hardcontact.report.own_surfaces import spectrum_cautions
from hardcontact.report.own_surfaces.datasets import (
    Datasets,
    fails_hindcast,
    forces_at_range,
    stored_tabor_number,
)
from hardcontact.report.own_surfaces.spectrum_cautions import Caution
from hardcontact.report.quantities import number_of, number_without_value
from hardcontact.surfaces.synthesis import SIDES
from hardcontact.theory.validity import Elasticity

#: Fewest pixels in contact: below, rounding to whole pixels may change the area by over 5 %.
MIN_CONTACT_PIXELS = 10
#: Largest ln(high / mean) relative to ln(mean / low) of a measured force without a caution.
#: If tests are few, the upper end is much farther, because they may scatter more than it seems.
MAX_LOPSIDEDNESS = 2.0


def answer_cautions(data: Datasets, numbers: Mapping[str, Number]) -> list[Caution]:
    """Return the cautions about the answer of one surface, the grave ones first."""
    possible_cautions = [
        spectrum_cautions.blind_scans_caution(data),
        *spectrum_cautions.defect_cautions(data.spectra, grave=True),
        *spectrum_cautions.reading_cautions(data.spectra),
        *spectrum_cautions.repeated_scan_cautions(data.spectra),
        *_contact_cautions(data.force, numbers),
        _small_scan_caution(data),
        _few_pixels_caution(data.force),
        *_test_cautions(numbers),
        *_interval_cautions(data.force, numbers),
        *spectrum_cautions.defect_cautions(data.spectra, grave=False),
        spectrum_cautions.contradiction_caution(data.spectra),
        spectrum_cautions.excess_roughness_caution(data.spectra),
        *_hindcast_cautions(data),
        Caution("ripples") if (data.edges["edge_status"] == EdgeStatus.RIPPLES).any() else None,
        spectrum_cautions.tail_caution(data),
        spectrum_cautions.long_wave_caution(data),
        _small_window_caution(data),
    ]
    surface_cautions = [caution for caution in possible_cautions if caution is not None]
    return sorted(surface_cautions, key=lambda caution: not caution.grave)


def _contact_cautions(force: xr.Dataset, numbers: Mapping[str, Number]) -> Iterator[Caution]:
    """Yield cautions if few patches are touched, or bodies are too soft, or stick like no solid."""
    if force["interval_source"].item() == IntervalSource.FEW_PATCHES:
        counts = [Number(name, int(force[name].item())) for name in ("contacts", "touched_patches")]
        yield Caution("few_patches", *counts, grave=True)
    tabor = stored_tabor_number(force)
    if tabor.status != Elasticity.HARD:
        yield Caution("soft_bodies", tabor._replace(name="tabor"), grave=True)
    work = numbers.get("measured_work")
    if work is not None and not work.value <= STRONGEST_WORK:
        yield Caution("strong_work", work._replace(name="work"), grave=True)


def _test_cautions(numbers: Mapping[str, Number]) -> Iterator[Caution]:
    """Yield cautions if tests are too few to estimate their scatter, or seem to repeat a site."""
    force = numbers.get("measured_force")
    if force is None:
        return
    rise, fall = np.log(force.high / force.value), np.log(force.value / force.low)
    if rise > MAX_LOPSIDEDNESS * fall:
        yield Caution("few_tests", numbers["measured_force_sites"]._replace(name="tests"))
    if numbers["measured_force_looks_repeated"].value:
        tests = numbers["measured_force_tests"]._replace(name="tests")
        yield Caution("repeated_tests", tests, grave=True)


def _interval_cautions(force: xr.Dataset, numbers: Mapping[str, Number]) -> Iterator[Caution]:
    """Yield cautions on the interval of the mean force: bounds, scans, positions on the sphere."""
    mean = numbers["mean_force"]
    if np.nanmax([mean.value, mean.high]) >= forces_at_range(force)["smooth_bound"].item():
        yield Caution("smooth_bound")
    if force["interval_source"].item() == IntervalSource.QUARTERS:
        scans = Number("scans", int(force["interval_scans"].item()))
        correlation = number_of(force, "correlation_of_parts", name="correlation")
        yield Caution("conditional_intervals", scans, correlation)
    if "position_factor" in numbers:
        yield Caution("sphere_positions", numbers["position_factor"]._replace(name="factor"))


def _small_window_caution(data: Datasets) -> Caution | None:
    """Return a caution if the window holds too little of the force at any range of adhesion."""
    shares = data.force["window_share"]
    answer_share = forces_at_range(data.force)["window_share"]
    small_shares = shares[shares < MIN_WINDOW_SHARE]
    if not small_shares.size:
        return None
    lowers_answer = answer_share.item() < MIN_WINDOW_SHARE
    # The share falls with the range of adhesion, so that the longest range has the smallest.
    shown_share = answer_share if lowers_answer else shares.sel(rho=shares["rho"].max())
    first_range = np.nan if lowers_answer else small_shares["rho"].min().item()
    return Caution(
        "window",
        Number("share", shown_share.item()),
        Number("window", float(data.force.attrs["window"]), "nm"),
        Number("range", shown_share["rho"].item(), "nm"),
        Number("shortest_low_range", first_range, "nm"),
        grave=answer_share.item() < 1 - data.edges.attrs["tolerance"],
    )


def _small_scan_caution(data: Datasets) -> Caution | None:
    """Return a caution if scans are smaller than contacts need, with the effect on the force."""
    low, high = data.force["finite_scan_ratio"].values.tolist()
    if high == 1:
        return None
    size = number_of(data.topography, "scan_size", "nm", name="size")
    search_size = number_of(data.force, "search_size", "nm")
    share = size.value / search_size.value
    ratio = number_without_value("ratio", low, high)
    numbers = [size, search_size, Number("share", share), ratio]
    if share < SMALLEST_SIZE_RATIO:
        numbers.append(Number("smallest_share", SMALLEST_SIZE_RATIO))
    return Caution("small_scan", *numbers, grave=low > 1 + data.edges.attrs["tolerance"])


def _few_pixels_caution(force: xr.Dataset) -> Caution | None:
    """Return a caution if few pixels, or only a part of a pixel, carry the preload."""
    area = float(force.attrs["contact_area"])
    pixel = force["pixel_area"].item()
    if area >= MIN_CONTACT_PIXELS * pixel:
        return None
    return Caution(
        "few_pixels",
        Number("area", area, "nm2"),
        Number("pixel_area", pixel, "nm2"),
        Number("pixels", area / pixel),
        grave=area < pixel,
    )


def _hindcast_cautions(data: Datasets) -> list[Caution]:
    """Return a caution with the hindcast ratio of each side, grave if the hindcast fails."""
    if "hindcast_ratio" not in data.force:
        return []
    side_cautions = []
    for side in SIDES:
        force = data.force.sel(side=side)
        ratio = number_of(force, "hindcast_ratio", name="ratio")
        fails = fails_hindcast(data, side)
        if fails or np.isfinite(ratio.value):
            start = number_of(force, "transition", "nm", name="start")
            side_cautions.append(Caution(f"hindcast_{side}", ratio, start, grave=fails, side=side))
    return side_cautions
