"""The mean spectrum of several scans of a surface in bins, and a smooth curve through it."""

from typing import NamedTuple

import numpy as np
import scipy
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats
from hardcontact.scans.measured_spectrum import CALIBRATION_SCATTER, bias_of_log, variance_of_log
from hardcontact.surfaces.spectrum import BIN_CENTRES, BIN_WIDTH, Spectrum

#: Standard deviation of the change of the slope d ln C/d ln q over a decade. A roll-off changes the
#: slope by 2 + 2H, some 3.6, once in three measured decades.
SLOPE_CHANGE = 2.0
#: A bin holds a peak, such as a grating's, if chance gives so much power with less than this
#: probability. Among 60 bins, one in 170 spectra has a false peak.
PEAK_PROBABILITY = 1e-4
#: Bound of the search in `match_height_variance`: no ln C changes so much.
MAX_LOG_CHANGE = 20.0


class MeanBins(NamedTuple):
    """The mean of all scans in each bin; NaN in bins in which no scan is reliable."""

    density: Floats  #: (bins,) C_iso in nm⁴ from the mean of ln C, without its bias.
    variance: Floats  #: (bins,) variance of ln C, from the number of modes alone.
    power: Floats  #: (bins,) mean C_iso in nm⁴.
    is_peak: NDArray[np.bool_]  #: (bins,) True where a grating, for example, adds power.


class Curve(NamedTuple):
    """A spectrum at the centres of the bins, from the lowest to the highest measured bin."""

    wavevector: Floats  #: rad/nm.
    density: Floats  #: C_iso in nm⁴.
    variance: Floats  #: Variance of ln C, with that of the calibration.


def mean_bins(reliable: NDArray[np.bool_], density: Floats, modes: Floats) -> MeanBins:
    """Return the mean over scans of their reliable C_iso (scan, bins) in nm⁴."""
    mode_variance = variance_of_log(modes)
    weight = np.where(reliable, 1 / (mode_variance + CALIBRATION_SCATTER**2), 0.0)
    logs = np.where(reliable, np.log(density) + bias_of_log(modes), 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        weight = weight / weight.sum(axis=0)
    variance = (weight**2 * mode_variance).sum(axis=0)
    power = (weight * np.where(reliable, density, 0.0)).sum(axis=0)
    mean_density = np.exp((weight * logs).sum(axis=0))
    return MeanBins(mean_density, variance, power, _find_peaks(mean_density, variance, power))


def _find_peaks(density: Floats, variance: Floats, power: Floats) -> NDArray[np.bool_]:
    """Return the mask of peaks: inner bins with more power than a smooth spectrum has by chance."""
    inner = np.flatnonzero(np.isfinite(density))[1:-1]
    modes = 1 / variance[inner] + 0.5  # inverts the variance, trigamma(n) ≈ 1/(n - 0.5)
    is_peak = np.zeros(len(power), bool)
    while True:
        curve = smooth_curve(np.where(is_peak, np.nan, density), variance)
        smooth_power = Spectrum(curve.wavevector, curve.density)(BIN_CENTRES[inner])
        # The power of n modes over its mean is a gamma variable.
        chance = scipy.special.gammaincc(modes, modes * power[inner] / smooth_power)
        new_peaks = inner[(chance < PEAK_PROBABILITY) & ~is_peak[inner]]
        if not len(new_peaks):
            return is_peak
        is_peak[new_peaks] = True


def smooth_curve(
    density: Floats, variance: Floats, rng: np.random.Generator | None = None
) -> Curve:
    """Return a smooth curve through bins and gaps; with `rng`, a sample of the posterior.

    C_iso (bins,) is NaN in gaps. The slope d ln C/d ln q is a Wiener process, so that the posterior
    mean is a smoothing spline (Wahba, J. R. Stat. Soc. B 40 (1978) 364).
    """
    finite = np.flatnonzero(np.isfinite(density))
    bins = slice(finite[0], finite[-1] + 1)
    weight = np.where(np.isfinite(density), 1 / variance, 0.0)[bins]
    count = len(weight)
    slope_change = SLOPE_CHANGE * np.sqrt(BIN_WIDTH / np.log(10))  # from bin to bin
    bends = np.diff(np.eye(count), n=2, axis=0) / (BIN_WIDTH * slope_change)
    posterior = np.linalg.inv(np.diag(weight) + bends.T @ bends)
    logs = np.log(np.where(weight > 0, density[bins], 1.0))
    curve = np.zeros(count)
    if rng is not None:  # A prior sample, plus the posterior mean of its distance to the data.
        curve = BIN_WIDTH * np.cumsum(np.cumsum(slope_change * rng.standard_normal(count)))
        noise = np.where(weight > 0, np.sqrt(variance[bins]), 0.0)
        logs = logs - curve - noise * rng.standard_normal(count)
    smooth = curve + posterior @ (weight * logs)
    return Curve(BIN_CENTRES[bins], np.exp(smooth), np.diag(posterior) + CALIBRATION_SCATTER**2)


def smooth_curve_without_peaks(bins: MeanBins, rng: np.random.Generator | None = None) -> Curve:
    """Return a smooth curve through the bins without a peak; peaks keep their power."""
    curve = smooth_curve(np.where(bins.is_peak, np.nan, bins.density), bins.variance, rng)
    is_in_curve = np.isin(BIN_CENTRES, curve.wavevector)
    density = np.where(bins.is_peak[is_in_curve], bins.power[is_in_curve], curve.density)
    return curve._replace(density=density)


def match_height_variance(curve: Curve, power: Floats) -> Curve:
    """Return a curve changed so that its variance of heights is that of the mean C_iso `power`.

    Each ln C changes in proportion to its variance and to its share in the variance of heights. To
    first order, this curve is the most likely one. Gaps, in which `power` is NaN, do not count.
    """
    wavevector, density, variance = curve
    power = power[np.isin(BIN_CENTRES, wavevector)]
    total = np.nansum(power * wavevector**2)
    share = np.where(np.isfinite(power), density * wavevector**2 / total, 0.0)
    direction = (variance - CALIBRATION_SCATTER**2) * share

    def relative_excess(multiplier: float) -> float:
        return float((share * np.exp(multiplier * direction)).sum() - 1)

    bound = MAX_LOG_CHANGE / direction.max()
    multiplier = scipy.optimize.brentq(relative_excess, -bound, bound)
    return curve._replace(density=density * np.exp(multiplier * direction))
