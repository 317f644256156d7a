"""C_iso of one scan, a map or a line scan, with the number of independent modes and local slopes.

A line scan gives C_1D alone. Its inverse Abel transform is C_iso (Bracewell, The Fourier Transform
and Its Applications). `surfaces.spectrum` defines both.
"""

from dataclasses import replace

import numpy as np
import scipy

from hardcontact.base.arrays import Floats
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.spectrum import BIN_CENTRES, BIN_EDGES, measured_psds, profile_psd

#: Share of independent modes under a Hann window, along one axis:
#: (mean w²)² / mean w⁴ = (3/8)² / (35/128).
INDEPENDENT_SHARE = (3 / 8) ** 2 / (35 / 128)
#: Relative standard deviation of C_iso between scans with many modes: heights of microscopes are
#: calibrated to some ten percent. It limits the weight of a scan.
CALIBRATION_SCATTER = 0.2
#: Half the width, in ln q, of the interval to which a local slope is fitted: it holds five bins.
SLOPE_HALF_WIDTH = 0.25 * np.log(10)
#: Standard deviation, in ln q, of the kernel that smooths a spectrum: one bin of BIN_EDGES.
SMOOTHING_WIDTH = 0.1 * np.log(10)
#: Largest factor on the width of the kernel in bins with few independent modes.
MAX_WIDENING = 4.0
#: Bins with fewer independent modes have a wider kernel.
ENOUGH_MODES = 20.0
#: Values of u with p = q cosh u in `_inverse_abel`, down to a thousandth of the wavelength: shorter
#: waves add less than a thousandth.
INTEGRATION_POINTS = np.linspace(0, 7.6, 400)
#: Slope of the flattest C_1D of a self-affine surface, q^-1: extrapolated C_1D is no flatter.
FLATTEST_PROFILE_SLOPE = -1.0


def isotropic_psd(scan: HeightMap) -> Floats:
    """Return C_iso (bins,) in nm⁴ of a scan; NaN in empty bins."""
    levelled = level_plane(scan)
    if scan.kind == "map":
        _, _, isotropic = measured_psds(levelled)
        return isotropic
    modes = independent_modes(scan.kind, scan.size)
    return isotropic_from_profile(BIN_CENTRES, profile_psd(levelled), modes)


def axis_ratio(scan: HeightMap) -> Floats:
    """Return the ratio (bins,), at least 1, of C_1D along both axes; 1 where one is missing."""
    if scan.kind == "line scan":
        return np.ones(len(BIN_CENTRES))
    levelled = level_plane(scan)
    profile_x = profile_psd(levelled)
    profile_y = profile_psd(replace(levelled, heights=levelled.heights.T))
    ratio = np.maximum(profile_x / profile_y, profile_y / profile_x)
    return np.asarray(np.where(np.isfinite(ratio), ratio, 1.0), float)


def independent_modes(kind: str, size: float) -> Floats:
    """Return the number of independent modes in each bin of the PSD of a map or line scan.

    The wavevectors in a scan are 2 pi/size apart along each axis. The Hann window mixes neighbours,
    so only INDEPENDENT_SHARE of them are independent along each axis. A bin of a map is a ring of
    wavevectors, half of which count, because q and -q are one mode.
    """
    # A bin has at least the independent share of one wave.
    if kind == "map":
        count = np.pi / 2 * np.diff(BIN_EDGES**2) * (INDEPENDENT_SHARE * size / (2 * np.pi)) ** 2
    else:
        count = np.diff(BIN_EDGES) * INDEPENDENT_SHARE * size / (2 * np.pi)
    return np.asarray(np.maximum(count, INDEPENDENT_SHARE), float)


def variance_of_log(modes: Floats) -> Floats:
    """Return the variance of ln C of a mean over modes: the trigamma of their number.

    The mean over n modes is a gamma variable of shape n. The variance of its logarithm is 1.64 for
    one mode, 0.105 for ten, and approaches 1/n.
    """
    # Less than one mode has the variance of one mode over their number.
    trigamma = scipy.special.polygamma(1, np.maximum(modes, 1.0))
    return np.asarray(trigamma / np.minimum(modes, 1.0))


def bias_of_log(modes: Floats) -> Floats:
    """Return the logarithm of the mean of C minus the mean of ln C: ln n - digamma(n), n modes.

    For one mode it is 0.58, for ten 0.05. Added to ln C, it makes a mean of ln C unbiased.
    """
    modes = np.maximum(modes, 1.0)
    return np.asarray(np.log(modes) - scipy.special.digamma(modes), float)


