"""Cautions about the answer of a surface, as codes with numbers: scans, pixels, intervals.

The template own_caution.txt has the sentence for each code.
"""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from statistics import NormalDist

import numpy as np
import xarray as xr

from hardcontact.base.number import Number, Status
from hardcontact.contact.finite_scan import MIN_WINDOW_SHARE, SMALLEST_SIZE_RATIO
from hardcontact.contact.hertz_jkr_dmt import STRONGEST_WORK
from hardcontact.report.own_surfaces.artificial_roughness import (
    fails_hindcast,
    measurement_name,
    split_scans,
    without_padding,
)
from hardcontact.report.own_surfaces.datasets import Datasets, forces_at_range, stored_tabor_number
from hardcontact.report.quantities import number_of, number_without_value
from hardcontact.scans.defect_sentences import defect_sentence
from hardcontact.scans.defects import DEFECTS
from hardcontact.scans.heights import split_notes
from hardcontact.scans.mean_spectrum import find_contradictions
from hardcontact.scans.reliable_band import OTHER_BODY
from hardcontact.surfaces.synthesis import SIDES

#: Fewest pixels in contact: below, rounding to whole pixels may change the area by over 5 %.
MIN_CONTACT_PIXELS = 10
#: Number of pixels in the shortest wavelength of a scan.
NYQUIST_PIXELS = 2
#: Largest ratio of added power to the power in the scans without a caution.
MAX_POWER_RATIO = 2.0
#: Largest ln(high / mean) relative to ln(mean / low) of a measured force without a caution.
#: If tests are few, the upper end is much farther, because they may scatter more than it seems.
MAX_LOPSIDEDNESS = 2.0
#: Codes of defects that change the highest points, and thus the force.
MISLEADING_DEFECTS = frozenset({"spikes", "equal_lines", "highest"})


@dataclass(frozen=True)
class Caution:
    """A caution about the answer of one surface."""

    code: str  #: What makes the answer less sure.
    grave: bool = False  #: Whether it changes the force by more than the tolerance of the band.
    numbers: dict[str, Number] = field(default_factory=dict)  #: In its sentence, by name.
    texts: dict[str, str] = field(default_factory=dict)  #: In its sentence, by name.
    measurement: int = 0  #: Number of the measurement with the defect; 0 for other cautions.


def cautions(data: Datasets, numbers: Mapping[str, Number]) -> list[Caution]:
    """Return the cautions about the answer of one surface, the grave ones first.

    The numbers of edges and forces are given by name.
    """
    possible_cautions = [
        _blind_scans(data),
        *_defect_cautions(data.spectra, MISLEADING_DEFECTS, grave=True),
        *_reading_cautions(data.spectra),
        *_repeated_scan_cautions(data.spectra),
        _few_patches(data.force),
        _soft_bodies(data.force),
        _strong_work(numbers),
        _small_scans(data),
        _few_pixels(data.force),
        _few_tests(numbers),
        _repeated_tests(numbers),
        _smooth_bound(data.force, numbers),
        _conditional_intervals(data.force),
        _sphere_positions(numbers),
        *_defect_cautions(data.spectra, set(DEFECTS) - MISLEADING_DEFECTS, grave=False),
        _contradiction(data.spectra),
        _excess_roughness(data.spectra),
        *_hindcast_cautions(data),
        Caution("ripples") if (data.edges["edge_status"] == Status.RIPPLES).any() else None,
        _tail_caution(data),
        _long_wave_caution(data),
        _small_window(data),
    ]
    surface_cautions = [caution for caution in possible_cautions if caution is not None]
    return sorted(surface_cautions, key=lambda caution: not caution.grave)


def _blind_scans(data: Datasets) -> Caution | None:
    """Return a caution if the scans in contact are reliable nowhere.

    These scans are the maps with the pixels of the computed contacts.
    """
    scans = without_padding(data.spectra)
    makes_contacts = (scans["kind"].values.astype(str) == "map") & np.isclose(
        scans["pixel_size"].values ** 2, data.force["pixel_area"].item()
    )
    is_reliable = (scans["reliable"].values == 1).any(axis=1)
    makes_contacts &= scans["limited_by"].values.astype(str) != OTHER_BODY
    is_blind = makes_contacts.any() and not is_reliable[makes_contacts].any()
    return Caution("blind_scans", grave=True) if is_blind else None


def _defect_cautions(spectra: xr.Dataset, codes: Collection[str], *, grave: bool) -> list[Caution]:
    """Return the defects with these codes in the measurements of a surface, with sentences."""
    defects = []
    for index, measurement in enumerate(split_scans(without_padding(spectra)), start=1):
        for code in codes:
            numbers = {
                name: Number(name, measurement[name].item(), unit, source="file")
                for name, unit in DEFECTS[code].items()
            }
            values = {name: number.value for name, number in numbers.items()}
            if np.isfinite(list(values.values())).all():
                sentence = f"{measurement_name(measurement)}: {defect_sentence(code, values)}"
                defects.append(Caution(code, grave, numbers, {"sentence": sentence}, index))
    return defects


