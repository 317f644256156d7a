"""The distribution of the pull-off force over positions of the sphere, from a spectrum.

The force is a mixture of log-normal distributions, one for each level of the apex; the levels
follow `apex_distribution`. At a given level `closed_form` gives the mean. The variance is that of a
sum over the summits (`summits`) that rise above a level under the sphere, a Poisson process. No
number is fitted to a force. workflow/report/theory.md (The distribution of forces) has the
derivation.
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
    find_rough_spectrum,
    spectral_moment,
    spectrum_between,
    structure_function,
    summits_above,
)

#: Deviations of a summit's curvature from its mean, in standard deviations.
DEVIATIONS = np.linspace(-8, 8, 801)
#: Their probabilities in a normal distribution.
PROBABILITIES = np.exp(-(DEVIATIONS**2) / 2) / np.sqrt(2 * np.pi) * (DEVIATIONS[1] - DEVIATIONS[0])
#: Factor by which the radius grows to find the exponent of the force against the radius.
RADIUS_FACTOR = 1.2


@dataclass(frozen=True)
class ForceStatistics:
    """The distribution of pull-off forces over positions, a mixture of log-normals."""

    weibull_modulus: float  #: 0 if the apex is below the mean plane, infinite without roughness.
    touching_count: float  #: Mean number of summits in contact; 0 without roughness.
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
        squared_deviations = (centres - self.weights @ centres) ** 2
        return float(np.sqrt(self.weights @ (squared_deviations + self.log_force_stds**2)))


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
        attraction.touching_count,
        dmt_force * means[possible],
        apex.weights[possible],
        log_force_stds[possible],
    )


class _Attraction(NamedTuple):
    """The attraction relative to the force of DMT, without the area in contact."""

    apex: ApexDistribution
    surface_terms: Floats  #: (n,) mean attraction by the summits below the sphere, at each level.
    summit_term: float  #: Mean attraction by the summits that touch.
    touching_count: float  #: Mean number of the summits that touch.
    variance: Floats  #: (n,) variance of the sum of both attractions, at each level.
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
    relative_rms = np.sqrt(spectral_moment(spectrum, 0)) / contact.rho
    touching_share = special.ndtr(-apex.levels)
    # Force of a rough summit relative to a smooth summit, and its scatter and growth.
    summit_ratio = 1.0
    summit_scatter = 1.0
    summit_growth = 1.0
    summit = roughness_on_summit(spectrum, apex, contact)
    if summit is not None and generations:
        rough_summit = _attraction(*summit, generations - 1)
        if rough_summit.mean < 1:
            summit_ratio = rough_summit.mean
            summit_scatter = rough_summit.scatter
            summit_growth = rough_summit.growth
    surface_terms, summit_term = rough_terms(apex, relative_rms, summit_ratio)
    summit_counts = np.interp(apex.levels, LEVELS, summits_above(spectrum, contact.radius)[1])
    touching_count = max(apex.mean(summit_counts), 1.0)
    cover = apex.mean(touching_share)
    # Mean of the squared force of a summit, relative to the square of its mean force. The radius of
    # a summit counts only as far as its force grows with the radius.
    radius_variation = summit_growth * summit_radius_variation(spectrum, apex)
    mean_square = (1 + radius_variation**2) * summit_scatter
    dispersion = dispersion_index(cover)
    summit_force = summit_ratio * touching_share / np.maximum(summit_counts, 1e-300)
    # Squared attractions fall with half the range of adhesion.
    squared_terms = rough_terms(apex, 2 * relative_rms, summit_ratio)[0]
    summit_variance = dispersion * mean_square * summit_force * squared_terms
    field_variance = surface_terms**2 * field_variation(spectrum, contact) ** 2
    # One summit always touches; the number of the others scatters like Poisson's. Summits that
    # cover the plane are one flat contact, and only its rim scatters.
    touching_variance = (summit_term / touching_count) ** 2 * (
        (1 - cover) * touching_count * (mean_square - 1) + dispersion * (touching_count - 1)
    )
    variance = np.minimum(field_variance, summit_variance) + touching_variance
    mean = apex.mean(surface_terms) + summit_term
    growth = _growth_with_radius(spectrum, contact, summit_ratio, mean)
    return _Attraction(apex, surface_terms, summit_term, touching_count, variance, growth)


def _growth_with_radius(
    spectrum: Spectrum, contact: Contact, summit_ratio: float, mean: float
) -> float:
    """Return the exponent of the force against the radius; `mean` is the attraction at the radius.

    Rough summits attract with `summit_ratio` times the force of smooth summits at both radii.
    """
    relative_rms = np.sqrt(spectral_moment(spectrum, 0)) / contact.rho
    apex = apex_distribution(spectrum, RADIUS_FACTOR * contact.radius, contact.area)
    surface_terms, summit_term = rough_terms(apex, relative_rms, summit_ratio)
    ratio = (apex.mean(surface_terms) + summit_term) / mean
    return float(np.clip(1 + np.log(ratio) / np.log(RADIUS_FACTOR), 0, 1))


def dispersion_index(cover: float) -> float:
    """Return the variance over the mean of the number of summits that cover a share of the plane.

    Summits do not overlap. Their number scatters like the number of hard discs, whose pressure is
    the pressure of an ideal gas divided by (1 - cover)² (scaled particle theory).
    """
    return (1 - cover) ** 3 / (1 + cover)


def summit_radius_variation(spectrum: Spectrum, apex: ApexDistribution) -> float:
    """Return the coefficient of variation of the radius 1/sqrt(K) of summits.

    K = a² - b² is the Gaussian curvature of a summit, a its mean curvature, b half the difference
    of its principal curvatures. theory.md (How does a single summit scatter?) has the distributions
    of a and b, and the density of summits. Waves shorter than a summit are roughness on it.
    """
    longer = spectrum_between(spectrum, 0, 2 * np.pi / (SUMMIT_SIZE * apex.half_width))
    if longer is None:
        return 0.0
    sigma = np.sqrt(spectral_moment(spectrum, 0))
    squared_gradient = spectral_moment(longer, 2)
    squared_laplacian = spectral_moment(longer, 4)
    deviation = np.sqrt(max(squared_laplacian - squared_gradient**2 / sigma**2, 0.0)) / 2
    mean = max(apex.mean(), 1.0) * squared_gradient / (2 * sigma)
    a = np.maximum(mean + deviation * DEVIATIONS, 0)
    b = np.sqrt(squared_laplacian) / 2  # the rms of b
    # The density of summits is the mean of K over a > b; means over summits are weighted with K.
    probability = -np.expm1(-((a / b) ** 2))
    density = PROBABILITIES @ (a**2 - b**2 * probability)
    mean_radius = PROBABILITIES @ (a - b * special.dawsn(a / b)) / density
    mean_square = PROBABILITIES @ probability / density
    return float(np.sqrt(max(mean_square / mean_radius**2 - 1, 0.0)))


def field_variation(spectrum: Spectrum, contact: Contact) -> float:
    """Return the coefficient of variation of the attraction of a surface that many points carry.

    theory.md (All together) has its square, an integral over the autocorrelation. The term that is
    linear in the autocorrelation is an integral over the spectrum.
    """
    q = spectrum.wavevector
    reach = 4 * contact.radius * contact.rho
    height_density = spectrum.density * q**2 * np.exp(-(q**2) * reach / 4)
    linear = np.trapezoid(height_density, np.log(q)) / (2 * np.pi * contact.rho**2)
    distances, structure = structure_function(spectrum)
    exponent = np.minimum(spectral_moment(spectrum, 0) * (1 - structure) / contact.rho**2, 500)
    beyond_linear = (np.expm1(exponent) - exponent) * np.exp(-(distances**2) / reach)
    return float(np.sqrt(linear + 2 * np.trapezoid(beyond_linear * distances, distances) / reach))
