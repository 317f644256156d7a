"""Classical models of the adhesion of a rough sphere, applied to the roughness of Table 1.

The models need asperities, which Table 1 does not give: they are taken from rms height, slope and
curvature. No formula was compared with its primary source. Lengths are in nm, forces in N, works of
adhesion in J/m², moduli in Pa. Attractive forces are positive.
"""

from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq, minimize_scalar

from hardcontact.base.arrays import Floats
from hardcontact.base.units import NANOMETRE
from hardcontact.contact.hertz_jkr_dmt import Values, dmt_pull_off, jkr_pull_off

#: Close-packed hemispheres: radius r over rms height from their base, rms² = πr²/4√3.
HEMISPHERE_OVER_RMS = (4 * np.sqrt(3) / np.pi) ** 0.5
#: Rabinovich et al.: largest height of an asperity relative to the rms height.
PEAK_OVER_RMS = 1.817

#: Nodes and weights on [0, 1] of the quadrature over asperity heights.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(160)
_NODES, _WEIGHTS = (_NODES + 1) / 2, _WEIGHTS / 2
#: Range of elastic adhesion indices over which relative forces are tabulated.
ADHESION_INDICES = (1e-4, 1e7)
#: Limit of the integral over asperity heights, in their standard deviations.
MAX_HEIGHT_DEVIATIONS = 9.0

#: Tension of an asperity relative to its pull-off force, as a function of its compression, in a
#: unit that differs between models.
Tension = Callable[[Floats], Values]


class ElasticSphere(NamedTuple):
    """A smooth sphere and its materials."""

    radius: float  #: In nm.
    modulus: float  #: Effective modulus E* in Pa.
    spacing: float  #: Equilibrium spacing in nm.


class Roughness(NamedTuple):
    """Three rows of Table 1: rms values (..., surface) in nm, 1 and nm⁻¹."""

    height: Floats
    slope: Floats
    curvature: Floats


class ClassicalModel(NamedTuple):
    """A classical model of the adhesion of a rough sphere."""

    label: str  #: Name in figures.
    #: The pull-off force in N for a work of adhesion.
    force: Callable[[Values, Roughness, ElasticSphere], Values]
    is_proportional: bool  #: Whether the force is proportional to the work of adhesion.


def rumpf(work: Values, asperity_radius: Values, sphere: ElasticSphere) -> Values:
    """Return the van der Waals pull-off force of a sphere on one hemispherical asperity.

    The force is A/6z0² [rR/(r+R) + R/(1+r/z0)²] for an asperity of the radius r on a plane. A is
    12πz0²W, z0 the spacing. Rumpf, Particle Technology (1990).
    """
    reduced_radius = asperity_radius * sphere.radius / (asperity_radius + sphere.radius)
    plane_term = sphere.radius / (1 + asperity_radius / sphere.spacing) ** 2
    return dmt_pull_off(work, reduced_radius + plane_term)


def rabinovich(work: Values, roughness: Roughness, sphere: ElasticSphere) -> Values:
    """Return the van der Waals pull-off force of a sphere on flat spherical caps.

    The force is AR/6z0² [1/(1 + 32 kσR/λ²) + 1/(1 + kσ/z0)²] with A = 12πz0²W and k = 1.817. Caps
    are kσ high and λ/2 wide, for the rms height σ and the distance λ between peaks, 2πσ over the
    rms slope. Rabinovich et al., J. Colloid Interface Sci. 232 (2000) 10 and 17.
    """
    peak_distance = 2 * np.pi * roughness.height / roughness.slope
    cap_height = PEAK_OVER_RMS * roughness.height
    cap_term = 1 / (1 + 32 * cap_height * sphere.radius / peak_distance**2)
    plane_term = 1 / (1 + cap_height / sphere.spacing) ** 2
    return dmt_pull_off(work, sphere.radius) * (cap_term + plane_term)


