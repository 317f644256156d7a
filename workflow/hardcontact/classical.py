"""Closed forms of adhesive contact: smooth spheres between JKR and DMT, and rough ones.

Lengths in nm, forces in N, works of adhesion in J/m², moduli and pressures in Pa. Forces are
positive where they pull. Arguments may be arrays; they broadcast.
"""

from functools import lru_cache

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq, minimize_scalar

__all__ = [
    "adhesion_index",
    "dmt_pull_off",
    "effective_work_of_adhesion",
    "fuller_tabor",
    "jkr_pull_off",
    "maugis_dugdale_coefficient",
    "maugis_parameter",
    "maugis_rough_dmt",
    "rabinovich",
    "rumpf",
    "self_consistent_work_of_adhesion",
    "tabor_parameter",
    "transition_coefficient",
]

NANOMETRE = 1e-9  # m

# Rabinovich et al.: greatest height of an asperity over the rms height.
PEAK_OVER_RMS = 1.817

# Nodes and weights on [0, 1] of the quadrature over asperity heights.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(160)
_NODES, _WEIGHTS = (_NODES + 1) / 2, _WEIGHTS / 2
INDICES = (1e-4, 1e7)  # elastic adhesion indices between which relative forces are tabulated
TAIL = 9.0  # standard deviations of asperity heights beyond which none is counted


# Smooth spheres


def jkr_pull_off(work, radius):
    """Pull-off force (N) of a compliant sphere, 1.5πWR.

    Johnson, Kendall and Roberts, Proc. R. Soc. A 324 (1971) 301.
    """
    return 1.5 * np.pi * work * radius * NANOMETRE


def dmt_pull_off(work, radius):
    """Pull-off force (N) of a stiff sphere, 2πWR.

    Derjaguin, Muller and Toporov, J. Colloid Interface Sci. 53 (1975) 314.
    """
    return 2 * np.pi * work * radius * NANOMETRE


def tabor_parameter(work, radius, modulus, spacing):
    """Tabor parameter (RW²/E*²z0³)^⅓; small: DMT, large: JKR.

    spacing: equilibrium spacing z0 in nm. Tabor, J. Colloid Interface Sci. 58 (1977) 2.
    """
    return np.cbrt(radius * NANOMETRE * work**2 / (modulus**2 * (spacing * NANOMETRE) ** 3))


def maugis_parameter(tabor):
    """Maugis parameter λ = 2σ0 (R/πWK²)^⅓ = 1.157 times the Tabor parameter.

    K = 4E*/3; the cohesive stress σ0 = 16W/(9√3 z0) is the greatest one of the Lennard-Jones law.
    Maugis, J. Colloid Interface Sci. 150 (1992) 243.
    """
    return 32 / (9 * np.sqrt(3)) / np.cbrt(16 * np.pi / 9) * tabor


def transition_coefficient(maugis):
    """Pull-off force over πWR against the Maugis parameter, by the fit of Carpick et al.

    7/4 - ¼ (4.04 λ^1.4 - 1)/(4.04 λ^1.4 + 1), for every λ: 2 (DMT) to 3/2 (JKR). Carpick, Ogletree
    and Salmeron, J. Colloid Interface Sci. 211 (1999) 395, as used by Grierson, Flater and Carpick,
    J. Adhes. Sci. Technol. 19 (2005) 291. Unverified against the primary source; it keeps within
    1.7 % of the exact pair it was fitted to (`maugis_dugdale_coefficient`), farthest at λ = 0.26.
    """
    stiffness = 4.04 * np.asarray(maugis) ** 1.4
    return 7 / 4 - (stiffness - 1) / (stiffness + 1) / 4


def maugis_dugdale_coefficient(maugis):
    """Pull-off force over πWR against the Maugis parameter, exact for a Dugdale law.

    The pair of equations of Maugis, J. Colloid Interface Sci. 150 (1992) 243, section 6, checked
    against the implementation in the package Adhesion 0.93, solved numerically. Raises ValueError
    for a Maugis parameter that is not positive.
    """
    _require_positive("Maugis parameter", maugis)
    return np.vectorize(_maugis_dugdale, otypes=[float])(maugis)


def _maugis_dugdale(maugis):
    """Greatest tension over πWR for one λ.

    Its place in s = sqrt(m² - 1) lies near a sum of the limits: 3/(πλ)^1.5 (DMT) and 1.145/λ (JKR).
    """
    guess = np.log(3 / (np.pi * maugis) ** 1.5 + 1.145 / maugis)
    found = minimize_scalar(
        lambda logarithm: _maugis_dugdale_force(np.exp(logarithm), maugis),
        bounds=(guess - 2, guess + 2),
        method="bounded",
        options={"xatol": 1e-7},
    )
    return -found.fun


