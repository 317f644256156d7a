"""The distribution of the pull-off force over places of a Gaussian surface, from its spectrum.

Clumps of points (`summits`) are a Poisson process: under the sphere Lambda(t) of them rise above
the level t = z/sigma, and Lambda falls by e over sigma/t. Rigid bodies meet at the highest; in
plastic contact the n clumps above the level of closest approach touch. With G_i, the Poisson
process of unit rate in ascending order, as Lambda of the i-th clump, the attraction is

    F ~ n + Σ_{i>n} (G_n/G_i)^(1/k),   k = rho m/sigma²,

if all clumps are alike. For k > 1 the sum over many points, those below the sphere, does not
fluctuate, and F ~ G_n^(1/k): Weibull's law of modulus k for n = 1 (Gumbel's, of scale sigma/t, of
the approach), a power of a gamma variable for more, log-normal for many. For k < 1 the sum
converges, and n/(1 - k) clumps carry the force: its mean no longer depends on the level (frozen, as
in the random energy model), and what scatters is how many there are and how large.

At a given level the force is therefore a mean, the terms of `closed_form`, and the variance of a
sum of Poisson clumps (Campbell's theorem), of which it is taken as log-normal; the force over
places is the mixture of these over the levels of `closest_approaches`. The area in contact always
attracts alike. The force of a summit, 2 pi W/sqrt(K), scatters with its Gaussian curvature K
(Nayak, J. Lubr. Technol. 93 (1971) 398) and with the roughness on it, to which the same law
applies. No number is fitted to a force; resources/validation tells what was chosen how, and errors.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy import special, stats

from hardcontact.contact.smooth_sphere import dmt_pull_off
from hardcontact.insight.closed_form import (
    GENERATIONS,
    SUMMIT,
    Contact,
    contact_share,
    gaussian_share,
    on_summit,
)
from hardcontact.insight.summits import (
    LEVELS,
    Approaches,
    banded,
    closest_approaches,
    clumps_above,
    correlation_lost,
    moment,
    rough_waves,
)
from hardcontact.surfaces.spectrum import Floats, Spectrum

#: Standard deviations of curvature, and their probabilities, that a summit is averaged over.
DEVIATIONS = np.linspace(-8, 8, 801)
#: Factor of the radius with which the exponent of the force over it is found.
WIDER = 1.2
CHANCES = stats.norm.pdf(DEVIATIONS) * (DEVIATIONS[1] - DEVIATIONS[0])


@dataclass(frozen=True)
class ForceStatistics:
    """The distribution of the pull-off force over places: a mixture of log-normal ones."""

    modulus: float  #: k = rho m/sigma²; infinite without roughness.
    clumps: float  #: Mean number of clumps in contact, n; 0 without roughness.
    summits: float  #: Force over that of one clump in contact: n/(1 - k) where k is below one.
    #: (n,) means at the levels of closest approach in N, their probabilities, and the standard
    #: deviation of ln F at each.
    means: Floats
    weights: Floats
    spreads: Floats

    @property
    def force(self) -> float:
        """The mean in N."""
        return float(self.weights @ self.means)

    @property
    def variation(self) -> float:
        """Standard deviation over mean."""
        square = self.weights @ (self.means**2 * np.exp(self.spreads**2))
        return float(np.sqrt(max(float(square) / self.force**2 - 1, 0.0)))

    @property
    def spread(self) -> float:
        """Standard deviation of ln F."""
        centres = np.log(self.means) - self.spreads**2 / 2
        around = (centres - self.weights @ centres) ** 2
        return float(np.sqrt(self.weights @ (around + self.spreads**2)))

    @property
    def median_over_mean(self) -> float:
        """The median over the mean."""
        return float(self.quantile(0.5)) / self.force

    def probability(self, force: ArrayLike) -> Floats:
        """Return the probability (...) that a place has less than a force (...) in N."""
        far = np.log(np.asarray(force, float)[..., None] / self.means) + self.spreads**2 / 2
        with np.errstate(divide="ignore", invalid="ignore"):
            below = special.ndtr(far / self.spreads)
        # Without spread a level has a single force.
        return np.asarray(np.where(self.spreads > 0, below, far >= 0) @ self.weights)

    def quantile(self, probability: ArrayLike) -> Floats:
        """Return the force (...) in N that a share (...) of places does not reach."""
        reach = np.exp(8 * self.spreads.max() + 1e-6)
        forces = np.geomspace(self.means.min() / reach, self.means.max() * reach, 2000)
        known = self.probability(forces)
        found = np.interp(np.asarray(probability, float), known, np.log(forces))
        return np.asarray(np.exp(found))


def force_statistics(spectrum: Spectrum, contact: Contact) -> ForceStatistics:
    """Return the distribution of the pull-off force of a sphere over places of a Gaussian surface.

    Only the wavelengths of the spectrum count. The mean is that of `closed_form` in its regime of
    many points, and less in that of single peaks (`_terms`).
    """
    smooth = float(dmt_pull_off(contact.work, contact.radius))
    waves = rough_waves(spectrum, contact.radius)
    if waves is None:
        one = np.ones(1)
        force = smooth * (1 + contact_share(contact)) * one
        return ForceStatistics(np.inf, 0.0, np.inf, force, one, 0 * one)
    found = _attraction(waves, contact, GENERATIONS)
    levels, means = found.levels, found.first + found.touching + contact_share(contact)
    k = contact.rho * levels.mean() / np.sqrt(moment(waves, 0))
    spreads = np.sqrt(np.log1p(found.variance / means**2))
    known = levels.weights > 0
    return ForceStatistics(
        float(max(k, 0.0)),
        found.clumps,
        found.mean * found.clumps / found.touching,
        smooth * means[known],
        levels.weights[known],
        spreads[known],
    )


class _Attraction(NamedTuple):
    """The attraction in 2 pi R W, without that of the area in contact, by level (n,)."""

    levels: Approaches
    first: Floats  #: (n,) mean of the clumps below the sphere.
    touching: float  #: Mean of those that touch.
    clumps: float  #: Mean number of those that touch.
    variance: Floats  #: (n,) of the sum.
    growth: float  #: Exponent of the force over the radius of the sphere, 0 to 1.

    @property
    def mean(self) -> float:
        return self.levels.mean(self.first) + self.touching

    @property
    def scatter(self) -> float:
        """Mean square over squared mean."""
        return self.levels.mean((self.first + self.touching) ** 2 + self.variance) / self.mean**2


def _attraction(waves: Spectrum, contact: Contact, generations: int) -> _Attraction:
    """Return how a sphere is attracted by summits, which are rough themselves."""
    radius, rho = contact.radius, contact.rho
    levels = closest_approaches(waves, radius, contact.area)
    sigma, t = np.sqrt(moment(waves, 0)), levels.levels
    # What a rough summit attracts of what a smooth one does.
    share, scatter, growth = 1.0, 1.0, 1.0
    summit = on_summit(waves, levels, contact)
    if summit is not None and generations:
        on_it = _attraction(*summit, generations - 1)
        if on_it.mean < 1:
            share, scatter, growth = on_it.mean, on_it.scatter, on_it.growth
    first, touching = _terms(sigma, levels, rho, share)
    number = np.interp(t, LEVELS, clumps_above(waves, radius)[1])
    clumps, cover = max(levels.mean(number), 1.0), levels.mean(stats.norm.sf(t))
    # The mean of the squared force of a clump, over the square of its mean force. The radius of a
    # summit counts as far as the force on it grows with it.
    square = (1 + (growth * summit_variation(waves, levels)) ** 2) * scatter
    crowded = number_variance(cover)
    of_one = share * stats.norm.sf(t) / np.maximum(number, 1e-300)
    of_clumps = crowded * square * of_one * _terms(sigma, levels, rho / 2, share)[0]
    of_field = first**2 * field_variation(waves, contact) ** 2
    # n clumps touch, of which all but the last are as many as Poisson lets expect. Where they cover
    # the plane they are one flat contact, whose rim is the force.
    scattered = (1 - cover) * clumps * (square - 1) + crowded * (clumps - 1)
    variance = np.minimum(of_field, of_clumps) + (touching / clumps) ** 2 * scattered
    found = _Attraction(levels, first, touching, clumps, variance, 1.0)
    wider = closest_approaches(waves, WIDER * radius, contact.area)
    of_wider, touching = _terms(sigma, wider, rho, share)
    slope = 1 + np.log((wider.mean(of_wider) + touching) / found.mean) / np.log(WIDER)
    return found._replace(growth=float(np.clip(slope, 0, 1)))


def _terms(sigma: float, levels: Approaches, rho: float, share: float) -> tuple[Floats, float]:
    """Return the force (n,) of the points below the sphere, and that of the clumps that touch.

    Points closer to the sphere than the height sigma/t of a clump belong, in the average over the
    plane, mostly to clumps that rise above it. There are none: clumps below the sphere attract as
    those that touch do, a share of what smooth ones do.
    """
    t, relief = levels.levels, 1 / max(levels.mean(), 1.0)

    def whole(level: Floats) -> Floats:
        return gaussian_share(sigma, level * sigma, rho) + stats.norm.sf(level)

    near = 1 - np.exp(-relief * sigma / rho) * whole(t - relief) / whole(t)
    first = gaussian_share(sigma, t * sigma, rho) * (1 - (1 - share) * near)
    return first, share * levels.mean(stats.norm.sf(t))


def number_variance(cover: float) -> float:
    """Return the variance over the mean of the number of clumps that cover a share of the plane.

    They do not overlap: their number scatters as that of hard discs does whose pressure is that of
    an ideal gas over (1 - cover)² (scaled particle theory).
    """
    return (1 - cover) ** 3 / (1 + cover)


def summit_variation(waves: Spectrum, levels: Approaches) -> float:
    """Return the standard deviation over the mean of the radius 1/sqrt(K) of summits.

    K = a² - b² is their Gaussian curvature. On a Gaussian surface at the level t the mean curvature
    a is normal about t g²/2 sigma with the variance L²/4 - g⁴/4 sigma², b² is exponential about
    L²/4, with the rms gradient g and the rms Laplacian L; summits are as dense as K where a > b.
    Waves shorter than a summit are roughness on it.
    """
    longer = banded(waves, 0, 2 * np.pi / (SUMMIT * levels.radius))
    if longer is None:
        return 0.0
    sigma = np.sqrt(moment(waves, 0))
    gradient, laplacian = moment(longer, 2), moment(longer, 4)
    rest = np.sqrt(max(laplacian - gradient**2 / sigma**2, 0.0)) / 2
    a = max(levels.mean(), 1.0) * gradient / (2 * sigma) + rest * DEVIATIONS
    a, chances, b = np.maximum(a, 0), CHANCES, np.sqrt(laplacian) / 2
    fewer = -np.expm1(-((a / b) ** 2))  # the probability of a > b
    density = chances @ (a**2 - b**2 * fewer)  # means over b of K, sqrt(K), 1
    mean = chances @ (a - b * special.dawsn(a / b)) / density
    return float(np.sqrt(max(chances @ fewer / density / mean**2 - 1, 0.0)))


def field_variation(waves: Spectrum, contact: Contact) -> float:
    """Return the standard deviation over the mean of ∫ exp((h - s)/rho) over the plane.

    Heights h are normal and s = r²/2R: its square is ∫ [exp(r(d)/rho²) - 1] exp(-d²/4 R rho) over
    all distances d, r the autocorrelation, over 4 pi R rho. Its part that is linear in r is the
    variance (1/2 pi rho²) ∫ q C_iso exp(-q² R rho) dq of the mean height.
    """
    q, reach = waves.wavevector, 4 * contact.radius * contact.rho
    of_height = waves.density * q**2 * np.exp(-(q**2) * reach / 4)
    linear = np.trapezoid(of_height, np.log(q)) / (2 * np.pi * contact.rho**2)
    distances, lost = correlation_lost(waves)
    exponent = np.minimum(moment(waves, 0) * (1 - lost) / contact.rho**2, 500)
    more = (np.expm1(exponent) - exponent) * np.exp(-(distances**2) / reach)
    return float(np.sqrt(linear + 2 * np.trapezoid(more * distances, distances) / reach))