def _reading_cautions(spectra: xr.Dataset) -> list[Caution]:
    """Return the cautions of the reader of each measurement, as sentences."""
    return [
        Caution("reading", texts={"sentence": f"{measurement_name(measurement)}: {line}"})
        for measurement in split_scans(without_padding(spectra))
        for line in split_notes(str(measurement["notes"].item()).splitlines())[1]
    ]


def _repeated_scan_cautions(spectra: xr.Dataset) -> list[Caution]:
    """Return a caution for each scan of an area that an earlier scan shows."""
    return [
        Caution(
            "repeated_scan",
            grave=True,
            texts={
                "scan": measurement_name(measurement),
                "first": str(measurement["earlier_scan"].item()),
            },
        )
        for measurement in split_scans(without_padding(spectra))
        if measurement["earlier_scan"].item()
    ]


def _few_patches(force: xr.Dataset) -> Caution | None:
    """Return a caution if the contacts on a scan touch too few patches for an interval."""
    if force["interval_source"].item() != Status.FEW_PATCHES:
        return None
    names = ("contacts", "touched_patches")
    numbers = {name: Number(name, int(force[name].item())) for name in names}
    return Caution("few_patches", grave=True, numbers=numbers)


def _soft_bodies(force: xr.Dataset) -> Caution | None:
    """Return a caution if the bodies are, or may be, too soft for a hard contact."""
    number = stored_tabor_number(force)
    if number.status == Status.HARD:
        return None
    return Caution("soft_bodies", grave=True, numbers={"tabor": number})


def _strong_work(numbers: Mapping[str, Number]) -> Caution | None:
    """Return a caution if a measured force needs more work of adhesion than any solid has."""
    work = numbers.get("measured_work")
    if work is None or work.value <= STRONGEST_WORK:
        return None
    return Caution("strong_work", grave=True, numbers={"work": work})


def _few_tests(numbers: Mapping[str, Number]) -> Caution | None:
    """Return a caution if the tests are too few for an estimate of their scatter."""
    force = numbers.get("measured_force")
    if force is None:
        return None
    above, below = np.log(force.high / force.value), np.log(force.value / force.low)
    if not above > MAX_LOPSIDEDNESS * below:
        return None
    return Caution("few_tests", numbers={"tests": numbers["measured_force_sites"]})


def _repeated_tests(numbers: Mapping[str, Number]) -> Caution | None:
    """Return a caution if tests look as if several were made at one site."""
    repeated = numbers.get("measured_force_looks_repeated")
    if repeated is None or not repeated.value:
        return None
    return Caution("repeated_tests", True, {"tests": numbers["measured_force_tests"]})


def _smooth_bound(force: xr.Dataset, numbers: Mapping[str, Number]) -> Caution | None:
    """Return a caution if the mean force, or its upper end, is as high as on a smooth sphere."""
    mean = numbers["mean_force"]
    is_bounded = np.nanmax([mean.value, mean.high]) >= forces_at_range(force)["smooth_bound"].item()
    return Caution("smooth_bound") if is_bounded else None


def _small_window(data: Datasets) -> Caution | None:
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
    numbers = {
        "share": Number("share", shown_share.item()),
        "window": Number("window", float(data.force.attrs["window"]), "nm"),
        "at": Number("at", shown_share["rho"].item(), "nm"),
        "from": Number("from", first_range, "nm"),
    }
    # Attributes of a dataset are NumPy numbers, whose comparisons JSON does not know.
    is_grave = bool(answer_share.item() < 1 - data.edges.attrs["tolerance"])
    return Caution("window", is_grave, numbers)


def _small_scans(data: Datasets) -> Caution | None:
    """Return a caution if scans are smaller than contacts need, with the effect on the force."""
    low, high = data.force["finite_scan_ratio"].values.tolist()
    if high == 1:
        return None
    size = number_of(data.topography, "scan_size", "nm", name="size")
    search_size = number_of(data.force, "search_size", "nm")
    share = size.value / search_size.value
    numbers = {
        "size": size,
        "search_size": search_size,
        "share": Number("share", share),
        "ratio": number_without_value("ratio", low, high),
    }
    if share < SMALLEST_SIZE_RATIO:
        numbers["tried"] = Number("tried", SMALLEST_SIZE_RATIO)
    return Caution("small_scan", bool(low > 1 + data.edges.attrs["tolerance"]), numbers)


def _few_pixels(force: xr.Dataset) -> Caution | None:
    """Return a caution if few pixels, or only a part of a pixel, carry the preload."""
    area = float(force.attrs["contact_area"])
    pixel = force["pixel_area"].item()
    if area >= MIN_CONTACT_PIXELS * pixel:
        return None
    numbers = {
        "area": Number("area", area, "nm2"),
        "pixel_area": Number("pixel_area", pixel, "nm2"),
        "pixels": Number("pixels", area / pixel),
    }
    return Caution("few_pixels", bool(area < pixel), numbers)


