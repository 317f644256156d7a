"""Classical models of the adhesion of a rough sphere, applied to the roughness of Table 1.

The models need radii, heights and distances of asperities, which Table 1 does not give; how they
follow from rms height, slope and curvature is assumed and is described with each model. Lengths in
nm, forces in N, works of adhesion in J/m², moduli in Pa. Forces are positive where they pull.
Arguments may be arrays; they broadcast.
"""

from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq, minimize_scalar

from hardcontact.contact.smooth_sphere import NANOMETRE, Values, dmt_pull_off, jkr_pull_off

# Close-packed hemispheres of radius r, heights from their base: rms² = π r²/4√3.
HEMISPHERE_OVER_RMS = (4 * np.sqrt(3) / np.pi) ** 0.5
# Rabinovich et al.: greatest height of an asperity over the rms height.
PEAK_OVER_RMS = 1.817

# Nodes and weights on [0, 1] of the quadrature over asperity heights.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(160)
_NODES, _WEIGHTS = (_NODES + 1) / 2, _WEIGHTS / 2
INDICES = (1e-4, 1e7)  # elastic adhesion indices between which relative forces are tabulated
TAIL = 9.0  # standard deviations of asperity heights at which the integral ends

#: Tension of asperities over that of a single one at pull-off, for their compressions.
Tension = Callable[[np.ndarray], Values]

ASPERITIES = (
    "Gaussian asperity heights of standard deviation rms height, asperity radius 1/rms curvature "
    "(both assumed)"
)
UNVERIFIED = "unverified against the primary source"


class ElasticSphere(NamedTuple):
    """A smooth sphere and its materials, the same for all models."""

    radius: float  #: Of the sphere, in nm.
    modulus: float  #: Effective modulus E* in Pa.
    spacing: float  #: Equilibrium spacing in nm.


class Roughness(NamedTuple):
    """Three rows of Table 1: rms values (..., surface) in nm, 1 and nm⁻¹."""

    height: np.ndarray
    slope: np.ndarray
    curvature: np.ndarray


class Model(NamedTuple):
    """A classical model of the adhesion of a rough sphere."""

    label: str  #: Its name in figures.
    #: The pull-off force in N for a work of adhesion.
    force: Callable[[Values, Roughness, ElasticSphere], Values]
    proportional: bool  #: Whether the force is proportional to the work of adhesion.
    roughness: str  #: How its asperities follow from rms values.
    verified: str  #: Against which source its equations were checked.


def rumpf(work: Values, radius: Values, asperity_radius: Values, spacing: float) -> Values:
    """Return the van der Waals pull-off force of a sphere on one hemispherical asperity.

    A/6z0² [rR/(r+R) + R/(1+r/z0)²] with A = 12πz0²W, the Hamaker constant that gives the smooth
    sphere 2πWR; z0 is the spacing. The asperity of the radius r stands on a plane. Rumpf, Particle
    Technology (1990). Unverified against the primary source.
    """
    contact = asperity_radius * radius / (asperity_radius + radius)
    return dmt_pull_off(work, contact + radius / (1 + asperity_radius / spacing) ** 2)


def rabinovich(work: Values, roughness: Roughness, sphere: ElasticSphere) -> Values:
    """Return the van der Waals pull-off force of a sphere on flat spherical caps.

    AR/6z0² [1/(1 + 32 k Rσ/λ²) + 1/(1 + kσ/z0)²] with k = 1.817, A = 12πz0²W, for the rms height σ
    and the distance λ between peaks, 2π σ over the rms slope. The caps are kσ high and λ/2 wide.
    Rabinovich et al., J. Colloid Interface Sci. 232 (2000) 10 and 17: what defines an asperity is
    that of the abstract, the coefficients are unverified against the primary source. For σ = 0 at a
    given λ the force is twice that of the smooth sphere.
    """
    distance = 2 * np.pi * roughness.height / roughness.slope
    peak = PEAK_OVER_RMS * roughness.height
    contact = 1 / (1 + 32 * peak * sphere.radius / distance**2)
    return dmt_pull_off(work, sphere.radius) * (contact + 1 / (1 + peak / sphere.spacing) ** 2)


def adhesion_index(work: Values, roughness: Roughness, modulus: float) -> Values:
    """Return the elastic adhesion index E* σ^1.5/(β^½ W) of asperities of the radius β.

    It is the force to flatten asperities, whose heights have the standard deviation σ, over that of
    adhesion, which vanishes beyond about 10. Fuller and Tabor, Proc. R. Soc. A 345 (1975) 327.
    Unverified against the primary source.
    """
    height, asperity = roughness.height * NANOMETRE, 1 / roughness.curvature * NANOMETRE
    return modulus * height**1.5 / (np.sqrt(asperity) * work)


def fuller_tabor(work: Values, roughness: Roughness, sphere: ElasticSphere) -> Values:
    """Return the pull-off force of a sphere with JKR asperities of Gaussian heights.

    1.5πWR, that of the smooth sphere, times the pull-off force of the asperities over that of as
    many of equal height. That the ratio of a plane holds for the sphere is assumed here. Fuller and
    Tabor, Proc. R. Soc. A 345 (1975) 327, restated by Greenwood, Tribol. Lett. 65 (2017) 159, whose
    assumptions and JKR equations these are; unverified against the primary source.
    """
    index = adhesion_index(work, roughness, sphere.modulus)
    return jkr_pull_off(work, sphere.radius) * _relative_pull_off(_jkr_tension, 16, index)


