"""Smooth gains of a spectrum: three bands of wavelengths, and amplitudes multiplied."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from hardcontact.surfaces.spectrum import WAVEVECTORS, Density, spectrum_from
from hardcontact.surfaces.substitute_scans import ScanGrid

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["BANDS", "amplified", "band_shares", "conditioned_density"]

#: Bands whose amplitudes are free.
BANDS = 3


def band_shares(grid: ScanGrid) -> NDArray[np.float64]:
    """Return the shares of amplitude of three smooth bands: (3, points of WAVEVECTORS).

    They add up to one everywhere and go over into each other between the size of a scan, its
    geometric mean with two pixels, and two pixels, as sin² in the logarithm of the wavelength.
    """
    longest, shortest = grid.size, 2 * grid.pixel_size
    place = np.log(longest * WAVEVECTORS / (2 * np.pi)) / np.log(longest / shortest)
    first, second = (
        np.sin(np.pi / 2 * np.clip(2 * place - step, 0, 1)) ** 2 for step in range(BANDS - 1)
    )
    return np.array([1 - first, first - second, second])


def amplified(density: Density, gain: NDArray[np.float64]) -> Density:
    """Return a spectrum whose amplitudes are multiplied by a gain on WAVEVECTORS.

    The gain is interpolated linearly in the logarithm of the wavevector, so that gains of several
    bands add up between the points of the table too.
    """
    table = np.log(WAVEVECTORS)

    def amplified_density(wavevector: NDArray[np.float64]) -> NDArray[np.float64]:
        with np.errstate(divide="ignore"):
            gains = np.interp(np.log(wavevector), table, gain)
        return density(wavevector) * gains**2

    return amplified_density


def conditioned_density(spectrum: "xr.Dataset", conditioning: "xr.Dataset") -> Density:
    """Return the spectrum that scans of a group are drawn with, from the two files."""
    return amplified(spectrum_from(spectrum), conditioning["gain"].values)
