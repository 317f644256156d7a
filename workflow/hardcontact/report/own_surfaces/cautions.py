"""Cautions about the answer of a surface: on its scans, spectrum, forces and intervals.

A caution is a code with numbers; the template own_caution.txt has the sentence for each code.
"""

from collections.abc import Iterator, Mapping
from statistics import NormalDist

import numpy as np
import xarray as xr

from hardcontact.base.number import Number, numbers_by_name
from hardcontact.contact.hertz_jkr_dmt import STRONGEST_WORK, Elasticity
from hardcontact.contact.numerical_limits import MIN_WINDOW_SHARE, SMALLEST_SIZE_RATIO
from hardcontact.inference.edges import EdgeStatus
from hardcontact.inference.scan_parts import IntervalSource
from hardcontact.report.own_surfaces.datasets import (
    Datasets,
    drop_padding,
    fails_hindcast,
    forces_at_range,
    measurement_name,
    split_measurements,
    stored_tabor_number,
)
from hardcontact.report.quantities import number_of, number_without_value
from hardcontact.scans.defects import DEFECT_UNITS, DEFECTS, defect_sentence
from hardcontact.scans.heights import split_notes
from hardcontact.scans.reliable_wavelengths import OTHER_BODY
from hardcontact.scans.scan_pairs import find_contradictions
from hardcontact.surfaces.synthesis import SIDES

#: Fewest pixels in contact: below, rounding to whole pixels may change the area by over 5 %.
MIN_CONTACT_PIXELS = 10
#: Largest ln(high / mean) relative to ln(mean / low) of a measured force without a caution.
#: If sites are few, the upper end is much farther, because they may scatter more than it seems.
MAX_LOPSIDEDNESS = 2.0
#: Pixels in the shortest wavelength that a scan resolves, by the sampling theorem.
NYQUIST_PIXELS = 2
#: Largest ratio of extrapolated power to that in the scans without a caution: a choice.
MAX_POWER_RATIO = 2.0
#: Codes of defects that may change the highest points, and thus the force.
MISLEADING_DEFECTS = frozenset({"streaks", "spikes", "equal_lines", "highest"})


class Caution:
    """A caution about the answer of one surface: a code, and the numbers and texts of its sentence.

    A grave one means that the force or the fit may be wrong by more than the tolerance.
    `measurement` is the number of the measurement with a defect, 0 for other cautions.
    """

    def __init__(
        self, code: str, *numbers: Number, grave: bool = False, measurement: int = 0, **texts: str
    ) -> None:
        self.code = code
        self.numbers = numbers_by_name(*numbers)
        self.grave = grave
        self.measurement = measurement
        self.texts = texts


def answer_cautions(surface_data: Datasets, numbers: Mapping[str, Number]) -> list[Caution]:
    """Return the cautions about the answer of one surface, the grave ones first."""
    has_ripples = (surface_data.edges["edge_status"] == EdgeStatus.RIPPLES).any()
    surface_cautions = [
        *_blind_scans_caution(surface_data),
        *_defect_cautions(surface_data.spectra, grave=True),
        *_scan_cautions(surface_data.spectra),
        *_contact_cautions(surface_data.force, numbers),
        *_small_scan_caution(surface_data),
        *_few_pixels_caution(surface_data.force),
        *_measured_force_cautions(numbers),
        *_interval_cautions(surface_data.force, numbers),
        *_defect_cautions(surface_data.spectra, grave=False),
        *_contradiction_caution(surface_data.spectra),
        *_excess_roughness_caution(surface_data.spectra),
        *_hindcast_cautions(surface_data),
        *([Caution("ripples")] if has_ripples else []),
        _tail_caution(surface_data),
        *_long_wave_caution(surface_data),
        *_small_window_caution(surface_data),
    ]
    return sorted(surface_cautions, key=lambda caution: not caution.grave)


def _contact_cautions(force: xr.Dataset, numbers: Mapping[str, Number]) -> Iterator[Caution]:
    """Yield cautions if few patches touch, bodies may be soft, or no solid has the fitted work."""
    if force["interval_source"].item() == IntervalSource.FEW_PATCHES:
        counts = [Number(name, int(force[name].item())) for name in ("contacts", "touched_patches")]
        yield Caution("few_patches", *counts, grave=True)
    tabor = stored_tabor_number(force)
    if tabor.status != Elasticity.HARD:
        yield Caution("soft_bodies", tabor._replace(name="tabor"), grave=True)
    work = numbers.get("measured_work")
    if work is not None and not work.value <= STRONGEST_WORK:
        yield Caution("strong_work", work._replace(name="work"), grave=True)


def _measured_force_cautions(numbers: Mapping[str, Number]) -> Iterator[Caution]:
    """Yield cautions if sites are too few to estimate their scatter, or sites seem repeated."""
    force = numbers.get("measured_force")
    if force is None:
        return
    rise, fall = np.log(force.high / force.value), np.log(force.value / force.low)
    if rise > MAX_LOPSIDEDNESS * fall:
        yield Caution("few_sites", numbers["measured_force_sites"]._replace(name="sites"))
    if numbers["measured_force_looks_repeated"].value:
        count = numbers["measured_force_count"]._replace(name="count")
        yield Caution("repeated_sites", count, grave=True)


