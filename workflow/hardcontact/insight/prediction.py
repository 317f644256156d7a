"""What the closed form predicts from a spectrum: numbers with units, intervals and statuses."""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from hardcontact.insight.closed_form import (
    SMOOTH,
    ClosedForm,
    Contact,
    closed_form,
    contact_share,
    edges,
    smooth_force,
)
from hardcontact.numbers.printing import print_length, print_quantity
from hardcontact.surfaces.spectrum import Spectrum, all_scales_moments

#: Factor within which the closed form gives forces computed on random surfaces of 20 µm with the
#: spectra of the four diamond coatings of the paper: 1.76 in closed_form.nc of the default study
#: (`insight.closed_form_errors`). On surfaces of 5 µm, which lack the long waves, it is 2.4.
ERROR = 1.8
#: Ranges of adhesion and radius in nm and area in contact in nm² that it was measured at, and the
#: greatest freezing there: 83.5, rounded up.
RANGES, RADIUS, AREA, FREEZING = (0.5, 20.0), 250e3, 400.0, 84.0
#: Rms height in nm below which there is no surface: a tenth of an atom.
LEAST_HEIGHT = 0.01
#: Change of the force by the last octave of a spectrum beyond which waves that it lacks matter.
CHANGE = 0.1
#: Factor between neighbouring wavelengths of a spectrum beyond which a bend may hide between them.
GAP = 4.0
#: Statuses: within what the error was measured on, or not; whether what a spectrum lacks matters;
#: edges.
INSIDE, OUTSIDE = "inside", "outside"
MATTERS, NEGLIGIBLE, UNKNOWN = "matters", "negligible", "unknown"
FOUND, NONE = "found", "none"


class Number(NamedTuple):
    """A number and its unit, the interval that belongs to it, and a status.

    Value and interval are NaN where there is none; the status is a code, or empty.
    """

    value: float
    unit: str
    low: float = math.nan
    high: float = math.nan
    status: str = ""


def prediction(spectrum: Spectrum, contact: Contact, tolerance: float) -> dict[str, Number]:
    """Return all that the closed form says of a sphere on a surface of a spectrum, by name.

    The spectrum is a `rough_part`; without the roughness beyond an edge the force changes by the
    tolerance, a relative change. The interval of the force is a factor of `ERROR` to either side,
    where spectrum and contact are like those that this error was measured on; otherwise it has
    none and the status ``"outside"``.
    """
    height, gradient, _ = map(float, all_scales_moments(spectrum))
    longest, shortest = map(float, 2 * np.pi / spectrum.wavevector[[0, -1]])
    found, smooth = closed_form(spectrum, contact), smooth_force(contact)
    gap = float((spectrum.wavevector[1:] / spectrum.wavevector[:-1]).max())
    checks = dict(_last_octaves(spectrum, contact, found)) | _tried(contact, found)
    checks["widest_gap"] = Number(gap, "1", status=UNKNOWN if gap > GAP else NEGLIGIBLE)
    sure = all(one.status in (NEGLIGIBLE, INSIDE) for one in checks.values())
    error, status = (ERROR, INSIDE) if sure else (math.nan, OUTSIDE)
    short_edge, long_edge = (
        Number(edge, "nm", status=FOUND if math.isfinite(edge) else NONE)
        for edge in edges(spectrum, contact, tolerance)
    )
    return {
        "shortest_wavelength": Number(shortest, "nm"),
        "longest_wavelength": Number(longest, "nm"),
        "rms_height": Number(height, "nm"),
        "rms_gradient": Number(gradient, "1"),
        "pull_off_force": Number(
            found.force, "N", found.force / error, found.force * error, status
        ),
        "smooth_force": Number(smooth, "N"),
        "force_ratio": Number(found.force / smooth, "1"),
        "closest_approach": Number(found.closest_approach, "nm"),
        "freezing": Number(found.freezing, "1", status=found.regime.replace(" ", "_")),
        "short_edge": short_edge,
        "long_edge": long_edge,
        "tolerance": Number(tolerance, "1"),
    } | checks


def rough_part(spectrum: Spectrum, name: str = "spectrum") -> Spectrum:
    """Return a spectrum without the zeros at its ends: it ends where its roughness does.

    Unknown densities are a ValueError of one line that begins with the name, and so is an rms
    height below any atom's or above the longest wave, for its unit is wrong.
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
    height, longest = all_scales_moments(part)[0], 2 * np.pi / part.wavevector[0]
    if not LEAST_HEIGHT <= height <= longest:
        raise ValueError(
            f"{name}: expected densities of an rms height of {print_length(LEAST_HEIGHT)} to "
            f"{print_length(longest)}, its longest wavelength, found {height:.3g} nm: is the unit "
            "right?"
        )
    return part


def too_wide(contact: Contact, preload: float) -> str:
    """Return that a contact alone would attract as much as the whole smooth sphere, if it would.

    The preload, in N, is that of the contact.
    """
    share = contact_share(contact)
    if share < 1:
        return ""
    return (
        f"preload: expected less than {print_quantity(preload / share, 'N')} at this hardness, "
        f"radius and range, found {print_quantity(preload, 'N')}: the contact alone would stick "
        "like a smooth sphere"
    )


def _last_octaves(
    spectrum: Spectrum, contact: Contact, found: ClosedForm
) -> Iterator[tuple[str, Number]]:
    """Yield how much the last octave of either end of a spectrum changes the force, by name.

    It is not known of a spectrum that has hardly more than this octave.
    """
    wavevector = spectrum.wavevector
    ends = {
        "longest_octave_change": wavevector >= 2 * wavevector[0],
        "shortest_octave_change": wavevector <= wavevector[-1] / 2,
    }
    for name, kept in ends.items():
        change, status = math.nan, UNKNOWN
        if kept.sum() >= 2:
            inner = Spectrum(wavevector[kept], spectrum.density[kept])
            change = abs(closed_form(inner, contact).force / found.force - 1)
            status = MATTERS if change > CHANGE else NEGLIGIBLE
        yield name, Number(change, "1", status=status)


def _tried(contact: Contact, found: ClosedForm) -> dict[str, Number]:
    """Return what the error depends on, with the interval that it was measured in."""
    freezing, (least, most) = found.freezing, RANGES
    tried = {
        "tried_range": (contact.rho, "nm", least, most, least <= contact.rho <= most),
        "tried_radius": (contact.radius, "nm", RADIUS, RADIUS, np.isclose(contact.radius, RADIUS)),
        "tried_area": (contact.area, "nm2", AREA, AREA, np.isclose(contact.area, AREA)),
        "tried_freezing": (
            freezing, "1", 0.0, FREEZING, freezing <= FREEZING or found.regime == SMOOTH,
        ),
    }  # fmt: skip
    return {
        name: Number(value, unit, low, high, INSIDE if holds else OUTSIDE)
        for name, (value, unit, low, high, holds) in tried.items()
    }
