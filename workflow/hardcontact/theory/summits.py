"""The highest summits under a sphere: their height, width and number, from a spectrum alone.

A summit is a group of neighbouring points above a high level. A level t is a height above the mean
plane relative to the rms height sigma: of points, of summits, or of the apex of the sphere.

A summit covers the area pi delta² on average. Its half-width delta is the distance over which the
autocorrelation of heights falls to (1 - 1/t²) sigma². The density of summits is Nayak's on a smooth
surface (J. Lubr. Technol. 93 (1971) 398) and, up to a constant, Pickands' with fine roughness
(Trans. Am. Math. Soc. 145 (1969) 51). High summits are independent (Aldous, Probability
Approximations via the Poisson Clumping Heuristic, 1989), so that their number has a Poisson
distribution. workflow/report/theory.md (The distribution of forces) has the equations.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy import special

from hardcontact.base.arrays import Floats
from hardcontact.surfaces.spectrum import Spectrum, spectral_moment

#: Points of a resampled spectrum.
SPECTRUM_POINTS = 300
#: Points of an autocorrelation.
AUTOCORRELATION_POINTS = 120
#: Levels t of the apex at closest approach. Wide contacts sink below the mean plane.
LEVELS = np.linspace(-6, 8, 701)
#: If more summits fill the area in contact, their total area counts as normally distributed.
MAX_POISSON_SUMMITS = 50.0
#: Smallest probability computed as one minus its complement: smaller differences have few digits.
MIN_SUBTRACTED_PROBABILITY = 1e-3
#: Poisson terms below e^-45, 3e-20, are left out of sums.
LOG_NEGLIGIBLE_PROBABILITY = -45.0
#: Summits at lower levels have the width of summits at this level, because such low points form no
#: separate groups. Chosen on designed surfaces: resources/validation/README.md says what other
#: values would change.
LOWEST_SUMMIT_LEVEL = 1.2
#: A sphere follows the longest waves, as long as their rms curvature is less than this share of its
#: own, 1/R. Chosen on designed surfaces, too.
MAX_FOLLOWED_CURVATURE = 0.1


class ApexDistribution(NamedTuple):
    """Distribution of the level t of the sphere's apex at closest approach."""

    levels: Floats  #: Levels t (n,).
    weights: Floats  #: Their probabilities (n,).
    half_width: float  #: Half-width in nm of summits at the mean level.

    def mean(self, values: ArrayLike | None = None) -> float:
        """Return the mean of values (n,) at the levels, or of the levels themselves."""
        return float(self.weights @ (self.levels if values is None else np.asarray(values)))


def spectrum_between(spectrum: Spectrum, lowest: float, highest: float) -> Spectrum | None:
    """Return a spectrum between two wavevectors (rad/nm), on a new grid, or None without waves."""
    nonzero_wavevectors = spectrum.wavevector[spectrum.density > 0]
    if not len(nonzero_wavevectors):
        return None
    low, high = max(lowest, nonzero_wavevectors[0]), min(highest, nonzero_wavevectors[-1])
    if high <= low * (1 + 1e-9):
        return None
    wavevector = np.geomspace(low, high, SPECTRUM_POINTS)
    # The minimum keeps the last wave in spite of rounding.
    return Spectrum(wavevector, spectrum(np.minimum(wavevector, nonzero_wavevectors[-1])))


def find_rough_spectrum(spectrum: Spectrum, radius: float) -> Spectrum | None:
    """Return the spectrum of the waves that a sphere does not follow; None if it follows all."""
    resampled = spectrum_between(spectrum, 0, np.inf)
    if resampled is None:
        return None
    q = resampled.wavevector
    step = np.log(q[1] / q[0])
    # The mean square of the Laplacian is the integral of q^6 C/(2 pi) over ln q. The mean curvature
    # is half the Laplacian.
    curvature = np.sqrt(np.cumsum(resampled.density * q**6) * step / (2 * np.pi)) / 2
    not_followed = np.flatnonzero(curvature > MAX_FOLLOWED_CURVATURE / radius)
    return spectrum_between(spectrum, q[not_followed[0]], np.inf) if len(not_followed) else None


def summit_half_width(spectrum: Spectrum, levels: ArrayLike) -> Floats:
    """Return the half-width delta (n,) in nm of summits at levels t (n,)."""
    q = spectrum.wavevector
    distances = np.geomspace(0.05 / q[-1], 10 / q[0], AUTOCORRELATION_POINTS)
    # The fall of the autocorrelation at the distances, in shares of sigma².
    integrand = spectrum.density * q**2 * (1 - special.j0(distances[:, None] * q))
    total = 2 * np.pi * spectral_moment(spectrum, 0)  # 2 pi sigma², as the integrand lacks 1/(2 pi)
    fall = np.maximum.accumulate(np.trapezoid(integrand, np.log(q), axis=1) / total)
    log_fall = -2 * np.log(np.maximum(levels, LOWEST_SUMMIT_LEVEL))
    return np.asarray(np.exp(np.interp(log_fall, np.log(fall), np.log(distances))))


