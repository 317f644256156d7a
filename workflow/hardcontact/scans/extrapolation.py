"""The extrapolation of a spectrum beyond the wavelengths measured: a tail and a roll-off.

The tail of short waves is self-affine, with the Hurst exponent of the shortest decade measured. It
ends at atoms, or where slope or curvature over all scales would exceed that of the roughest surface
in Table 1.

Above the longest wavelength measured, at most a third of the widest scan, C_iso rises up to the
roll-off, and is constant beyond. Levelling removes most of the variance of waves longer than a
scan, because they are slopes in it, but leaves enough for Bayes' rule to give the roll-off.
"""

from collections.abc import Sequence
from enum import StrEnum
from typing import NamedTuple

import numpy as np
import scipy

from hardcontact.base.arrays import Floats
from hardcontact.scans.reliable_wavelengths import STEEPEST_SELF_AFFINE_SLOPE, ReliableWavelengths
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.levelling import level_plane, squared_projections
from hardcontact.surfaces.spectral_models import power_law_tail
from hardcontact.surfaces.spectrum import (
    BIN_CENTRES,
    BIN_WIDTH,
    LOG_WAVEVECTORS,
    MIN_BINS,
    WAVEVECTORS,
    Spectrum,
)

#: The largest rms gradient over all scales: that of UNCD with its uncertainty (1.17 + 0.28).
MAX_GRADIENT = 1.45
#: The largest rms half-Laplacian in 1/nm, also of UNCD (6.32 + 1.20): the curvature of an atom.
MAX_HALF_LAPLACIAN = 7.52
#: The shortest wave of a row of atoms in nm: two bonds of diamond, 0.154 nm each.
ATOMIC_WAVELENGTH = 0.3
#: Fewest decades from which a Hurst exponent is known: those of five bins, less rounding.
MIN_FITTED_DECADES = 0.39
#: Sharpness s of a roll-off at q_r, from gradual to sharp: C_iso ~ (1 + (q/q_r)^2s)^(-(1 + H)/s).
SHARPNESS = (1.0, 2.0, 4.0)
#: Bounds of the fitted roll-off: factors on the lowest and the highest wavevector. Below, the fit
#: is a power law; above, hardly a bin is left for the exponent.
ROLLOFF_BOUNDS = (0.1, 0.7)
#: Number of roll-offs compared. On a scan of 10 µm, four times as many changed the roll-off by 6 %,
#: far less than its uncertainty, and the Hurst exponent by 0.0002.
ROLLOFF_COUNT = 61
#: Standard deviation of the Hurst exponent below the wavelengths measured: surfaces are self-affine
#: over some decades at best.
HURST_SCATTER = 0.1
#: If a Hurst exponent within 0 to 1 is less probable, no self-affine surface fits.
MIN_TRUNCATED_PROBABILITY = 0.05
#: Normal distributions with a smaller share within 0 to 1 do not count, because their mean would be
#: a ratio of rounding errors.
NEGLIGIBLE_SHARE = 1e-9
#: Ratio of the longest possible roll-off wavelength to the size of the scan: a scan shows longer
#: waves as slopes, which levelling removes.
MAX_ROLLOFF_OVER_SIZE = 10.0
#: Number of directions of waves over which `share_after_levelling` averages. More directions change
#: it by less than 0.5 % for a line scan, and 1e-6 for a map.
DIRECTION_COUNT = 64


class HurstFit(NamedTuple):
    """The Hurst exponent of the shortest waves; 0 or 1 if no exponent between them fits."""

    exponent: float
    error: float  #: Standard error, HURST_SCATTER included.
    shortest: float  #: Shortest wavelength in nm of the bins fitted.
    longest: float  #: Longest wavelength in nm.


def fit_hurst_exponent(wavevector: Floats, density: Floats, variance: Floats) -> HurstFit:
    """Return the Hurst exponent H of the shortest decade, or of three bins if they are wider.

    `variance` is of ln C. Far below the roll-off wavelength C_iso falls as q^(-2 - 2H), near it
    less steeply: at a third of a gradual roll-off, H = 0.8 looks like 0.62. The roll-off is not
    known, so H is fitted for many cases, each a roll-off with a SHARPNESS. The result is the
    posterior mean of H over all cases. A priori H is uniform from 0 to 1, and so are the logarithm
    of the roll-off and SHARPNESS.
    """
    is_fitted = wavevector >= wavevector[-1] / 10 * (1 - 1e-9)
    is_fitted[-MIN_BINS:] = True
    q = wavevector[is_fitted]
    exponents, errors, probability = _fit_cases(
        _falls_of_cases(q), np.log(density[is_fitted]), 1 / variance[is_fitted]
    )
    exponent, exponent_variance = _truncated_moments(exponents, errors, probability)
    error = np.sqrt(exponent_variance + HURST_SCATTER**2)
    return HurstFit(float(exponent), float(error), *(2 * np.pi / q[[-1, 0]]).tolist())