def _conditional_intervals(force: xr.Dataset) -> Caution | None:
    """Return a caution if intervals are conditional on the scans at hand."""
    if force["interval_source"].item() != Status.QUARTERS:
        return None
    numbers = {
        "scans": Number("scans", int(force["interval_scans"].item())),
        "correlation": number_of(force, "correlation_of_parts"),
    }
    return Caution("conditional_intervals", numbers=numbers)


def _sphere_positions(numbers: Mapping[str, Number]) -> Caution | None:
    """Return a caution on the unknown position of a rough sphere, which changes the force."""
    if "position_factor" not in numbers:
        return None
    return Caution("sphere_positions", numbers={"factor": numbers["position_factor"]})


def _contradiction(spectra: xr.Dataset) -> Caution | None:
    """Return a caution about the two measurements that contradict each other most, if any do."""
    scans = without_padding(spectra)
    arrays = [scans[name].values for name in ("psd", "reliable", "kind", "size")]
    contradictions = find_contradictions(*arrays)
    if not contradictions:
        return None
    worst = contradictions[0]
    numbers = {
        "band": number_without_value("band", worst.shortest, worst.longest, "nm"),
        "factor": Number("factor", worst.factor),
        "others": Number("others", len(contradictions) - 1),
    }
    texts = {
        "higher": measurement_name(scans.isel(measurement=worst.higher)),
        "lower": measurement_name(scans.isel(measurement=worst.lower)),
    }
    return Caution("contradiction", numbers=numbers, texts=texts)


def _excess_roughness(spectra: xr.Dataset) -> Caution | None:
    """Return a caution if the added roughness exceeds that in the scans, which may be smoothed."""
    q = spectra["bin_wavevector"].values
    wavelength = 2 * np.pi / q
    scans = without_padding(spectra)
    is_resolved = wavelength >= NYQUIST_PIXELS * scans["pixel_size"].values[:, None]
    densities = np.where(is_resolved & np.isfinite(scans["psd"].values), scans["psd"].values, 0.0)
    scan_density = densities.max(axis=0, initial=0.0)
    added_density = np.interp(q, spectra["wavevector"].values, spectra["spectrum"].values)
    is_added = wavelength < spectra["shortest_measured"].item()
    is_excess = is_added & (scan_density > 0) & (added_density > MAX_POWER_RATIO * scan_density)
    if not is_excess.any():
        return None
    shortest, longest = wavelength[is_excess].min(), wavelength[is_excess].max()
    factor = (added_density[is_excess] / scan_density[is_excess]).max()
    numbers = {
        "band": number_without_value("band", float(shortest), float(longest), "nm"),
        "factor": Number("factor", float(factor)),
    }
    return Caution("more_than_measured", numbers=numbers)


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
            numbers = {"ratio": ratio, "start": number_of(force, "transition", "nm", name="start")}
            side_cautions.append(Caution(f"hindcast_{side}", fails, numbers, {"side": side}))
    return side_cautions


def _tail_caution(data: Datasets) -> Caution:
    """Return the caution on the extrapolation of the spectrum to short wavelengths."""
    spectra = data.spectra
    wavelength = 2 * np.pi / spectra["wavevector"].values[spectra["spectrum"].values > 0]
    quantile = NormalDist().inv_cdf((1 + data.edges.attrs["confidence"]) / 2)
    hurst = spectra["tail_hurst"].item()
    half_width = quantile * spectra["tail_hurst_error"].item()
    low, high = max(hurst - half_width, 0.0), min(hurst + half_width, 1.0)
    shortest, longest = spectra["tail_fit_shortest"].item(), spectra["tail_fit_longest"].item()
    numbers = {
        "hurst": Number("hurst", hurst, "1", low, high, source="extrapolated"),
        "known": Number("known", int(spectra["tail_known"].item() == 1)),
        "fitted": number_without_value("fitted", shortest, longest, "nm"),
        "ends_at": Number("ends_at", float(wavelength.min()), "nm"),
    }
    return Caution("tail", numbers=numbers, texts={"ended_by": spectra["tail_ended_by"].item()})


def _long_wave_caution(data: Datasets) -> Caution | None:
    """Return a caution on the extrapolation of the spectrum to long wavelengths, if any."""
    rolloff = data.spectra["rolloff"].item()
    if not np.isfinite(rolloff):
        return None
    numbers = {
        "rolloff": Number("rolloff", rolloff, "nm", source="extrapolated"),
        "above": number_of(data.spectra, "longest_measured", "nm"),
    }
    if "sphere_share" not in data.spectra:  # Otherwise the spectrum is of both bodies.
        numbers |= {
            "of_scans": Number("of_scans", float(data.topography["rms_height"].mean()), "nm"),
            "all_scales": number_of(data.topography, "all_scales_rms_height", "nm"),
        }
    return Caution("long_waves", numbers=numbers)
