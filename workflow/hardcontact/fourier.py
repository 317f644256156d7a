"""Fourier interpolation and cutoff filters of periodic surfaces.

Surfaces are square arrays (y, x) in nm. One whose shortest wavelength is known is kept on the
coarsest grid that represents it exactly, and interpolated when pixels are needed.
"""

import numpy as np
from scipy import fft

__all__ = ["filtered", "highpass", "interpolate", "lowpass"]

ROWS = 512  # rows a block, so that no step holds a second full-size array in double precision


def lowpass(heights, pixel_size, cutoff):
    """The part of a surface with wavelengths >= cutoff (nm), on the coarsest grid that holds it.

    Returns heights (m, m) in float64 and their pixel size; m is at most the surface's own size.
    What is left of the surface is its complement: nothing is kept twice.
    """
    pixels = heights.shape[0]
    limit = pixels * pixel_size / cutoff * (1 + 1e-12)
    highest = int(limit)
    if 2 * highest + 2 > pixels:
        raise ValueError(
            f"expected a cutoff of more than two pixels ({2 * pixel_size:.4g} nm), "
            f"found {cutoff:.4g} nm"
        )
    transform = np.empty((pixels, highest + 1), complex)
    for start in range(0, pixels, ROWS):
        rows = slice(start, start + ROWS)
        transform[rows] = fft.rfft(heights[rows].astype(float), axis=1)[:, : highest + 1]
    transform = fft.fft(transform, axis=0, overwrite_x=True)
    coarse = 2 * highest + 2
    order_y = np.fft.fftfreq(coarse, 1 / coarse)
    kept = transform[order_y.astype(int)]  # negative orders index from the end
    kept[np.hypot(order_y[:, None], np.arange(highest + 1)) > limit] = 0
    kept[coarse // 2] = 0
    scale = (coarse / pixels) ** 2
    return fft.irfft2(kept, s=(coarse, coarse)) * scale, pixels * pixel_size / coarse


def interpolate(heights, pixels):
    """The trigonometric interpolation of a periodic surface on pixels x pixels, float32.

    heights: (n, n), n <= pixels. It passes through the original points where they coincide.
    Raises ValueError if the finer grid has fewer pixels than the surface.
    """
    coarse = heights.shape[0]
    if pixels < coarse:
        raise ValueError(f"expected at least {coarse} pixels to interpolate to, found {pixels}")
    transform = fft.rfft2(heights.astype(float))
    padded = np.zeros((pixels, transform.shape[1]), complex)
    half = coarse // 2
    padded[: coarse - half] = transform[: coarse - half]
    padded[-half:] += transform[-half:]
    if coarse % 2 == 0 and pixels > coarse:
        # The highest order stands for both its signs; beyond its own grid it is shared by them.
        padded[-half] /= 2
        padded[half] += padded[-half]
        padded[:, -1] /= 2
    padded = fft.ifft(padded, axis=0, overwrite_x=True)
    fine = np.empty((pixels, pixels), np.float32)
    for start in range(0, pixels, ROWS):
        rows = slice(start, start + ROWS)
        fine[rows] = fft.irfft(padded[rows], n=pixels, axis=1) * (pixels / coarse) ** 2
    return fine


def highpass(heights, pixel_size, cutoff):
    """The part of a surface with wavelengths < cutoff (nm): what `lowpass` leaves, float32."""
    band, _ = lowpass(heights, pixel_size, cutoff)
    return heights - interpolate(band, heights.shape[0])


def filtered(heights, pixel_size, side, cutoff, pixels):
    """A master without the scales beyond a cutoff (nm), on (pixels, pixels), and their size (nm).

    side: "small" removes wavelengths below the cutoff, "large" those above; cutoff: None removes
    nothing. Raises ValueError if pixels are too few for what is left.
    """
    size = heights.shape[0] * pixel_size
    if cutoff is not None and side == "small":
        heights, _ = lowpass(heights, pixel_size, cutoff)
    elif cutoff is not None:
        heights = highpass(heights, pixel_size, cutoff)
    if heights.shape[0] != pixels:
        heights = interpolate(heights, pixels)
    return heights, size / pixels