def _falls_of_cases(q: Floats) -> Floats:
    """Return ln C (case, bins) relative to the plateau at long waves, if H = 0.

    With another H it is (1 + H) times this fall. A case is a roll-off with a SHARPNESS.
    """
    rolloffs = np.geomspace(ROLLOFF_BOUNDS[0] * q[0], ROLLOFF_BOUNDS[1] * q[-1], ROLLOFF_COUNT)
    sharpness = np.array(SHARPNESS)[:, None, None]
    falls = -np.log1p((q / rolloffs[:, None]) ** (2 * sharpness)) / sharpness
    return np.asarray(falls.reshape(-1, len(q)))


def _fit_cases(falls: Floats, log_density: Floats, weight: Floats) -> tuple[Floats, Floats, Floats]:
    """Return Hurst exponents, their standard errors and the probability of each case: (case,).

    ln C = (1 + H) fall + constant is a straight line over the fall, so that a weighted regression
    gives 1 + H. The probability of a case is proportional to exp(-chi²/2) times the error of H,
    because with a larger error more values of H fit.
    """
    total_weight = weight.sum()
    centred = falls - (falls @ weight)[:, None] / total_weight
    spread = centred**2 @ weight
    slopes = centred @ (weight * log_density) / spread
    residuals = log_density - log_density @ weight / total_weight - slopes[:, None] * centred
    log_probability = -(residuals**2 @ weight) / 2 - np.log(spread) / 2
    probability = np.exp(log_probability - log_probability.max())
    probability /= probability.sum()
    return slopes - 1, 1 / np.sqrt(spread), probability


def _truncated_moments(
    exponents: Floats, errors: Floats, probability: Floats
) -> tuple[Floats, Floats]:
    """Return mean and variance of H, if each case (case,) has a normal distribution of H.

    The distributions are truncated to 0 to 1, because no self-affine surface has another H: 0.9 ±
    0.2 becomes 0.80 ± 0.14. With the density p and the distribution P of the standard normal, a
    case truncated to `low` to `high`, in standard errors, has

        shift = (p(low) - p(high)) / (P(high) - P(low)),  mean = exponent + error shift.

    If less than MIN_TRUNCATED_PROBABILITY lies within 0 to 1, the mean is not truncated, but
    clipped.
    """
    low, high = -exponents / errors, (1 - exponents) / errors
    share_within = scipy.special.ndtr(high) - scipy.special.ndtr(low)
    probability_within = probability @ share_within
    if probability_within < MIN_TRUNCATED_PROBABILITY:
        mean = probability @ exponents
        return np.clip(mean, 0, 1), probability @ (errors**2 + (exponents - mean) ** 2)
    mixture = np.array([low, high, exponents, errors, share_within, probability])
    low, high, exponents, errors, share_within, probability = mixture[
        :, share_within > NEGLIGIBLE_SHARE
    ]
    low_density, high_density = np.exp(-np.square([low, high]) / 2) / np.sqrt(2 * np.pi)
    shift = (low_density - high_density) / share_within
    means = exponents + errors * shift
    variances = errors**2 * (
        1 + (low * low_density - high * high_density) / share_within - shift**2
    )
    # The variance of a mixture: the mean variance of its cases, plus the variance of their means.
    weight = probability * share_within / probability_within
    mean = weight @ means
    return mean, weight @ (variances + (means - mean) ** 2)


class TailEnd(StrEnum):
    """The bound that ends the extrapolation to short waves; NONE for a description."""

    NONE, ATOMS, GRADIENT, HALF_LAPLACIAN = "", "atoms", "gradient", "half_laplacian"


class Tail(NamedTuple):
    """The extrapolation below the shortest wavelength measured; NaN without extrapolation."""

    tail_hurst: float = np.nan
    tail_hurst_error: float = np.nan  #: Standard error of the Hurst exponent.
    tail_fit_shortest: float = np.nan  #: Shortest wavelength (nm) of the fit of the exponent.
    tail_fit_longest: float = np.nan  #: Longest wavelength (nm) of this fit.
    tail_ended_by: TailEnd = TailEnd.NONE


def is_tail_known(tail: Tail) -> bool:
    """Return True if an exponent between 0 and 1 fits enough decades, or there is no tail."""
    decades = np.log10(tail.tail_fit_longest / tail.tail_fit_shortest)
    is_physical = 0 < tail.tail_hurst < 1
    return bool(np.isnan(tail.tail_hurst) or (is_physical and decades >= MIN_FITTED_DECADES))


