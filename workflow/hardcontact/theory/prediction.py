"""Predictions of the closed form for a spectrum: numbers with units, intervals and statuses."""

import math
from collections.abc import Iterator, Mapping
from enum import StrEnum
from typing import Any, NamedTuple

import numpy as np

from hardcontact.base.arrays import Floats
from hardcontact.base.formatting import format_length
from hardcontact.base.number import Number, numbers_by_name
from hardcontact.contact.contact import Contact
from hardcontact.inference.edges import EDGE_NAMES, EdgeStatus
from hardcontact.scans.extrapolation import TailEnd, extrapolate_short_waves, fit_hurst_exponent
from hardcontact.scans.joined_spectrum import ScanSpectrum, reliable_spectrum
from hardcontact.scans.measured_spectrum import CALIBRATION_SCATTER
from hardcontact.surfaces.spectrum import MIN_BINS, WAVEVECTORS, Spectrum, all_scales_rms
from hardcontact.theory.closed_form import ClosedForm, closed_form, critical_band, smooth_force
from hardcontact.theory.validity import (
    Validity,
    is_validated,
    nearest_ratios,
    table_point,
    validated_limits,
)

#: Smallest accepted rms height in nm: a tenth of an atom.
MIN_RMS_HEIGHT = 0.01
#: Largest ratio of neighbouring wavelengths: the spectrum may bend unnoticed in a wider gap.
MAX_WAVELENGTH_RATIO = 4.0
#: Largest relative change of the force by missing waves that is negligible.
MAX_NEGLIGIBLE_CHANGE = 0.1
#: Largest skewness of heights that count as Gaussian. 240 self-affine maps had less than 0.7. On
#: bumps with a skewness of 1 the closed form was 7 to 15 times too high.
MAX_SKEWNESS = 1.0
#: The point in the table of designed surfaces at which an error is read; None if none is known.
KnownPoint = Mapping[str, Any] | None


class Effect(StrEnum):
    """Whether something that the closed form leaves out changes its force."""

    MATTERS, NEGLIGIBLE, UNKNOWN = "matters", "negligible", "unknown"


def prediction(
    spectrum: Spectrum, contact: Contact, tolerance: float, name: str = "spectrum"
) -> dict[str, Number]:
    """Predict the pull-off force and both edges of a sphere on a rough surface, in closed form.

    Intervals come from surfaces on which the error of the closed form is known. It is known for
    this spectrum if its assumptions hold, and if such surfaces have similar parameters. Four
    assumptions must hold:

    - the spectrum has no wide gap, and its longest octave hardly matters;
    - heights are not skewed, as far as scans tell;
    - if scans are extrapolated already, the error is known for their reliable waves;
    - the waves that an extrapolation adds hardly matter.

    Otherwise intervals are NaN, and force and finite edges are OUTSIDE. Scans with steep sidewalls
    have no edges and the force NaN. Raises ValueError if `trim_spectrum` refuses the spectrum;
    messages call it `name`.
    """
    trimmed = trim_spectrum(spectrum, name)
    inputs = _input_numbers(trimmed, contact, tolerance)
    scan_spectrum = spectrum if isinstance(spectrum, ScanSpectrum) else None
    # A share of NaN means that no steep sidewalls were found.
    if scan_spectrum and scan_spectrum.joined_dataset["sidewall_slope_share"].notnull().any():
        force = Number("closed_form_force", math.nan, "N", status=Validity.STEEP_SIDEWALLS)
        return numbers_by_name(*inputs, force)
    form = closed_form(trimmed, contact)
    skewness = scan_spectrum.skewness if scan_spectrum else 0.0
    checks = _spectrum_checks(trimmed, contact, form, skewness)
    assumptions_hold = all(number.status == Effect.NEGLIGIBLE for number in checks)
    if scan_spectrum and scan_spectrum.is_extrapolated:
        reliable_force = _reliable_force(scan_spectrum, contact, tolerance, name)
        checks.append(reliable_force)
        assumptions_hold &= reliable_force.status == Validity.INSIDE
    # The fourth assumption does not apply to the extrapolated spectrum itself.
    extrapolation = _extrapolate(spectrum, trimmed)
    extrapolated: list[Number] = []
    if extrapolation is not None and _adds_waves(extrapolation, trimmed):
        extrapolated = _extrapolated_numbers(extrapolation, contact, tolerance, assumptions_hold)
        extrapolated_force, *_ = extrapolated
        change = _force_change("extrapolated_change", extrapolated_force.value, form)
    else:
        # A spectrum that ends in zeros has no shorter waves.
        is_unknown = extrapolation is None and spectrum.density[-1] > 0
        status = Effect.UNKNOWN if is_unknown else Effect.NEGLIGIBLE
        change = Number("extrapolated_change", math.nan, status=status)
    assumptions_hold &= change.status == Effect.NEGLIGIBLE
    point = table_point(trimmed, contact, form)
    known_point = point if assumptions_hold and is_validated(point) else None
    return numbers_by_name(
        *inputs,
        _force_number("closed_form_force", form, known_point),
        *extrapolated,
        Number("force_over_smooth", form.force / smooth_force(contact)),
        Number("apex_height", form.apex_height, "nm"),
        Number("weibull_modulus", form.weibull_modulus, status=form.regime),
        *_edge_numbers("", critical_band(trimmed, contact, tolerance), known_point),
        *checks,
        change,
        *validated_limits(point),
    )


