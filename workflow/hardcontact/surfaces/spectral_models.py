"""Models of C_iso (nm⁴) over wavevectors q (rad/nm), for segments of a description.

The roll-off is a wavelength; q_r is its wavevector.
"""

from collections.abc import Callable

import numpy as np
import scipy

from hardcontact.base.arrays import Floats
from hardcontact.surfaces.spectrum import WAVEVECTORS


def self_affine(wavevector: Floats, plateau: float, rolloff: float, hurst: float) -> Floats:
    """Return C_iso: the plateau (nm⁴) at wavelengths above the roll-off (nm), then ∝ q^(-2-2H)."""
    return plateau * np.maximum(wavevector * rolloff / (2 * np.pi), 1.0) ** (-2 - 2 * hurst)


def varying_hurst(
    wavevector: Floats, plateau: float, rolloff: float, hurst: float, hurst_change: float
) -> Floats:
    """Return C_iso whose Hurst exponent changes by `hurst_change`, H', per decade of wavevector.

    C_iso is C_0, the plateau (nm⁴), at wavelengths above the roll-off (nm). At shorter ones it is
    C_0 10^(-(2 + 2H) x - H' x²) with x = log10(q/q_r).
    """
    decades = np.log10(np.maximum(wavevector * rolloff / (2 * np.pi), 1.0))
    return np.asarray(plateau * 10 ** (-(2 + 2 * hurst) * decades - hurst_change * decades**2))


def smooth_rolloff(wavevector: Floats, plateau: float, rolloff: float, hurst: float) -> Floats:
    """Return C_iso: the plateau (nm⁴) times [1 + (q/q_r)²]^(-1-H), with the roll-off in nm."""
    return plateau * (1 + (wavevector * rolloff / (2 * np.pi)) ** 2) ** (-1 - hurst)


#: Models that are formulas, by their names in descriptions (`resources/README.md`), with their
#: parameter columns. The models `power law` and `profile` are functions below.
SPECTRAL_MODELS: dict[str, tuple[Callable[..., Floats], tuple[str, ...]]] = {
    "self-affine": (self_affine, ("plateau_nm4", "rolloff_nm", "hurst")),
    "varying Hurst": (varying_hurst, ("plateau_nm4", "rolloff_nm", "hurst", "hurst_change")),
    "smooth roll-off": (smooth_rolloff, ("plateau_nm4", "rolloff_nm", "hurst")),
}


def power_law_extrapolation(density: Floats, hurst: float) -> Floats:
    """Return C_iso ∝ q^(-2-2H) at wavelengths shorter than all of `density`, zero elsewhere."""
    if not density.any():
        raise ValueError("power law: expected a segment at longer wavelengths, found none")
    last_index = density.nonzero()[0][-1]
    ratio = WAVEVECTORS / WAVEVECTORS[last_index]
    return np.where(ratio > 1, density[last_index] * ratio ** (-2 - 2 * hurst), 0.0)


def shares_of_longer_waves(shortest: float) -> Floats:
    """Return which share (points,) of the waves at each of WAVEVECTORS is longer than `shortest`.

    Each of WAVEVECTORS stands for a bin of waves around it, and all bins are equally wide in ln q.
    The share is between 0 and 1 only in the bin that contains the wavelength `shortest` (nm).
    """
    step = np.log(WAVEVECTORS[1] / WAVEVECTORS[0])
    distance_in_steps = np.log(2 * np.pi / (shortest * WAVEVECTORS)) / step
    return np.asarray(np.clip(distance_in_steps + 0.5, 0, 1))


def power_law_tail(density: Floats, hurst: float, shortest: float) -> Floats:
    """Return the `power_law_extrapolation` down to a shortest wavelength (nm)."""
    return power_law_extrapolation(density, hurst) * shares_of_longer_waves(shortest)


def profile_over_isotropic(wavevector: Floats, hurst: float) -> Floats:
    """Return the ratio C_1D/C_iso in 1/nm of an isotropic C_iso ∝ q^(-2-2H).

    C_1D(q_x) = (1/pi) ∫_0^∞ C_iso(sqrt(q_x² + q_y²)) dq_y.
    """
    numerator, denominator = scipy.special.gamma([hurst + 0.5, hurst + 1])
    return np.asarray(wavevector / (2 * np.sqrt(np.pi)) * numerator / denominator)


def isotropic_through_points(wavevector: Floats, wavelengths: Floats, profile: Floats) -> Floats:
    """Return C_iso (nm⁴) through points of C_1D (nm³) at wavelengths (nm).

    C_1D follows a power law between neighbouring points. One Hurst exponent, fitted to all points,
    converts it to C_iso by `profile_over_isotropic`.
    """
    log_points = np.log(2 * np.pi / wavelengths)
    log_profile = np.log(profile)
    hurst = (-np.polyfit(log_points, log_profile, 1)[0] - 1) / 2
    sorting = np.argsort(log_points)
    log_points, log_profile = log_points[sorting], log_profile[sorting]
    log_wavevector = np.log(wavevector)
    # The first and the last interval are extrapolated beyond the points.
    interval = np.clip(np.searchsorted(log_points, log_wavevector) - 1, 0, len(log_points) - 2)
    slope = np.diff(log_profile)[interval] / np.diff(log_points)[interval]
    log_distance = log_wavevector - log_points[interval]
    interpolated_profile: Floats = np.exp(log_profile[interval] + slope * log_distance)
    return interpolated_profile / profile_over_isotropic(wavevector, hurst)
