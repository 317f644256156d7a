"""The distribution of the pull-off force over positions of the sphere, from a spectrum.

Clumps of points (`summits`) are a Poisson process: Lambda(t) of them rise above the level t =
z/sigma under the sphere, n touch. If all clumps are alike and G_1 < G_2 < ... are a Poisson process
of unit rate, the attraction is

    F ~ n + Σ_{i>n} (G_n/G_i)^(1/k),   k = rho m/sigma²:

For k > 1 and n = 1 it has Weibull's law of modulus k; for k < 1 n/(1 - k) clumps carry it. At a
given level the force is taken as log-normal, with the mean from `closed_form` and the variance of a
sum of Poisson clumps. Over positions it is a mixture of these log-normals over the levels of
`apex_distribution`. workflow/report/theory.md has the derivation. No number is fitted to a force.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy import special

from hardcontact.base.arrays import Floats
from hardcontact.contact.contact import Contact
from hardcontact.contact.hertz_jkr_dmt import dmt_pull_off
from hardcontact.surfaces.spectrum import Spectrum
from hardcontact.theory.closed_form import (
    GENERATIONS,
    SUMMIT_SIZE,
    contact_term,
    rough_terms,
    roughness_on_summit,
)
from hardcontact.theory.summits import (
    LEVELS,
    ApexDistribution,
    apex_distribution,
    clumps_above,
    find_rough_spectrum,
    spectral_moment,
    spectrum_between,
    structure_function,
)

#: Deviations of a summit's curvature from its mean, in standard deviations, with probabilities.
DEVIATIONS = np.linspace(-8, 8, 801)
PROBABILITIES = np.exp(-(DEVIATIONS**2) / 2) / np.sqrt(2 * np.pi) * (DEVIATIONS[1] - DEVIATIONS[0])
#: Factor by which the radius grows to find the exponent of the force against the radius.
RADIUS_FACTOR = 1.2


@dataclass(frozen=True)
class ForceStatistics:
    """The distribution of pull-off forces over positions, a mixture of log-normals."""

    weibull_modulus: float  #: k = rho m/sigma²; infinite without roughness.
    clumps: float  #: Mean number of clumps in contact, n; 0 without roughness.
    means: Floats  #: (n,) at the levels of the apex, in N.
    weights: Floats  #: (n,) probabilities of the levels.
    log_force_stds: Floats  #: (n,) standard deviations of ln F at each level.

    @property
    def force(self) -> float:
        """The mean in N."""
        return float(self.weights @ self.means)

    @property
    def relative_std(self) -> float:
        """Coefficient of variation."""
        square = self.weights @ (self.means**2 * np.exp(self.log_force_stds**2))
        return float(np.sqrt(max(float(square) / self.force**2 - 1, 0.0)))

    @property
    def log_force_std(self) -> float:
        """Standard deviation of ln F."""
        centres = np.log(self.means) - self.log_force_stds**2 / 2
        between = (centres - self.weights @ centres) ** 2
        return float(np.sqrt(self.weights @ (between + self.log_force_stds**2)))


def predict_statistics(spectrum: Spectrum, contact: Contact) -> ForceStatistics:
    """Return the distribution of the pull-off force over positions on a Gaussian surface.

    The surface has no other wavelengths than the spectrum. The mean equals `closed_form`.
    """
    dmt_force = float(dmt_pull_off(contact.work, contact.radius))
    rough_spectrum = find_rough_spectrum(spectrum, contact.radius)
    if rough_spectrum is None:
        force = dmt_force * (1 + contact_term(contact))
        return ForceStatistics(np.inf, 0.0, np.array([force]), np.ones(1), np.zeros(1))
    attraction = _attraction(rough_spectrum, contact, GENERATIONS)
    apex = attraction.apex
    means = attraction.surface_terms + attraction.summit_term + contact_term(contact)
    weibull_modulus = contact.rho * apex.mean() / np.sqrt(spectral_moment(rough_spectrum, 0))
    log_force_stds = np.sqrt(np.log1p(attraction.variance / means**2))
    possible = apex.weights > 0
    return ForceStatistics(
        float(max(weibull_modulus, 0.0)),
        attraction.clumps,
        dmt_force * means[possible],
        apex.weights[possible],
        log_force_stds[possible],
    )


class _Attraction(NamedTuple):
    """The attraction over 2 pi R W without the area in contact, at the levels of the apex (n,)."""

    apex: ApexDistribution
    surface_terms: Floats  #: (n,) mean attraction by the clumps below the sphere.
    summit_term: float  #: Mean attraction by the clumps that touch.
    clumps: float  #: Mean number of the clumps that touch.
    variance: Floats  #: (n,) variance of the sum of both attractions.
    growth: float  #: Exponent of the force against the radius of the sphere, 0 to 1.

    @property
    def mean(self) -> float:
        return self.apex.mean(self.surface_terms) + self.summit_term

    @property
    def scatter(self) -> float:
        """Mean square over squared mean."""
        square = (self.surface_terms + self.summit_term) ** 2 + self.variance
        return self.apex.mean(square) / self.mean**2


def _attraction(spectrum: Spectrum, contact: Contact, generations: int) -> _Attraction:
    """Return the attraction of a sphere by summits, which are rough themselves."""
    apex = apex_distribution(spectrum, contact.radius, contact.area)
    sigma = np.sqrt(spectral_moment(spectrum, 0))
    touching_share = special.ndtr(-apex.levels)
    # Force of a rough summit relative to a smooth summit, and its scatter and growth.
    summit_ratio = 1.0
    scatter = 1.0
    growth = 1.0
    summit = roughness_on_summit(spectrum, apex, contact)
    if summit is not None and generations:
        rough_summit = _attraction(*summit, generations - 1)
        if rough_summit.mean < 1:
            summit_ratio = rough_summit.mean
            scatter = rough_summit.scatter
            growth = rough_summit.growth
    surface_terms, summit_term = rough_terms(sigma, apex, contact.rho, summit_ratio)
    clump_counts = np.interp(apex.levels, LEVELS, clumps_above(spectrum, contact.radius)[1])
    clumps = max(apex.mean(clump_counts), 1.0)
    cover = apex.mean(touching_share)
    # Mean of the squared force of a clump, relative to the square of its mean force. The radius of
    # a summit counts only as far as its force grows with the radius.
    mean_square = (1 + (growth * summit_radius_variation(spectrum, apex)) ** 2) * scatter
    dispersion = clump_dispersion_index(cover)
    clump_force = summit_ratio * touching_share / np.maximum(clump_counts, 1e-300)
    squared_terms = rough_terms(sigma, apex, contact.rho / 2, summit_ratio)[0]
    clump_variance = dispersion * mean_square * clump_force * squared_terms
    field_variance = surface_terms**2 * field_variation(spectrum, contact) ** 2
    # One clump always touches; the number of the other n - 1 scatters like Poisson's. Clumps that
    # cover the plane are one flat contact, and only its rim scatters. In squared clump forces:
    touching = (1 - cover) * clumps * (mean_square - 1) + dispersion * (clumps - 1)
    variance = np.minimum(field_variance, clump_variance) + (summit_term / clumps) ** 2 * touching
    mean = apex.mean(surface_terms) + summit_term
    growth = _growth_with_radius(spectrum, contact, summit_ratio, mean)
    return _Attraction(apex, surface_terms, summit_term, clumps, variance, growth)


def _growth_with_radius(
    spectrum: Spectrum, contact: Contact, summit_ratio: float, mean: float
) -> float:
    """Return the exponent of the force against the radius; `mean` is the attraction at the radius.

    Rough summits attract with `summit_ratio` times the force of smooth ones at both radii.
    """
    sigma = np.sqrt(spectral_moment(spectrum, 0))
    apex = apex_distribution(spectrum, RADIUS_FACTOR * contact.radius, contact.area)
    surface_terms, summit_term = rough_terms(sigma, apex, contact.rho, summit_ratio)
    ratio = (apex.mean(surface_terms) + summit_term) / mean
    return float(np.clip(1 + np.log(ratio) / np.log(RADIUS_FACTOR), 0, 1))


def clump_dispersion_index(cover: float) -> float:
    """Return the variance over the mean of the number of clumps that cover a share of the plane.

    Clumps do not overlap. Their number scatters like the number of hard discs, whose pressure is
    the pressure of an ideal gas divided by (1 - cover)² (scaled particle theory).
    """
    return (1 - cover) ** 3 / (1 + cover)


def summit_radius_variation(spectrum: Spectrum, apex: ApexDistribution) -> float:
    """Return the coefficient of variation of the radius 1/sqrt(K) of summits.

    K = a² - b² is their Gaussian curvature. On a Gaussian surface at the level t the mean curvature
    a is normal with the mean t g²/2 sigma and the variance L²/4 - g⁴/4 sigma²; b² is exponential
    with the mean L²/4; g is the rms gradient, L the rms Laplacian. The density of summits is
    proportional to K where a > b. Waves shorter than a summit are roughness on it.
    """
    longer = spectrum_between(spectrum, 0, 2 * np.pi / (SUMMIT_SIZE * apex.clump_radius))
    if longer is None:
        return 0.0
    sigma = np.sqrt(spectral_moment(spectrum, 0))
    gradient = spectral_moment(longer, 2)
    laplacian = spectral_moment(longer, 4)
    deviation = np.sqrt(max(laplacian - gradient**2 / sigma**2, 0.0)) / 2
    a = max(apex.mean(), 1.0) * gradient / (2 * sigma) + deviation * DEVIATIONS
    a = np.maximum(a, 0)
    b = np.sqrt(laplacian) / 2
    summits = -np.expm1(-((a / b) ** 2))  # the probability of a > b
    density = PROBABILITIES @ (a**2 - b**2 * summits)  # means over b of K, sqrt(K), 1
    mean = PROBABILITIES @ (a - b * special.dawsn(a / b)) / density
    return float(np.sqrt(max(PROBABILITIES @ summits / density / mean**2 - 1, 0.0)))


def field_variation(spectrum: Spectrum, contact: Contact) -> float:
    """Return the coefficient of variation of ∫ exp((z - y)/rho) over the plane.

    Heights z are normal with the autocorrelation r(d); y is the sphere. The squared coefficient is
    the integral of [exp(r(d)/rho²) - 1] exp(-d²/4 R rho)/(4 pi R rho) over the plane of distances
    d. Its part that is linear in r is (1/2 pi rho²) ∫ q C_iso exp(-q² R rho) dq.
    """
    q = spectrum.wavevector
    reach = 4 * contact.radius * contact.rho
    height_density = spectrum.density * q**2 * np.exp(-(q**2) * reach / 4)
    linear = np.trapezoid(height_density, np.log(q)) / (2 * np.pi * contact.rho**2)
    distances, structure = structure_function(spectrum)
    exponent = np.minimum(spectral_moment(spectrum, 0) * (1 - structure) / contact.rho**2, 500)
    beyond_linear = (np.expm1(exponent) - exponent) * np.exp(-(distances**2) / reach)
    return float(np.sqrt(linear + 2 * np.trapezoid(beyond_linear * distances, distances) / reach))
