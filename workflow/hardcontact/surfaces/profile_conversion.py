"""The isotropic power spectral density of a surface from that of its profiles.

C_1D(q_x) = (1/pi) ∫_0^∞ C_iso(sqrt(q_x² + q_y²)) dq_y is an Abel transform. Its inverse is
C_iso(q) = -2 ∫_q^∞ C_1D'(p) / sqrt(p² - q²) dp: C_iso depends on the profiles' shorter waves, so
that no single exponent converts a spectrum with a roll-off.
Source: Bracewell, The Fourier Transform and Its Applications, chapter on the Abel transform.
"""

import numpy as np
from numpy.typing import NDArray

from hardcontact.surfaces.spectrum import Density

__all__ = ["isotropic_from_profile", "profile_from_isotropic"]

#: Width (standard deviation) of the kernel that smooths a spectrum, in ln q: a bin of BIN_EDGES,
#: and up to four where bins have fewer independent waves than ENOUGH.
SMOOTHING, WIDEST = 0.1 * np.log(10), 4.0
ENOUGH = 20.0
#: u of p = q cosh u in both integrals: waves to a thousandth of the wavelength, beyond which even
#: C_1D ~ 1/q adds less than a thousandth.
SUBSTITUTED = np.linspace(0, 7.6, 400)
#: The flattest C_1D of a self-affine surface is q^-1: the measurement continues at least as steep.
FLATTEST = -1.0


def profile_from_isotropic(
    density: Density, wavevector: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return C_1D of the profiles of an isotropic surface.

    Parameters
    ----------
    density : callable
        C_iso in nm⁴ as a function of the wavevector in rad/nm.
    wavevector : numpy.ndarray
        (points,) of the profiles, in rad/nm.

    Returns
    -------
    numpy.ndarray
        C_1D (points,) in nm³.
    """
    # q_y = q_x sinh u, so that q = q_x cosh u and dq_y = q du.
    isotropic = wavevector[:, None] * np.cosh(SUBSTITUTED)
    integrand = density(isotropic) * isotropic
    return np.asarray(np.trapezoid(integrand, SUBSTITUTED, axis=1) / np.pi)


def isotropic_from_profile(
    wavevector: NDArray[np.float64], profile: NDArray[np.float64], waves: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return C_iso of a surface whose profiles have a measured C_1D.

    The ratio C_iso/C_1D is that of the smoothed, falling spectrum, so that the scatter of C_1D is
    neither amplified nor made negative. Beyond its last point C_1D continues as a power law.

    Parameters
    ----------
    wavevector : numpy.ndarray
        (bins,) in rad/nm, growing.
    profile : numpy.ndarray
        C_1D (bins,) in nm³; NaN in empty bins. At least two bins are known.
    waves : numpy.ndarray
        (bins,) number of independent waves.

    Returns
    -------
    numpy.ndarray
        C_iso (bins,) in nm⁴; NaN in empty bins.
    """
    known = np.isfinite(profile)
    log_q = np.log(wavevector[known])
    smooth, last_slope = _falling(log_q, np.log(profile[known]), waves[known])
    density = np.full(profile.shape, np.nan)
    ratio = _inverse_abel(log_q, smooth, min(last_slope, FLATTEST)) / np.exp(smooth)
    density[known] = profile[known] * ratio
    return density


def _falling(
    log_q: NDArray[np.float64], log_density: NDArray[np.float64], waves: NDArray[np.float64]
) -> tuple[NDArray[np.float64], float]:
    """Return ln C smoothed by local lines and falling (bins,), and its slope at the end."""
    from scipy.optimize import isotonic_regression

    distance = log_q - log_q[:, None]
    width = SMOOTHING * np.clip(ENOUGH / waves, 1, WIDEST)
    weight = waves * np.exp(-((distance / width[:, None]) ** 2) / 2)
    weight /= weight.sum(axis=1, keepdims=True)
    centre, mean = (weight * distance).sum(axis=1), weight @ log_density
    variance = (weight * distance**2).sum(axis=1) - centre**2
    slope = ((weight * distance) @ log_density - centre * mean) / variance
    smooth = isotonic_regression(mean - slope * centre, weights=waves, increasing=False).x
    return np.asarray(smooth, float), float(slope[-1])


def _inverse_abel(
    log_q: NDArray[np.float64], log_density: NDArray[np.float64], last_slope: float
) -> NDArray[np.float64]:
    """Return C_iso (bins,) of a C_1D that is a power law between its points and beyond."""
    log_p = log_q[:, None] + np.log(np.cosh(SUBSTITUTED))
    slopes = np.append(np.diff(log_density) / np.diff(log_q), last_slope)
    segment = np.clip(np.searchsorted(log_q, log_p, side="right") - 1, 0, len(log_q) - 1)
    slope = slopes[segment]
    profile = np.exp(log_density[segment] + slope * (log_p - log_q[segment]))
    # dp / sqrt(p² - q²) = du, and C_1D' = slope C_1D / p.
    integrand = -slope * profile / np.exp(log_p)
    return np.asarray(2 * np.trapezoid(integrand, SUBSTITUTED, axis=1))