def local_slopes(wavevector: Floats, density: Floats, variance: Floats) -> tuple[Floats, Floats]:
    """Return d ln C / d ln q of a spectrum, fitted to half a decade around each bin, and its error.

    Each row of the matrices (bin, neighbour) is a weighted regression of ln C on the distance in
    ln q: slope = sum(weight centred ln C) / spread, with the squared error 1/spread. `variance` is
    of ln C. A bin without neighbours has the slope NaN and an infinite error.
    """
    distance = np.log(wavevector) - np.log(wavevector)[:, None]
    is_near = np.abs(distance) <= SLOPE_HALF_WIDTH
    weight = np.where(is_near, 1 / variance, 0.0)
    total_weight = weight.sum(axis=1)
    centred = distance - ((weight * distance).sum(axis=1) / total_weight)[:, None]
    spread = (weight * centred**2).sum(axis=1)
    has_neighbours = is_near.sum(axis=1) > 1
    spread = np.where(has_neighbours, spread, np.nan)
    slope = (weight * centred) @ np.log(density) / spread
    return slope, np.where(has_neighbours, 1 / np.sqrt(spread), np.inf)


def isotropic_from_profile(wavevector: Floats, profile_density: Floats, modes: Floats) -> Floats:
    """Return C_iso (bins,) in nm⁴ of a surface whose profiles have a measured C_1D in nm³.

    The inverse Abel transform contains the slope of C_1D, which enlarges scatter. So it is applied
    to a smooth, falling C_1D, and only the ratio C_iso/C_1D is taken from there.
    """
    finite = np.isfinite(profile_density)
    if finite.sum() < 2:
        return np.full(profile_density.shape, np.nan)
    log_q, log_density = np.log(wavevector[finite]), np.log(profile_density[finite])
    smooth_log_density, last_slope = _smooth_falling_spectrum(log_q, log_density, modes[finite])
    density = np.full(profile_density.shape, np.nan)
    isotropic = _inverse_abel(log_q, smooth_log_density, min(last_slope, FLATTEST_PROFILE_SLOPE))
    ratio = isotropic / np.exp(smooth_log_density)
    density[finite] = profile_density[finite] * ratio
    return density


def _smooth_falling_spectrum(
    log_q: Floats, log_density: Floats, modes: Floats
) -> tuple[Floats, float]:
    """Return ln C (bins,) smoothed by local lines and falling, and the slope of the last line.

    Each row of the matrices (bin, neighbour) fits a line to ln C over the distance in ln q. Its
    weights are a Gaussian around the bin, wider for a bin of few modes. The line at the distance
    zero is the smooth ln C. Where this still rises, neighbouring bins get their mean.
    """
    distance = log_q - log_q[:, None]
    width = SMOOTHING_WIDTH * np.clip(ENOUGH_MODES / modes, 1, MAX_WIDENING)
    weight = modes * np.exp(-((distance / width[:, None]) ** 2) / 2)
    weight /= weight.sum(axis=1, keepdims=True)
    mean_distance = (weight * distance).sum(axis=1)
    mean_log_density = weight @ log_density
    variance = (weight * distance**2).sum(axis=1) - mean_distance**2
    covariance = (weight * distance) @ log_density - mean_distance * mean_log_density
    slope = covariance / variance
    smooth_log_density = mean_log_density - slope * mean_distance
    result = scipy.optimize.isotonic_regression(smooth_log_density, weights=modes, increasing=False)
    return np.asarray(result.x), float(slope[-1])


def _inverse_abel(log_q: Floats, log_density: Floats, last_slope: float) -> Floats:
    """Return C_iso (bins,) from C_1D, which is a power law between its points and beyond.

    With p = q cosh u the inverse Abel transform has no singularity:

        C_iso(q) = -2 ∫_q^∞ C_1D'(p) / sqrt(p² - q²) dp = -2 ∫_0^∞ C_1D'(p) du.

    Matrices are (q, u). Between two points the slope d ln C_1D/d ln p is constant, so that
    C_1D' = slope C_1D/p.
    """
    log_p = log_q[:, None] + np.log(np.cosh(INTEGRATION_POINTS))
    slopes = np.append(np.diff(log_density) / np.diff(log_q), last_slope)
    segment = np.clip(np.searchsorted(log_q, log_p, side="right") - 1, 0, len(log_q) - 1)
    slope = slopes[segment]
    profile_density = np.exp(log_density[segment] + slope * (log_p - log_q[segment]))
    integrand = -slope * profile_density / np.exp(log_p)
    return np.asarray(2 * np.trapezoid(integrand, INTEGRATION_POINTS, axis=1))
