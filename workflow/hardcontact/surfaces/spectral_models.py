"""Models of the isotropic power spectral density, in the conventions of `spectrum`."""

import numpy as np
from numpy.typing import NDArray

from hardcontact.surfaces.spectrum import WAVEVECTORS

Floats = NDArray[np.float64]


def self_affine(wavevector: Floats, plateau: float, rolloff: float, hurst: float) -> Floats:
    """Return C_iso: `plateau` (nm⁴) above the roll-off wavelength (nm), (q/q_r)^(-2-2H) below."""
    return plateau * np.maximum(wavevector * rolloff / (2 * np.pi), 1.0) ** (-2 - 2 * hurst)


def varying_hurst(
    wavevector: Floats, plateau: float, rolloff: float, hurst: tuple[float, float]
) -> Floats:
    """Return C_iso (nm⁴) whose Hurst exponent changes linearly with the logarithm of wavelength.

    C_iso = C_0 10^(-(2 + 2H) x - H' x²), x = log10(q/q_r), beyond the roll-off (nm) and C_0, the
    plateau, before it: locally a power law of the exponent H + H' x. `hurst` is H and H' a decade.
    """
    first, change = hurst
    decades = np.log10(np.maximum(wavevector * rolloff / (2 * np.pi), 1.0))
    return np.asarray(plateau * 10 ** (-(2 + 2 * first) * decades - change * decades**2))


def continued(above: Floats, hurst: float) -> Floats:
    """Return C_iso ∝ q^(-2-2H) that continues a spectrum where it ends, without a jump.

    Both are in nm⁴ on WAVEVECTORS; it is zero where the spectrum, `above`, is not.
    """
    last = above.nonzero()[0][-1]
    relative = WAVEVECTORS / WAVEVECTORS[last]
    return np.where(relative > 1, above[last] * relative ** (-2 - 2 * hurst), 0.0)


def share_of_cells(shortest: float) -> Floats:
    """Return the share of each cell of WAVEVECTORS that lies above a wavelength (nm).

    The cell that the wavelength lies in counts by the share before it, so that moments of the table
    depend on it continuously.
    """
    cells = np.log(2 * np.pi / (shortest * WAVEVECTORS)) / np.log(WAVEVECTORS[1] / WAVEVECTORS[0])
    return np.asarray(np.clip(cells + 0.5, 0, 1))


def power_law_tail(above: Floats, hurst: float, shortest: float) -> Floats:
    """Return `continued`, up to the wavelength (nm) at which the spectrum ends."""
    return continued(above, hurst) * share_of_cells(shortest)


def smooth_rolloff(wavevector: Floats, plateau: float, rolloff: float, hurst: float) -> Floats:
    """Return C_iso: `plateau` (nm⁴) [1 + (q/q_r)²]^(-1-H), roll-off wavelength in nm."""
    return plateau * (1 + (wavevector * rolloff / (2 * np.pi)) ** 2) ** (-1 - hurst)


def profile_from_isotropic_power_law(wavevector: Floats, hurst: float) -> Floats:
    """Return the ratio C_1D/C_iso in 1/nm of an isotropic C_iso ∝ q^(-2-2H).

    C_1D(q_x) = (1/pi) ∫_0^∞ C_iso(sqrt(q_x² + q_y²)) dq_y, in closed form for a power law.
    """
    from scipy.special import gamma

    ratio = wavevector / (2 * np.sqrt(np.pi)) * gamma(hurst + 0.5) / gamma(hurst + 1)
    return np.asarray(ratio, float)


def profile_points(wavevector: Floats, wavelengths: Floats, profile: Floats) -> Floats:
    """Return C_iso (nm⁴) through measured points of C_1D, converted with one fitted Hurst exponent.

    The points are wavelengths in nm and C_1D in nm³.
    """
    points, level = np.log(2 * np.pi / wavelengths), np.log(profile)
    hurst = (-np.polyfit(points, level, 1)[0] - 1) / 2
    order = np.argsort(points)
    density = np.exp(_extended(np.log(wavevector), points[order], level[order]))
    return density / profile_from_isotropic_power_law(wavevector, hurst)


def _extended(x: Floats, points: Floats, values: Floats) -> Floats:
    """Return the linear interpolation that continues its first and last segment."""
    segment = np.clip(np.searchsorted(points, x) - 1, 0, len(points) - 2)
    slope = np.diff(values)[segment] / np.diff(points)[segment]
    return values[segment] + slope * (x - points[segment])
