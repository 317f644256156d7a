"""The Hurst exponent of the shortest waves of a spectrum, fitted together with its roll-off."""

from typing import NamedTuple

import numpy as np

from hardcontact.surfaces.spectrum import MIN_BINS, Floats

#: Exponents s of C0 (1 + (q/q_r)^2s)^(-(1 + H)/s): gradual to sharp roll-offs at q_r.
SHARPNESS = (1.0, 2.0, 4.0)
#: Bounds of the roll-offs that are fitted with H: factors on the first and the last wavevector.
ROLLOFF_BOUNDS = (0.1, 0.7)
#: Roll-off wavelengths that are compared.
ROLLOFF_COUNT = 61
#: Standard deviation of the Hurst exponent beyond what is measured: surfaces are self-affine over
#: some decades at best.
HURST_SCATTER = 0.1
#: Probability that the Hurst exponent lies within 0 to 1 below which no self-affine surface fits.
MIN_INSIDE = 0.05
#: Share of a normal distribution that does not count.
NEGLIGIBLE = 1e-9


class HurstFit(NamedTuple):
    """The Hurst exponent of the shortest waves of a spectrum; 0 or 1 if none between them fits."""

    exponent: float
    error: float  #: The standard error, of the fit and by HURST_SCATTER.
    shortest: float  #: Wavelengths in nm of the bins fitted.
    longest: float


def fitted_hurst(wavevector: Floats, density: Floats, variance: Floats) -> HurstFit:
    """Return the Hurst exponent past the roll-off, fitted together with it.

    The bins of the last decade, with the variance of their ln C, follow ln C = ln C0 - (1 + H)
    ln(1 + (q/q_r)^2s)/s. Given the roll-off q_r and s, this is a weighted regression. All q_r in
    their logarithm, all SHARPNESS, and all H within 0 to 1 are equally likely beforehand; exponent
    and error are mean and standard deviation by Bayes' rule.

    Parameters
    ----------
    wavevector, density, variance : numpy.ndarray
        Bins, in rad/nm and nm⁴, at least three.

    Returns
    -------
    HurstFit
        The exponent with its error.
    """
    fitted = wavevector >= wavevector[-1] / 10 * (1 - 1e-9)
    fitted[-MIN_BINS:] = True
    q, log_density, weight = wavevector[fitted], np.log(density[fitted]), 1 / variance[fitted]
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
    exponent, variance_of_mean = _within_bounds(slopes - 1, 1 / np.sqrt(spread), probability)
    error = np.sqrt(variance_of_mean + HURST_SCATTER**2)
    return HurstFit(float(exponent), float(error), *(2 * np.pi / q[[-1, 0]]).tolist())


def _within_bounds(exponents: Floats, errors: Floats, probability: Floats) -> tuple[Floats, Floats]:
    """Return mean and variance of a mixture of normal exponents (case,), held within 0 to 1.

    If hardly any of it lies within, the mean is at the bound.
    """
    from scipy.special import ndtr

    low, high = -exponents / errors, (1 - exponents) / errors
    inside = ndtr(high) - ndtr(low)
    total = probability @ inside
    if total < MIN_INSIDE:
        mean = probability @ exponents
        return np.clip(mean, 0, 1), probability @ (errors**2 + (exponents - mean) ** 2)
    low, high, exponents, errors, inside, probability = (
        values[inside > NEGLIGIBLE]
        for values in (low, high, exponents, errors, inside, probability)
    )
    at_low, at_high = (np.exp(-(end**2) / 2) / np.sqrt(2 * np.pi) for end in (low, high))
    shift = (at_low - at_high) / inside
    means = exponents + errors * shift
    variances = errors**2 * (1 + (low * at_low - high * at_high) / inside - shift**2)
    weight = probability * inside / total
    mean = weight @ means
    return mean, weight @ (variances + (means - mean) ** 2)
