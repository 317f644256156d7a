"""What the closed form says of experiments that state no spectrum: distributions of numbers.

A published force rarely comes with the spectrum of the roughness, the hardness and the range of
adhesion. What is not stated is drawn from a prior, and the closed form turns each draw into the
number that was measured, one in which the work of adhesion cancels. The error of the closed form
is drawn too, from those on the designed surfaces that are nearest (`prediction`).
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hardcontact.insight.closed_form import (
    ClosedForm,
    Contact,
    closed_form,
    contact_share,
    smooth_force,
)
from hardcontact.insight.experiments import (
    DISTANCE,
    EXPONENT,
    FALL,
    HEIGHT,
    RADIUS,
    RATIO,
    ROUGHER,
    UNKNOWN,
    Experiment,
)
from hardcontact.insight.prediction import coordinates, is_tried, neighbouring_errors
from hardcontact.insight.summits import moment
from hardcontact.surfaces.spectral_models import self_affine
from hardcontact.surfaces.spectrum import WAVEVECTORS, Floats, Spectrum

#: Lateral scales, which both surfaces of a fall need not share, and what they do share.
ROLL_OFF = "rolloff_nm"
LATERAL = (ROLL_OFF, "hurst", "shortest_nm")
SHARED = (RADIUS, "preload_nN", "hardness_GPa", "range_nm")
#: Ranks of the law's error, 0 the least and 1 the greatest of computed over predicted force.
ERRORS = ("error", f"{ROUGHER}error")


class Case(NamedTuple):
    """A surface, what touches it, and the closed form of their force."""

    waves: Spectrum
    contact: Contact
    found: ClosedForm

    def error(self, rank: float) -> float:
        """Return a computed over the predicted force, by its rank among the nearest surfaces."""
        place = coordinates(self.waves, self.contact, self.found)
        return float(np.quantile(neighbouring_errors(place, "force"), rank))

    def inside(self) -> bool:
        """Return whether the case lies within what the error was measured on."""
        return is_tried(*self)


def drawn(experiment: Experiment, draws: int, rng: np.random.Generator) -> dict[str, Floats]:
    """Return draws (draws,) of what the law needs, by the names of columns, in their units.

    All are even in their logarithm. The prior of a roll-off is a multiple of the rms height.
    Lateral scales of the second surface of a fall, named after ROUGHER, are drawn by themselves.
    ERRORS are ranks.
    """

    def spread(column: str) -> Floats:
        _, low, high = experiment.cells[column]
        return np.asarray(low * (high / low) ** rng.random(draws))

    found = {name: spread(name) for name in SHARED}
    for prefix in ("", ROUGHER) if experiment.statement == FALL else ("",):
        height = found[prefix + HEIGHT] = spread(prefix + HEIGHT)
        found |= {prefix + name: spread(name) for name in LATERAL}
        if experiment.cells[ROLL_OFF].basis == UNKNOWN:
            found[prefix + ROLL_OFF] *= height
    return found | {name: rng.random(draws) for name in ERRORS}


def cases(experiment: Experiment, draw: Mapping[str, float]) -> list[Case]:
    """Return the cases whose forces make the number of an experiment, for one draw.

    They are both surfaces of a fall, the smoother first; both ends of the radius of an exponent;
    else a single one.
    """
    rho, area = draw["range_nm"], draw["preload_nN"] / draw["hardness_GPa"]  # nm²
    ends = experiment.cells[RADIUS]
    radii = [ends.low, ends.high] if experiment.statement == EXPONENT else [draw[RADIUS]]
    prefixes = ["", ROUGHER] if experiment.statement == FALL else [""]
    found = []
    for prefix in prefixes:
        waves = _spectrum(*(draw[prefix + name] for name in (HEIGHT, *LATERAL)))
        for radius in radii:
            contact = Contact(radius, rho, 1.0, area)
            found.append(Case(waves, contact, closed_form(waves, contact)))
    return found


def _spectrum(rms_height: float, rolloff: float, hurst: float, shortest: float) -> Spectrum:
    """Return C_iso, constant above the roll-off and self-affine to the shortest wavelength."""
    wavevector = np.geomspace(WAVEVECTORS[0], 2 * np.pi / shortest, len(WAVEVECTORS))
    waves = Spectrum(wavevector, self_affine(wavevector, 1.0, rolloff, hurst))
    return Spectrum(wavevector, waves.density * rms_height**2 / moment(waves, 0))


def number_of_law(statement: str, of: Sequence[Case], errors: Sequence[float]) -> float:
    """Return the number that an experiment states, from its cases and errors of their forces.

    Errors are computed over predicted forces, 1 of the closed form itself. No force exceeds that
    on a smooth surface. It is NaN where the area in contact alone would attract as much: such a
    sphere has no rough contact. A distance, from the mean plane, is in nm; it has no error.
    """
    if any(contact_share(one.contact) >= 1 for one in of):
        return np.nan
    if statement == DISTANCE:
        return of[0].found.closest_approach
    smooth = [smooth_force(one.contact) for one in of]
    pairs = zip(of, errors, smooth, strict=False)
    forces = [min(one.found.force * error, most) for one, error, most in pairs]
    if statement == RATIO:
        return forces[0] / smooth[0]
    if statement == FALL:
        return forces[0] / forces[1]
    radii = [one.contact.radius for one in of]
    return float(np.log(forces[1] / forces[0]) / np.log(radii[1] / radii[0]))


def numbers_of_law(
    experiment: Experiment, draws: Mapping[str, Floats]
) -> tuple[Floats, NDArray[np.bool_]]:
    """Return the number (draws,) of each draw with the error of the law, and where it was tried."""
    numbers, inside = [], []
    for values in zip(*draws.values(), strict=True):
        draw = dict(zip(draws, values, strict=True))
        of = cases(experiment, draw)
        errors = [one.error(draw[name]) for one, name in zip(of, ERRORS, strict=False)]
        numbers.append(number_of_law(experiment.statement, of, errors))
        inside.append(all(one.inside() for one in of))
    return np.array(numbers), np.array(inside)
