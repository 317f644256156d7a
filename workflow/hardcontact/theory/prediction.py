"""Predictions of the closed form for a spectrum: numbers with units, intervals and statuses.

The errors come from designed surfaces with computed forces and edges. Only the half of these
surfaces counts that was held out while the closed form was developed (`held_out_surfaces`).
"""

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from hardcontact.base.formatting import format_length
from hardcontact.base.number import Number
from hardcontact.contact.contact import Contact
from hardcontact.surfaces.extrapolated_spectrum import extrapolate_short_waves, fit_hurst_exponent
from hardcontact.surfaces.joined_spectrum import ScanSpectrum
from hardcontact.surfaces.measured_spectrum import CALIBRATION_SCATTER
from hardcontact.surfaces.spectrum import MIN_BINS, WAVEVECTORS, Spectrum, all_scales_rms
from hardcontact.theory.closed_form import ClosedForm, closed_form, critical_band, smooth_force
from hardcontact.theory.pull_off_statistics import predict_statistics
from hardcontact.theory.validity import (
    EDGE_FOUND,
    INSIDE,
    MAX_NEGLIGIBLE_CHANGE,
    NO_EDGE,
    OUTSIDE,
    UNKNOWN,
    VALIDATED_QUANTITIES,
    is_validated,
    nearest_errors,
    table_coordinates,
    validated_ranges,
)

#: Smallest accepted rms height in nm: a tenth of an atom.
MIN_RMS_HEIGHT = 0.01
#: Largest ratio of neighbouring wavelengths: the spectrum may bend unnoticed in a wider gap.
MAX_WAVELENGTH_RATIO = 4.0
#: Largest skewness of heights that count as Gaussian. Of 240 self-affine maps, with roll-offs of up
#: to four times their size, none had 0.7. On bumps with a skewness of 1 the closed form was 7 to 15
#: times too high, on pores with -3 it was 3 times too low.
MAX_SKEWNESS = 1.0
#: The edges of the band among the predicted quantities.
EDGE_NAMES = VALIDATED_QUANTITIES[1:]
MATTERS, NEGLIGIBLE = "matters", "negligible"
#: Of a force that is withheld: heights with steep edges are not Gaussian.
STEEP_EDGES = "steep_edges"


def prediction(
    spectrum: Spectrum,
    contact: Contact,
    tolerance: float,
    name: str = "spectrum",
) -> dict[str, Number]:
    """Predict the pull-off force and both edges of a sphere on a rough surface, in closed form.

    The spectrum of scans rises above its longest wavelength, where it is extrapolated, as the rms
    height of the scans requires; that of a table is level there. ``extrapolated_force`` is the
    force with the spectrum extrapolated to short waves. Without a known error intervals are NaN and
    the force has the status OUTSIDE. For scans with steep edges the force has no value. Raises
    ValueError if `trim_spectrum` refuses the spectrum, which messages call `name`.
    """
    waves = trim_spectrum(spectrum, name)
    height, gradient, _ = all_scales_rms(waves)
    longest, shortest = 2 * np.pi / waves.wavevector[[0, -1]]
    smooth = smooth_force(contact)
    inputs = [
        Number("shortest_wavelength", float(shortest), "nm"),
        Number("longest_wavelength", float(longest), "nm"),
        Number("rms_height", float(height), "nm"),
        Number("rms_gradient", float(gradient)),
        Number("smooth_force", smooth, "N"),
        Number("tolerance", tolerance),
    ]
    scans = spectrum if isinstance(spectrum, ScanSpectrum) else None
    if scans is not None and scans.joined["edge_slope_share"].notnull().any():
        force = Number("pull_off_force", math.nan, "N", status=STEEP_EDGES)
        return {number.name: number for number in (*inputs, force)}
    form = closed_form(waves, contact)
    skewness = 0.0 if scans is None else scans.skewness
    widest_gap = float((waves.wavevector[1:] / waves.wavevector[:-1]).max())
    checks = [
        _longest_octave(waves, contact, form),
        Number(
            "widest_gap",
            widest_gap,
            status=UNKNOWN if widest_gap > MAX_WAVELENGTH_RATIO else NEGLIGIBLE,
        ),
        Number(
            "skewness", skewness, status=MATTERS if abs(skewness) > MAX_SKEWNESS else NEGLIGIBLE
        ),
    ]
    is_known_inside = all(number.status == NEGLIGIBLE for number in checks)
    if scans is not None and scans.is_extrapolated:
        measured_numbers = prediction(scans.measured(), contact, tolerance, name)
        force = measured_numbers.get("extrapolated_force", measured_numbers["pull_off_force"])
        is_known_inside = is_known_inside and force.status == INSIDE
    *extrapolated, change = _extrapolated_numbers(
        spectrum, contact, form.force, tolerance, is_known_inside
    )
    checks += [change, *validated_ranges(waves, contact, form)]
    validated = is_known_inside and all(number.status in (NEGLIGIBLE, INSIDE) for number in checks)
    point = table_coordinates(waves, contact, form)
    ends = zip(EDGE_NAMES, critical_band(waves, contact, tolerance), strict=True)
    numbers = [
        *inputs,
        _force_number("pull_off_force", form, point, validated),
        *extrapolated,
        Number("force_scatter", predict_statistics(waves, contact).log_force_std),
        Number("force_ratio", form.force / smooth),
        Number("apex_height", form.apex_height, "nm"),
        Number("weibull_modulus", form.weibull_modulus, status=form.regime.replace(" ", "_")),
        *(_edge_number(end, end, edge, point, validated) for end, edge in ends),
        *checks,
    ]
    return {number.name: number for number in numbers}


