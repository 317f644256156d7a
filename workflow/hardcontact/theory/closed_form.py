"""The pull-off force of a sphere on a Gaussian surface, in closed form from its spectrum.

The surface has heights of the rms sigma about its mean plane, the sphere the radius R; at closest
approach its apex is at m above that plane. Eq. 2 of the paper, averaged over the heights, is

    F/(2 pi R W) = exp(sigma²/2rho² - m/rho) Phi(m/sigma - sigma/rho) + Q(m/sigma) + A/(2 pi R rho)

(workflow/report/theory.md), Phi the normal distribution, Q = 1 - Phi, A = load/hardness the area in
contact. The first term is the mean over all points of the surface, the second the force of the
summits that touch. If sigma/rho < m/sigma, many points below the sphere attract; if not, the few
highest points do, as in the random energy model (Derrida, Phys. Rev. B 24 (1981) 2613).

A summit is itself a rough body. Waves shorter than its size, 2.5 delta (`summits`), are roughness
on it, and the same equation, with its radius delta² m/(2 sigma²), gives the share of the force of a
smooth summit that is left; and so on to the shortest waves. This share also multiplies the part of
the first term that is of summits below the sphere (`rough_terms`). The area in contact, at most
that of a summit, pi delta², flattens what is smaller than itself. That waves begin at 2.5 delta is
a choice: of 2 delta, 2.5 delta and pi delta, tried on designed surfaces (`prediction`) that were
not held out, the first gives better edges and the last better forces.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import special

from hardcontact.band.critical_band import critical_wavelength, logarithmic_limits
from hardcontact.contact.contact import Contact
from hardcontact.contact.smooth_sphere import dmt_pull_off
from hardcontact.surfaces.spectrum import Floats, Spectrum
from hardcontact.theory.summits import (
    Approaches,
    banded,
    closest_approaches,
    clump_radius,
    moment,
    rough_waves,
)

#: Regimes: roughness hardly counts, many points of the surface attract, a few summits do.
SMOOTH, MANY_POINTS, SINGLE_PEAKS = "smooth", "many points", "single peaks"
#: Largest |m/sigma - sigma/rho| of the transition between the last two: the attraction comes from
#: heights near sigma²/rho with the standard deviation sigma, so that the highest point, at m, is
#: within one of them.
TRANSITION = 1.0
#: Share of the force on a smooth surface, both without the area in contact, beyond which a surface
#: counts as smooth.
SMOOTH_SHARE = 0.9
#: Generations of summits upon summits.
GENERATIONS = 8
#: Wavelength, in radii of its clump, below which waves are roughness on a summit.
SUMMIT = 2.5
#: Roughness on a summit counts from this rms height on, in ranges of adhesion.
FINEST = 0.005
#: Cutoffs, from one end of the spectrum to the other, at which edges are looked for.
CUTOFFS = 60


@dataclass(frozen=True)
class ClosedForm:
    """The mean pull-off force and what decides it."""

    force: float  #: In N.
    relative: float  #: Force over 2 pi R W.
    first_term: float  #: Share of 2 pi R W of the mean over all points alone, all summits smooth.
    rms_height: float  #: sigma in nm.
    closest_approach: float  #: The mean of m in nm.
    #: (sigma/rho)/(m/sigma): beyond one single peaks decide; infinite where m is not above zero.
    freezing: float
    regime: str  #: SMOOTH, MANY_POINTS or SINGLE_PEAKS.


def contact_share(contact: Contact) -> float:
    """Return A/(2 pi R rho), the force of the area in contact alone over 2 pi R W."""
    return contact.area / (2 * np.pi * contact.radius * contact.range)


def smooth_force(contact: Contact) -> float:
    """Return the force (N) on a surface without roughness: 2 pi R W, and the area in contact."""
    return float(dmt_pull_off(contact.work, contact.radius)) * (1 + contact_share(contact))


def at_transition(over_range: ArrayLike, level: ArrayLike) -> NDArray[np.bool_]:
    """Return whether sigma/rho and m/sigma are those of the transition between the regimes."""
    return np.asarray(np.abs(np.subtract(level, over_range)) < TRANSITION)


def gaussian_share(rms_height: ArrayLike, approach: ArrayLike, rho: ArrayLike) -> Floats:
    """Return exp(sigma²/2rho² - m/rho) Phi(m/sigma - sigma/rho): the first term of F/(2 pi R W).

    sigma, m and rho are in nm; they broadcast.
    """
    sigma, m, rho = np.asarray(rms_height), np.asarray(approach), np.asarray(rho)
    log_phi = special.log_ndtr(m / sigma - sigma / rho)
    return np.asarray(np.exp(sigma**2 / (2 * rho**2) - m / rho + log_phi))


def closed_form(
    spectrum: Spectrum,
    contact: Contact,
    approaches: ArrayLike | None = None,
    *,
    rough_below: bool = True,
) -> ClosedForm:
    """Return the mean pull-off force over contacts of a sphere on a Gaussian surface.

    Parameters
    ----------
    spectrum : Spectrum
        C_iso in nm⁴; only its wavelengths count.
    contact : Contact
        The sphere, the attraction and the area in contact.
    approaches : array_like, optional
        Heights m (nm) of closest approach of computed contacts; by default those that the spectrum
        lets expect.
    rough_below : bool
        Whether summits below the sphere attract as rough ones (`rough_terms`); if not, only those
        that touch do.
    """
    smooth = float(dmt_pull_off(contact.work, contact.radius))
    waves = rough_waves(spectrum, contact.radius)
    if waves is None:  # The limit of a rms height of zero.
        force = smooth_force(contact)
        return ClosedForm(force, force / smooth, 1.0, 0.0, 0.0, 0.0, SMOOTH)
    sigma = float(np.sqrt(moment(waves, 0)))
    if approaches is None:
        levels = closest_approaches(waves, contact.radius, contact.area)
    else:
        heights = np.ravel(approaches) / sigma
        (delta,) = clump_radius(waves, [heights.mean()])
        levels = Approaches(heights, np.full(heights.shape, 1 / heights.size), float(delta))
    first_term = levels.mean(gaussian_share(sigma, levels.levels * sigma, contact.range))
    first, touching = _terms(waves, levels, contact, GENERATIONS, rough_below)
    relative = first + touching + contact_share(contact)
    m = float(sigma * levels.mean())
    freezing = float(sigma**2 / (contact.range * m)) if m > 0 else np.inf
    regime = SINGLE_PEAKS if freezing > 1 else MANY_POINTS
    if first + touching > SMOOTH_SHARE:
        regime = SMOOTH
    return ClosedForm(smooth * relative, relative, first_term, sigma, m, freezing, regime)


def _terms(
    waves: Spectrum, levels: Approaches, contact: Contact, generations: int, rough_below: bool
) -> tuple[float, float]:
    """Return the first and the second term of F/(2 pi R W), the mean over levels of approach."""
    sigma = np.sqrt(moment(waves, 0))
    share, summit = 1.0, on_summit(waves, levels, contact)
    if summit is not None and generations:
        finer, summit_contact = summit
        approaches = closest_approaches(finer, summit_contact.radius, summit_contact.area)
        terms = _terms(finer, approaches, summit_contact, generations - 1, rough_below)
        share = min(sum(terms), 1.0)
    first, touching = rough_terms(sigma, levels, contact.range, share)
    if not rough_below:
        first = gaussian_share(sigma, levels.levels * sigma, contact.range)
    return levels.mean(first), touching


def rough_terms(sigma: float, levels: Approaches, rho: float, share: float) -> tuple[Floats, float]:
    """Return the first term of F/(2 pi R W) at each level (n,), and the mean second term.

    Rough summits attract with a share of the force of smooth ones, whether they touch or lie below
    the sphere. The points closer to the sphere than sigma/t, the height over which the number of
    summits falls by e, are on summits: in the mean over the plane mostly on summits that rise above
    the sphere, of which there are none.
    """
    t, relief = levels.levels, 1 / max(levels.mean(), 1.0)

    def both_terms(level: Floats) -> Floats:
        return gaussian_share(sigma, level * sigma, rho) + special.ndtr(-level)

    near = 1 - np.exp(-relief * sigma / rho) * both_terms(t - relief) / both_terms(t)
    first = gaussian_share(sigma, t * sigma, rho) * (1 - (1 - share) * near)
    return first, share * levels.mean(special.ndtr(-t))


def on_summit(
    waves: Spectrum, levels: Approaches, contact: Contact
) -> tuple[Spectrum, Contact] | None:
    """Return the roughness on a summit that touches, and the contact of its smooth shape.

    None stands for a summit without roughness that counts.
    """
    finer = banded(waves, 2 * np.pi / (SUMMIT * levels.radius), np.inf)
    if finer is None or moment(finer, 0) < (FINEST * contact.range) ** 2:
        return None
    sigma, level = np.sqrt(moment(waves, 0)), levels.mean()
    radius = min(levels.radius**2 * max(level, 1.0) / (2 * sigma), contact.radius)
    summit_load = contact.hardness * np.pi * levels.radius**2 * 1e-18
    return finer, replace(contact, radius=radius, preload=min(contact.preload, summit_load))


def filtered_spectrum(spectrum: Spectrum, side: str, cutoff: float) -> Spectrum:
    """Return a spectrum without the wavelengths below ("small") or above ("large") a cutoff."""
    limit = 2 * np.pi / cutoff
    part = banded(spectrum, 0.0, limit) if side == "small" else banded(spectrum, limit, np.inf)
    return part or Spectrum(spectrum.wavevector, np.zeros_like(spectrum.density))


def edges(spectrum: Spectrum, contact: Contact, tolerance: float) -> tuple[float, float]:
    """Return both edges (nm) of the band of wavelengths that decide the force.

    Without all that is shorter, or longer, the force changes by the tolerance, a relative change.
    They are NaN where it never does. Summits below the sphere count as smooth: on designed surfaces
    that were held out, rough ones give better forces of single peaks, but no better edges.
    """
    wavelengths = 2 * np.pi / spectrum.wavevector[spectrum.density > 0]
    if not len(wavelengths):
        return np.nan, np.nan
    cutoffs = np.geomspace(wavelengths[-1], wavelengths[0], CUTOFFS)
    limits = logarithmic_limits(tolerance)
    whole = closed_form(spectrum, contact, rough_below=False).relative

    def edge(side: str, cutoffs: Floats) -> float:
        """Return the critical wavelength (nm) of a side; from the end where no cutoff acts."""
        curve = [0.0]
        for cutoff in cutoffs[1:]:
            part = filtered_spectrum(spectrum, side, cutoff)
            relative = closed_form(part, contact, rough_below=False).relative
            curve.append(np.log(relative / whole))
            if not limits[0] <= curve[-1] <= limits[1]:
                break
        return critical_wavelength(cutoffs[: len(curve)], np.array(curve), limits)

    return edge("small", cutoffs), edge("large", cutoffs[::-1])
