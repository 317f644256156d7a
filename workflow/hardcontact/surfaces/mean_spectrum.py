"""The mean spectrum of several measurements of a surface in bins, and a smooth curve through it."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hardcontact.surfaces.measured_spectrum import CALIBRATION, bias_of_log, variance_of_log
from hardcontact.surfaces.spectrum import BIN_CENTRES, BIN_WIDTH, Floats, Spectrum

#: Standard deviation of the change of the slope d ln C/d ln q along a root of a decade: at a
#: roll-off it is 2 + 2H, some 3.6, once in the three decades that surfaces are measured on.
KINK = 2.0
#: Probability of more power in a bin by chance, below which it is that of a line, as of a grating.
LINE_PROBABILITY = 1e-4
#: The largest change of ln C that is tried to keep the variance of the bins.
MAX_LOG_CHANGE = 20.0


class MeanBins(NamedTuple):
    """The mean of all measurements in each bin, NaN where there is none."""

    #: (bins,) C_iso in nm⁴ of the mean of ln C, freed of the bias of the logarithm.
    density: Floats
    variance: Floats  #: (bins,) of ln C, by the number of waves alone.
    power: Floats  #: (bins,) mean C_iso in nm⁴.


class Curve(NamedTuple):
    """A spectrum at the centres of the bins from the first to the last that is measured."""

    wavevector: Floats  #: rad/nm.
    density: Floats  #: C_iso in nm⁴.
    variance: Floats  #: Of ln C, calibration included.


def mean_bins(reliable: NDArray[np.bool_], density: Floats, waves: Floats) -> MeanBins:
    """Return the means over measurements of C_iso (measurement, bins) in nm⁴ where reliable."""
    wave_variance = variance_of_log(waves)
    weight = np.where(reliable, 1 / (wave_variance + CALIBRATION**2), 0.0)
    logs = np.where(reliable, np.log(density) + bias_of_log(waves), 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        weight = weight / weight.sum(axis=0)
    variance = (weight**2 * wave_variance).sum(axis=0)
    power = (weight * np.where(reliable, density, 0.0)).sum(axis=0)
    return MeanBins(np.exp((weight * logs).sum(axis=0)), variance, power)


def line_bins(bins: MeanBins) -> NDArray[np.bool_]:
    """Return which bins hold a line: more power than chance adds to a smooth spectrum."""
    from scipy.special import gammaincc

    inner = np.flatnonzero(np.isfinite(bins.density))[1:-1]
    waves = 1 / bins.variance[inner] + 0.5  # The variance of ln C is the trigamma of their number.
    lines = np.zeros(len(bins.power), bool)
    while True:
        curve = smoothed(np.where(lines, np.nan, bins.density), bins.variance)
        expected = Spectrum(curve.wavevector, curve.density)(BIN_CENTRES[inner])
        chance = gammaincc(waves, waves * bins.power[inner] / expected)
        new_lines = inner[(chance < LINE_PROBABILITY) & ~lines[inner]]
        if not len(new_lines):
            return lines
        lines[new_lines] = True


def smoothed(density: Floats, variance: Floats, rng: np.random.Generator | None = None) -> Curve:
    """Return a smooth curve through bins, across gaps between them.

    C_iso (bins,) in nm⁴, NaN in gaps, has the variance (bins,) of its logarithm by the number of
    waves. The slope d ln C/d ln q changes at random by KINK a root of a decade (an integrated
    Wiener process): the mean of all curves that may be, given the points, is a smoothing spline
    (Wahba, J. R. Stat. Soc. B 40 (1978) 364). A generator draws one of the curves. The variance of
    the result covers these curves and the calibration.
    """
    finite = np.flatnonzero(np.isfinite(density))
    bins = slice(finite[0], finite[-1] + 1)
    weight = np.where(np.isfinite(density), 1 / variance, 0.0)[bins]
    count, change = len(weight), KINK * np.sqrt(BIN_WIDTH / np.log(10))
    bends = np.diff(np.eye(count), n=2, axis=0) / (BIN_WIDTH * change)
    posterior = np.linalg.inv(np.diag(weight) + bends.T @ bends)
    logs = np.log(np.where(weight > 0, density[bins], 1.0))
    curve = np.zeros(count)
    if rng is not None:
        curve = BIN_WIDTH * np.cumsum(np.cumsum(change * rng.standard_normal(count)))
        noise = np.where(weight > 0, np.sqrt(variance[bins]), 0.0)
        logs = logs - curve - noise * rng.standard_normal(count)
    smooth = curve + posterior @ (weight * logs)
    return Curve(BIN_CENTRES[bins], np.exp(smooth), np.diag(posterior) + CALIBRATION**2)


def smoothed_without_lines(
    bins: MeanBins, lines: NDArray[np.bool_], rng: np.random.Generator | None = None
) -> Curve:
    """Return the bins smoothed as by `smoothed`, but `lines` (bins,) with the power they have."""
    curve = smoothed(np.where(lines, np.nan, bins.density), bins.variance, rng)
    within = np.isin(BIN_CENTRES, curve.wavevector)
    density = np.where(lines[within], bins.power[within], curve.density)
    return curve._replace(density=density)


def with_power(curve: Curve, power: Floats) -> Curve:
    """Return a curve with the variance of heights that C_iso (bins,) in nm⁴ has in known bins.

    Of all curves with this variance it is the most likely one, to first order: ln C changes in
    proportion to its variance and to the share of a bin in the variance of heights.
    """
    from scipy.optimize import brentq

    wavevector, density, variance = curve
    power = power[np.isin(BIN_CENTRES, wavevector)]
    total = np.nansum(power * wavevector**2)
    share = np.where(np.isfinite(power), density * wavevector**2 / total, 0.0)
    doubt = (variance - CALIBRATION**2) * share

    def excess(strength: float) -> float:
        return float((share * np.exp(strength * doubt)).sum() - 1)

    bound = MAX_LOG_CHANGE / doubt.max()
    strength = brentq(excess, -bound, bound)
    return curve._replace(density=density * np.exp(strength * doubt))