def trim_spectrum(spectrum: Spectrum, name: str = "spectrum") -> Spectrum:
    """Return a spectrum without the zeros at its ends; messages call it `name`.

    Raises ValueError if densities are unknown, if wavelengths are beyond those of the study, or if
    the rms height is below MIN_RMS_HEIGHT or above the longest wavelength: then the unit is
    probably wrong.
    """
    if not ((np.diff(spectrum.wavevector) > 0).all() and (spectrum.density >= 0).all()):
        raise ValueError(
            f"{name}: expected growing wavevectors with densities of at least 0, found others: "
            "leave out what is not known"
        )
    rough_indices = np.flatnonzero(spectrum.density > 0)
    if len(rough_indices) < 2:
        raise ValueError(f"{name}: expected roughness at two wavelengths or more, found less")
    rough_slice = slice(rough_indices[0], rough_indices[-1] + 1)
    rough = Spectrum(spectrum.wavevector[rough_slice], spectrum.density[rough_slice])
    shortest, longest = 2 * np.pi / rough.wavevector[[-1, 0]]
    minimum, maximum = 2 * np.pi / WAVEVECTORS[[-1, 0]]
    if shortest < minimum * (1 - 1e-9) or longest > maximum * (1 + 1e-9):
        raise ValueError(
            f"{name}: expected wavelengths of {format_length(minimum)} to "
            f"{format_length(maximum)}, found {shortest:.3g} nm to {longest:.3g} nm: "
            "is the unit right?"
        )
    height = all_scales_rms(rough)[0]
    if not MIN_RMS_HEIGHT <= height <= longest:
        raise ValueError(
            f"{name}: expected densities of an rms height of {format_length(MIN_RMS_HEIGHT)} to "
            f"{format_length(longest)}, its longest wavelength, found {height:.3g} nm: is the unit "
            "right?"
        )
    return rough


def _validated_interval(
    name: str, value: float, point: Mapping[str, Any], validated: bool
) -> tuple[float, float]:
    """Return the interval of a predicted quantity, NaN if its error is not known.

    The name is one of VALIDATED_QUANTITIES.
    """
    lowest, highest = nearest_errors(point, name) if validated else (math.nan, math.nan)
    return value * lowest, value * highest


def _force_number(name: str, form: ClosedForm, point: Mapping[str, Any], validated: bool) -> Number:
    """Return a force (N) with its interval; the status says whether its error is known."""
    interval = _validated_interval("force", form.force, point, validated)
    return Number(name, form.force, "N", *interval, INSIDE if validated else OUTSIDE)


