"""The Hurst exponent of the shortest waves of a spectrum, fitted together with its roll-off."""

from typing import NamedTuple

import numpy as np

from hardcontact.surfaces.spectrum import MIN_BINS, Floats

#: Exponents s of C0 (1 + (q/q_r)^2s)^(-(1 + H)/s): from a gradual to a sharp roll-off at q_r.
SHARPNESS = (1.0, 2.0, 4.0)
#: Bounds of the fitted roll-off: factors on the first and the last wavevector.
ROLLOFF_BOUNDS = (0.1, 0.7)
#: Roll-off wavelengths that are compared.
ROLLOFF_COUNT = 61
#: Standard deviation of the Hurst exponent below the wavelengths measured: surfaces are self-affine
#: over some decades at best.
HURST_SCATTER = 0.1
#: Least probability of a Hurst exponent within 0 to 1 at which a self-affine surface fits.
MIN_TRUNCATED_PROBABILITY = 0.05
#: Share of a normal distribution within 0 to 1, below which a case of the mixture is left out.
NEGLIGIBLE_SHARE = 1e-9


class HurstFit(NamedTuple):
    """The Hurst exponent of the shortest waves; 0 or 1 if no exponent between them fits."""

    exponent: float
    error: float  #: Standard error of the fit, with HURST_SCATTER.
    shortest: float  #: Wavelengths in nm of the bins fitted.
    longest: float


def fit_hurst_exponent(wavevector: Floats, density: Floats, variance: Floats) -> HurstFit:
    """Return the Hurst exponent of at least three bins, fitted together with the roll-off.

    Bins of the last decade follow ln C = ln C0 - (1 + H) ln(1 + (q/q_r)^2s)/s, a weighted
    regression for each roll-off q_r and s. The prior is uniform in ln q_r, in SHARPNESS, and in H
    within 0 to 1. The exponent is the posterior mean; its error has HURST_SCATTER.
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
    from scipy.special import ndtr

    low, high = -exponents / errors, (1 - exponents) / errors
    truncated_share = ndtr(high) - ndtr(low)
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
