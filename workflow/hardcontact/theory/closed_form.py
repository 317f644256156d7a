"""The pull-off force of a sphere on a Gaussian surface, in closed form from its spectrum.

The heights of the surface about its mean plane have the rms sigma, the sphere has the radius R. At
closest approach its apex is at the height m above that plane. Eq. 2 of the paper, averaged over the
heights, is

    F/(2 pi R W) = exp(sigma²/2rho² - m/rho) Phi(m/sigma - sigma/rho) + Q(m/sigma) + A/(2 pi R rho)

(workflow/report/theory.md). Phi is the normal distribution, Q = 1 - Phi, and A = load/hardness is
the area in contact. The first term is the mean over all points of the surface, the second is the
force of the summits that touch. If sigma/rho < m/sigma, many points below the sphere attract; if
not, the few highest points do, as in the random energy model (Derrida, Phys. Rev. B 24 (1981)
2613).

A summit is itself a rough body. Waves shorter than its size, 2.5 delta (`summits`), are roughness
on it. The same equation, with the radius delta² m/(2 sigma²) of the summit, gives its force
relative to a smooth summit, and is applied again to the summits upon it, down to the shortest
waves. This relative force also multiplies the contribution of summits below the sphere to the first
term (`rough_terms`). The area in contact flattens smaller roughness; it is at most the area pi
delta² of a summit. The size of 2.5 delta is a choice: 2 delta, 2.5 delta and pi delta were compared
on designed surfaces (`prediction`) that were not held out; 2 delta gives better edges and pi delta
better forces.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike
from scipy import special

from hardcontact.contact.contact import Contact
from hardcontact.contact.smooth_sphere import dmt_pull_off
from hardcontact.inference.curve_edges import interpolate_edge, logarithmic_limits
from hardcontact.surfaces.spectrum import Floats, Spectrum
from hardcontact.theory.summits import (
    ApexLevels,
    apex_levels,
    moment,
    rough_waves,
    spectrum_between,
)

#: Regimes: roughness hardly counts, many points of the surface attract, a few summits do.
SMOOTH, MANY_POINTS, SINGLE_PEAKS = "smooth", "many points", "single peaks"
#: A surface counts as smooth if its force exceeds this share of the force on a smooth surface. The
#: area in contact does not count in either force.
SMOOTH_SHARE = 0.9
#: Number of generations of summits on summits.
GENERATIONS = 8
#: Wavelength, in radii of its clump, below which waves are roughness on a summit: chosen with the
#: forces and edges of 48 designed surfaces that were not held out. With 2 the force changes by
#: 0.02 in its logarithm (median; at most 0.58), with pi by 0.04 (0.44).
SUMMIT_SIZE = 2.5
#: Smallest rms height on a summit that counts as roughness, in ranges of adhesion.
MIN_SUMMIT_ROUGHNESS = 0.005
#: Number of cutoffs between both ends of the spectrum at which edges are looked for.
CUTOFFS = 60


@dataclass(frozen=True)
class ClosedForm:
    """The mean pull-off force, its terms and its regime."""

    force: float  #: In N.
    relative: float  #: Force relative to 2 pi R W.
    rms_height: float  #: sigma in nm.
    apex_height: float  #: The mean of m in nm, positive above the mean plane.
    #: (sigma/rho)/(m/sigma): above one single peaks decide; infinite if m is not above zero.
    freezing: float
    regime: str  #: SMOOTH, MANY_POINTS or SINGLE_PEAKS.


def contact_share(contact: Contact) -> float:
    """Return A/(2 pi R rho), the force of the area in contact relative to 2 pi R W."""
    return contact.area / (2 * np.pi * contact.radius * contact.rho)


def smooth_force(contact: Contact) -> float:
    """Return the force (N) on a smooth surface: 2 pi R W and the force of the area in contact."""
    return float(dmt_pull_off(contact.work, contact.radius)) * (1 + contact_share(contact))


def gaussian_share(rms_height: ArrayLike, apex_height: ArrayLike, rho: ArrayLike) -> Floats:
    """Return exp(sigma²/2rho² - m/rho) Phi(m/sigma - sigma/rho): the first term of F/(2 pi R W).

    All arguments (rms height sigma, apex height m and range rho) are in nm; they broadcast.
    """
    sigma = np.asarray(rms_height)
    m = np.asarray(apex_height)
    rho = np.asarray(rho)
    log_phi = special.log_ndtr(m / sigma - sigma / rho)
    return np.asarray(np.exp(sigma**2 / (2 * rho**2) - m / rho + log_phi))


def closed_form(spectrum: Spectrum, contact: Contact, *, rough_below: bool = True) -> ClosedForm:
    """Return the mean pull-off force over contacts of a sphere on a Gaussian surface.

    Roughness at other wavelengths than those of the spectrum does not exist. Without `rough_below`
    only the summits that touch are rough; summits below the sphere attract as smooth ones.
    """
    smooth = float(dmt_pull_off(contact.work, contact.radius))
    waves = rough_waves(spectrum, contact.radius)
    if waves is None:  # The limit of an rms height of zero.
        force = smooth_force(contact)
        return ClosedForm(force, force / smooth, 0.0, 0.0, 0.0, SMOOTH)
    sigma = float(np.sqrt(moment(waves, 0)))
    levels = apex_levels(waves, contact.radius, contact.area)
    first_term, summit_term = _terms(waves, levels, contact, GENERATIONS, rough_below)
    relative = first_term + summit_term + contact_share(contact)
    m = float(sigma * levels.mean())
    freezing = float(sigma**2 / (contact.rho * m)) if m > 0 else np.inf
    regime = SINGLE_PEAKS if freezing > 1 else MANY_POINTS
    if first_term + summit_term > SMOOTH_SHARE:
        regime = SMOOTH
    return ClosedForm(smooth * relative, relative, sigma, m, freezing, regime)


def _terms(
    waves: Spectrum, levels: ApexLevels, contact: Contact, generations: int, rough_below: bool
) -> tuple[float, float]:
    """Return the first and the second term of F/(2 pi R W), averaged over levels of the apex."""
    sigma = np.sqrt(moment(waves, 0))
    summit_ratio = 1.0
    summit = roughness_on_summit(waves, levels, contact)
    if summit is not None and generations:
        finer, summit_contact = summit
        finer_levels = apex_levels(finer, summit_contact.radius, summit_contact.area)
        terms = _terms(finer, finer_levels, summit_contact, generations - 1, rough_below)
        summit_ratio = min(sum(terms), 1.0)
    first_term, summit_term = rough_terms(sigma, levels, contact.rho, summit_ratio)
    if not rough_below:
        first_term = gaussian_share(sigma, levels.levels * sigma, contact.rho)
    return levels.mean(first_term), summit_term


def rough_terms(
    sigma: float, levels: ApexLevels, rho: float, summit_ratio: float
) -> tuple[Floats, float]:
    """Return the first term of F/(2 pi R W) at each level (n,), and the mean second term.

    A rough summit attracts with `summit_ratio` times the force of a smooth one, whether it touches
    or lies below the sphere. The number of summits falls by the factor e over the height sigma/t,
    so points closer to the sphere than sigma/t are on summits. A plain mean over the plane would
    mostly count points on summits above the sphere, which closest approach excludes.
    """
    t = levels.levels
    decay_level = 1 / max(levels.mean(), 1.0)

    def both_terms(level: Floats) -> Floats:
        return gaussian_share(sigma, level * sigma, rho) + special.ndtr(-level)

    summit_share = 1 - np.exp(-decay_level * sigma / rho) * both_terms(
        t - decay_level
    ) / both_terms(t)
    first_term = gaussian_share(sigma, t * sigma, rho) * (1 - (1 - summit_ratio) * summit_share)
    return first_term, summit_ratio * levels.mean(special.ndtr(-t))


def roughness_on_summit(
    waves: Spectrum, levels: ApexLevels, contact: Contact
) -> tuple[Spectrum, Contact] | None:
    """Return the spectrum of the roughness on a touching summit, and the contact of the summit.

    None if the roughness on the summit is negligible.
    """
    finer = spectrum_between(waves, 2 * np.pi / (SUMMIT_SIZE * levels.radius), np.inf)
    if finer is None or moment(finer, 0) < (MIN_SUMMIT_ROUGHNESS * contact.rho) ** 2:
        return None
    sigma = np.sqrt(moment(waves, 0))
    level = levels.mean()
    radius = min(levels.radius**2 * max(level, 1.0) / (2 * sigma), contact.radius)
    summit_load = contact.hardness * np.pi * levels.radius**2 * 1e-18
    return finer, replace(contact, radius=radius, preload=min(contact.preload, summit_load))


def filtered_spectrum(spectrum: Spectrum, side: str, cutoff: float) -> Spectrum:
    """Return a spectrum without the wavelengths below or above a cutoff (nm).

    The side ``"short"`` removes wavelengths below the cutoff, ``"long"`` wavelengths above it. If
    no wave remains, all densities are zero.
    """
    limit = 2 * np.pi / cutoff
    filtered = (
        spectrum_between(spectrum, 0.0, limit)
        if side == "short"
        else spectrum_between(spectrum, limit, np.inf)
    )
    return filtered or Spectrum(spectrum.wavevector, np.zeros_like(spectrum.density))


def critical_band(spectrum: Spectrum, contact: Contact, tolerance: float) -> tuple[float, float]:
    """Return the short and the long edge (nm) of the band of wavelengths that decide the force.

    Without all shorter or all longer wavelengths the force changes by the tolerance; NaN if it
    never does. Summits below the sphere count as smooth: on the held-out designed surfaces rough
    summits improve the forces of single peaks, but not the edges.
    """
    wavelengths = 2 * np.pi / spectrum.wavevector[spectrum.density > 0]
    if not len(wavelengths):
        return np.nan, np.nan
    cutoffs = np.geomspace(wavelengths[-1], wavelengths[0], CUTOFFS)
    limits = logarithmic_limits(tolerance)
    unfiltered = closed_form(spectrum, contact, rough_below=False).relative

    def edge(side: str, cutoffs: Floats) -> float:
        """Return the edge (nm) of a side; no wave is removed at the first cutoff."""
        curve = [0.0]
        for cutoff in cutoffs[1:]:
            filtered = filtered_spectrum(spectrum, side, cutoff)
            relative = closed_form(filtered, contact, rough_below=False).relative
            curve.append(np.log(relative / unfiltered))
            if not limits[0] <= curve[-1] <= limits[1]:
                break
        return interpolate_edge(cutoffs[: len(curve)], np.array(curve), limits)

    return edge("short", cutoffs), edge("long", cutoffs[::-1])