def _edge_number(
    name: str, edge_name: str, edge: float, point: Mapping[str, Any], validated: bool
) -> Number:
    """Return an edge (nm) with its interval; `edge_name` is that in EDGE_NAMES."""
    if not math.isfinite(edge):
        return Number(name, edge, "nm", status=NO_EDGE)
    interval = _validated_interval(edge_name, edge, point, validated)
    return Number(name, edge, "nm", *interval, EDGE_FOUND)


def _extrapolated_numbers(
    spectrum: Spectrum,
    contact: Contact,
    force: float,
    tolerance: float,
    is_known_inside: bool,
) -> Iterator[Number]:
    """Yield the force and both edges of the extrapolated spectrum, and the change of the force.

    The change is relative to the force (N) without extrapolation; the tolerance defines the edges.
    A spectrum is not extrapolated below a density of zero at its end, nor if it has a zero within.
    The error of the force is known only if it is known inside the spectrum.
    """
    joined = spectrum.joined if isinstance(spectrum, ScanSpectrum) else None
    rough = trim_spectrum(spectrum)
    change = hurst = math.nan
    status = NEGLIGIBLE if spectrum.density[-1] == 0 else UNKNOWN
    longest = rolloff = float(2 * np.pi / rough.wavevector[0])
    density = None
    ended_by = ""
    if joined is not None and joined.attrs["tail_known"]:
        density = joined["spectrum"].values
        rolloff = joined.attrs["rolloff"]
        hurst = joined.attrs["tail_hurst"]
        ended_by = joined.attrs["tail_ended_by"]
    elif (
        joined is None
        and status == UNKNOWN
        and len(rough.density) >= MIN_BINS
        and rough.density.all()
    ):
        variance = np.full(rough.density.shape, CALIBRATION_SCATTER**2)
        fit = fit_hurst_exponent(rough.wavevector, rough.density, variance)
        density, tail = extrapolate_short_waves(rough.wavevector, rough.density, fit)
        hurst = tail.tail_hurst
        ended_by = tail.tail_ended_by
    # Without an exponent no waves are added: slope or curvature are at their bounds already.
    if density is not None and math.isnan(hurst) and rolloff <= longest:
        status = NEGLIGIBLE
    elif density is not None:
        extrapolated = trim_spectrum(Spectrum(WAVEVECTORS, density))
        form = closed_form(extrapolated, contact)
        validated = is_known_inside and is_validated(extrapolated, contact, form)
        point = table_coordinates(extrapolated, contact, form)
        yield _force_number("extrapolated_force", form, point, validated)
        for end, edge in zip(
            EDGE_NAMES, critical_band(extrapolated, contact, tolerance), strict=True
        ):
            yield _edge_number(f"extrapolated_{end}", end, edge, point, validated)
        yield Number("extrapolated_to", float(2 * np.pi / extrapolated.wavevector[-1]), "nm")
        yield Number("extrapolated_rolloff", rolloff, "nm")
        yield Number("extrapolated_hurst", hurst, status=ended_by)
        change = abs(form.force / force - 1)
        status = MATTERS if change > MAX_NEGLIGIBLE_CHANGE else NEGLIGIBLE
    yield Number("extrapolated_change", change, status=status)


def _longest_octave(waves: Spectrum, contact: Contact, form: ClosedForm) -> Number:
    """Return the relative change of the force by the longest octave of a spectrum.

    The change is unknown for a spectrum that has hardly more than this octave.
    """
    is_shorter = waves.wavevector >= 2 * waves.wavevector[0]
    change = math.nan
    status = UNKNOWN
    if is_shorter.sum() >= 2:
        shorter_waves = Spectrum(waves.wavevector[is_shorter], waves.density[is_shorter])
        change = abs(closed_form(shorter_waves, contact).force / form.force - 1)
        status = MATTERS if change > MAX_NEGLIGIBLE_CHANGE else NEGLIGIBLE
    return Number("longest_octave_change", change, status=status)
