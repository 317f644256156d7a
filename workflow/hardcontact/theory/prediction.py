"""Predictions of the closed form for a spectrum: numbers with units, intervals and statuses.

The errors come from designed surfaces with computed forces and edges (`validation`). Only the half
of these surfaces counts that was held out while the closed form was developed.
"""

import math
from collections.abc import Iterator, Mapping
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.code import LIBRARY
from hardcontact.base.number import Number
from hardcontact.base.printing import print_length, print_quantity
from hardcontact.contact.contact import Contact
from hardcontact.contact.smooth_sphere import (
    maugis_parameter,
    tabor_parameter,
    transition_coefficient,
)
from hardcontact.surfaces.extrapolated_spectrum import extrapolate_short_waves
from hardcontact.surfaces.hurst_exponent import fit_hurst_exponent
from hardcontact.surfaces.measured_spectrum import CALIBRATION_SCATTER
from hardcontact.surfaces.spectrum import (
    MIN_BINS,
    WAVEVECTORS,
    Spectrum,
    all_scales_moments,
    roll_off,
)
from hardcontact.theory.closed_form import (
    ClosedForm,
    closed_form,
    contact_share,
    edges,
    smooth_force,
)
from hardcontact.theory.pull_off_statistics import force_statistics

#: Designed surfaces with computed and predicted numbers; its README describes the columns.
VALIDATION = LIBRARY.parents[1] / "resources/validation/prediction.csv"
#: Number of surfaces nearest to an input whose errors count. Another error of the same distribution
#: lies between the smallest and the largest of n errors with the probability (n - 1)/(n + 1): 0.9.
NEAREST_SURFACES = 19
#: A smaller modulus counts as this one. It is 0 where the sphere goes below the mean plane.
MIN_MODULUS = 1e-3
#: Predicted and computed quantities: columns of the table.
VALIDATED_QUANTITIES = ("force", "short_edge", "long_edge")
#: Parameters on which an error depends, with their units. An input must lie within their ranges in
#: the table.
VALIDATED_PARAMETERS = {
    "rho": "nm",
    "radius": "nm",
    "modulus": "1",
    "contact_over_rolloff": "1",
    "mean_hurst": "1",
    "bend": "1",
}
#: Points of a spectrum to which a Hurst exponent and its change are fitted.
FITTED_POINTS = 40
#: Smallest accepted rms height in nm: a tenth of an atom.
MIN_RMS_HEIGHT = 0.01
#: Largest relative change of the force, by missing waves or by elasticity, that is negligible.
MAX_NEGLIGIBLE_CHANGE = 0.1
#: Largest ratio of neighbouring wavelengths: the spectrum may bend unnoticed in a wider gap.
MAX_WAVELENGTH_RATIO = 4.0
#: Largest skewness of heights that count as Gaussian. Of 240 self-affine maps, with roll-offs of up
#: to four times their size, none had 0.7. On bumps with a skewness of 1 the closed form was 7 to 15
#: times too high, on pores with -3 it was 3 times too low.
MAX_SKEWNESS = 1.0
#: Statuses: inside or outside the validated ranges; whether missing waves matter; whether an edge
#: exists; whether the bodies are practically rigid.
INSIDE, OUTSIDE = "inside", "outside"
MATTERS, NEGLIGIBLE, UNKNOWN = "matters", "negligible", "unknown"
FOUND, NONE = "found", "none"
#: Of a force that is withheld: heights with steep edges are not Gaussian.
STEEP_EDGES = "steep_edges"
HARD, SOFT = "hard", "soft"


@cache
def validation(path: str | Path = VALIDATION) -> pd.DataFrame:
    """Return the surfaces of the table that were held out, with their errors.

    Parameters
    ----------
    path : str or Path
        The table, resources/validation/prediction.csv by default.

    Returns
    -------
    pandas.DataFrame
        Rows of the table with the column ``<name>_error`` for each of VALIDATED_QUANTITIES: the
        computed value relative to the predicted value, NaN if an edge is open or not predicted.
    """
    table = pd.read_csv(path)
    held_out = table[table["held_back"] == 1].copy()
    for name in VALIDATED_QUANTITIES:
        error = held_out[name] / held_out[f"predicted_{name}"]
        if f"{name}_is" in held_out:
            error = error.where(held_out[f"{name}_is"] == FOUND)
        held_out[f"{name}_error"] = error
    return held_out