def extrapolate_short_waves(
    wavevector: Floats, density: Floats, hurst_fit: HurstFit, hurst_deviation: float = 0.0
) -> tuple[Floats, Tail]:
    """Return C_iso (nm⁴) on WAVEVECTORS from at least three measured points, and its tail.

    The tail continues the measured C_iso as q^(-2 - 2H) to shorter waves, until `_find_tail_end`
    ends it. `hurst_deviation` is added to the fitted H. If the measured waves already exceed a
    bound, there is no tail.
    """
    # The highest measured wavevector may exceed the highest of WAVEVECTORS by rounding.
    interpolated = Spectrum(wavevector, density)(np.minimum(WAVEVECTORS, wavevector[-1]))
    measured_density = np.where(wavevector[-1] * (1 + 1e-9) >= WAVEVECTORS, interpolated, 0.0)
    exponent = float(np.clip(hurst_fit.exponent + hurst_deviation, 0, 1))
    # One point scatters, so the tail starts at the geometric mean of the last MIN_BINS points. Each
    # is first moved to the last wavevector along the slope of the tail.
    relative_wavevector = wavevector[-MIN_BINS:] / wavevector[-1]
    tail_slope = -2 - 2 * exponent
    start_density = np.exp(np.mean(np.log(density[-MIN_BINS:] * relative_wavevector**-tail_slope)))
    last_index = measured_density.nonzero()[0][-1]
    tail_start = measured_density.copy()
    relative_start = WAVEVECTORS[last_index] / wavevector[-1]
    tail_start[last_index] = start_density * relative_start**tail_slope
    endless_density = measured_density + power_law_tail(tail_start, exponent, ATOMIC_WAVELENGTH)
    end_index, ended_by = _find_tail_end(endless_density)
    is_before_end = np.arange(len(WAVEVECTORS)) <= max(end_index, last_index)
    extrapolated_density = np.where(is_before_end, endless_density, 0.0)
    if end_index <= last_index:
        return extrapolated_density, Tail(tail_ended_by=ended_by)
    tail = Tail(exponent, hurst_fit.error, hurst_fit.shortest, hurst_fit.longest, ended_by)
    return extrapolated_density, tail


def _find_tail_end(density: Floats) -> tuple[int, TailEnd]:
    """Return the last index of WAVEVECTORS within all bounds, and the bound exceeded first.

    Gradient and half-Laplacian include all waves up to a wavevector, so they grow with it.
    """

    def rms(exponent: int, divisor: int) -> Floats:
        """Return the root of ∫ q^exponent C_iso d ln q / (2 pi divisor), up to each wavevector."""
        square = density * WAVEVECTORS**exponent / divisor / (2 * np.pi)
        return np.sqrt(scipy.integrate.cumulative_trapezoid(square, LOG_WAVEVECTORS, initial=0))

    exceeded = {
        TailEnd.GRADIENT: rms(4, 1) > MAX_GRADIENT,
        TailEnd.HALF_LAPLACIAN: rms(6, 4) > MAX_HALF_LAPLACIAN,
        TailEnd.ATOMS: density == 0,
    }
    # The appended True stands for a bound that no wave exceeds.
    last_indices = {end: int(np.append(mask, True).argmax()) - 1 for end, mask in exceeded.items()}
    ended_by = min(last_indices, key=lambda end: last_indices[end])
    return last_indices[ended_by], ended_by


def extrapolate_long_waves(density: Floats, longest: float, slope: float, rolloff: float) -> Floats:
    """Return C_iso with d ln C/d ln q = `slope`, clipped to -4 to 0, up to `rolloff` (nm).

    `density` is constant above the wavelength `longest`. There it is multiplied by
    (wavelength/longest)^-slope, which is constant beyond the roll-off.
    """
    wavelength_ratio = np.maximum(2 * np.pi / WAVEVECTORS / longest, 1.0)
    rolloff_ratio = max(rolloff / longest, 1.0)
    exponent = -np.clip(slope, STEEPEST_SELF_AFFINE_SLOPE, 0.0)
    return np.asarray(density * np.minimum(wavelength_ratio, rolloff_ratio) ** exponent)


def share_after_levelling(wavevector: Floats, size: float, kind: str) -> Floats:
    """Return the share (q,) of variance that levelling leaves of waves of random directions.

    Levelling removes the mean of the heights, and their mean slope along each axis. In a wave much
    longer than the scan, these have almost all of the variance. The matrices are (q, direction).
    """
    angle = (np.arange(DIRECTION_COUNT) + 0.5) * np.pi / 2 / DIRECTION_COUNT
    # Below this phase the share would be lost in rounding.
    half_phase = np.maximum(wavevector[:, None] * size / 2, 1e-3)
    mean_x, slope_x = squared_projections(half_phase * np.cos(angle))
    if kind == "line scan":
        return np.asarray((1 - mean_x - slope_x).mean(axis=1))
    mean_y, slope_y = squared_projections(half_phase * np.sin(angle))
    removed = mean_x * mean_y + slope_x * mean_y + mean_x * slope_y
    return np.asarray((1 - removed).mean(axis=1))