def _interval_cautions(force: xr.Dataset, numbers: Mapping[str, Number]) -> Iterator[Caution]:
    """Yield cautions on the interval of the mean force: bound, scans, position on the sphere."""
    mean = numbers["mean_force"]
    if np.nanmax([mean.value, mean.high]) >= forces_at_range(force)["smooth_bound"].item():
        yield Caution("smooth_bound")
    if force["interval_source"].item() == IntervalSource.QUARTERS:
        scans = Number("scans", int(force["interval_scans"].item()))
        correlation = number_of(force, "correlation_of_parts", name="correlation")
        yield Caution("conditional_intervals", scans, correlation)
    if "position_factor" in numbers:
        yield Caution("sphere_positions", numbers["position_factor"]._replace(name="factor"))


def _small_window_caution(surface_data: Datasets) -> Iterator[Caution]:
    """Yield a caution if the window holds too little of the force at any range of adhesion."""
    shares = surface_data.force["window_share"]
    answer_share = forces_at_range(surface_data.force)["window_share"]
    small_shares = shares[shares < MIN_WINDOW_SHARE]
    if not small_shares.size:
        return
    lowers_answer = answer_share.item() < MIN_WINDOW_SHARE
    # The share falls with the range of adhesion, so that the longest range has the smallest.
    shown_share = answer_share if lowers_answer else shares.sel(rho=shares["rho"].max())
    shortest_low_range = np.nan if lowers_answer else small_shares["rho"].min().item()
    yield Caution(
        "window",
        Number("share", shown_share.item()),
        Number("window", float(surface_data.force.attrs["window"]), "nm"),
        Number("range", shown_share["rho"].item(), "nm"),
        Number("shortest_low_range", shortest_low_range, "nm"),
        grave=answer_share.item() < 1 - surface_data.edges.attrs["tolerance"],
    )


def _small_scan_caution(surface_data: Datasets) -> Iterator[Caution]:
    """Yield a caution if scans are smaller than contacts need, with the effect on the force."""
    low, high = surface_data.force["finite_scan_ratio"].values.tolist()
    if high == 1:
        return
    size = number_of(surface_data.topography, "scan_size", "nm", name="size")
    search_size = number_of(surface_data.force, "search_size", "nm")
    share = size.value / search_size.value
    numbers = [size, search_size, Number("share", share), number_without_value("ratio", low, high)]
    if share < SMALLEST_SIZE_RATIO:
        numbers.append(Number("smallest_share", SMALLEST_SIZE_RATIO))
    yield Caution("small_scan", *numbers, grave=low > 1 + surface_data.edges.attrs["tolerance"])


def _few_pixels_caution(force: xr.Dataset) -> Iterator[Caution]:
    """Yield a caution if few pixels, or only a part of a pixel, carry the preload."""
    area = float(force.attrs["contact_area"])
    pixel = force["pixel_area"].item()
    if area >= MIN_CONTACT_PIXELS * pixel:
        return
    areas = Number("area", area, "nm2"), Number("pixel_area", pixel, "nm2")
    yield Caution("few_pixels", *areas, Number("pixels", area / pixel), grave=area < pixel)


def _hindcast_cautions(surface_data: Datasets) -> Iterator[Caution]:
    """Yield a caution on the hindcast of each side that has one, grave if it fails.

    If no octave could be tested at either side, one caution, "hindcast", has the numbers of both.
    """
    force = surface_data.force
    if "hindcast_ratio" not in force or force["hindcast_fails"].isnull().all():
        return
    ratios = [number_of(force.sel(side=side), "hindcast_ratio", name="ratio") for side in SIDES]
    starts = [number_of(force.sel(side=side), "transition", "nm", name="start") for side in SIDES]
    sides = list(zip(SIDES, ratios, starts, strict=True))
    if force["hindcast_ratio"].isnull().all():
        side_numbers = [
            number._replace(name=f"{side}_{number.name}")
            for side, *numbers in sides
            for number in numbers
        ]
        yield Caution("hindcast", *side_numbers, grave=True)
        return
    for side, ratio, start in sides:
        fails = fails_hindcast(surface_data, side)
        yield Caution(f"hindcast_{side}", ratio, start, grave=fails, side=side)


def _blind_scans_caution(surface_data: Datasets) -> Iterator[Caution]:
    """Yield a caution if the maps on which contacts are made are reliable nowhere."""
    scans = drop_padding(surface_data.spectra)
    makes_contacts = (scans["kind"].values.astype(str) == "map") & np.isclose(
        scans["pixel_size"].values ** 2, surface_data.force["pixel_area"].item()
    )
    # Where the other body is rougher, a map need not be reliable.
    makes_contacts &= scans["limited_by"].values.astype(str) != OTHER_BODY
    is_reliable = (scans["reliable"].values == 1).any(axis=1)
    if makes_contacts.any() and not is_reliable[makes_contacts].any():
        yield Caution("blind_scans", grave=True)


