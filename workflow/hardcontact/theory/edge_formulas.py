"""Both edges of the critical band as formulas of a spectrum and a contact.

Lengths are in nm. As in `closed_form`, s = sigma/rho, t = m/sigma and k = t/s. The normal
distribution has the density phi, the distribution function Phi, Q = 1 - Phi and the hazard h =
phi/Q; L(t) = ∫_t^∞ Q = phi - t Q. The waves shorter than lambda have the variance V(lambda), all
waves have sigma². At an edge ln F has changed by c = ln(1 + tolerance). The derivation is in
workflow/report/theory.md.

*All waves alike.* With E = -d ln F/d ln sigma (`elasticity`), which is s (h - s) if many points
attract and k/(1 - k) if single peaks do,

    lambda_S = V^-1[sigma² (1 - exp(-2c/E))],  lambda_L = V^-1[sigma² exp(-2c/E)].

*Waves on a summit.* Without the waves shorter than lambda, summits have the mean curvature
sqrt(32/(3 pi)) kappa; kappa is the rms half-Laplacian of the remaining waves (Nayak, J. Lubr.
Technol. 93 (1971) 398: 8/3 sqrt(m4/pi)). R_lambda is the effective radius of such a summit and the
sphere, and sigma_lambda the rms height of the shorter waves. The contact flattens the shorter waves
down to the level t at which 2 pi R_lambda sigma_lambda L(t) = A. The mean gap that they leave,

    g(lambda) = sigma_lambda ∫_-∞^t Phi = sigma_lambda (t + L(t)),

lowers ln F by g/rho: the second lambda_S is where g = c rho. The short edge is the shorter of both
lambda_S, since either change is enough. The long edge is at least the size of a summit, 2.5
delta as in `closed_form`.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy import special

from hardcontact.contact.contact import Contact
from hardcontact.inference.curve_edges import interpolate_edge
from hardcontact.surfaces.spectrum import Floats, Spectrum
from hardcontact.theory.closed_form import SUMMIT_SIZE, contact_share, gaussian_share
from hardcontact.theory.summits import ApexLevels, apex_levels, moment, rough_waves

#: Mean curvature of the summits of a Gaussian surface relative to its rms half-Laplacian.
SUMMIT_CURVATURE = np.sqrt(32 / (3 * np.pi))
#: Levels t at which L(t) is tabulated for its inversion.
LEVELS = np.linspace(-60, 12, 7201)


class Edges(NamedTuple):
    """Both edges of the band in nm, NaN if all waves together change the force too little."""

    short: float
    long: float


def formula_edges(spectrum: Spectrum, contact: Contact, tolerance: float) -> Edges:
    """Return both edges of the critical band in plastic contact.

    spectrum: c_iso in nm⁴.
    contact: the area in contact is above zero.
    tolerance: relative change of the force that defines an edge.
    Returns short and long edge in nm.
    """
    waves = rough_waves(spectrum, contact.radius)
    change = float(np.log1p(tolerance))
    if waves is None:
        return Edges(np.nan, np.nan)
    wavelength, variance, gap = gaps_on_summits(waves, contact.radius, contact.area)
    summit_edge = interpolate_edge(wavelength, gap / contact.range, (-1.0, change))
    if np.isnan(summit_edge):
        return Edges(np.nan, np.nan)
    levels = apex_levels(waves, contact.radius, contact.area)
    force_elasticity = elasticity(float(np.sqrt(moment(waves, 0))), levels, contact)
    remaining = np.exp(-2 * change / force_elasticity) if force_elasticity > 0 else 0.0
    variances = np.array([1 - remaining, remaining]) * variance[-1]
    short, long = np.exp(np.interp(variances, variance, np.log(wavelength)))
    return Edges(float(min(short, summit_edge)), float(max(long, SUMMIT_SIZE * levels.radius)))


def gaps_on_summits(waves: Spectrum, radius: float, area: float) -> tuple[Floats, Floats, Floats]:
    """Return the mean gaps g(lambda) that waves shorter than lambda leave on summits.

    waves: waves that the sphere does not follow, as from `rough_waves`.
    radius: radius of the sphere in nm.
    area: area in contact in nm², above zero.
    Returns ascending wavelengths lambda (n,) in nm, V(lambda) in nm² and g(lambda) in nm.
    """
    q = waves.wavevector
    steps = np.diff(np.log(q))

    def cells(order: int) -> Floats:
        values = waves.density * q ** (2 + order) / (2 * np.pi)
        return np.asarray((values[1:] + values[:-1]) / 2 * steps)[::-1]

    variance = np.cumsum(cells(0))
    squared_laplacian = cells(4)
    remaining = np.maximum(squared_laplacian.sum() - np.cumsum(squared_laplacian), 0)
    curvature = SUMMIT_CURVATURE * np.sqrt(remaining) / 2 + 1 / radius
    sigma = np.sqrt(variance)
    level = level_of_area(area * curvature / (2 * np.pi * sigma))
    return 2 * np.pi / q[-2::-1], variance, sigma * height_above(-level)


def elasticity(sigma: float, levels: ApexLevels, contact: Contact) -> float:
    """Return the elasticity E = -d ln F/d ln sigma of the force.

    The first term of F, G = exp(s²/2 - t s) Phi(t - s), has the elasticity s (h - s) + phi/Phi(t -
    s) (s + t - h). Touching summits, Q, have h (h - t), except for the highest summit: its height
    is fixed. The heights that attract are normal about sigma²/rho with the standard deviation
    sigma. With the probability Phi(t - s) they lie below the sphere and are many.

    sigma: rms height of all waves in nm.
    levels: levels t of the apex at closest approach.
    contact: the sphere, the attraction and the area in contact.
    Returns e of the mean force.
    """
    t = levels.mean()
    s = sigma / contact.range
    h = float(hazard(t))
    many_points_share = special.ndtr(t - s)
    first_term = float(gaussian_share(sigma, t * sigma, contact.range))
    first_elasticity = s * (h - s) + hazard(s - t) * (s + t - h)
    summit_term = special.ndtr(-t)
    summit_elasticity = h * (h - t)
    # The highest of Poisson's clumps rises above the others by exp(-gamma) of a clump.
    highest_area = np.exp(-np.euler_gamma) * np.pi * levels.radius**2
    highest_elasticity = highest_area / (highest_area + contact.area) * summit_elasticity
    peak_elasticity = first_term * (first_elasticity - highest_elasticity)
    peak_elasticity += summit_term * (summit_elasticity - highest_elasticity)
    peak_elasticity /= first_term + summit_term + contact_share(contact)
    return float(many_points_share * first_elasticity + (1 - many_points_share) * peak_elasticity)


def hazard(level: ArrayLike) -> Floats:
    """Return h(t) = phi/Q at levels t (...): dm/d sigma at a fixed area in contact."""
    t = np.asarray(level, float)
    return np.asarray(np.exp(-(t**2) / 2 - np.log(2 * np.pi) / 2 - special.log_ndtr(-t)))


def height_above(level: ArrayLike) -> Floats:
    """Return L(t) = phi - t Q, the mean height above levels t (...), in rms heights."""
    t = np.asarray(level, float)
    return np.asarray(special.ndtr(-t) * (hazard(t) - t))


def level_of_area(area: ArrayLike) -> Floats:
    """Return the level t (...) at which L(t) = A/(2 pi R sigma), the dimensionless area (...)."""
    log_heights = -np.log(height_above(LEVELS))
    return np.asarray(np.interp(-np.log(area), log_heights, LEVELS))
