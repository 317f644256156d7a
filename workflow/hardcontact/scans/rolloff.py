"""Extrapolation of a spectrum above the longest wavelength measured: it rises up to a roll-off.

The longer waves of a surface appear in a scan as slopes and bows, which levelling removes in part.
What is left adds to the variance of heights, from which Bayes' rule gives the roll-off. C_iso is
constant beyond it.
"""

from collections.abc import Sequence

import numpy as np
import scipy

from hardcontact.base.arrays import Floats
from hardcontact.scans.reliable_band import STEEPEST_SELF_AFFINE_SLOPE, ReliableBand
from hardcontact.scans.tail import ROLLOFF_COUNT
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.levelling import level_plane, squared_projections
from hardcontact.surfaces.spectrum import BIN_CENTRES, BIN_WIDTH, LOG_WAVEVECTORS, WAVEVECTORS

#: Ratio of the longest possible roll-off wavelength to the size of the scan: a scan shows longer
#: waves as slopes, which levelling removes.
MAX_ROLLOFF_OVER_SIZE = 10.0
#: Number of directions of waves over which `levelled_share` averages: more change it by less than
#: 0.5 % for a line scan, and 1e-6 for a map.
DIRECTION_COUNT = 64


def extrapolate_long_waves(density: Floats, longest: float, slope: float, rolloff: float) -> Floats:
    """Return C_iso on WAVEVECTORS that rises from the longest wavelength measured to the roll-off.

    It rises with d ln C/d ln q = `slope`, clipped to 0 and to the STEEPEST_SELF_AFFINE_SLOPE.
    """
    relative = np.maximum(2 * np.pi / WAVEVECTORS / longest, 1.0)
    exponent = -np.clip(slope, STEEPEST_SELF_AFFINE_SLOPE, 0.0)
    return np.asarray(density * np.minimum(relative, max(rolloff / longest, 1.0)) ** exponent)


def levelled_share(wavevector: Floats, size: float, kind: str) -> Floats:
    """Return the share (q,) of the variance of random waves that remains in a levelled scan."""
    angle = (np.arange(DIRECTION_COUNT) + 0.5) * np.pi / 2 / DIRECTION_COUNT
    half_phase = np.maximum(wavevector[:, None] * size / 2, 1e-3)
    mean_x, slope_x = squared_projections(half_phase * np.cos(angle))
    if kind == "line scan":
        return np.asarray((1 - mean_x - slope_x).mean(axis=1))
    mean_y, slope_y = squared_projections(half_phase * np.sin(angle))
    removed = mean_x * mean_y + slope_x * mean_y + mean_x * slope_y
    return np.asarray((1 - removed).mean(axis=1))


class RolloffEvidence:
    """The rms height of the scans of a surface that show the longest waves, as evidence."""

    def __init__(
        self, scans: Sequence[HeightMap], densities: Floats, bands: Sequence[ReliableBand]
    ) -> None:
        """Store what all scans show, with their PSDs (scan, bins) and bands."""
        longest = max(band.longest for band in bands)
        is_widest = np.array([band.longest == longest for band in bands])
        widest_scans = [scan for scan, widest in zip(scans, is_widest, strict=True) if widest]
        kind = widest_scans[0].kind
        self.size = widest_scans[0].size
        self.count = len(widest_scans)
        #: The mean variance of the levelled heights in nm².
        self.variance = float(np.mean([level_plane(scan).heights.T.var() for scan in widest_scans]))
        self._measured_density = np.nan_to_num(densities[is_widest]).mean(axis=0)
        shortest = min(band.shortest for band in bands if band.longest == longest)
        self._is_unreliable = 2 * np.pi / BIN_CENTRES < shortest
        self._levelled_share = levelled_share(WAVEVECTORS, self.size, kind)
        # Independent modes per ln q: q²L²/4π in a map, qL/2π along a line, and 1 for waves longer
        # than the scan, which appear as a bow.
        waves = WAVEVECTORS * self.size / (2 * np.pi)
        self._mode_count = np.maximum(waves if kind == "line scan" else np.pi * waves**2, 1)

    def rolloff_quantile(
        self, density: Floats, longest: float, slope: float, probability: float
    ) -> float:
        """Return a quantile of the roll-off wavelength, for its probability.

        The prior is uniform in the logarithm of the roll-off, from the longest wavelength measured
        to MAX_ROLLOFF_OVER_SIZE times the size of the scan. If the `slope` d ln C/d ln q there is
        not negative, the roll-off is the longest wavelength.
        """
        if slope >= 0:
            return longest
        rolloffs = np.geomspace(
            longest, max(MAX_ROLLOFF_OVER_SIZE * self.size, 1.01 * longest), ROLLOFF_COUNT
        )
        spectra = (extrapolate_long_waves(density, longest, slope, rolloff) for rolloff in rolloffs)
        log_likelihoods = np.array([self._log_likelihood(spectrum) for spectrum in spectra])
        posterior = np.exp(log_likelihoods - log_likelihoods.max())
        cumulative = (np.cumsum(posterior) - posterior / 2) / posterior.sum()
        return float(np.exp(np.interp(probability, cumulative, np.log(rolloffs))))

    def _log_likelihood(self, density: Floats) -> float:
        """Return the logarithm of the likelihood of the measured variance, up to a constant.

        The powers of N independent modes are exponential, so that their sum is a gamma variable of
        relative variance 1/N.
        """
        power = density * WAVEVECTORS**2 * self._levelled_share / (2 * np.pi)
        expected_variance = np.trapezoid(power, LOG_WAVEVECTORS) + self._noise_variance(density)
        variance_of_variance = np.trapezoid(power**2 / self._mode_count, LOG_WAVEVECTORS)
        shape = expected_variance**2 / variance_of_variance * self.count
        scale = expected_variance / shape
        ratio = self.variance / scale
        return float(
            (shape - 1) * np.log(ratio) - ratio - scipy.special.gammaln(shape) - np.log(scale)
        )

    def _noise_variance(self, density: Floats) -> float:
        """Return the variance of heights (nm²) from noise, the excess of unreliable short waves."""
        excess = self._measured_density - np.interp(BIN_CENTRES, WAVEVECTORS, density)
        power = (np.maximum(excess, 0) * BIN_CENTRES**2)[self._is_unreliable]
        return float(power.sum() * BIN_WIDTH / (2 * np.pi))
