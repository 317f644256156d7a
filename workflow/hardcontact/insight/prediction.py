"""What the closed form predicts from a spectrum: numbers with units, intervals and statuses."""

import math
from collections.abc import Iterator

import numpy as np

from hardcontact.contact.smooth_sphere import (
    maugis_parameter,
    tabor_parameter,
    transition_coefficient,
)
from hardcontact.insight.closed_form import (
    SMOOTH,
    ClosedForm,
    Contact,
    closed_form,
    contact_share,
    edges,
    smooth_force,
)
from hardcontact.numbers.number import Number
from hardcontact.numbers.printing import print_length, print_quantity
from hardcontact.surfaces.joined_spectrum import CALIBRATION, FEWEST, continued_spectrum
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum, all_scales_moments

#: Factor within which the closed form gives forces computed on random surfaces of 20 µm with the
#: spectra of the four diamond coatings of the paper: 1.76 in closed_form.nc of the default study
#: (`insight.closed_form_errors`). On surfaces of 5 µm, which lack the long waves, it is 2.4.
ERROR = 1.8
#: Ranges of adhesion and radius in nm and areas in contact in nm² that it was measured at (of 400
#: nm² asked for, 405 nm² in pixels of 5 µm / 1024, 763 nm² in those of 20 µm / 1024), and the
#: greatest freezing there: 83.5, rounded up.
RANGES, RADIUS, AREAS, FREEZING = (0.5, 20.0), 250e3, (400.0, 763.0), 84.0
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


def prediction(
    spectrum: Spectrum, contact: Contact, tolerance: float, name: str = "spectrum"
) -> dict[str, Number]:
    """Return all that the closed form says of a sphere on a surface of a spectrum, by name.

    Without the roughness beyond an edge the force changes by the tolerance, a relative change. The
    interval of the force is a factor of `ERROR` to either side, where spectrum and contact are like
    those that this error was measured on; otherwise it has none and the status ``"outside"``. The
    ``continued_force`` is that of the spectrum continued as in the study, unless it ends with a
    density of zero. What is no spectrum is refused as by `rough_part`, with the name.
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
    *of_tail, change = _continued(spectrum, contact, found.force, known)
    checks += [change, *_tried(contact, found)]
    sure = all(one.status in (NEGLIGIBLE, INSIDE) for one in checks)
    ends = zip(("short_edge", "long_edge"), edges(waves, contact, tolerance), strict=True)
    numbers = [
        Number("shortest_wavelength", shortest, "nm"),
        Number("longest_wavelength", longest, "nm"),
        Number("rms_height", height, "nm"),
        Number("rms_gradient", gradient),
        _force("pull_off_force", found, sure),
        *of_tail,
        Number("smooth_force", smooth, "N"),
        Number("force_ratio", found.force / smooth),
        Number("closest_approach", found.closest_approach, "nm"),
        Number("freezing", found.freezing, status=found.regime.replace(" ", "_")),
        *(
            Number(end, edge, "nm", status=FOUND if math.isfinite(edge) else NONE)
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

    The effective modulus is in Pa. The bodies are SOFT where their elasticity takes more than
    CHANGE of the force from a smooth sphere.
    """
    value = float(tabor_parameter(contact.work, contact.radius, modulus, contact.rho))
    softening = 1 - float(transition_coefficient(maugis_parameter(value))) / 2
    return Number("tabor_parameter", value, status=SOFT if softening > CHANGE else HARD)


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


def _force(name: str, found: ClosedForm, sure: bool) -> Number:
    """Return a force with its interval and whether its error is known."""
    error, status = (ERROR, INSIDE) if sure else (math.nan, OUTSIDE)
    return Number(name, found.force, "N", found.force / error, found.force * error, status)


def _continued(spectrum: Spectrum, contact: Contact, force: float, known: bool) -> Iterator[Number]:
    """Yield the force with the waves beyond the shortest; at last, how much they change the force.

    There is nothing beyond a density of zero. What has a zero within is not continued. The error is
    known only where that is known of the rest of the spectrum.
    """
    waves = rough_part(spectrum)
    change, status = math.nan, NEGLIGIBLE if spectrum.density[-1] == 0 else UNKNOWN
    if status == UNKNOWN and len(waves.density) >= FEWEST and waves.density.all():
        variance = np.full(waves.density.shape, CALIBRATION**2)
        density, tail = continued_spectrum(waves.wavevector, waves.density, variance)
        whole = rough_part(Spectrum(WAVEVECTORS, density))
        found = closed_form(whole, contact)
        inside = known and all(one.status == INSIDE for one in _tried(contact, found))
        yield _force("continued_force", found, inside)
        yield Number("continued_to", float(2 * np.pi / whole.wavevector[-1]), "nm")
        yield Number("continued_hurst", tail.tail_hurst, status=tail.tail_ended_by)
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


def _tried(contact: Contact, found: ClosedForm) -> Iterator[Number]:
    """Yield what the error depends on, with the interval that it was measured in."""
    (least, most), freezing = RANGES, found.freezing
    radius = np.isclose(contact.radius, RADIUS)
    area = AREAS[0] * (1 - 1e-9) <= contact.area <= AREAS[1]
    tried = [
        (Number("tried_range", contact.rho, "nm", least, most), least <= contact.rho <= most),
        (Number("tried_radius", contact.radius, "nm", RADIUS, RADIUS), radius),
        (Number("tried_area", contact.area, "nm2", *AREAS), area),
        (
            Number("tried_freezing", freezing, "1", 0.0, FREEZING),
            freezing <= FREEZING or found.regime == SMOOTH,
        ),
    ]
    for one, holds in tried:
        yield one._replace(status=INSIDE if holds else OUTSIDE)