def _maugis_dugdale_force(s, maugis):
    """Force over πWR, compression positive, of the contact whose cohesive zone has m² = 1 + s².

    The first equation of the pair is quadratic in the contact radius once m is given: no root has
    to be searched for.
    """
    angle = np.arctan(s)
    excess = s**2 / (np.sqrt(1 + s**2) + 1)  # m - 1
    quadratic = maugis / 2 * (s + (s**2 - 1) * angle)
    linear = 4 / 3 * maugis**2 * (angle * s - excess)
    contact = 2 / (linear + np.sqrt(linear**2 + 4 * quadratic))
    return contact**3 - maugis * contact**2 * (s + (1 + s**2) * angle)


def effective_work_of_adhesion(force, radius, coefficient):
    """Work of adhesion (J/m²) of the smooth sphere with this pull-off force, F/(coefficient πR)."""
    return force / (coefficient * np.pi * radius * NANOMETRE)


def self_consistent_work_of_adhesion(
    force, radius, modulus, spacing, coefficient=transition_coefficient
):
    """Effective work of adhesion (J/m²) whose own Tabor parameter gives its coefficient.

    coefficient: function of the Maugis parameter. NaN where the force is NaN; raises ValueError
    for a force that is not positive.
    """
    _require_positive("pull-off force", force)

    def solve(one):
        if np.isnan(one):
            return np.nan

        def excess(work):
            maugis = maugis_parameter(tabor_parameter(work, radius, modulus, spacing))
            return effective_work_of_adhesion(one, radius, coefficient(maugis)) / work - 1

        ends = [effective_work_of_adhesion(one, radius, end) for end in (2.02, 1.48)]
        return brentq(excess, *ends, xtol=1e-12 * ends[0])

    return np.vectorize(solve, otypes=[float])(force)


# Rough spheres


def rumpf(work, radius, asperity_radius, spacing):
    """Van der Waals pull-off force (N) of a sphere on a plane with one hemispherical asperity.

    A/6z0² [rR/(r+R) + R/(1+r/z0)²] with A = 12πz0²W, the Hamaker constant that gives the smooth
    sphere 2πWR. Roughness: the radius r of the asperity, which is its height too. Rumpf, Particle
    Technology (1990). Unverified against the primary source.
    """
    contact = asperity_radius * radius / (asperity_radius + radius)
    return dmt_pull_off(work, contact + radius / (1 + asperity_radius / spacing) ** 2)


def rabinovich(work, radius, rms_height, peak_distance, spacing):
    """Van der Waals pull-off force (N) of a sphere on asperities that are flat spherical caps.

    AR/6z0² [1/(1 + 32 k Rσ/λ²) + 1/(1 + kσ/z0)²] with k = 1.817, A = 12πz0²W. Roughness: rms
    height σ and distance λ between peaks; the caps are kσ high and λ/2 wide. Rabinovich et al.,
    J. Colloid Interface Sci. 232 (2000) 10 and 17: what defines an asperity is that of the
    abstract, the coefficients are unverified against the primary source (32 follows from the caps'
    shape; close-packed paraboloids give k = 1.819). For σ = 0 at a given λ contact and plane
    both count in full, and the force is twice that of the smooth sphere.
    """
    peak = PEAK_OVER_RMS * rms_height
    contact = 1 / (1 + 32 * peak * radius / peak_distance**2)
    return dmt_pull_off(work, radius) * (contact + 1 / (1 + peak / spacing) ** 2)


def adhesion_index(work, rms_height, asperity_radius, modulus):
    """Elastic adhesion index E* σ^1.5/(β^½ W) of asperities of radius β and rms height σ (1).

    The force to flatten asperities over that of adhesion: beyond about 10 none is left. Fuller and
    Tabor, Proc. R. Soc. A 345 (1975) 327. Unverified against the primary source.
    """
    height, asperity = rms_height * NANOMETRE, asperity_radius * NANOMETRE
    return modulus * height**1.5 / (np.sqrt(asperity) * work)