def validated_errors(path: str | Path) -> dict[tuple[str, str], tuple[Number, int]]:
    """Return the errors of the closed form by quantity and regime.

    Parameters
    ----------
    path : str or Path
        The table, as for `validation`.

    Returns
    -------
    dict of tuple to tuple
        By name (VALIDATED_QUANTITIES) and regime: the computed value relative to the predicted
        value, and the number of surfaces. The value is the median over these surfaces; nine tenths
        of them lie within its interval.
    """
    errors_by_regime = {}
    for name, (regime, table) in product(VALIDATED_QUANTITIES, validation(path).groupby("regime")):
        ratios = table[f"{name}_error"].dropna()
        low, median, high = ratios.quantile([0.05, 0.5, 0.95])
        errors_by_regime[name, str(regime)] = Number(name, median, "1", low, high), len(ratios)
    return errors_by_regime


def table_coordinates(waves: Spectrum, contact: Contact, form: ClosedForm) -> dict[str, Any]:
    """Return the coordinates of a spectrum and a contact in the table of designed surfaces.

    Parameters
    ----------
    waves : Spectrum
        Trimmed by `trim_spectrum`.
    contact : Contact
        The sphere, the attraction and the area in contact.
    form : ClosedForm
        The closed form of both.

    Returns
    -------
    dict
        ``modulus``, k = rho m/sigma², the inverse of the freezing, infinite without roughness;
        ``contact_over_rolloff``, ``mean_hurst``, ``bend`` and ``regime``.
    """
    mean_hurst, bend = hurst_and_bend(waves, math.sqrt(contact.area))
    return {
        "modulus": 1 / form.freezing if form.freezing else math.inf,
        "contact_over_rolloff": math.sqrt(contact.area) / roll_off(waves),
        "mean_hurst": mean_hurst,
        "bend": bend,
        "regime": form.regime,
    }


def hurst_and_bend(waves: Spectrum, contact_length: float) -> tuple[float, float]:
    """Return the mean Hurst exponent of a spectrum, and its change per decade of wavevector.

    A parabola is fitted to log C_iso against log q. The fit begins at the roll-off and ends at the
    length of the contact (nm), or at the shortest wave if that is longer. Both numbers are NaN if
    the roll-off is shorter than the length of the contact.
    """
    lowest, highest = 2 * np.pi / roll_off(waves), waves.wavevector[-1]
    decades = math.log10(min(highest, 2 * np.pi / contact_length) / lowest)
    if decades <= 0:
        return math.nan, math.nan
    log_wavevectors = np.linspace(-decades / 2, decades / 2, FITTED_POINTS)
    density = waves(np.minimum(lowest * 10 ** (log_wavevectors + decades / 2), highest))
    curvature, slope, _ = np.polyfit(log_wavevectors, np.log10(density), 2)
    return float(-1 - slope / 2), float(-curvature)


def nearest_errors(point: Mapping[str, Any], name: str) -> tuple[float, float]:
    """Return the smallest and the largest error among the nearest surfaces of the table.

    Distances are those between the logarithms of modulus and contact_over_rolloff. A surface of
    another regime is farther by one. A point outside the table is moved to its border.

    Parameters
    ----------
    point : mapping
        `table_coordinates` of an input.
    name : str
        One of VALIDATED_QUANTITIES.

    Returns
    -------
    tuple of float
        Computed value relative to the predicted value, smallest and largest.
    """
    surfaces = validation().dropna(subset=f"{name}_error")
    axes = ["modulus", "contact_over_rolloff"]
    rows = surfaces[axes].to_numpy()
    nearest_inside = np.clip([point[axis] for axis in axes], rows.min(axis=0), rows.max(axis=0))
    log_distances = np.log(np.maximum(rows, MIN_MODULUS) / np.maximum(nearest_inside, MIN_MODULUS))
    distance = np.hypot(*log_distances.T) + (surfaces["regime"] != point["regime"]).to_numpy()
    errors = surfaces[f"{name}_error"].iloc[np.argsort(distance)[:NEAREST_SURFACES]]
    return float(errors.min()), float(errors.max())