def apex_distribution(spectrum: Spectrum, radius: float, area: float) -> ApexDistribution:
    """Return the distribution of the level of the apex of a sphere with an area (nm²) in contact.

    The sphere sinks until the summits above it fill the area.
    """
    half_widths, counts, bearing_areas = summits_above(spectrum, radius)
    # No summit rises above the last level, so pi delta² stands for the mean area of a summit there.
    summit_areas = np.append(bearing_areas[:-1] / counts[:-1], np.pi * half_widths[-1] ** 2)
    probability = _probability_of_smaller_area(counts, area / summit_areas)
    # The lowest level also has the probability of all levels below it.
    weights = np.append(probability[0], np.maximum(np.diff(probability), 0))
    weights /= weights.sum()
    levels = np.append(LEVELS[0], (LEVELS[1:] + LEVELS[:-1]) / 2)
    half_width = float(np.interp(weights @ levels, LEVELS, half_widths))
    return ApexDistribution(levels, weights, half_width)


def summits_above(spectrum: Spectrum, radius: float) -> tuple[Floats, Floats, Floats]:
    """Return half-width, mean number and mean total area of summits above a sphere at LEVELS: (n,).

    Number and area (nm²) are Lambda and B in theory.md.
    """
    half_widths = summit_half_width(spectrum, LEVELS)
    share_above = special.ndtr(-LEVELS)
    # Area (nm²) of the plane over which the height of the sphere changes by one level, sigma.
    area_per_level = 2 * np.pi * radius * np.sqrt(spectral_moment(spectrum, 0))
    return (
        half_widths,
        area_per_level * _integral_to_last_level(share_above / (np.pi * half_widths**2)),
        area_per_level * _integral_to_last_level(share_above),
    )


def search_size(spectrum: Spectrum, radius: float, area: float) -> float:
    """Return how wide (nm) a surface must be to hold the summits that a sphere can touch.

    At the distance r from the apex the sphere is r²/2R higher, and heights above it are rarer by
    exp(-t r²/(2 R sigma)). Touching points therefore have the rms distance sqrt(2 R sigma/t), half
    the width. The width is 0 if the sphere follows all waves.
    """
    rough_spectrum = find_rough_spectrum(spectrum, radius)
    if rough_spectrum is None:
        return 0.0
    # At level 0 the width would be infinite.
    apex_level = max(apex_distribution(rough_spectrum, radius, area).mean(), 1.0)
    return float(2 * np.sqrt(2 * radius * np.sqrt(spectral_moment(rough_spectrum, 0)) / apex_level))


def _integral_to_last_level(density: Floats) -> Floats:
    """Return the integral of a density (n,) from each of LEVELS to the last."""
    cells = (density[1:] + density[:-1]) / 2 * (LEVELS[1] - LEVELS[0])
    return np.append(np.cumsum(cells[::-1])[::-1], 0.0)


def _probability_of_smaller_area(summit_counts: Floats, area_ratio: Floats) -> Floats:
    """Return the probability (n,) that summits have a smaller total area than the contact.

    Their number has a Poisson distribution of the mean `summit_counts`, their areas an exponential
    one. `area_ratio` is the contact area relative to the mean area of a summit.
    """
    is_few = area_ratio <= MAX_POISSON_SUMMITS
    spread = np.sqrt(2 * np.maximum(summit_counts, 1e-300))
    probability = special.ndtr((area_ratio - summit_counts) / spread)
    # The sum over i in theory.md is a noncentral chi-squared distribution of 2 degrees of freedom.
    # Its small probabilities lack digits, and their forces may be huge: they are summed below.
    probability[is_few] = 1 - special.chndtr(2 * summit_counts[is_few], 2, 2 * area_ratio[is_few])
    is_rare = is_few & (probability < MIN_SUBTRACTED_PROBABILITY)
    if is_rare.any():
        means, ratios = summit_counts[is_rare], area_ratio[is_rare]
        max_ratio = ratios.max()
        # More summits than this, some 8 standard deviations, hardly ever have so small an area.
        i = np.arange(1, int(max_ratio + 8 * np.sqrt(max_ratio) + 25) if max_ratio else 1)[:, None]
        with np.errstate(divide="ignore"):
            log_poisson = i * np.log(means) - means - special.gammaln(i + 1)
        row, column = np.nonzero(log_poisson > LOG_NEGLIGIBLE_PROBABILITY)
        terms = np.exp(log_poisson[row, column]) * special.gammainc(i[row, 0], ratios[column])
        probability[is_rare] = np.exp(-means) + np.bincount(column, terms, len(means))
    return np.asarray(np.clip(probability, 0, 1))
