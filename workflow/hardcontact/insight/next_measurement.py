"""How much a further measurement would narrow an answer, expected before anyone measures.

Truths are drawn from what the present measurements leave open: spectra, and pairs of range and work
of adhesion. Of each the closed form gives what the answer asks for, both edges, force and pair, and
what a candidate would measure: logarithms of C_iso at its wavelengths, or of a force. With outcomes
y, data x and the covariance N of the errors of x, the best linear estimate of y leaves

    V = var y - cov(y, x) [var x + N]^-1 cov(x, y)

of the variance, whatever is measured; over n truths and p data it is V (n - 1)/(n - 1 - p). (Kay,
Fundamentals of Statistical Signal Processing: Estimation Theory, 1993, section 12.3.) What is not
linear in x remains in V.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
import xarray as xr
from scipy import linalg

from hardcontact.insight.closed_form import Contact, closed_form, contact_share, edges
from hardcontact.insight.pull_off_statistics import force_statistics
from hardcontact.numbers.statistics import percentile_interval
from hardcontact.surfaces.measured_spectrum import CALIBRATION, variance_of_log, waves_in_bins
from hardcontact.surfaces.spectrum import BIN_CENTRES, HALF_DECADE, Floats, Spectrum

#: What an answer asks for.
OUTCOMES = ("short_edge", "long_edge", "force", "range", "work")
#: Contacts whose forces may be measured: that of the answer, others on the surface, and that of the
#: answer on a coating of the same roughness at a FACTOR less height.
CONTACTS = ("forces", "radius", "preload", "coating")
#: How many times smaller or larger another sphere, preload, height or scan is.
FACTOR = 10.0
#: Truths that are drawn, and tests of a mean force, an array of the paper's.
TRUTHS, TESTS = 32, 400
#: Further places that are scanned.
PLACES = 3
#: Pixels along an edge of a map, and of one reliable wave; the part of a size that is the longest.
PIXELS, OF_WAVE, PARTS = 512, 4, 3
#: Shortest reliable wavelength (nm) of sharp tips of a force microscope and its largest maps; the
#: shortest wavelength of a stylus. Assumed, too.
SHARPEST, LARGEST, STYLUS = 10.0, 100e3, 10e3
#: Length in nm of a cross section in an electron microscope and its shortest reliable wavelength.
#: Assumed: no source says how long they are in general.
SECTION, SECTION_SHORTEST = 500.0, 1.0


#: Data (draw, p) of truths, without errors, and the covariance (p, p) of the errors.
Data = tuple[Floats, Floats]


class AtHand(NamedTuple):
    """What is at hand of a surface."""

    #: Standard error of the logarithm of the mean force that the places of its scans leave.
    sampling: float
    scans: int
    tested: bool  #: Whether forces on it were measured.


@dataclass(frozen=True)
class Scan:
    """A measurement of the surface: the wavelengths (nm) at which it is reliable."""

    kind: str  #: "map" or "profile".
    size: float  #: In nm.
    shortest: float
    longest: float
    places: int = 0  #: Further places that the sphere may touch.


def drawn_truths(
    rng: np.random.Generator,
    spectra: Sequence[Spectrum],
    joined: Spectrum,
    contact: Contact,
    pairs: Sequence[tuple[float, float]],
    tolerance: float,
) -> xr.Dataset:
    """Return what is true for each of several spectra of a surface, and the forces it gives.

    Truths take the pairs of range (nm) and work of adhesion (J/m²) in turn. Over draw stand
    ``true_outcome`` (OUTCOMES; nm, N, J/m²), NaN where an edge is none, and ``true_force``
    (CONTACTS) in N, NaN where the contact alone would attract like a smooth sphere; ``places``, by
    how many standard errors the places of few scans mislead about the force; and ``variation``
    (CONTACTS) of forces over places, that of the joined spectrum. Over (draw, bin_wavevector)
    stands ``drawn_spectrum``, C_iso in nm⁴.
    """
    outcomes, forces = [], []
    for number, spectrum in enumerate(spectra):
        rho, work = pairs[number % len(pairs)]
        of_pair = _contacts(replace(contact, rho=rho, work=work))
        coating = Spectrum(joined.wavevector, joined.density / FACTOR**2)
        forces.append(
            [
                closed_form(coating if name == "coating" else spectrum, one).force
                if contact_share(one) < 1
                else np.nan
                for name, one in of_pair.items()
            ]
        )
        ends = edges(spectrum, of_pair["forces"], tolerance)
        outcomes.append([*ends, forces[-1][0], rho, work])
    variation = [force_statistics(joined, one).variation for one in _contacts(contact).values()]
    return xr.Dataset(
        {
            "true_outcome": (("draw", "outcome"), np.array(outcomes)),
            "true_force": (("draw", "contact"), np.array(forces), {"units": "N"}),
            "places": ("draw", rng.standard_normal(len(spectra)), {"units": "1"}),
            "variation": ("contact", variation, {"units": "1"}),
            "drawn_spectrum": (
                ("draw", "bin_wavevector"),
                np.array([_density(spectrum) for spectrum in spectra]),
                {"units": "nm4"},
            ),
        },
        {
            "outcome": list(OUTCOMES),
            "contact": list(CONTACTS),
            "bin_wavevector": ("bin_wavevector", BIN_CENTRES, {"units": "rad nm-1"}),
        },
    )


def _density(spectrum: Spectrum) -> Floats:
    """Return C_iso (bins,) in nm⁴, zero where the spectrum has ended."""
    density = spectrum(BIN_CENTRES)
    return np.where(spectrum.wavevector[spectrum.density > 0][-1] >= BIN_CENTRES, density, 0.0)


def _contacts(contact: Contact) -> dict[str, Contact]:
    """Return the contacts, by CONTACTS."""
    smaller = replace(contact, radius=contact.radius / FACTOR)
    harder = replace(contact, area=contact.area * FACTOR)
    return dict(zip(CONTACTS, (contact, smaller, harder, contact), strict=True))


def scans(shortest: float, longest: float, size: float, finest: float) -> dict[str, Scan]:
    """Return the scans that may be next, where the spectrum is measured between both ends.

    Finer and larger maps reach a FACTOR further, as far as force microscopes do; beyond, a stylus
    has longer waves, a cross section shorter ones. Other places are scanned like those of contacts,
    of which the size and the shortest reliable wavelength are given. Lengths are in nm.
    """
    fine, wide = max(shortest / FACTOR, SHARPEST), PARTS * longest * FACTOR
    found = {
        "more_places": Scan("map", size, finest, size / PARTS, PLACES),
    }
    if shortest > SHARPEST:
        edge = PIXELS * fine / OF_WAVE
        found["finer_map"] = Scan("map", edge, fine, edge / PARTS)
    if PARTS * longest < LARGEST:
        edge = min(wide, LARGEST)
        found["larger_map"] = Scan("map", edge, OF_WAVE * edge / PIXELS, edge / PARTS)
    if wide > LARGEST:
        found["stylus"] = Scan("profile", wide, STYLUS, wide / PARTS)
    if shortest > SECTION_SHORTEST:
        found["section"] = Scan("profile", SECTION, SECTION_SHORTEST, SECTION / PARTS)
    return found


def of_scan(scan: Scan, drawn: Floats) -> Data:
    """Return the data (draw, p) of a scan and the covariance (p, p) of their errors.

    The drawn spectra (draw, bins) are C_iso in nm⁴ at BIN_CENTRES. Data are means of ln C over half
    decades; the waves of a bin scatter, and the calibration of the scan moves all of them at once.
    """
    wavelength = 2 * np.pi / BIN_CENTRES
    inside = (scan.shortest <= wavelength) & (wavelength <= scan.longest)
    bins = np.flatnonzero(inside & (drawn > 0).all(axis=0))
    groups = np.array_split(bins, -(-len(bins) // HALF_DECADE)) if len(bins) else []
    count = max(scan.places, 1)
    variance = variance_of_log(count * waves_in_bins(scan.kind, scan.size))
    data = np.array([np.log(drawn[:, one]).mean(axis=1) for one in groups])
    errors = np.diag([variance[one].sum() / len(one) ** 2 for one in groups])
    return data.reshape(len(groups), len(drawn)).T, errors + CALIBRATION**2 / count


def linear_estimate(outcomes: Floats, data: Floats, errors: Floats) -> tuple[Floats, Floats]:
    """Return the gain (p, y) of the best linear estimate, and the variance (y,) that it leaves.

    Outcomes (n, y) and data (n, p) are those of truths, without the errors (p, p) of the data.
    """
    count, known = data.shape
    y, x = outcomes - outcomes.mean(axis=0), data - data.mean(axis=0)
    inverse = np.linalg.pinv(x.T @ x / (count - 1) + errors, hermitian=True)
    cross = x.T @ y / (count - 1)
    gain = inverse @ cross
    left = y.var(axis=0, ddof=1) - (cross * gain).sum(axis=0)
    freedom = (count - 1) / max(count - 1 - known, 1)
    return gain, np.maximum(left, 0) * freedom


def _outcomes(truths: xr.Dataset, at_hand: AtHand) -> tuple[Floats, Floats]:
    """Return logarithms (draw, OUTCOMES) as known now, and by what places mislead (draw, 1)."""
    outcomes = np.log(truths["true_outcome"].values)
    misled = at_hand.sampling * truths["places"].values[:, None]
    outcomes[:, [OUTCOMES.index("force")]] += misled
    return outcomes, misled


def present_intervals(
    truths: xr.Dataset, at_hand: AtHand, confidence: float
) -> dict[str, tuple[float, float]]:
    """Return between which values a share of the truths of one surface lies, by OUTCOMES.

    They are in nm, N and J/m², NaN where a truth has no edge that counts.
    """
    ends = percentile_interval(np.exp(_outcomes(truths, at_hand)[0]), confidence)
    return dict(zip(OUTCOMES, map(tuple, ends.tolist()), strict=True))


def widths_left(
    truths: xr.Dataset, possible: Mapping[str, Scan], at_hand: AtHand
) -> dict[str, dict[str, float]]:
    """Return which share of the interval of each outcome every measurement leaves, by its code.

    The truths are those of one surface, of `drawn_truths`.
    Shares are NaN where fewer than half of the truths have the outcome, or all have the same.
    """
    outcomes, misled = _outcomes(truths, at_hand)
    drawn, error = truths["drawn_spectrum"].values, at_hand.sampling
    candidates = {name: of_scan(scan, drawn) for name, scan in possible.items()}
    for name, scan in possible.items():
        if scan.places and error:
            of_places = misled, np.array([[error**2 * at_hand.scans / scan.places]])
            candidates[name] = _both(candidates[name], of_places)
    for name in CONTACTS:
        at = truths.sel(contact=name)
        force, variance = (
            np.log(at["true_force"].values)[:, None],
            at["variation"].item() ** 2 / TESTS,
        )
        if np.isfinite(force).all():
            # Forces on this contact show where its places lie; on others, places mislead anew.
            here = (force + misled, 0.0) if name == "forces" else (force, error**2)
            candidates[name] = here[0], np.array([[variance + here[1]]])
    before = np.empty((len(drawn), 0)), np.empty((0, 0))
    if at_hand.tested:
        before = candidates.pop("forces", before)
    return {
        name: {
            outcome: _width_left(outcomes[:, place], before, _both(before, after))
            for place, outcome in enumerate(OUTCOMES)
        }
        for name, after in candidates.items()
    }


def _width_left(outcome: Floats, before: Data, after: Data) -> float:
    """Return the width of an interval (draw,) with the data after over that with those before."""
    seen = np.isfinite(outcome)
    if seen.sum() < len(seen) / 2 or np.ptp(outcome[seen]) == 0:
        return np.nan
    known, told = (
        linear_estimate(outcome[seen, None], data[seen], errors)[1].item()
        for data, errors in (before, after)
    )
    return min(np.sqrt(told / known), 1.0) if known else np.nan


def _both(before: Data, after: Data) -> Data:
    """Return data and errors of what is known before and of what is measured after it."""
    # `linalg.block_diag` makes a row of a block without entries.
    blocks = [errors for _, errors in (before, after) if errors.size]
    data = np.hstack([before[0], after[0]])
    return data, linalg.block_diag(*blocks) if blocks else before[1]
