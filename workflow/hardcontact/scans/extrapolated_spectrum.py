"""Extrapolation of a joined spectrum beyond the wavelengths of its measurements.

The spectrum is self-affine from the shortest wavelength down to atoms, with the Hurst exponent of
its last decade, within bounds on slope and curvature. It rises from the longest wavelength up to a
roll-off, and is constant beyond. The roll-off follows from the variance of the levelled heights by
Bayes' rule.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import scipy

from hardcontact.base.arrays import Floats
from hardcontact.scans.reliable_band import STEEPEST_SELF_AFFINE_SLOPE, ReliableBand
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.levelling import level, squared_projections
from hardcontact.surfaces.spectrum import (
    BIN_CENTRES,
    BIN_WIDTH,
    MIN_BINS,
    WAVEVECTORS,
    Spectrum,
    power_law_tail,
)

#: The largest rms gradient, and half-Laplacian in 1/nm, over all scales: those of UNCD, the
#: roughest hard surface of Table 1, with their uncertainties (1.17 + 0.28, 6.32 + 1.20). A sphere
#: of such a curvature has the radius of an atom.
MAX_GRADIENT = 1.45
MAX_HALF_LAPLACIAN = 7.52
#: The shortest wave of a row of atoms in nm: two bonds of diamond, 0.154 nm each.
ATOMIC_WAVELENGTH = 0.3
#: Ratio of the longest possible roll-off wavelength to the size of the scan: a scan shows longer
#: waves as slopes, which levelling removes.
MAX_ROLLOFF_OVER_SIZE = 10.0
#: Fewest decades to which the Hurst exponent is fitted: five bins.
MIN_FITTED_DECADES = 0.39
#: Number of directions of waves over which `levelled_share` averages: more directions change a
#: share by less than 0.5 % (line scan) or 1e-6 (map).
DIRECTION_COUNT = 64
LOG_WAVEVECTORS = np.log(WAVEVECTORS)
#: Exponents s of C0 (1 + (q/q_r)^2s)^(-(1 + H)/s): from a gradual to a sharp roll-off at q_r.
SHARPNESS = (1.0, 2.0, 4.0)
#: Bounds of the fitted roll-off: factors on the first and the last wavevector. Below the lower
#: bound the fit is a power law; above the upper bound hardly a bin is left for its exponent.
ROLLOFF_BOUNDS = (0.1, 0.7)
#: Roll-off wavelengths that are compared. In a trial on a scan of 10 µm, four times as many changed
#: the roll-off by 6 %, far less than its uncertainty, and the Hurst exponent by 0.0002.
ROLLOFF_COUNT = 61
#: Standard deviation of the Hurst exponent below the wavelengths measured: surfaces are self-affine
#: over some decades at best.
HURST_SCATTER = 0.1
#: If a Hurst exponent within 0 to 1 is less probable, no self-affine surface fits: the usual level
#: of significance.
MIN_TRUNCATED_PROBABILITY = 0.05
#: Normal distributions with a smaller share within 0 to 1 are left out of the mixture: their weight
#: is negligible, and their mean would be a ratio of rounding errors.
NEGLIGIBLE_SHARE = 1e-9


class HurstFit(NamedTuple):
    """The Hurst exponent of the shortest waves; 0 or 1 if no exponent between them fits."""

    exponent: float
    error: float  #: Standard error of the fit, HURST_SCATTER included.
    shortest: float  #: Wavelengths in nm of the bins fitted.
    longest: float


def fit_hurst_exponent(wavevector: Floats, density: Floats, variance: Floats) -> HurstFit:
    """Return the Hurst exponent of at least three bins, fitted together with the roll-off.

    Bins of the last decade follow ln C = ln C0 - (1 + H) ln(1 + (q/q_r)^2s)/s, a weighted
    regression for each roll-off q_r and s. The prior is uniform in ln q_r, in SHARPNESS, and in H
    within 0 to 1. The exponent is the posterior mean; its error includes HURST_SCATTER.
    """
    is_fitted = wavevector >= wavevector[-1] / 10 * (1 - 1e-9)
    is_fitted[-MIN_BINS:] = True
    q = wavevector[is_fitted]
    log_density = np.log(density[is_fitted])
    weight = 1 / variance[is_fitted]
    rolloffs = np.geomspace(ROLLOFF_BOUNDS[0] * q[0], ROLLOFF_BOUNDS[1] * q[-1], ROLLOFF_COUNT)
    sharpness = np.array(SHARPNESS)[:, None, None]
    falls = -np.log1p((q / rolloffs[:, None]) ** (2 * sharpness)) / sharpness
    falls = falls.reshape(-1, len(q))
    total = weight.sum()
    centred = falls - (falls @ weight)[:, None] / total
    spread = centred**2 @ weight
    slopes = centred @ (weight * log_density) / spread
    residuals = log_density - log_density @ weight / total - slopes[:, None] * centred
    log_evidence = -(residuals**2 @ weight) / 2 - np.log(spread) / 2
    probability = np.exp(log_evidence - log_evidence.max())
    probability /= probability.sum()
    exponent, variance_of_mean = _truncated_moments(slopes - 1, 1 / np.sqrt(spread), probability)
    error = np.sqrt(variance_of_mean + HURST_SCATTER**2)
    return HurstFit(float(exponent), float(error), *(2 * np.pi / q[[-1, 0]]).tolist())


def _truncated_moments(
    exponents: Floats, errors: Floats, probability: Floats
) -> tuple[Floats, Floats]:
    """Return mean and variance of a mixture of normal exponents (case,), truncated to 0 to 1.

    If the probability of this range is below MIN_TRUNCATED_PROBABILITY, the mean is clipped to it.
    """
    low, high = -exponents / errors, (1 - exponents) / errors
    truncated_share = scipy.special.ndtr(high) - scipy.special.ndtr(low)
    total = probability @ truncated_share
    if total < MIN_TRUNCATED_PROBABILITY:
        mean = probability @ exponents
        return np.clip(mean, 0, 1), probability @ (errors**2 + (exponents - mean) ** 2)
    cases = truncated_share > NEGLIGIBLE_SHARE
    low, high = low[cases], high[cases]
    exponents, errors = exponents[cases], errors[cases]
    truncated_share, probability = truncated_share[cases], probability[cases]
    low_density = np.exp(-(low**2) / 2) / np.sqrt(2 * np.pi)
    high_density = np.exp(-(high**2) / 2) / np.sqrt(2 * np.pi)
    shift = (low_density - high_density) / truncated_share
    means = exponents + errors * shift
    variances = errors**2 * (
        1 + (low * low_density - high * high_density) / truncated_share - shift**2
    )
    weight = probability * truncated_share / total
    mean = weight @ means
    return mean, weight @ (variances + (means - mean) ** 2)


class Tail(NamedTuple):
    """The extrapolation below the shortest wavelength measured; NaN without extrapolation."""

    tail_hurst: float = np.nan
    tail_hurst_error: float = np.nan  #: Its standard error.
    tail_fit_shortest: float = np.nan  #: Wavelengths in nm that the Hurst exponent is fitted to.
    tail_fit_longest: float = np.nan
    #: Bound that ends the tail: "gradient", "half_laplacian" or "atoms"; "" for a description.
    tail_ended_by: str = ""


def has_exponent(tail: Tail) -> bool:
    """Return whether a Hurst exponent within 0 to 1 fits at least half a decade of bins.

    Otherwise roughness below the wavelengths measured is a guess. Returns True for a spectrum that
    is not extrapolated to short wavelengths.
    """
    decades = np.log10(tail.tail_fit_longest / tail.tail_fit_shortest)
    is_physical = 0 < tail.tail_hurst < 1
    return bool(np.isnan(tail.tail_hurst) or (is_physical and decades >= MIN_FITTED_DECADES))


def extrapolate_short_waves(
    wavevector: Floats, density: Floats, hurst: HurstFit, change: float = 0.0
) -> tuple[Floats, Tail]:
    """Return C_iso (nm⁴) on WAVEVECTORS from at least three measured points, and its tail.

    C_iso is constant above the longest wavelength, self-affine below the shortest. The tail ends
    at the distance of atoms, or before all scales exceed MAX_GRADIENT or MAX_HALF_LAPLACIAN.
    `change` adds to the Hurst exponent, which is then clipped to 0 and 1.
    """
    # The last point of the table may lie beyond the last wavevector by rounding.
    table = Spectrum(wavevector, density)(np.minimum(WAVEVECTORS, wavevector[-1]))
    measured_density = np.where(wavevector[-1] * (1 + 1e-9) >= WAVEVECTORS, table, 0.0)
    exponent = float(np.clip(hurst.exponent + change, 0, 1))
    # The tail starts at the log-mean of the last points, each moved along the tail.
    relative = wavevector[-MIN_BINS:] / wavevector[-1]
    fall = 2 + 2 * exponent
    first_density = np.exp(np.mean(np.log(density[-MIN_BINS:] * relative**fall)))
    last_index = measured_density.nonzero()[0][-1]
    tail_start = measured_density.copy()
    tail_start[last_index] = first_density * (WAVEVECTORS[last_index] / wavevector[-1]) ** -fall
    spectrum = measured_density + power_law_tail(tail_start, exponent, ATOMIC_WAVELENGTH)
    end_index, ended_by = _find_tail_end(spectrum)
    spectrum = np.where(np.arange(len(WAVEVECTORS)) <= max(end_index, last_index), spectrum, 0.0)
    if end_index <= last_index:
        return spectrum, Tail(tail_ended_by=ended_by)
    return spectrum, Tail(exponent, hurst.error, hurst.shortest, hurst.longest, ended_by)


def _find_tail_end(density: Floats) -> tuple[int, str]:
    """Return the last index of WAVEVECTORS within the bounds, and `tail_ended_by`."""

    def rms(power: int, divisor: int) -> Floats:
        square = density * WAVEVECTORS**power / divisor / (2 * np.pi)
        return np.sqrt(scipy.integrate.cumulative_trapezoid(square, LOG_WAVEVECTORS, initial=0))

    exceeded = {
        "gradient": rms(4, 1) > MAX_GRADIENT,
        "half_laplacian": rms(6, 4) > MAX_HALF_LAPLACIAN,
        "atoms": density == 0,
    }
    # The appended True is the first exceeded wave if there is no other.
    first_exceeded = {
        bound: int(np.argmax(np.append(waves, True))) for bound, waves in exceeded.items()
    }
    ended_by = min(first_exceeded, key=first_exceeded.__getitem__)
    return first_exceeded[ended_by] - 1, ended_by


def extrapolate_long_waves(density: Floats, longest: float, slope: float, rolloff: float) -> Floats:
    """Return C_iso (nm⁴) on WAVEVECTORS that rises above the longest wavelength measured (nm).

    It rises up to the roll-off (nm) with d ln C/d ln q = `slope`, clipped to 0 and to the
    STEEPEST_SELF_AFFINE_SLOPE.
    """
    relative = np.maximum(2 * np.pi / WAVEVECTORS / longest, 1.0)
    exponent = -np.clip(slope, STEEPEST_SELF_AFFINE_SLOPE, 0.0)
    rise = np.minimum(relative, max(rolloff / longest, 1.0)) ** exponent
    return np.asarray(density * rise)


def levelled_share(wavevector: Floats, size: float, kind: str) -> Floats:
    """Return the share (q,) of the variance of random waves that remains in a levelled scan.

    Levelling a scan of this size (nm) removes the mean and the slope along x and, for a map, y.
    """
    angle = (np.arange(DIRECTION_COUNT) + 0.5) * np.pi / 2 / DIRECTION_COUNT
    half = np.maximum(wavevector[:, None] * size / 2, 1e-3)
    mean_x, slope_x = squared_projections(half * np.cos(angle))
    if kind == "line scan":
        return np.asarray((1 - mean_x - slope_x).mean(axis=1))
    mean_y, slope_y = squared_projections(half * np.sin(angle))
    removed = mean_x * mean_y + slope_x * mean_y + mean_x * slope_y
    return np.asarray((1 - removed).mean(axis=1))


class RolloffEvidence:
    """The scans of a surface that show the longest waves, and the evidence of their rms height."""

    def __init__(
        self, scans: Sequence[HeightMap], densities: Floats, bands: Sequence[ReliableBand]
    ) -> None:
        """Store the evidence of all scans, with their PSDs (scan, bins) in nm⁴ and their bands."""
        longest = max(band.longest for band in bands)
        widest_indices = [index for index, band in enumerate(bands) if band.longest == longest]
        kind = scans[widest_indices[0]].kind
        self.size = scans[widest_indices[0]].size
        self.count = len(widest_indices)
        variances = [level(scans[index]).heights.T.var() for index in widest_indices]
        #: The mean variance of the levelled heights in nm².
        self.variance = float(np.mean(variances))
        self._density = np.nan_to_num(densities[widest_indices]).mean(axis=0)
        shortest = min(bands[index].shortest for index in widest_indices)
        self._unreliable = 2 * np.pi / BIN_CENTRES < shortest
        self._share = levelled_share(WAVEVECTORS, self.size, kind)
        # Independent modes per ln q: q²L²/4π in a map, qL/2π along a line, and 1 for waves longer
        # than the scan, which appear as a bow.
        waves = WAVEVECTORS * self.size / (2 * np.pi)
        self._mode_count = np.maximum(waves if kind == "line scan" else np.pi * waves**2, 1)

    def rolloff_quantile(
        self, density: Floats, longest: float, slope: float, probability: float
    ) -> float:
        """Return the quantile, for a probability, of the roll-off wavelength in nm.

        The prior is uniform in the logarithm of the roll-off, from the longest wavelength measured
        (nm) to MAX_ROLLOFF_OVER_SIZE times the size of the scan. `slope` is d ln C/d ln q at this
        wavelength. The result is this wavelength if the slope is not negative.
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

        The power of each of N independent modes is distributed exponentially, so that their sum is
        a gamma variable of relative variance 1/N.
        """
        power = density * WAVEVECTORS**2 * self._share / (2 * np.pi)
        expected_variance = np.trapezoid(power, LOG_WAVEVECTORS) + self._noise_variance(density)
        variance_of_scan = np.trapezoid(power**2 / self._mode_count, LOG_WAVEVECTORS)
        shape = expected_variance**2 / variance_of_scan * self.count
        scale = expected_variance / shape
        ratio = self.variance / scale
        return float(
            (shape - 1) * np.log(ratio) - ratio - scipy.special.gammaln(shape) - np.log(scale)
        )

    def _noise_variance(self, density: Floats) -> float:
        """Return the variance of heights (nm²) from noise at wavelengths too short to be reliable.

        It is what the measured spectrum has in excess of the surface's C_iso.
        """
        excess = self._density - np.interp(BIN_CENTRES, WAVEVECTORS, density)
        power = (np.maximum(excess, 0) * BIN_CENTRES**2)[self._unreliable]
        return float(power.sum() * BIN_WIDTH / (2 * np.pi))
