"""What the closed form predicts from a spectrum: numbers with units, intervals and statuses.

Errors are those on designed surfaces whose forces and edges were computed (`validation`), in the
half of them that nobody looked at while the closed form was made.
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
from hardcontact.surfaces.extrapolated_spectrum import continued_spectrum
from hardcontact.surfaces.hurst_exponent import fitted_hurst
from hardcontact.surfaces.measured_spectrum import CALIBRATION
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
#: Surfaces nearest to an input whose errors count. The least and the greatest of n errors hold one
#: more, drawn alike, with the probability (n - 1)/(n + 1): nine of ten.
NEAREST = 19
#: Below this a modulus, 0 where the sphere goes below the mean plane, is as good as any.
LEAST_MODULUS = 1e-3
#: What is predicted and computed: columns of the table.
VALIDATED = ("force", "short_edge", "long_edge")
#: What an error depends on, whose range in the table an input must lie in, and the unit.
TRIED = {
    "rho": "nm",
    "radius": "nm",
    "modulus": "1",
    "contact_over_rolloff": "1",
    "mean_hurst": "1",
    "bend": "1",
}
#: Points of a spectrum to which a Hurst exponent and its change are fitted.
FITTED_POINTS = 40
#: Rms height in nm below which there is no surface: a tenth of an atom.
LEAST_HEIGHT = 0.01
#: Change of the force by waves that a spectrum lacks, or by elasticity, beyond which they matter.
CHANGE = 0.1
#: Factor between neighbouring wavelengths of a spectrum beyond which a bend may hide between them.
GAP = 4.0
#: Statuses: within what the error was measured on, or not; whether what a spectrum lacks matters;
#: edges; whether the bodies are as good as rigid.
INSIDE, OUTSIDE = "inside", "outside"
MATTERS, NEGLIGIBLE, UNKNOWN = "matters", "negligible", "unknown"
FOUND, NONE = "found", "none"
HARD, SOFT = "hard", "soft"


@cache
def validation(path: str | Path = VALIDATION) -> pd.DataFrame:
    """Return the surfaces of the table that were held out, with ``<name>_error`` of VALIDATED.

    An error is computed over predicted, NaN where an edge is open or none is predicted.
    """
    table = pd.read_csv(path)
    held_back = table[table["held_back"] == 1].copy()
    for name in VALIDATED:
        error = held_back[name] / held_back[f"predicted_{name}"]
        if f"{name}_is" in held_back:
            error = error.where(held_back[f"{name}_is"] == FOUND)
        held_back[f"{name}_error"] = error
    return held_back


def validated_errors(path: str | Path) -> dict[tuple[str, str], tuple[Number, int]]:
    """Return computed over predicted, by name of VALIDATED and regime, and on how many surfaces.

    The path is that of the table as in VALIDATION. The number is the median, its interval holds
    nine tenths.
    """
    found = {}
    for name, (regime, table) in product(VALIDATED, validation(path).groupby("regime")):
        errors = table[f"{name}_error"].dropna()
        low, median, high = errors.quantile([0.05, 0.5, 0.95])
        found[name, str(regime)] = Number(name, median, "1", low, high), len(errors)
    return found


def coordinates(waves: Spectrum, contact: Contact, found: ClosedForm) -> dict[str, Any]:
    """Return where a spectrum and a contact lie among those of the table.

    The modulus k = rho m/sigma² is the inverse of the freezing, infinite without roughness.
    """
    mean_hurst, bend = hurst_and_bend(waves, math.sqrt(contact.area))
    return {
        "modulus": 1 / found.freezing if found.freezing else math.inf,
        "contact_over_rolloff": math.sqrt(contact.area) / roll_off(waves),
        "mean_hurst": mean_hurst,
        "bend": bend,
        "regime": found.regime,
    }


def hurst_and_bend(waves: Spectrum, contact_length: float) -> tuple[float, float]:
    """Return the mean Hurst exponent of a spectrum, and its change a decade of wavevector.

    A parabola is fitted to log C_iso against log q, between the roll-off and the length of the
    contact (nm) or the shortest wave. Both are NaN if there are no waves between them.
    """
    first, last = 2 * np.pi / roll_off(waves), waves.wavevector[-1]
    decades = math.log10(min(last, 2 * np.pi / contact_length) / first)
    if decades <= 0:
        return math.nan, math.nan
    middle = np.linspace(-decades / 2, decades / 2, FITTED_POINTS)
    density = waves(np.minimum(first * 10 ** (middle + decades / 2), last))
    curvature, slope, _ = np.polyfit(middle, np.log10(density), 2)
    return float(-1 - slope / 2), float(-curvature)


def nearest_errors(place: Mapping[str, Any], name: str) -> tuple[float, float]:
    """Return the least and the greatest error, of VALIDATED, of the NEAREST surfaces to a place.

    The distance is that of the logarithms of both `coordinates`; another regime is one further.
    A place beyond the table counts as at its border.
    """
    known = validation().dropna(subset=f"{name}_error")
    axes = ["modulus", "contact_over_rolloff"]
    rows = known[axes].to_numpy()
    here = np.clip([place[axis] for axis in axes], rows.min(axis=0), rows.max(axis=0))
    apart = np.log(np.maximum(rows, LEAST_MODULUS) / np.maximum(here, LEAST_MODULUS))
    distance = np.hypot(*apart.T) + (known["regime"] != place["regime"]).to_numpy()
    errors = known[f"{name}_error"].iloc[np.argsort(distance)[:NEAREST]]
    return float(errors.min()), float(errors.max())


def is_tried(waves: Spectrum, contact: Contact, found: ClosedForm) -> bool:
    """Return whether the error of a closed form is known: its contact lies within the table."""
    return all(one.status == INSIDE for one in _tried(waves, contact, found))


def prediction(
    spectrum: Spectrum,
    contact: Contact,
    tolerance: float,
    name: str = "spectrum",
    joined: xr.Dataset | None = None,
) -> dict[str, Number]:
    """Return all that the closed form says of a sphere on a surface of a spectrum, by name.

    Without the roughness beyond an edge the force changes by the tolerance, a relative change.
    Intervals are those of `nearest_errors` where contact and spectrum lie within the table;
    otherwise there are none and the force has the status ``"outside"``. The ``continued_force`` is
    that of the spectrum continued as in the study: that of scans, `joined` as by
    `joined_spectrum`, rises above its longest wavelength as their rms height says; a table is level
    there, and does not go on below a density of zero at its end. What is no spectrum is refused as
    by `rough_part`, with the name.
    """
    waves = rough_part(spectrum, name)
    height, gradient, _ = map(float, all_scales_moments(waves))
    longest, shortest = map(float, 2 * np.pi / waves.wavevector[[0, -1]])
    found, smooth = closed_form(waves, contact), smooth_force(contact)
    gap = float((waves.wavevector[1:] / waves.wavevector[:-1]).max())
    checks = [
        _longest_octave(waves, contact, found),
        Number("widest_gap", gap, status=UNKNOWN if gap > GAP else NEGLIGIBLE),
    ]
    known = all(one.status == NEGLIGIBLE for one in checks)
    *of_tail, change = _continued(spectrum, joined, contact, (found.force, tolerance), known)
    checks += [change, *_tried(waves, contact, found)]
    sure = all(one.status in (NEGLIGIBLE, INSIDE) for one in checks)
    place = coordinates(waves, contact, found)
    ends = zip(VALIDATED[1:], edges(waves, contact, tolerance), strict=True)
    numbers = [
        Number("shortest_wavelength", shortest, "nm"),
        Number("longest_wavelength", longest, "nm"),
        Number("rms_height", height, "nm"),
        Number("rms_gradient", gradient),
        _force("pull_off_force", found, place, sure),
        *of_tail,
        Number("force_scatter", force_statistics(waves, contact).spread),
        Number("smooth_force", smooth, "N"),
        Number("force_ratio", found.force / smooth),
        Number("closest_approach", found.closest_approach, "nm"),
        Number("freezing", found.freezing, status=found.regime.replace(" ", "_")),
        *(
            Number(end, edge, "nm", *_interval(end, edge, place, sure), status=FOUND)
            if math.isfinite(edge)
            else Number(end, edge, "nm", status=NONE)
            for end, edge in ends
        ),
        Number("tolerance", tolerance),
        *checks,
    ]
    return {one.name: one for one in numbers}


def rough_part(spectrum: Spectrum, name: str = "spectrum") -> Spectrum:
    """Return a spectrum without the zeros at its ends: it ends where its roughness does.

    Unknown densities are a ValueError of one line that begins with the name, and so are waves that
    the study has none of, and an rms height below any atom's or above the longest wave: their unit
    is wrong.
    """
    if not ((np.diff(spectrum.wavevector) > 0).all() and (spectrum.density >= 0).all()):
        raise ValueError(
            f"{name}: expected growing wavevectors with densities of at least 0, found others: "
            "leave out what is not known"
        )
    known = np.flatnonzero(spectrum.density > 0)
    if len(known) < 2:
        raise ValueError(f"{name}: expected roughness at two wavelengths or more, found less")
    rough = slice(known[0], known[-1] + 1)
    part = Spectrum(spectrum.wavevector[rough], spectrum.density[rough])
    shortest, longest = 2 * np.pi / part.wavevector[[-1, 0]]
    least, most = 2 * np.pi / WAVEVECTORS[[-1, 0]]
    if shortest < least * (1 - 1e-9) or longest > most * (1 + 1e-9):
        raise ValueError(
            f"{name}: expected wavelengths of {print_length(least)} to {print_length(most)}, found "
            f"{shortest:.3g} nm to {longest:.3g} nm: is the unit right?"
        )
    height = all_scales_moments(part)[0]
    if not LEAST_HEIGHT <= height <= longest:
        raise ValueError(
            f"{name}: expected densities of an rms height of {print_length(LEAST_HEIGHT)} to "
            f"{print_length(longest)}, its longest wavelength, found {height:.3g} nm: is the unit "
            "right?"
        )
    return part


def tabor(contact: Contact, modulus: float) -> Number:
    """Return the Tabor parameter, with the range of adhesion as spacing, and what it says.

    The effective modulus is in Pa, NaN if it is not known. The bodies are SOFT where their
    elasticity takes more than CHANGE of the force from a smooth sphere.
    """
    if math.isnan(modulus):
        return Number("tabor_parameter", modulus, status=UNKNOWN)
    value = float(tabor_parameter(contact.work, contact.radius, modulus, contact.range))
    softening = 1 - float(transition_coefficient(maugis_parameter(value))) / 2
    return Number("tabor_parameter", value, status=SOFT if softening > CHANGE else HARD)


def too_wide(contact: Contact) -> str:
    """Return that a contact alone would attract as much as the whole smooth sphere, if it would."""
    share = contact_share(contact)
    if share < 1:
        return ""
    return (
        f"preload: expected less than {print_quantity(contact.preload / share, 'N')} at this "
        f"hardness, radius and range, found {print_quantity(contact.preload, 'N')}: the contact "
        "alone would stick like a smooth sphere"
    )


def _interval(name: str, value: float, place: Mapping[str, Any], sure: bool) -> tuple[float, float]:
    """Return the interval of a number of VALIDATED, NaN where its error is not known."""
    least, greatest = nearest_errors(place, name) if sure else (math.nan, math.nan)
    return value * least, value * greatest


def _force(name: str, found: ClosedForm, place: Mapping[str, Any], sure: bool) -> Number:
    """Return a force with its interval and whether its error is known."""
    interval = _interval("force", found.force, place, sure)
    return Number(name, found.force, "N", *interval, INSIDE if sure else OUTSIDE)


def _continued(
    spectrum: Spectrum,
    joined: xr.Dataset | None,
    contact: Contact,
    changing: tuple[float, float],
    known: bool,
) -> Iterator[Number]:
    """Yield force and edges with the waves beyond the ends; at last, how they change the force.

    Changing are the force without them and the relative change that edges stand for.

    There is nothing beyond a density of zero. What has a zero within is not continued. The error is
    known only where that is known of the rest of the spectrum.
    """
    waves, (force, tolerance) = rough_part(spectrum), changing
    change, status = math.nan, NEGLIGIBLE if spectrum.density[-1] == 0 else UNKNOWN
    longest = rolloff = float(2 * np.pi / waves.wavevector[0])
    density, hurst, ended_by = None, math.nan, ""
    if joined is not None and joined.attrs["tail_known"]:
        density = joined["spectrum"].values
        rolloff, hurst, ended_by = (
            joined.attrs[name] for name in ("rolloff", "tail_hurst", "tail_ended_by")
        )
    elif (
        joined is None
        and status == UNKNOWN
        and len(waves.density) >= MIN_BINS
        and waves.density.all()
    ):
        variance = np.full(waves.density.shape, CALIBRATION**2)
        fit = fitted_hurst(waves.wavevector, waves.density, variance)
        density, tail = continued_spectrum(waves.wavevector, waves.density, fit)
        hurst, ended_by = tail.tail_hurst, tail.tail_ended_by
    # Without an exponent nothing is added: slope or curvature are at their bounds already.
    if density is not None and math.isnan(hurst) and rolloff <= longest:
        status = NEGLIGIBLE
    elif density is not None:
        whole = rough_part(Spectrum(WAVEVECTORS, density))
        found = closed_form(whole, contact)
        inside = known and is_tried(whole, contact, found)
        yield _force("continued_force", found, coordinates(whole, contact, found), inside)
        for end, edge in zip(VALIDATED[1:], edges(whole, contact, tolerance), strict=True):
            yield Number(f"continued_{end}", edge, "nm", status=FOUND if edge > 0 else NONE)
        yield Number("continued_to", float(2 * np.pi / whole.wavevector[-1]), "nm")
        yield Number("continued_rolloff", rolloff, "nm")
        yield Number("continued_hurst", hurst, status=ended_by)
        change = abs(found.force / force - 1)
        status = MATTERS if change > CHANGE else NEGLIGIBLE
    yield Number("continued_change", change, status=status)


def _longest_octave(waves: Spectrum, contact: Contact, found: ClosedForm) -> Number:
    """Return how much the longest octave of a spectrum changes the force.

    It is not known of a spectrum that has hardly more than this octave.
    """
    kept = waves.wavevector >= 2 * waves.wavevector[0]
    change, status = math.nan, UNKNOWN
    if kept.sum() >= 2:
        inner = Spectrum(waves.wavevector[kept], waves.density[kept])
        change = abs(closed_form(inner, contact).force / found.force - 1)
        status = MATTERS if change > CHANGE else NEGLIGIBLE
    return Number("longest_octave_change", change, status=status)


def _tried(waves: Spectrum, contact: Contact, found: ClosedForm) -> Iterator[Number]:
    """Yield what an error depends on, with the range that it has in the table."""
    values = {"rho": contact.range, "radius": contact.radius, **coordinates(waves, contact, found)}
    for name, unit in TRIED.items():
        least, most = validation()[name].agg(["min", "max"])
        status = INSIDE if least <= values[name] <= most else OUTSIDE
        yield Number(f"tried_{name}", values[name], unit, least, most, status)