def adhesion_index(work: Values, roughness: Roughness, modulus: float) -> Values:
    """Return the elastic adhesion index E* σ^1.5/(β^½ W) of asperities.

    Their radius β is 1 over the rms curvature, the standard deviation σ of their heights the rms
    height. Fuller and Tabor, Proc. R. Soc. A 345 (1975) 327.
    """
    height = roughness.height * NANOMETRE
    asperity_radius = 1 / roughness.curvature * NANOMETRE
    return modulus * height**1.5 / (np.sqrt(asperity_radius) * work)


def fuller_tabor(work: Values, roughness: Roughness, sphere: ElasticSphere) -> Values:
    """Return the pull-off force of a sphere with JKR asperities of Gaussian heights.

    The force of the smooth sphere, 1.5πWR, is multiplied by the largest mean tension of the
    asperities at any separation, relative to the pull-off force 1.5πβW of one. The ratio for a
    plane is assumed for the sphere.
    Fuller and Tabor, Proc. R. Soc. A 345 (1975) 327; assumptions and JKR equations as restated by
    Greenwood, Tribol. Lett. 65 (2017) 159.
    """
    index = adhesion_index(work, roughness, sphere.modulus)
    return jkr_pull_off(work, sphere.radius) * _relative_pull_off(_jkr_tension, 16, index)


def maugis_rough_dmt(work: Values, roughness: Roughness, sphere: ElasticSphere) -> Values:
    """Return the pull-off force of a sphere with DMT asperities of Gaussian heights.

    The force of the smooth sphere, 2πWR, is multiplied by the largest mean tension of the
    asperities at any separation, relative to the pull-off force 2πβW of one. As in `fuller_tabor`,
    the ratio for a plane is assumed for the sphere. Maugis, J. Adhes. Sci. Technol. 10 (1996) 161.
    """
    index = adhesion_index(work, roughness, sphere.modulus)
    return dmt_pull_off(work, sphere.radius) * _relative_pull_off(_dmt_tension, 4, index)


def _relative_pull_off(tension: Tension, spread_factor: float, index: Values) -> Values:
    """Return the pull-off force of asperities of Gaussian heights relative to equal heights.

    Asperities of equal height all pull off at once. Of unequal ones the high ones are still pressed
    when the low ones have let go, so together they pull less: JKR asperities 0.73 times as much at
    the adhesion index 1, 0.036 times at 10. At each separation of the surfaces the asperities have
    a mean tension, and the pull-off force is its largest value over all separations. It depends on
    the adhesion index alone, so a spline holds it. Beyond ADHESION_INDICES the nearest of them
    counts.
    """
    log_index = np.log(np.clip(index, *ADHESION_INDICES))
    return np.exp(-np.exp(_force_spline(tension, spread_factor)(log_index)))


@lru_cache
def _force_spline(tension: Tension, spread_factor: float) -> CubicSpline:
    """Return a spline of ln(-ln r) by ln θ: relative pull-off force r at the adhesion index θ.

    The spread, the standard deviation of heights in the unit of the compression, is
    (spread_factor θ²/9π²)^⅓. The factor is 16 for the unit of `_jkr_tension`, 4 for `_dmt_tension`.
    """
    indices = np.geomspace(*ADHESION_INDICES, 221)
    spreads = np.cbrt(spread_factor * indices**2 / (9 * np.pi**2))
    log_forces = np.array([_log_largest_tension(tension, spread) for spread in spreads])
    return CubicSpline(np.log(indices), np.log(-log_forces))


def _log_largest_tension(tension: Tension, spread: float) -> float:
    """Return ln(largest mean tension over all separations), at a spread of `_force_spline`.

    The search has two steps. At the separation of balance the asperities pull as much as they push.
    The largest tension lies beyond it, where they pull more, and the logarithm of the distance from
    the balance is searched.
    """
    # These limits contain the balance for all adhesion indices of the spline.
    lowest, highest = -3 / spread - 12, 10 + 6 * spread
    balance = brentq(
        lambda separation: _mean_tension(tension, spread, separation)[0], lowest, highest
    )

    def minus_log_tension(log_distance: float) -> float:
        value, exponent = _mean_tension(tension, spread, balance + np.exp(log_distance))
        return -(np.log(value) + exponent) if value > 0 else np.inf

    bounds = np.log(1e-8), np.log(highest - balance)
    minimum = minimize_scalar(
        minus_log_tension, bounds=bounds, method="bounded", options={"xatol": 1e-7}
    )
    log_factor = np.log(2 * np.pi) / 2  # `_mean_tension` returns sqrt(2π) times the mean.
    return float(-minimum.fun - log_factor)