class RolloffEvidence:
    """The variance of heights of the widest scans of a surface, as evidence of the roll-off.

    Levelling leaves 76 % of the variance of waves as long as a map, and 3 % if they are three times
    as long. So waves too long to be measured still raise the variance of the levelled heights. With
    a longer roll-off there are more of them, so this variance tells which roll-offs are probable.
    """

    def __init__(
        self, scans: Sequence[HeightMap], densities: Floats, scan_waves: list[ReliableWavelengths]
    ) -> None:
        longest = max(waves.longest for waves in scan_waves)
        is_widest = np.array([waves.longest == longest for waves in scan_waves])
        widest_scans = [scan for scan, widest in zip(scans, is_widest, strict=True) if widest]
        kind = widest_scans[0].kind
        self._size = widest_scans[0].size
        self._scan_count = len(widest_scans)
        # The mean variance of the levelled heights in nm².
        self._variance = float(np.mean([level_plane(scan).heights.var() for scan in widest_scans]))
        # The mean C_iso (bins,) in nm⁴, and the bins of short waves that may hold noise.
        self._measured_density = np.nan_to_num(densities[is_widest]).mean(axis=0)
        shortest = min(waves.shortest for waves in scan_waves if waves.longest == longest)
        self._is_unreliable = 2 * np.pi / BIN_CENTRES < shortest
        self._share_after_levelling = share_after_levelling(WAVEVECTORS, self._size, kind)
        # Independent modes per ln q: q²L²/4π in a map, qL/2π along a line, but at least 1, because
        # waves longer than the scan appear as a bow.
        waves_in_size = WAVEVECTORS * self._size / (2 * np.pi)
        modes = waves_in_size if kind == "line scan" else np.pi * waves_in_size**2
        self._mode_count = np.maximum(modes, 1)

    def rolloff_quantile(
        self, density: Floats, longest: float, slope: float, probability: float
    ) -> float:
        """Return a quantile of the roll-off wavelength (nm): the median if `probability` is 0.5.

        From the `longest` measured wavelength, C_iso continues with d ln C/d ln q = `slope`. Unless
        it rises toward long waves, it has no roll-off, and the quantile is `longest`.
        """
        if slope >= 0:
            return longest
        # A priori the logarithm of the roll-off is uniform, so that the posterior of these
        # roll-offs is proportional to their likelihoods.
        rolloffs = np.geomspace(longest, MAX_ROLLOFF_OVER_SIZE * self._size, ROLLOFF_COUNT)
        trials = [extrapolate_long_waves(density, longest, slope, rolloff) for rolloff in rolloffs]
        log_likelihoods = np.array([self._log_likelihood(trial) for trial in trials])
        posterior = np.exp(log_likelihoods - log_likelihoods.max())
        # Half of the probability of a roll-off counts as below it.
        cumulative = (np.cumsum(posterior) - posterior / 2) / posterior.sum()
        return float(np.exp(np.interp(probability, cumulative, np.log(rolloffs))))

    def _log_likelihood(self, density: Floats) -> float:
        """Return the logarithm of the likelihood of the measured variance, up to a constant.

        With C_iso `density`, the mean variance of heights over the scans is a gamma variable. Its
        mean is the expected variance: what levelling leaves of all waves, and noise. Its relative
        variance is 1/shape.
        """
        variance_per_log = density * WAVEVECTORS**2 * self._share_after_levelling / (2 * np.pi)
        expected_variance = np.trapezoid(variance_per_log, LOG_WAVEVECTORS)
        expected_variance += self._noise_variance(density)
        variance_of_variance = np.trapezoid(variance_per_log**2 / self._mode_count, LOG_WAVEVECTORS)
        # The power of n modes has the relative variance 1/n, and varies independently per ln q.
        # Scans are independent, too.
        shape = expected_variance**2 / variance_of_variance * self._scan_count
        scale = expected_variance / shape
        ratio = self._variance / scale
        return float(
            (shape - 1) * np.log(ratio) - ratio - scipy.special.gammaln(shape) - np.log(scale)
        )

    def _noise_variance(self, density: Floats) -> float:
        """Return the variance of heights (nm²) from noise.

        Noise is what the measured C_iso has above `density` at waves too short to be reliable.
        """
        excess = self._measured_density - np.interp(BIN_CENTRES, WAVEVECTORS, density)
        excess_per_log = (np.maximum(excess, 0) * BIN_CENTRES**2)[self._is_unreliable]
        return float(excess_per_log.sum() * BIN_WIDTH / (2 * np.pi))