def _defect_cautions(spectra: xr.Dataset, *, grave: bool) -> Iterator[Caution]:
    """Yield a caution for each defect in MISLEADING_DEFECTS if grave, else for each other."""
    for index, scan in enumerate(split_measurements(spectra), start=1):
        for code, names in DEFECTS.items():
            values = {name: scan[name].item() for name in names}
            if (code in MISLEADING_DEFECTS) != grave or not np.isfinite([*values.values()]).all():
                continue
            numbers = [
                Number(name, values[name], DEFECT_UNITS[name], source="file") for name in names
            ]
            texts = {"scan": measurement_name(scan), "sentence": defect_sentence(code, values)}
            yield Caution(code, *numbers, grave=grave, measurement=index, **texts)


def _scan_cautions(spectra: xr.Dataset) -> Iterator[Caution]:
    """Yield the cautions in the notes of each file, and on scans that repeat an earlier scan."""
    for scan in split_measurements(spectra):
        name = measurement_name(scan)
        _, sentences = split_notes(str(scan["notes"].item()).splitlines())
        for sentence in sentences:
            yield Caution("reading", scan=name, sentence=sentence)
        if earlier := str(scan["earlier_scan"].item()):
            yield Caution("repeated_scan", grave=True, scan=name, earlier=earlier)


def _contradiction_caution(spectra: xr.Dataset) -> Iterator[Caution]:
    """Yield a caution about the two measurements that contradict each other most, if any do."""
    scans = drop_padding(spectra)
    contradictions = find_contradictions(
        scans["psd"].values, scans["reliable"].values, scans["kind"].values, scans["size"].values
    )
    if not contradictions:
        return
    worst = contradictions[0]
    names = [measurement_name(scan) for scan in split_measurements(scans)]
    yield Caution(
        "contradiction",
        number_without_value("band", *worst.wavelengths, "nm"),
        Number("factor", worst.factor),
        Number("more_pairs", len(contradictions) - 1),
        higher=names[worst.higher],
        lower=names[worst.lower],
    )


def _excess_roughness_caution(spectra: xr.Dataset) -> Iterator[Caution]:
    """Yield a caution if extrapolated power exceeds MAX_POWER_RATIO times that in the scans."""
    q = spectra["bin_wavevector"].values
    wavelength = 2 * np.pi / q
    scans = drop_padding(spectra)
    is_resolved = wavelength >= NYQUIST_PIXELS * scans["pixel_size"].values[:, None]
    densities = np.where(is_resolved & np.isfinite(scans["psd"].values), scans["psd"].values, 0.0)
    scan_density = densities.max(axis=0, initial=0.0)
    used_density = np.interp(q, spectra["wavevector"].values, spectra["spectrum"].values)
    is_short = wavelength < spectra["shortest_measured"].item()
    is_excess = is_short & (scan_density > 0) & (used_density > MAX_POWER_RATIO * scan_density)
    if not is_excess.any():
        return
    shortest, longest = wavelength[is_excess].min(), wavelength[is_excess].max()
    factor = (used_density[is_excess] / scan_density[is_excess]).max()
    wavelengths = number_without_value("band", float(shortest), float(longest), "nm")
    yield Caution("more_than_measured", wavelengths, Number("factor", float(factor)))


def _tail_caution(surface_data: Datasets) -> Caution:
    """Return the caution on the extrapolation of the spectrum to short wavelengths."""
    spectra = surface_data.spectra
    wavelength = 2 * np.pi / spectra["wavevector"].values[spectra["spectrum"].values > 0]
    quantile = NormalDist().inv_cdf((1 + surface_data.edges.attrs["confidence"]) / 2)
    hurst = spectra["tail_hurst"].item()
    half_width = quantile * spectra["tail_hurst_error"].item()
    low, high = max(hurst - half_width, 0.0), min(hurst + half_width, 1.0)
    shortest, longest = spectra["tail_fit_shortest"].item(), spectra["tail_fit_longest"].item()
    return Caution(
        "tail",
        Number("hurst", hurst, "1", low, high, source="extrapolated"),
        Number("exponent_known", int(spectra["tail_known"].item() == 1)),
        number_without_value("fitted_band", shortest, longest, "nm"),
        Number("spectrum_end", float(wavelength.min()), "nm"),
        ended_by=spectra["tail_ended_by"].item(),
    )


def _long_wave_caution(surface_data: Datasets) -> Iterator[Caution]:
    """Yield a caution on the extrapolation of the spectrum to long wavelengths, if any."""
    rolloff = surface_data.spectra["rolloff"].item()
    if not np.isfinite(rolloff):
        return
    numbers = [
        Number("rolloff", rolloff, "nm", source="extrapolated"),
        number_of(surface_data.spectra, "longest_measured", "nm"),
    ]
    if "sphere_share" not in surface_data.spectra:  # Otherwise the spectrum is of both bodies.
        numbers += [
            Number("scan_rms_height", float(surface_data.topography["rms_height"].mean()), "nm"),
            number_of(surface_data.topography, "all_scales_rms_height", "nm"),
        ]
    yield Caution("long_waves", *numbers)