def _mean_tension(tension: Tension, spread: float, separation: float) -> tuple[float, float]:
    """Return the mean tension of Gaussian asperities times sqrt(2π) exp(-exponent), and exponent.

    The separation is in standard deviations of heights; an asperity of mean height detaches at 0.
    An asperity z deviations above the mean has the compression z - separation. The mean integrates
    over compressions, with the Gaussian density of z = separation + compression. The exponent
    prevents an underflow between separated surfaces.
    """
    # Compressions below `low` or above `high` do not count: there asperities are apart, or rarer
    # than exp(-MAX_HEIGHT_DEVIATIONS²/2) of the maximum.
    low = max(0.0, -MAX_HEIGHT_DEVIATIONS - separation)
    high = (
        MAX_HEIGHT_DEVIATIONS**2 / (separation + np.hypot(separation, MAX_HEIGHT_DEVIATIONS))
        if separation > 0
        else MAX_HEIGHT_DEVIATIONS - separation
    )
    exponent = -(max(separation, 0.0) ** 2) / 2
    # Nodes are squared, because the tension of JKR asperities begins as a square root.
    compression = low + (high - low) * _NODES**2
    weight = 2 * (high - low) * _NODES * _WEIGHTS
    density = np.exp(-((separation + compression) ** 2) / 2 - exponent)
    return float(np.sum(weight * density * tension(spread * compression))), exponent


def _jkr_tension(compression: Floats) -> Values:
    """Return the tension of an asperity relative to its pull-off force 1.5πβW.

    The compression, in (π²W²β/K²)^⅓ with K = 4E*/3, is zero where the asperity detaches at fixed
    grips. It is a quartic polynomial of the square root x of the contact radius.
    """
    smallest_x = 6 ** (-1 / 6)  # at detachment
    # Newton's iteration finds the excess of x over the smallest x, from above.
    excess = np.minimum(np.sqrt(compression / 6) / smallest_x, compression**0.25)
    for _ in range(7):
        value = excess**2 * (excess**2 + 4 * smallest_x * excess + 6 * smallest_x**2) - compression
        slope = excess * (4 * excess**2 + 12 * smallest_x * excess + 12 * smallest_x**2)
        excess = excess - np.divide(value, slope, out=np.zeros_like(excess), where=slope > 0)
    x_cubed = (smallest_x + excess) ** 3
    return (np.sqrt(6) * x_cubed - x_cubed**2) / 1.5


def _dmt_tension(compression: Floats) -> Values:
    """Return the tension relative to 2πβW; the compression is in (2πβW/Kβ^½)^⅔."""
    return 1 - compression**1.5


CLASSICAL_MODELS = {
    "rumpf_height": ClassicalModel(
        "Rumpf (height)",
        lambda work, roughness, sphere: rumpf(work, HEMISPHERE_OVER_RMS * roughness.height, sphere),
        is_proportional=True,
    ),
    "rumpf_curvature": ClassicalModel(
        "Rumpf (curvature)",
        lambda work, roughness, sphere: rumpf(work, 1 / roughness.curvature, sphere),
        is_proportional=True,
    ),
    "rabinovich": ClassicalModel("Rabinovich", rabinovich, is_proportional=True),
    "fuller_tabor": ClassicalModel("Fuller–Tabor", fuller_tabor, is_proportional=False),
    "maugis": ClassicalModel("Maugis", maugis_rough_dmt, is_proportional=False),
}
