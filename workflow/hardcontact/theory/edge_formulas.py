"""Both edges of the critical band as formulas of a spectrum and a contact.

Lengths in nm. As in `closed_form`, s = sigma/rho, t = m/sigma and k = t/s; phi and Phi are of the
normal distribution, Q = 1 - Phi, h = phi/Q its hazard, L(t) = ∫_t^∞ Q = phi - t Q. The waves
shorter than lambda have the variance V(lambda), all have sigma². At an edge ln F has changed by c =
ln(1 + tolerance). The derivation is in workflow/report/theory.md.

*All waves alike.* With E = -d ln F/d ln sigma (`elasticity`), s (h - s) of many points and
k/(1 - k) of single peaks,

    lambda_S = V^-1[sigma² (1 - exp(-2c/E))],  lambda_L = V^-1[sigma² exp(-2c/E)].

*Waves on a summit.* Without the waves shorter than lambda summits have the mean curvature
sqrt(32/(3 pi)) kappa, kappa the rms half-Laplacian of the waves that stay (Nayak, J. Lubr. Technol.
93 (1971) 398: 8/3 sqrt(m4/pi)). On one of them, which with the sphere has the radius R_lambda, the
contact flattens the shorter waves, of the rms height sigma_lambda, down to the level t of
2 pi R_lambda sigma_lambda L(t) = A. The mean gap that they leave,

    g(lambda) = sigma_lambda ∫_-∞^t Phi = sigma_lambda (t + L(t)),

takes ln F down by g/rho: lambda_S is also where g = c rho. The short edge is the shorter of both,
for either is enough. The long edge is not shorter than a summit, 2.5 delta as in `closed_form`.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy import special

from hardcontact.band.critical_band import critical_wavelength
from hardcontact.contact.contact import Contact
from hardcontact.surfaces.spectrum import Floats, Spectrum
from hardcontact.theory.closed_form import SUMMIT, contact_share, gaussian_share
from hardcontact.theory.summits import Approaches, closest_approaches, moment, rough_waves

#: Mean curvature of the summits of a Gaussian surface over its rms half-Laplacian.
SUMMIT_CURVATURE = np.sqrt(32 / (3 * np.pi))
#: Levels at which L(t) is tabulated to be inverted.
LEVELS = np.linspace(-60, 12, 7201)


class Edges(NamedTuple):
    """Both edges of the band in nm, NaN where all waves together change the force too little."""

    short: float
    long: float


def formula_edges(spectrum: Spectrum, contact: Contact, tolerance: float) -> Edges:
    """Return the edges beyond which the force in plastic contact changes by a relative change.

    Parameters
    ----------
    spectrum : Spectrum
        C_iso in nm⁴.
    contact : Contact
        With an area above zero.
    tolerance : float
        Relative change of the force that counts.
    """
    waves, change = rough_waves(spectrum, contact.radius), float(np.log1p(tolerance))
    if waves is None:
        return Edges(np.nan, np.nan)
    wavelength, variance, gap = gaps_on_summits(waves, contact.radius, contact.area)
    on_summit = critical_wavelength(wavelength, gap / contact.range, (-1.0, change))
    if np.isnan(on_summit):
        return Edges(np.nan, np.nan)
    approaches = closest_approaches(waves, contact.radius, contact.area)
    power = elasticity(float(np.sqrt(moment(waves, 0))), approaches, contact)
    remaining = np.exp(-2 * change / power) if power > 0 else 0.0
    parts = np.array([1 - remaining, remaining]) * variance[-1]
    short, long = np.exp(np.interp(parts, variance, np.log(wavelength)))
    return Edges(float(min(short, on_summit)), float(max(long, SUMMIT * approaches.radius)))


def gaps_on_summits(waves: Spectrum, radius: float, area: float) -> tuple[Floats, Floats, Floats]:
    """Return wavelengths lambda (n,) in nm, rising, V(lambda) in nm² and g(lambda) in nm.

    The radius of the sphere is in nm, the area in contact, above zero, in nm².
    """
    q, steps = waves.wavevector, np.diff(np.log(waves.wavevector))

    def cells(order: int) -> Floats:
        values = waves.density * q ** (2 + order) / (2 * np.pi)
        return np.asarray((values[1:] + values[:-1]) / 2 * steps)[::-1]

    variance, squared_laplacian = np.cumsum(cells(0)), cells(4)
    longer = np.maximum(squared_laplacian.sum() - np.cumsum(squared_laplacian), 0)
    curvature = SUMMIT_CURVATURE * np.sqrt(longer) / 2 + 1 / radius
    sigma = np.sqrt(variance)
    level = level_of_area(area * curvature / (2 * np.pi * sigma))
    return 2 * np.pi / q[-2::-1], variance, sigma * height_above(-level)


def elasticity(sigma: float, approaches: Approaches, contact: Contact) -> float:
    """Return E = -d ln F/d ln sigma, sigma the rms height (nm) of all waves.

    The first term of F, G = exp(s²/2 - t s) Phi(t - s), has s (h - s) + phi/Phi(t - s) (s + t - h);
    touching summits, Q, have h (h - t), except for the first one, which is as high as it is. The
    heights that attract are normal about sigma²/rho with the deviation sigma; with the probability
    Phi(t - s) they lie below the sphere and are many.
    """
    t, s = approaches.mean(), sigma / contact.range
    h, below = float(hazard(t)), special.ndtr(t - s)
    first = float(gaussian_share(sigma, t * sigma, contact.range))
    touching, touching_power = special.ndtr(-t), h * (h - t)
    first_power = s * (h - s) + hazard(s - t) * (s + t - h)
    # The highest of Poisson's clumps stands exp(-gamma) of one clump above the others.
    highest = np.exp(-np.euler_gamma) * np.pi * approaches.radius**2
    highest_power = highest / (highest + contact.area) * touching_power
    peaks = first * (first_power - highest_power) + touching * (touching_power - highest_power)
    peaks /= first + touching + contact_share(contact)
    return float(below * first_power + (1 - below) * peaks)


def hazard(level: ArrayLike) -> Floats:
    """Return h(t) = phi/Q (...) of levels t: dm/d sigma at a given area in contact."""
    t = np.asarray(level, float)
    return np.asarray(np.exp(-(t**2) / 2 - np.log(2 * np.pi) / 2 - special.log_ndtr(-t)))


def height_above(level: ArrayLike) -> Floats:
    """Return L(t) = phi - t Q (...): the mean height above levels t, in rms heights."""
    t = np.asarray(level, float)
    return np.asarray(special.ndtr(-t) * (hazard(t) - t))


def level_of_area(area: ArrayLike) -> Floats:
    """Return the level t (...) with L(t) = A/(2 pi R sigma), the area (...) without unit."""
    above = -np.log(height_above(LEVELS))
    return np.asarray(np.interp(-np.log(area), above, LEVELS))
