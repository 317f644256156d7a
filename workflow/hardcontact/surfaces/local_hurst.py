"""Local Hurst exponents of a surface, fitted to a published spectrum of its profiles.

C_iso is constant above the first of some given wavelengths and a power law between each two of
them, so that it has no jump. It is fitted in C_1D, by its Abel transform: a band adds to the C_1D
of all longer waves, so that exponents read off C_1D band by band would be wrong beside each bend.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hardcontact.surfaces.measured_spectrum import profile_from_isotropic
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum

__all__ = ["LocalHurst", "fitted_local_hurst", "local_power_laws"]

#: Exponents that are fitted: from C_iso constant over a band, to q^-10.
LEAST, MOST = -1.0, 4.0


class LocalHurst(NamedTuple):
    """A spectrum of local power laws, and how far it misses what it was fitted to.

    Attributes
    ----------
    plateau : float
        C_iso above the first wavelength, in nm⁴.
    hurst : numpy.ndarray
        (bands,) local Hurst exponents, from long to short wavelengths.
    misfit : numpy.ndarray
        (points,) ln of the fitted C_1D over the published one.
    """

    plateau: float
    hurst: NDArray[np.float64]
    misfit: NDArray[np.float64]


def local_power_laws(
    plateau: float, hurst: NDArray[np.float64], edges: NDArray[np.float64]
) -> Spectrum:
    """Return C_iso ∝ q^(-2-2H), H another in each band, and constant above the first.

    Parameters
    ----------
    plateau : float
        In nm⁴.
    hurst : numpy.ndarray
        (bands,) H; the last band has no end.
    edges : numpy.ndarray
        (bands,) longest wavelength of each band in nm, descending.

    Returns
    -------
    Spectrum
        On WAVEVECTORS.
    """
    decades = np.log(WAVEVECTORS * edges[:, None] / (2 * np.pi))
    ends = np.log(edges / np.append(edges[1:], 0.1 * edges[-1]))
    ends[-1] = np.inf
    level = -((2 + 2 * hurst)[:, None] * np.clip(decades, 0, ends[:, None])).sum(axis=0)
    return Spectrum(WAVEVECTORS, plateau * np.exp(level))


def fitted_local_hurst(
    wavevector: NDArray[np.float64], profile: NDArray[np.float64], edges: NDArray[np.float64]
) -> LocalHurst:
    """Return the local Hurst exponents of least squares in ln C_1D.

    Parameters
    ----------
    wavevector : numpy.ndarray
        (points,) in rad/nm; more of them than bands.
    profile : numpy.ndarray
        C_1D (points,) in nm³.
    edges : numpy.ndarray
        (bands,) longest wavelength of each band in nm, descending.

    Returns
    -------
    LocalHurst
        Plateau, exponents and misfit.
    """
    from scipy.optimize import least_squares

    def misfit(values: NDArray[np.float64]) -> NDArray[np.float64]:
        spectrum = local_power_laws(np.exp(values[0]), values[1:], edges)
        return np.log(profile_from_isotropic(spectrum, wavevector) / profile)

    # The plateau that a C_iso constant up to the first edge would need.
    start = np.log(np.pi * profile.max() * edges[0] / (2 * np.pi))
    fit = least_squares(
        misfit,
        np.append(start, np.full(len(edges), 0.5)),
        bounds=(
            np.append(-np.inf, np.full(len(edges), LEAST)),
            np.append(np.inf, np.full(len(edges), MOST)),
        ),
    )
    return LocalHurst(float(np.exp(fit.x[0])), fit.x[1:], fit.fun)
