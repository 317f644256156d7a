"""Cautions about the answer of a surface, and those on its forces, tests and intervals.

A caution is a code with numbers; the template own_caution.txt has the sentence for each code.
"""

from collections.abc import Mapping

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
from hardcontact.theory.assumptions import Elasticity

#: Fewest pixels in contact: below, rounding to whole pixels may change the area by over 5 %.
MIN_CONTACT_PIXELS = 10
#: Largest ln(high / mean) relative to ln(mean / low) of a measured force without a caution.
#: If tests are few, the upper end is much farther, because they may scatter more than it seems.
MAX_LOPSIDEDNESS = 2.0


def cautions(data: Datasets, numbers: Mapping[str, Number]) -> list[Caution]:
    """Return the cautions about the answer of one surface, the grave ones first.

    The numbers of edges and forces are by name.
    """
    possible_cautions = [
        spectrum_cautions.blind_scans_caution(data),
        *spectrum_cautions.defect_cautions(data.spectra, grave=True),
        *spectrum_cautions.reading_cautions(data.spectra),
        *spectrum_cautions.repeated_scan_cautions(data.spectra),
        _few_patches_caution(data.force),
        _soft_bodies_caution(data.force),
        _strong_work_caution(numbers),
        _small_scan_caution(data),
        _few_pixels_caution(data.force),
        _few_tests_caution(numbers),
        _repeated_tests_caution(numbers),
        _smooth_bound_caution(data.force, numbers),
        _conditional_intervals_caution(data.force),
        _sphere_positions_caution(numbers),
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


def _few_patches_caution(force: xr.Dataset) -> Caution | None:
    """Return a caution if the contacts on a scan touch too few patches for an interval."""
    if force["interval_source"].item() != IntervalSource.FEW_PATCHES:
        return None
    numbers = [Number(name, int(force[name].item())) for name in ("contacts", "touched_patches")]
    return Caution("few_patches", *numbers, grave=True)


def _soft_bodies_caution(force: xr.Dataset) -> Caution | None:
    """Return a caution if the bodies are, or may be, too soft for a hard contact."""
    number = stored_tabor_number(force)
    if number.status == Elasticity.HARD:
        return None
    return Caution("soft_bodies", number._replace(name="tabor"), grave=True)


def _strong_work_caution(numbers: Mapping[str, Number]) -> Caution | None:
    """Return a caution if a measured force needs more work of adhesion than any solid has."""
    work = numbers.get("measured_work")
    if work is None or work.value <= STRONGEST_WORK:
        return None
    return Caution("strong_work", work._replace(name="work"), grave=True)


def _few_tests_caution(numbers: Mapping[str, Number]) -> Caution | None:
    """Return a caution if the tests are too few for an estimate of their scatter."""
    force = numbers.get("measured_force")
    if force is None:
        return None
    above, below = np.log(force.high / force.value), np.log(force.value / force.low)
    if not above > MAX_LOPSIDEDNESS * below:
        return None
    return Caution("few_tests", numbers["measured_force_sites"]._replace(name="tests"))


def _repeated_tests_caution(numbers: Mapping[str, Number]) -> Caution | None:
    """Return a caution if tests look as if several were made at one site."""
    repeated = numbers.get("measured_force_looks_repeated")
    if repeated is None or not repeated.value:
        return None
    tests = numbers["measured_force_tests"]._replace(name="tests")
    return Caution("repeated_tests", tests, grave=True)


def _smooth_bound_caution(force: xr.Dataset, numbers: Mapping[str, Number]) -> Caution | None:
    """Return a caution if the mean force, or its upper end, is as high as on a smooth sphere."""
    mean = numbers["mean_force"]
    is_bounded = np.nanmax([mean.value, mean.high]) >= forces_at_range(force)["smooth_bound"].item()
    return Caution("smooth_bound") if is_bounded else None


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


def _conditional_intervals_caution(force: xr.Dataset) -> Caution | None:
    """Return a caution if intervals are conditional on the scans at hand."""
    if force["interval_source"].item() != IntervalSource.QUARTERS:
        return None
    scans = Number("scans", int(force["interval_scans"].item()))
    correlation = number_of(force, "correlation_of_parts", name="correlation")
    return Caution("conditional_intervals", scans, correlation)


def _sphere_positions_caution(numbers: Mapping[str, Number]) -> Caution | None:
    """Return a caution on the unknown position of a rough sphere, which changes the force."""
    if "position_factor" not in numbers:
        return None
    return Caution("sphere_positions", numbers["position_factor"]._replace(name="factor"))


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