def maugis_rough_dmt(work: Values, roughness: Roughness, sphere: ElasticSphere) -> Values:
    """Return the pull-off force of a sphere with DMT asperities of Gaussian heights.

    2πWR, that of the smooth sphere, times the greatest tension over separations d of ∫ [K β^½
    (z-d)^1.5 - 2πβW] φ(z) dz, z > d, over 2πβW; assumed for a sphere as in `fuller_tabor`. Maugis,
    J. Adhes. Sci. Technol. 10 (1996) 161. Unverified against the primary source.
    """
    index = adhesion_index(work, roughness, sphere.modulus)
    return dmt_pull_off(work, sphere.radius) * _relative_pull_off(_dmt_tension, 4, index)


def _jkr_tension(compression: np.ndarray) -> Values:
    """Return the tension of an asperity over its pull-off force 1.5πβW.

    The compression counts from where the asperity comes off at fixed grips, in (π²W²β/K²)^⅓. It is
    quartic in the root of the contact radius; Newton's iteration finds the only root from above.
    """
    least = 6 ** (-1 / 6)
    above = np.minimum(np.sqrt(compression / 6) / least, compression**0.25)
    for _ in range(7):
        value = above**2 * (above**2 + 4 * least * above + 6 * least**2) - compression
        slope = above * (4 * above**2 + 12 * least * above + 12 * least**2)
        above = above - np.divide(value, slope, out=np.zeros_like(above), where=slope > 0)
    cube = (least + above) ** 3
    return (np.sqrt(6) * cube - cube**2) / 1.5


def _dmt_tension(compression: np.ndarray) -> Values:
    """Return the tension over 2πβW; the compression in (2πβW/Kβ^½)^⅔ balances adhesion at 1."""
    return 1 - compression**1.5


def _greatest_tension(tension: Tension, spread: float) -> float:
    """Return ln of the greatest mean tension of asperities over all separations.

    The standard deviation `spread` of asperity heights is in the unit of the compression.
    """
    lowest, highest = -3 / spread - 12, 10 + 6 * spread
    # From this separation on the asperities pull more than they push.
    balance = brentq(lambda place: _mean_tension(tension, spread, place)[0], lowest, highest)

    def minus_logarithm(logarithm: float) -> float:
        value, exponent = _mean_tension(tension, spread, balance + np.exp(logarithm))
        return -(np.log(value) + exponent) if value > 0 else np.inf

    ends = np.log(1e-8), np.log(highest - balance)
    least = minimize_scalar(minus_logarithm, bounds=ends, method="bounded", options={"xatol": 1e-7})
    return float(-least.fun - np.log(2 * np.pi) / 2)


def _mean_tension(tension: Tension, spread: float, place: float) -> tuple[float, float]:
    """Return the mean tension of Gaussian asperities times sqrt(2π) exp(-exponent), and exponent.

    An asperity of mean height comes off at the separation `place`, in standard deviations of
    heights. The exponent keeps the mean tension of separated surfaces within floats.
    """
    low = max(0.0, -TAIL - place)
    high = TAIL**2 / (place + np.hypot(place, TAIL)) if place > 0 else TAIL - place
    exponent = -(max(place, 0.0) ** 2) / 2
    # Squared nodes, because the tension of JKR asperities begins as a square root.
    height = low + (high - low) * _NODES**2
    weight = 2 * (high - low) * _NODES * _WEIGHTS
    density = np.exp(-((place + height) ** 2) / 2 - exponent)
    return float(np.sum(weight * density * tension(spread * height))), exponent


@lru_cache
def _spline(tension: Tension, factor: float) -> CubicSpline:
    """Return a spline of ln(-ln r) over ln θ: nearly straight if the relative force r is not 0.

    The spread of heights in the unit of the compression is (factor θ²/9π²)^⅓.
    """
    indices = np.geomspace(*INDICES, 221)
    spreads = np.cbrt(factor * indices**2 / (9 * np.pi**2))
    logarithms = np.array([_greatest_tension(tension, spread) for spread in spreads])
    return CubicSpline(np.log(indices), np.log(-logarithms))


def _relative_pull_off(tension: Tension, factor: float, index: Values) -> Values:
    """Return the pull-off force of asperities over that of as many of equal height.

    At the lower end of INDICES it is that of the smooth sphere, at the upper end zero.
    """
    return np.exp(-np.exp(_spline(tension, factor)(np.log(np.clip(index, *INDICES)))))


MODELS = {
    "rumpf_height": Model(
        "Rumpf (height)",
        lambda work, roughness, sphere: rumpf(
            work, sphere.radius, HEMISPHERE_OVER_RMS * roughness.height, sphere.spacing
        ),
        True,
        "hemispheres of radius 1.485 rms height (close-packed; assumed)",
        UNVERIFIED,
    ),
    "rumpf_curvature": Model(
        "Rumpf (curvature)",
        lambda work, roughness, sphere: rumpf(
            work, sphere.radius, 1 / roughness.curvature, sphere.spacing
        ),
        True,
        "hemispheres of radius 1/rms curvature (assumed)",
        UNVERIFIED,
    ),
    "rabinovich": Model(
        "Rabinovich",
        rabinovich,
        True,
        "rms height; distance of peaks 2 pi rms height / rms slope, that of one wavelength "
        "(assumed)",
        f"definition of the asperity: abstract of the primary source; coefficients: {UNVERIFIED}",
    ),
    "fuller_tabor": Model(
        "Fuller–Tabor",
        fuller_tabor,
        False,
        ASPERITIES,
        f"assumptions and JKR equations: Greenwood, Tribol. Lett. 65 (2017) 159; {UNVERIFIED}",
    ),
    "maugis": Model("Maugis", maugis_rough_dmt, False, ASPERITIES, UNVERIFIED),
}
