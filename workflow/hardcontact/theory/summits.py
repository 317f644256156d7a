"""The highest summits under a sphere, from a spectrum alone: how high, how wide, how many.

Lengths in nm, wavevectors in rad/nm. Heights above the mean plane are in units of the rms height,
t = z/sigma. The surface is Gaussian.

Points above a high level come in clumps, one a summit. Where sigma² - r(d), r the autocorrelation
at the distance d, is 1/t² of sigma², heights are still those of the same summit: d = delta(t), and
a clump covers pi delta² on average. On a smooth surface this is the density of summits above a
level of Nayak, J. Lubr. Technol. 93 (1971) 398; on a rough one that of Pickands (Trans. Am. Math.
Soc. 145 (1969) 51), but for his constants: fine roughness makes many maxima and no more clumps.
Clumps are independent at high levels (Aldous, Probability Approximations via the Poisson Clumping
Heuristic, 1989), so that their number above a sphere is Poisson's, and the highest point Gumbel's.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy import special

from hardcontact.surfaces.spectrum import Floats, Spectrum

#: Points of a spectrum, and distances of its autocorrelation.
WAVES, DISTANCES = 300, 120
#: Levels t of closest approach: a contact wider than the roughness goes below the mean plane.
LEVELS = np.linspace(-6, 8, 701)
#: Mean clumps in the area of contact beyond which their sum is normal.
MANY = 50.0
#: Logarithm of a probability that does not count beside one, to the last digit.
RAREST = -45.0
#: Below this level heights have no clumps: those of this level stand for them.
LOWEST_CLUMPS = 1.2
#: A sphere follows waves whose curvature, all together, is less than this share of its own.
FOLLOWED = 0.1


class Approaches(NamedTuple):
    """Levels t (n,) of closest approach and their probabilities (n,), which add up to one.

    The radius is that of the clump about a summit at the mean level, in nm.
    """

    levels: Floats
    weights: Floats
    radius: float

    def mean(self, values: ArrayLike | None = None) -> float:
        """Return the mean of values (n,) at the levels, or of the levels themselves."""
        return float(self.weights @ (self.levels if values is None else np.asarray(values)))


def banded(spectrum: Spectrum, lowest: float, highest: float) -> Spectrum | None:
    """Return the waves of a spectrum between wavevectors (rad/nm) on a grid of its own, if any."""
    rough = spectrum.wavevector[spectrum.density > 0]
    if not len(rough):
        return None
    low, high = max(lowest, rough[0]), min(highest, rough[-1])
    if high <= low * (1 + 1e-9):
        return None
    wavevector = np.geomspace(low, high, WAVES)
    return Spectrum(wavevector, spectrum(np.minimum(wavevector, rough[-1])))


def moment(waves: Spectrum, order: int) -> float:
    """Return (1/2 pi) ∫ q^(1 + order) C_iso dq: squares of the rms height (0), of the gradient (2).

    Of order 4 it is the square of the rms Laplacian.
    """
    q = waves.wavevector
    return float(np.trapezoid(waves.density * q ** (2 + order), np.log(q)) / (2 * np.pi))


def rough_waves(spectrum: Spectrum, radius: float) -> Spectrum | None:
    """Return the waves that a sphere of a radius (nm) does not follow; None if it follows all.

    Waves that are flat beside the sphere lift it as they lift the surface: they are no roughness.
    """
    waves = banded(spectrum, 0, np.inf)
    if waves is None:
        return None
    q = waves.wavevector
    step = np.log(q[1] / q[0])
    curvature = np.sqrt(np.cumsum(waves.density * q**6) * step / (2 * np.pi)) / 2
    beyond = np.flatnonzero(curvature > FOLLOWED / radius)
    return banded(spectrum, q[beyond[0]], np.inf) if len(beyond) else None


def correlation_lost(waves: Spectrum) -> tuple[Floats, Floats]:
    """Return distances d (n,) in nm and 1 - r(d)/sigma² (n,), r the autocorrelation of heights."""
    q = waves.wavevector
    distances = np.geomspace(0.05 / q[-1], 10 / q[0], DISTANCES)
    lost = waves.density * q**2 * (1 - special.j0(distances[:, None] * q))
    variance = 2 * np.pi * moment(waves, 0)
    return distances, np.asarray(np.trapezoid(lost, np.log(q), axis=1) / variance)


def clump_radius(waves: Spectrum, levels: ArrayLike) -> Floats:
    """Return the radius delta(t) (n,) in nm of the clump of points about a summit, at levels t.

    It solves 1 - r(delta)/sigma² = 1/t².
    """
    distances, share = correlation_lost(waves)
    wanted = -2 * np.log(np.maximum(levels, LOWEST_CLUMPS))
    growing = np.log(np.maximum.accumulate(share))
    return np.asarray(np.exp(np.interp(wanted, growing, np.log(distances))))


def closest_approaches(waves: Spectrum, radius: float, area: float) -> Approaches:
    """Return how close a sphere comes to the mean plane until it touches a given area.

    At the height z under the sphere the area 2 pi R dz of the plane meets it, so that Lambda(t) = 2
    pi R sigma ∫_t^∞ Q(u)/(pi delta(u)²) du clumps rise above the sphere at the level t of its apex,
    Q the upper tail of the normal distribution. The area above the sphere is B(t) = 2 pi R sigma
    ∫_t^∞ Q(u) du, on average B/Lambda a clump. Areas of clumps are exponential, as they are of
    caps; their sum stays below the area of contact with the probability P(t) = exp(-Lambda) [1 +
    Σ_n Lambda^n/n! P(n, A Lambda/B)], P the incomplete gamma function: that closest approach lies
    below t. Without area it is exp(-Lambda); with many clumps it rises where B = A, the bearing
    area.

    The radius is in nm and the area, load over hardness, in nm². The lowest level has the
    probability that no point rises above it.
    """
    radii, clumps, bearing = clumps_above(waves, radius)
    # At the last level, where nothing rises, a clump has its own area.
    clump = np.append(bearing[:-1] / clumps[:-1], np.pi * radii[-1] ** 2)
    below = _touches_less(clumps, area / clump)
    middle = (LEVELS[1:] + LEVELS[:-1]) / 2
    weights = np.append(below[0], np.maximum(np.diff(below), 0))
    weights /= weights.sum()
    levels = np.append(LEVELS[0], middle)
    return Approaches(levels, weights, float(np.interp(weights @ levels, LEVELS, radii)))


def clumps_above(waves: Spectrum, radius: float) -> tuple[Floats, Floats, Floats]:
    """Return, at LEVELS, the radius of a clump, and Lambda and B of `closest_approaches`.

    That is in nm, as the radius of the sphere is, the mean number of clumps above the sphere, and
    the mean area above it in nm².
    """
    radii, tail = clump_radius(waves, LEVELS), special.ndtr(-LEVELS)
    reach = 2 * np.pi * radius * np.sqrt(moment(waves, 0))
    return radii, reach * _above(tail / (np.pi * radii**2)), reach * _above(tail)


def draw_size(spectrum: Spectrum, radius: float, area: float) -> float:
    """Return the edge 2 sqrt(2 R sigma/t) (nm) of the area in which a sphere finds its summits.

    Heights at the distance r from the apex touch if they lie r²/2R above the level t, where at high
    levels Gaussian ones are rarer by exp(-t r²/(2 R sigma)): so is the density of touching places,
    whose rms distance is sqrt(2 R sigma/t). The radius is in nm, the area in contact in nm². It is
    0 of a surface that the sphere follows; below one rms height the level counts as one.
    """
    waves = rough_waves(spectrum, radius)
    if waves is None:
        return 0.0
    level = max(closest_approaches(waves, radius, area).mean(), 1.0)
    return float(2 * np.sqrt(2 * radius * np.sqrt(moment(waves, 0)) / level))


def _above(density: Floats) -> Floats:
    """Return the integral of a density (n,) from each of LEVELS to the last."""
    cells = (density[1:] + density[:-1]) / 2 * (LEVELS[1] - LEVELS[0])
    return np.append(np.cumsum(cells[::-1])[::-1], 0.0)


def _touches_less(clumps: Floats, caps: Floats) -> Floats:
    """Return the probability (n,) that clumps of exponential area touch less than the contact.

    clumps: their mean number; caps: the area of contact over their mean area.
    """
    few = caps <= MANY
    spread = np.sqrt(2 * np.maximum(clumps, 1e-300))
    below = special.ndtr((caps - clumps) / spread)
    if few.any():
        most = np.max(caps[few])
        counts = np.arange(1, int(most + 8 * np.sqrt(most) + 25) if most else 1)[:, None]
        with np.errstate(divide="ignore"):
            log_poisson = counts * np.log(clumps[few]) - clumps[few] - special.gammaln(counts + 1)
        number, column = np.nonzero(log_poisson > RAREST)
        terms = special.gammainc(counts[number, 0], caps[few][column])
        terms *= np.exp(log_poisson[number, column])
        below[few] = np.exp(-clumps[few]) + np.bincount(column, terms, few.sum())
    return np.asarray(np.clip(below, 0, 1))
