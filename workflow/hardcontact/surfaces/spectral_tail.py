"""A measured spectrum continued beyond its band, within bounds on slope and curvature."""

import numpy as np
from numpy.typing import NDArray

from hardcontact.surfaces.measured_spectrum import local_slopes
from hardcontact.surfaces.reliable_band import digits
from hardcontact.surfaces.spectral_models import power_law_tail
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum

__all__ = ["continued_spectrum"]

#: The shortest wave of a row of atoms in nm: two bonds of diamond, 0.154 nm each.
ATOMIC = 0.3
#: The largest rms gradient, and half-Laplacian in 1/nm, over all scales: those of UNCD, the
#: roughest hard surface of Table 1 of the paper, with their uncertainties (1.17 + 0.28, 6.32 +
#: 1.20). A sphere of such a curvature has the radius of an atom.
GRADIENT, HALF_LAPLACIAN = 1.45, 7.52
#: H is fitted to C_iso flatter than q^-2 nowhere: this is the plateau or its roll-off.
FLATTEST = -2.0
#: Bins that a Hurst exponent, and the level of the tail, are fitted to at least.
FEWEST = 3


def continued_spectrum(
    wavevector: NDArray[np.float64], density: NDArray[np.float64], variance: NDArray[np.float64]
) -> tuple[NDArray[np.float64], str]:
    """Return C_iso over all scales from measured points, and how it was continued.

    Above the longest wavelength measured it is constant. Below the shortest it is self-affine with
    the Hurst exponent of the last decade past the roll-off, held within 0 to 1. The tail ends at
    the distance of atoms, or where the rms gradient or half-Laplacian of all scales would pass
    that of the roughest hard surface known: there is none if the measured part alone does.

    Parameters
    ----------
    wavevector, density : numpy.ndarray
        (points,) in rad/nm and nm⁴, at least three, without gaps.
    variance : numpy.ndarray
        (points,) of ln C.

    Returns
    -------
    spectrum : numpy.ndarray
        C_iso in nm⁴ on WAVEVECTORS.
    note : str
        What the tail is, in words.
    """
    # A point of the table at the last wavevector may lie beyond it by rounding.
    table = Spectrum(wavevector, density)(np.minimum(WAVEVECTORS, wavevector[-1]))
    measured = np.where(wavevector[-1] * (1 + 1e-9) >= WAVEVECTORS, table, 0.0)
    hurst, count = _hurst(wavevector, density, variance)
    level = _level(wavevector, density, hurst)
    last = measured.nonzero()[0][-1]
    start = measured.copy()
    start[last] = level * (WAVEVECTORS[last] / wavevector[-1]) ** (-2 - 2 * hurst)
    tail = power_law_tail(start, hurst, ATOMIC)
    ends, reason = _bounded(measured + tail)
    spectrum = np.where(np.arange(len(WAVEVECTORS)) <= max(ends, last), measured + tail, 0.0)
    if ends <= last:
        return spectrum, f"no roughness was added below the wavelengths measured: {reason}"
    short, long = 2 * np.pi / wavevector[[-1, -count]]
    return spectrum, (
        f"below the wavelengths measured, artificial: self-affine with H = {hurst:.2f}, fitted "
        f"from {digits(short)} to {digits(long)} nm and held within 0 to 1, "
        f"ending at {2 * np.pi / WAVEVECTORS[ends]:.2g} nm: {reason}"
    )


def _hurst(
    wavevector: NDArray[np.float64], density: NDArray[np.float64], variance: NDArray[np.float64]
) -> tuple[float, int]:
    """Return the Hurst exponent of the last decade past the roll-off, and its number of points."""
    slopes, error = local_slopes(wavevector, density, variance)
    fitted = wavevector >= wavevector[-1] / 10 * (1 - 1e-9)
    flat = np.flatnonzero(slopes - error > FLATTEST)
    if flat.size:
        fitted[: flat[-1] + 1] = False
    fitted[-FEWEST:] = True
    weight = 1 / np.sqrt(variance[fitted])
    slope = np.polyfit(np.log(wavevector[fitted]), np.log(density[fitted]), 1, w=weight)[0]
    return float(np.clip(-slope / 2 - 1, 0, 1)), int(fitted.sum())


def _level(wavevector: NDArray[np.float64], density: NDArray[np.float64], hurst: float) -> float:
    """Return C_iso in nm⁴ with which the tail begins: the log-mean of the last points along it."""
    relative = wavevector[-FEWEST:] / wavevector[-1]
    return float(np.exp(np.mean(np.log(density[-FEWEST:] * relative ** (2 + 2 * hurst)))))


def _bounded(density: NDArray[np.float64]) -> tuple[int, str]:
    """Return the last index of WAVEVECTORS within the bounds, and what ends the spectrum there."""
    gradient, half_laplacian = (
        np.sqrt(_sums(density * WAVEVECTORS**power / divisor / (2 * np.pi)))
        for power, divisor in ((4, 1), (6, 4))
    )
    ends = {
        f"the rms gradient of all scales reaches {GRADIENT}": gradient > GRADIENT,
        f"the rms curvature of all scales reaches {HALF_LAPLACIAN} per nm": (
            half_laplacian > HALF_LAPLACIAN
        ),
        "atoms are no closer": density == 0,
    }
    first = {
        reason: int(np.argmax(np.append(beyond, True)))  # where no wave is beyond: after the last
        for reason, beyond in ends.items()
    }
    reason = min(first, key=first.__getitem__)
    return first[reason] - 1, reason


def _sums(integrand: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the integral over ln q up to each point of WAVEVECTORS, by trapezoids."""
    steps = (integrand[1:] + integrand[:-1]) / 2 * np.diff(np.log(WAVEVECTORS))
    return np.append(0.0, np.cumsum(steps))
