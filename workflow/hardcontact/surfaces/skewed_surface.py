"""Random surfaces of given spectrum and skewness whose tops are blunt, as those of clusters are.

A skewed distribution and a spectrum leave open how sharp the highest summits are, and these carry
the contacts. Remapping heights by rank sharpens them; real clusters are rounded. `scipy` is
imported where it is used.
"""

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hardcontact.surfaces.height_map import HeightMap

__all__ = ["skewed_surface"]

Floats = NDArray[np.float64]

#: Radius of the paraboloid that tops are rounded with, times the rms half-Laplacian. A fit to one
#: AFM scan of UNCD (10 µm, 19.5 nm pixels), whose forces and summits it reproduces.
BLUNTNESS = 0.9

#: How often tops are rounded, heights remapped and amplitudes restored: a part of the same fit.
ROUNDS = 10

#: Depth of the paraboloid over the rms height: a deeper one changes forces by some 2 %.
DEPTH = 2.0


def skewed_surface(surface: HeightMap, skewness: float) -> HeightMap:
    """Return a surface with the same spectrum, heights of given skewness and blunt tops.

    In turn tops are rounded by an opening with a paraboloid, heights are remapped by rank to a
    Pearson III distribution, and the Fourier amplitudes restored. Without the first step this is
    the amplitude-adjusted surrogate of Schreiber and Schmitz, Phys. Rev. Lett. 77 (1996) 635. The
    skewness that is aimed at is corrected each time by what was missed. Tops are blunt whatever
    the skewness, at zero too.

    Parameters
    ----------
    surface : HeightMap
        Periodic and square, not flat.
    skewness : float
        Of the heights of the whole surface, -1 to 1; that of levelled parts is a little smaller.

    Returns
    -------
    HeightMap
        Heights in float64; the spectrum is exact, the skewness is met to some 5 %.
    """
    from scipy import fft
    from scipy.stats import skew

    heights: Floats = surface.heights.astype(float)
    amplitude, deviation = np.abs(fft.rfft2(heights)), heights.std()
    radius = BLUNTNESS / _rms_half_laplacian(heights, surface.pixel_size)
    reach = min(np.sqrt(2 * radius * DEPTH * deviation), surface.size / 2)
    pixels = int(reach / surface.pixel_size)
    place = np.arange(-pixels, pixels + 1) * surface.pixel_size
    parabola = -np.square(place, dtype=float) / (2 * radius)
    aimed = skewness
    for _ in range(ROUNDS):
        remapped = _remapped(_opened(heights, parabola), aimed, deviation)
        transform = fft.rfft2(remapped)
        size = np.abs(transform)
        transform *= np.divide(amplitude, size, out=np.zeros_like(size), where=size > 0)
        heights = fft.irfft2(transform, s=heights.shape)
        aimed += skewness - skew(heights, axis=None)
    return replace(surface, heights=heights)


def _rms_half_laplacian(heights: Floats, pixel_size: float) -> float:
    """Return half the rms Laplacian (1/nm) of periodic heights (nm), by finite differences."""
    neighbours = sum(np.roll(heights, step, axis) for step in (-1, 1) for axis in (0, 1))
    return float(np.sqrt(((neighbours - 4 * heights) ** 2).mean()) / (2 * pixel_size**2))


def _opened(heights: Floats, parabola: Floats) -> Floats:
    """Return periodic heights without what a paraboloid that slides below does not reach.

    The paraboloid is the sum of the parabola along both axes, so that each may be taken in turn.
    """
    from scipy.ndimage import grey_dilation, grey_erosion

    opened: Floats = heights
    axes: tuple[Any, Any] = parabola[None], parabola[:, None]
    for change in (grey_erosion, grey_dilation):
        for along in axes:
            opened = change(opened, structure=along, mode="wrap")
    return opened


def _remapped(heights: Floats, skewness: float, deviation: float) -> Floats:
    """Return heights in the same order with a Pearson III distribution of mean zero."""
    from scipy.stats import pearson3

    probability = np.linspace(0, 1, 4097)[1:-1]
    rank = (np.arange(heights.size) + 0.5) / heights.size
    quantiles = np.interp(rank, probability, pearson3.ppf(probability, skewness))
    remapped = np.empty(heights.size)
    remapped[np.argsort(heights, axis=None)] = deviation * quantiles
    return remapped.reshape(heights.shape)