def trim_spectrum(spectrum: Spectrum, name: str = "spectrum") -> Spectrum:
    """Return a spectrum without the zeros at its ends; messages call it `name`.

    Raises ValueError if densities are unknown, or wavelengths or rms height are impossible.
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
    trimmed = Spectrum(spectrum.wavevector[rough_slice], spectrum.density[rough_slice])
    shortest, longest = trimmed.wavelength[[-1, 0]]
    minimum, maximum = 2 * np.pi / WAVEVECTORS[[-1, 0]]
    if shortest < minimum * (1 - 1e-9) or longest > maximum * (1 + 1e-9):
        raise ValueError(
            f"{name}: expected wavelengths of {format_length(minimum)} to "
            f"{format_length(maximum)}, found {shortest:.3g} nm to {longest:.3g} nm: "
            "is the unit right?"
        )
    height = all_scales_rms(trimmed)[0]
    if not MIN_RMS_HEIGHT <= height <= longest:
        raise ValueError(
            f"{name}: expected densities of an rms height of {format_length(MIN_RMS_HEIGHT)} to "
            f"{format_length(longest)}, its longest wavelength, found {height:.3g} nm: is the unit "
            "right?"
        )
    return trimmed


def _input_numbers(spectrum: Spectrum, contact: Contact, tolerance: float) -> list[Number]:
    """Return the properties of a spectrum, the force on a smooth surface and the tolerance."""
    height, gradient, _ = all_scales_rms(spectrum)
    return [
        Number("shortest_wavelength", float(spectrum.wavelength[-1]), "nm"),
        Number("longest_wavelength", float(spectrum.wavelength[0]), "nm"),
        Number("rms_height", float(height), "nm"),
        Number("rms_gradient", float(gradient)),
        Number("smooth_force", smooth_force(contact), "N"),
        Number("tolerance", tolerance),
    ]


def _spectrum_checks(
    spectrum: Spectrum, contact: Contact, form: ClosedForm, skewness: float
) -> list[Number]:
    """Return the checks of a spectrum: all are NEGLIGIBLE if the assumptions hold.

    If the force changes without the longest octave, waves longer than those measured might change
    it, too. In a wide gap between wavelengths the spectrum might bend. Skewed heights are not
    Gaussian.
    """
    gap = float((spectrum.wavevector[1:] / spectrum.wavevector[:-1]).max())
    gap_status = Effect.UNKNOWN if gap > MAX_WAVELENGTH_RATIO else Effect.NEGLIGIBLE
    skewness_status = Effect.MATTERS if abs(skewness) > MAX_SKEWNESS else Effect.NEGLIGIBLE
    return [
        _longest_octave_change(spectrum, contact, form),
        Number("widest_gap", gap, status=gap_status),
        Number("skewness", skewness, status=skewness_status),
    ]


def _reliable_force(
    scan_spectrum: ScanSpectrum, contact: Contact, tolerance: float, name: str
) -> Number:
    """Return the force (N) of the reliable waves of scans; INSIDE if its error is known."""
    reliable_waves = reliable_spectrum(scan_spectrum.joined_dataset, scan_spectrum.skewness)
    numbers = prediction(reliable_waves, contact, tolerance, name)
    force = numbers["closed_form_force"]
    # Without the other waves this force may be OUTSIDE. The extrapolated force has these waves, so
    # its status tells whether all other assumptions hold.
    status = numbers.get("extrapolated_force", force).status
    return Number("reliable_force", force.value, "N", status=status)


def _validated_interval(name: str, value: float, point: KnownPoint) -> tuple[float, float]:
    """Return the interval of a value at a point, NaN for None; `name` is a validated quantity."""
    lowest, highest = (math.nan, math.nan) if point is None else nearest_ratios(point, name)
    return value * lowest, value * highest


def _force_number(name: str, form: ClosedForm, point: KnownPoint) -> Number:
    """Return a force (N) with its interval, and a status: INSIDE if its error is known."""
    interval = _validated_interval("force", form.force, point)
    status = Validity.OUTSIDE if point is None else Validity.INSIDE
    return Number(name, form.force, "N", *interval, status)


def _edge_numbers(prefix: str, band: tuple[float, float], point: KnownPoint) -> Iterator[Number]:
    """Yield the edges (nm) of a band, named by a prefix and EDGE_NAMES, with their intervals."""
    finite_status = Validity.OUTSIDE if point is None else EdgeStatus.FOUND
    for name, edge in zip(EDGE_NAMES.values(), band, strict=True):
        interval = _validated_interval(name, edge, point)
        status = finite_status if math.isfinite(edge) else EdgeStatus.NO_EDGE
        yield Number(f"{prefix}{name}", edge, "nm", *interval, status)


class _Extrapolation(NamedTuple):
    """A spectrum that is extrapolated to short waves, and to long waves up to a roll-off."""

    density: Floats  #: C_iso in nm⁴ at WAVEVECTORS, constant at wavelengths above the roll-off.
    rolloff: float  #: Roll-off in nm; without scans the longest wavelength.
    hurst: float  #: Hurst exponent of the extrapolated short waves; NaN if there are none.
    ended_by: str  #: What ends the extrapolated short waves: `Tail.tail_ended_by`.


def _extrapolate(spectrum: Spectrum, trimmed: Spectrum) -> _Extrapolation | None:
    """Return the extrapolation of a spectrum; None if it is not known or not needed.

    Joined scans have been extrapolated to both sides. A table is extrapolated to short waves only,
    unless it ends in a zero, has other zeros in between, or has too few points.
    """
    if isinstance(spectrum, ScanSpectrum):
        ends = spectrum.joined_dataset.attrs
        if not ends["tail_known"]:
            return None
        density = spectrum.joined_dataset["spectrum"].values
        return _Extrapolation(density, ends["rolloff"], ends["tail_hurst"], ends["tail_ended_by"])
    if spectrum.density[-1] == 0 or len(trimmed.density) < MIN_BINS or not trimmed.density.all():
        return None
    variance = np.full(trimmed.density.shape, CALIBRATION_SCATTER**2)
    fit = fit_hurst_exponent(trimmed.wavevector, trimmed.density, variance)
    density, tail = extrapolate_short_waves(trimmed.wavevector, trimmed.density, fit)
    longest = float(trimmed.wavelength[0])
    return _Extrapolation(density, longest, tail.tail_hurst, tail.tail_ended_by)


def _adds_waves(extrapolation: _Extrapolation, trimmed: Spectrum) -> bool:
    """Return True if an extrapolation adds short waves, or long waves below its roll-off."""
    return math.isfinite(extrapolation.hurst) or extrapolation.rolloff > trimmed.wavelength[0]


def _extrapolated_numbers(
    extrapolation: _Extrapolation, contact: Contact, tolerance: float, assumptions_hold: bool
) -> list[Number]:
    """Return the force and both edges of an extrapolated spectrum, and how it was extrapolated."""
    spectrum = trim_spectrum(Spectrum(WAVEVECTORS, extrapolation.density))
    form = closed_form(spectrum, contact)
    point = table_point(spectrum, contact, form)
    known_point = point if assumptions_hold and is_validated(point) else None
    band = critical_band(spectrum, contact, tolerance)
    return [
        _force_number("extrapolated_force", form, known_point),
        *_edge_numbers("extrapolated_", band, known_point),
        Number("extrapolated_to", float(spectrum.wavelength[-1]), "nm"),
        Number("extrapolated_rolloff", extrapolation.rolloff, "nm"),
        Number("extrapolated_hurst", extrapolation.hurst, status=TailEnd(extrapolation.ended_by)),
    ]


def _force_change(name: str, changed_force: float, form: ClosedForm) -> Number:
    """Return the relative change from the force of a closed form (N), and whether it matters."""
    change = abs(changed_force / form.force - 1)
    matters = change > MAX_NEGLIGIBLE_CHANGE
    return Number(name, change, status=Effect.MATTERS if matters else Effect.NEGLIGIBLE)


def _longest_octave_change(spectrum: Spectrum, contact: Contact, form: ClosedForm) -> Number:
    """Return the relative change of the force without the longest octave of a spectrum."""
    is_shorter = spectrum.wavevector >= 2 * spectrum.wavevector[0]
    if is_shorter.sum() < 2:
        return Number("longest_octave_change", math.nan, status=Effect.UNKNOWN)
    shorter = Spectrum(spectrum.wavevector[is_shorter], spectrum.density[is_shorter])
    return _force_change("longest_octave_change", closed_form(shorter, contact).force, form)