def is_validated(waves: Spectrum, contact: Contact, form: ClosedForm) -> bool:
    """Return whether the table covers a contact, so that the error of its closed form is known."""
    return all(number.status == INSIDE for number in _validated_ranges(waves, contact, form))


def prediction(
    spectrum: Spectrum,
    contact: Contact,
    tolerance: float,
    name: str = "spectrum",
    joined: xr.Dataset | None = None,
    skewness: float = 0.0,
) -> dict[str, Number]:
    """Predict the pull-off force and both edges of a sphere on a rough surface, in closed form.

    Parameters
    ----------
    spectrum : Spectrum
        C_iso in nm⁴ of the surface.
    contact : Contact
        The sphere, the attraction and the area in contact.
    tolerance : float
        Relative change of the force that defines an edge.
    name : str
        Name of the spectrum in messages.
    joined : xarray.Dataset or None
        From `joined_spectrum`, for a spectrum of scans. Its extrapolation rises above the longest
        wavelength as the rms height of the scans requires. None for a table: its extrapolation is
        level there, and ends at a density of zero at the end of the table.
    skewness : float
        Skewness of the heights; the closed form takes them to be Gaussian.

    Returns
    -------
    dict of str to Number
        By name. Intervals follow from `nearest_errors` if the table covers contact and spectrum.
        Otherwise they are NaN, and the force has the status ``"outside"``. ``continued_force`` is
        the force with the extrapolated spectrum. For scans with steep edges the force has no value
        and the status ``"steep_edges"``, and numbers that follow from it are left out.

    Raises
    ------
    ValueError
        If `trim_spectrum` refuses the spectrum.
    """
    waves = trim_spectrum(spectrum, name)
    height, gradient, _ = all_scales_moments(waves)
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
    if joined is not None and joined["edge_slope_share"].notnull().any():
        force = Number("pull_off_force", math.nan, "N", status=STEEP_EDGES)
        return {number.name: number for number in (*inputs, force)}
    form = closed_form(waves, contact)
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
    enough_waves = all(number.status == NEGLIGIBLE for number in checks)
    *extrapolated, change = _extrapolated_numbers(
        spectrum, joined, contact, form.force, tolerance, enough_waves
    )
    checks += [change, *_validated_ranges(waves, contact, form)]
    validated = all(number.status in (NEGLIGIBLE, INSIDE) for number in checks)
    point = table_coordinates(waves, contact, form)
    ends = zip(VALIDATED_QUANTITIES[1:], edges(waves, contact, tolerance), strict=True)
    numbers = [
        *inputs,
        _force_number("pull_off_force", form, point, validated),
        *extrapolated,
        Number("force_scatter", force_statistics(waves, contact).spread),
        Number("force_ratio", form.force / smooth),
        Number("closest_approach", form.closest_approach, "nm"),
        Number("freezing", form.freezing, status=form.regime.replace(" ", "_")),
        *(
            Number(end, edge, "nm", *_validated_interval(end, edge, point, validated), status=FOUND)
            if math.isfinite(edge)
            else Number(end, edge, "nm", status=NONE)
            for end, edge in ends
        ),
        *checks,
    ]
    return {number.name: number for number in numbers}


