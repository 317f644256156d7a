"""Fourier interpolation and cutoff filters of periodic surfaces.

A surface whose shortest wavelength is known is kept on the coarsest grid that represents it
exactly, and interpolated when pixels are needed. `scipy.fft` is imported where it is used: most
jobs that import this module transform nothing, and the import takes longer than they do.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from hardcontact.surfaces.height_map import HeightMap

__all__ = ["filtered", "filtered_series", "highpass", "interpolate", "lowpass"]

ROWS = 512  # rows a block, so that no step holds a second full-size array in double precision


def lowpass(surface: HeightMap, cutoff: float) -> HeightMap:
    """Return the part of a surface with wavelengths >= cutoff, on the coarsest grid that holds it.

    `highpass` is the complement: the two add up to the surface.

    Parameters
    ----------
    surface : HeightMap
        Periodic and square.
    cutoff : float
        In nm.

    Returns
    -------
    HeightMap
        Heights (m, m) in float64, m at most the surface's own pixels.

    Raises
    ------
    ValueError
        If the cutoff is two pixels or less.
    """
    from scipy import fft

    pixels = surface.pixels
    limit = surface.size / cutoff * (1 + 1e-12)
    highest = int(limit)
    if 2 * highest + 2 > pixels:
        raise ValueError(
            f"expected a cutoff of more than two pixels ({2 * surface.pixel_size:.4g} nm), "
            f"found {cutoff:.4g} nm"
        )
    transform = np.empty((pixels, highest + 1), complex)
    for start in range(0, pixels, ROWS):
        rows = slice(start, start + ROWS)
        block = surface.heights[rows].astype(float)
        transform[rows] = fft.rfft(block, axis=1)[:, : highest + 1]
    transform = fft.fft(transform, axis=0, overwrite_x=True)
    coarse = 2 * highest + 2
    order_y = np.fft.fftfreq(coarse, 1 / coarse)
    band = transform[order_y.astype(int)]  # negative orders index from the end
    band[np.hypot(order_y[:, None], np.arange(highest + 1)) > limit] = 0
    band[coarse // 2] = 0
    heights = fft.irfft2(band, s=(coarse, coarse)) * (coarse / pixels) ** 2
    return replace(surface, heights=heights, pixel_size=surface.size / coarse)


def interpolate(surface: HeightMap, pixels: int) -> HeightMap:
    """Return the trigonometric interpolation of a surface on pixels x pixels.

    It passes through the original points where they coincide.

    Parameters
    ----------
    surface : HeightMap
        Periodic and square.
    pixels : int
        At least the surface's own.

    Returns
    -------
    HeightMap
        Heights (pixels, pixels) in float32.

    Raises
    ------
    ValueError
        If the finer grid has fewer pixels than the surface.
    """
    from scipy import fft

    coarse = surface.pixels
    if pixels < coarse:
        raise ValueError(f"expected at least {coarse} pixels to interpolate to, found {pixels}")
    transform = fft.rfft2(surface.heights.astype(float))
    padded = np.zeros((pixels, transform.shape[1]), complex)
    half = coarse // 2
    padded[: coarse - half] = transform[: coarse - half]
    padded[-half:] += transform[-half:]
    if coarse % 2 == 0 and pixels > coarse:
        # On its own grid the Nyquist order stands for both signs; on a finer one they share it.
        padded[-half] /= 2
        padded[half] += padded[-half]
        padded[:, -1] /= 2
    padded = fft.ifft(padded, axis=0, overwrite_x=True)
    fine = np.empty((pixels, pixels), np.float32)
    for start in range(0, pixels, ROWS):
        rows = slice(start, start + ROWS)
        fine[rows] = fft.irfft(padded[rows], n=pixels, axis=1) * (pixels / coarse) ** 2
    return replace(surface, heights=fine, pixel_size=surface.size / pixels)


def highpass(surface: HeightMap, cutoff: float) -> HeightMap:
    """Return the part of a surface with wavelengths < cutoff (nm): what `lowpass` leaves."""
    band = interpolate(lowpass(surface, cutoff), surface.pixels)
    return replace(surface, heights=surface.heights - band.heights)


def filtered(master: HeightMap, side: str, cutoff: float | None, pixels: int) -> HeightMap:
    """Return a master without the scales beyond a cutoff.

    Parameters
    ----------
    master : HeightMap
        Periodic and square.
    side : str
        ``"small"`` removes wavelengths below the cutoff, ``"large"`` those above.
    cutoff : float or None
        In nm; None removes nothing.
    pixels : int
        Along an edge of the result.

    Returns
    -------
    HeightMap
        Heights (pixels, pixels) in nm.

    Raises
    ------
    ValueError
        If the remaining wavelengths need more pixels.
    """
    size = master.size
    if cutoff is not None and side == "small":
        master = lowpass(master, cutoff)
    elif cutoff is not None:
        master = highpass(master, cutoff)
    if master.pixels != pixels:
        master = interpolate(master, pixels)
    return replace(master, pixel_size=size / pixels)


def filtered_series(
    master: HeightMap, side: str, cutoffs: Sequence[float | None], pixels: int
) -> Iterator[HeightMap]:
    """Yield a master without the scales beyond each cutoff in turn.

    Parameters
    ----------
    master : HeightMap
        Periodic and square.
    side : str
        ``"small"`` removes wavelengths below the cutoffs, ``"large"`` those above.
    cutoffs : sequence of float or None
        In nm; None removes nothing.
    pixels : int
        Along an edge of the results.

    Yields
    ------
    HeightMap
        As of `filtered`.
    """
    for cutoff in cutoffs:
        yield filtered(master, side, cutoff, pixels)
