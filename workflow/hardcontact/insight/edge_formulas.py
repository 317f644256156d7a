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
from scipy import special, stats

from hardcontact.insight.closed_form import SUMMIT, Contact, contact_share, gaussian_share
from hardcontact.insight.summits import Approaches, closest_approaches, moment, rough_waves
from hardcontact.scales.critical_band import critical_wavelength
from hardcontact.surfaces.spectrum import Floats, Spectrum

#: Mean curvature of the summits of a Gaussian surface over its rms half-Laplacian.
SUMMIT_CURVATURE = np.sqrt(32 / (3 * np.pi))
#: Levels at which L(t) is tabulated to be inverted.
LEVELS = np.linspace(-60, 12, 7201)


class Edges(NamedTuple):
    """Both edges of the band, NaN where all waves together change the force too little."""

    short: float  #: In nm.
    long: float  #: In nm.
    level: float  #: t on the waves shorter than the short edge: the contact flattens below zero.


class Scales(NamedTuple):
    """What the waves shorter than a wavelength are on the summits of all longer ones."""

    wavelength: Floats  #: (n,) in nm, rising.
    variance: Floats  #: (n,) V in nm².
    level: Floats  #: (n,) t of closest approach on a summit.
    gap: Floats  #: (n,) g in nm.


def hazard(level: ArrayLike) -> Floats:
    """Return h(t) = phi/Q (...) of levels t: dm/d sigma at a given area in contact."""
    t = np.asarray(level, float)
    return np.asarray(np.exp(stats.norm.logpdf(t) - stats.norm.logsf(t)))


def height_above(level: ArrayLike) -> Floats:
    """Return L(t) = phi - t Q (...): the mean height above levels t, in rms heights."""
    t = np.asarray(level, float)
    return np.asarray(stats.norm.sf(t) * (hazard(t) - t))


def level_of_area(area: ArrayLike) -> Floats:
    """Return the level t (...) with L(t) = A/(2 pi R sigma), the area (...) without unit."""
    above = -np.log(height_above(LEVELS))
    return np.asarray(np.interp(-np.log(area), above, LEVELS))


def elasticity(sigma: float, approaches: Approaches, contact: Contact) -> float:
    """Return E = -d ln F/d ln sigma, sigma the rms height (nm) of all waves.

    The first term of F, G = exp(s²/2 - t s) Phi(t - s), has s (h - s) + phi/Phi(t - s) (s + t - h);
    touching summits, Q, have h (h - t), of which the first one's share is nobody's: it is as high
    as it is. The heights that attract are normal about sigma²/rho with the deviation sigma; with
    the probability Phi(t - s) they lie below the sphere and are many.
    """
    t, s = approaches.mean(), sigma / contact.rho
    h, below = float(hazard(t)), stats.norm.cdf(t - s)
    first = float(gaussian_share(sigma, t * sigma, contact.rho))
    touching, of_touching = stats.norm.sf(t), h * (h - t)
    slope = np.exp(stats.norm.logpdf(t - s) - special.log_ndtr(t - s))
    of_first = s * (h - s) + slope * (s + t - h)
    # The highest of Poisson's clumps stands exp(-gamma) of one clump above the others.
    highest = np.exp(-np.euler_gamma) * np.pi * approaches.radius**2
    nobodys = highest / (highest + contact.area) * of_touching
    peaks = first * (of_first - nobodys) + touching * (of_touching - nobodys)
    peaks /= first + touching + contact_share(contact)
    return float(below * of_first + (1 - below) * peaks)


def scales(waves: Spectrum, radius: float, area: float) -> Scales:
    """Return the level and the mean gap of shorter waves on the summits of longer ones.

    The radius of the sphere is in nm, the area in contact, above zero, in nm².
    """
    q, steps = waves.wavevector, np.diff(np.log(waves.wavevector))

    def cells(order: int) -> Floats:
        values = waves.density * q ** (2 + order) / (2 * np.pi)
        return np.asarray((values[1:] + values[:-1]) / 2 * steps)[::-1]

    variance, of_curvature = np.cumsum(cells(0)), cells(4)
    curvature = np.sqrt(np.maximum(of_curvature.sum() - np.cumsum(of_curvature), 0)) / 2
    together = SUMMIT_CURVATURE * curvature + 1 / radius
    sigma = np.sqrt(variance)
    level = level_of_area(area * together / (2 * np.pi * sigma))
    return Scales(2 * np.pi / q[-2::-1], variance, level, sigma * height_above(-level))


def formula_edges(spectrum: Spectrum, contact: Contact, tolerance: float) -> Edges:
    """Return the edges beyond which the force in plastic contact changes by a relative change."""
    waves, change = rough_waves(spectrum, contact.radius), float(np.log1p(tolerance))
    none = Edges(np.nan, np.nan, np.nan)
    if waves is None:
        return none
    known = scales(waves, contact.radius, contact.area)
    lengths = np.log(known.wavelength)
    on_summit = critical_wavelength(known.wavelength, known.gap / contact.rho, (-1.0, change))
    if np.isnan(on_summit):
        return none
    approaches = closest_approaches(waves, contact.radius, contact.area)
    power = elasticity(float(np.sqrt(moment(waves, 0))), approaches, contact)
    stays = np.exp(-2 * change / power) if power > 0 else 0.0
    parts = np.array([1 - stays, stays]) * known.variance[-1]
    short, long = np.exp(np.interp(parts, known.variance, lengths))
    short = min(short, on_summit)
    level = float(np.interp(np.log(short), lengths, known.level))
    return Edges(float(short), float(max(long, SUMMIT * approaches.radius)), level)


def short_edge_exponents(level: ArrayLike, hurst: float) -> tuple[Floats, Floats]:
    """Return d ln lambda_S over d ln sqrt(rho) and over d ln sqrt(A), of waves on a summit.

    On a self-affine surface R_lambda sigma_lambda ~ lambda², so that L(t) ~ A/lambda². With
    e = -d ln(t + L)/d ln A = (h - t) Phi/(t + L) they are 2/(H + 2 e) and 2 e/(H + 2 e): H/2 of the
    first and the second add up to one at every level (...).
    """
    t = np.asarray(level, float)
    felt = (hazard(t) - t) * stats.norm.cdf(t) / height_above(-t)
    return np.asarray(2 / (hurst + 2 * felt)), np.asarray(2 * felt / (hurst + 2 * felt))