def trim_spectrum(spectrum: Spectrum, name: str = "spectrum") -> Spectrum:
    """Return a spectrum without the zeros at its ends.

    Parameters
    ----------
    spectrum : Spectrum
        C_iso in nm⁴.
    name : str
        Name of the spectrum in messages.

    Returns
    -------
    Spectrum
        From the first to the last density above zero.

    Raises
    ------
    ValueError
        If densities are unknown. If wavelengths are beyond those of the study, or the rms height is
        below MIN_RMS_HEIGHT or above the longest wavelength: the unit is probably wrong.
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
            f"{name}: expected wavelengths of {print_length(minimum)} to {print_length(maximum)}, "
            f"found {shortest:.3g} nm to {longest:.3g} nm: is the unit right?"
        )
    height = all_scales_moments(rough)[0]
    if not MIN_RMS_HEIGHT <= height <= longest:
        raise ValueError(
            f"{name}: expected densities of an rms height of {print_length(MIN_RMS_HEIGHT)} to "
            f"{print_length(longest)}, its longest wavelength, found {height:.3g} nm: is the unit "
            "right?"
        )
    return rough


def tabor(contact: Contact, modulus: float) -> Number:
    """Return the Tabor parameter, with the range of adhesion as spacing, and its status.

    Parameters
    ----------
    contact : Contact
        The sphere and the attraction.
    modulus : float
        Effective modulus in Pa, NaN if it is not known.

    Returns
    -------
    Number
        The status is UNKNOWN without a modulus. It is SOFT if elasticity reduces the force of a
        smooth sphere by more than MAX_NEGLIGIBLE_CHANGE, otherwise HARD.
    """
    if math.isnan(modulus):
        return Number("tabor_parameter", modulus, status=UNKNOWN)
    value = float(tabor_parameter(contact.work, contact.radius, modulus, contact.range))
    softening = 1 - float(transition_coefficient(maugis_parameter(value))) / 2
    return Number(
        "tabor_parameter", value, status=SOFT if softening > MAX_NEGLIGIBLE_CHANGE else HARD
    )


def wide_contact_message(contact: Contact) -> str:
    """Return a message if the contact area alone attracts as strongly as a smooth sphere.

    The message is empty otherwise. It names the largest preload (N) that is valid.
    """
    share = contact_share(contact)
    if share < 1:
        return ""
    return (
        f"preload: expected less than {print_quantity(contact.preload / share, 'N')} at this "
        f"hardness, radius and range, found {print_quantity(contact.preload, 'N')}: the contact "
        "alone would stick like a smooth sphere"
    )


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


def _extrapolated_numbers(
    spectrum: Spectrum,
    joined: xr.Dataset | None,
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
        hurst, ended_by = tail.tail_hurst, tail.tail_ended_by
    # Without an exponent no waves are added: slope or curvature are at their bounds already.
    if density is not None and math.isnan(hurst) and rolloff <= longest:
        status = NEGLIGIBLE
    elif density is not None:
        extrapolated = trim_spectrum(Spectrum(WAVEVECTORS, density))
        form = closed_form(extrapolated, contact)
        validated = is_known_inside and is_validated(extrapolated, contact, form)
        yield _force_number(
            "continued_force", form, table_coordinates(extrapolated, contact, form), validated
        )
        for end, edge in zip(
            VALIDATED_QUANTITIES[1:], edges(extrapolated, contact, tolerance), strict=True
        ):
            yield Number(f"continued_{end}", edge, "nm", status=FOUND if edge > 0 else NONE)
        yield Number("continued_to", float(2 * np.pi / extrapolated.wavevector[-1]), "nm")
        yield Number("continued_rolloff", rolloff, "nm")
        yield Number("continued_hurst", hurst, status=ended_by)
        change = abs(form.force / force - 1)
        status = MATTERS if change > MAX_NEGLIGIBLE_CHANGE else NEGLIGIBLE
    yield Number("continued_change", change, status=status)


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


def _validated_ranges(waves: Spectrum, contact: Contact, form: ClosedForm) -> Iterator[Number]:
    """Yield the parameters on which an error depends, with their ranges in the table."""
    values = {
        "rho": contact.range,
        "radius": contact.radius,
        **table_coordinates(waves, contact, form),
    }
    for name, unit in VALIDATED_PARAMETERS.items():
        lowest, highest = validation()[name].agg(["min", "max"])
        status = INSIDE if lowest <= values[name] <= highest else OUTSIDE
        yield Number(f"tried_{name}", values[name], unit, lowest, highest, status)