def fuller_tabor(work, radius, rms_height, asperity_radius, modulus):
    """Pull-off force (N) of a sphere with JKR asperities of Gaussian heights.

    1.5πWR, that of the smooth sphere, times the pull-off force of the asperities over that of as
    many of equal height. Carrying this ratio over from a plane to the sphere is the reading used.
    Roughness: standard deviation of asperity heights, radius of asperities. Fuller and Tabor,
    Proc. R. Soc. A 345 (1975) 327, restated by Greenwood, Tribol. Lett. 65 (2017) 159, whose
    assumptions and JKR equations these are; unverified against the primary source.
    """
    index = adhesion_index(work, rms_height, asperity_radius, modulus)
    return jkr_pull_off(work, radius) * _relative_pull_off(_logarithm_jkr, index)


def maugis_rough_dmt(work, radius, rms_height, asperity_radius, modulus):
    """Pull-off force (N) of a sphere with DMT asperities of Gaussian heights.

    2πWR, that of the smooth sphere, times the greatest tension over separations d of
    ∫ [K β^½ (z-d)^1.5 - 2πβW] φ(z) dz, z > d, over 2πβW: as for `fuller_tabor` the reading used.
    Roughness: standard deviation of asperity heights, radius β of asperities. Maugis, J. Adhes.
    Sci. Technol. 10 (1996) 161. Unverified against the primary source.
    """
    index = adhesion_index(work, rms_height, asperity_radius, modulus)
    return dmt_pull_off(work, radius) * _relative_pull_off(_logarithm_dmt, index)


def _logarithm_jkr(index):
    """ln of the pull-off force of JKR asperities of Gaussian heights over that of equal heights.

    index: one elastic adhesion index > 0. Heights are measured in (π²W²β/K²)^⅓.
    """
    return _greatest_tension(_jkr_tension, np.cbrt(16 * index**2 / (9 * np.pi**2)))


def _logarithm_dmt(index):
    """As `_logarithm_jkr` for DMT asperities. Heights are measured in (2πβW/Kβ^½)^⅔."""
    return _greatest_tension(_dmt_tension, np.cbrt((2 * index / (3 * np.pi)) ** 2))


def _jkr_tension(compression):
    """Tension of an asperity over its pull-off force 1.5πβW.

    compression: from where it comes off at fixed grips, in (π²W²β/K²)^⅓. It is quartic in the root
    of the contact radius; from above, Newton's iteration goes down to the only root.
    """
    least = 6 ** (-1 / 6)
    above = np.minimum(np.sqrt(compression / 6) / least, compression**0.25)
    for _ in range(7):
        value = above**2 * (above**2 + 4 * least * above + 6 * least**2) - compression
        slope = above * (4 * above**2 + 12 * least * above + 12 * least**2)
        above = above - np.divide(value, slope, out=np.zeros_like(above), where=slope > 0)
    cube = (least + above) ** 3
    return (np.sqrt(6) * cube - cube**2) / 1.5


def _dmt_tension(compression):
    """Tension of an asperity over 2πβW; compression: in that which balances adhesion."""
    return 1 - compression**1.5


def _greatest_tension(tension, spread):
    """ln of the greatest mean tension of asperities over all separations of the two surfaces.

    tension: function of the compression of an asperity; spread: standard deviation of asperity
    heights in the unit of the compression.
    """
    lowest, highest = -3 / spread - 12, 10 + 6 * spread
    # From this separation on the asperities pull more than they push.
    balance = brentq(lambda place: _mean_tension(tension, spread, place)[0], lowest, highest)

    def minus_logarithm(logarithm):
        value, exponent = _mean_tension(tension, spread, balance + np.exp(logarithm))
        return -(np.log(value) + exponent) if value > 0 else np.inf

    ends = np.log(1e-8), np.log(highest - balance)
    found = minimize_scalar(minus_logarithm, bounds=ends, method="bounded", options={"xatol": 1e-7})
    return -found.fun - np.log(2 * np.pi) / 2


def _mean_tension(tension, spread, place):
    """Mean tension of Gaussian asperities times sqrt(2π) exp(-exponent), and this exponent.

    place: separation at which an asperity of mean height comes off, in standard deviations of
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
def _spline(logarithm):
    """Spline of ln(-ln r) over ln θ, nearly straight where the relative force r is not zero."""
    index = np.geomspace(*INDICES, 221)
    return CubicSpline(np.log(index), np.log([-logarithm(one) for one in index]))


def _relative_pull_off(logarithm, index):
    """exp(logarithm(index)) for indices of any shape, by a spline.

    At its lower end the force is that of the smooth sphere, at its upper end there is none: indices
    beyond are taken for the ends.
    """
    return np.exp(-np.exp(_spline(logarithm)(np.log(np.clip(index, *INDICES)))))


def _require_positive(name, values):
    if np.any(np.asarray(values) <= 0):
        raise ValueError(f"{name}: expected positive numbers, found {np.min(values):g}")
