"""Fourier interpolation and cutoff filters of periodic, square surfaces.

The order of a Fourier mode is its number of waves across the surface.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
import scipy
from numpy.typing import NDArray

from hardcontact.surfaces.height_map import HeightMap

#: Fourier transform over orders (y, x).
Transform = NDArray[np.complexfloating]

#: Rows transformed at a time, to save memory and to fit the cache.
BLOCK_ROWS = 64


def lowpass(height_map: HeightMap, cutoff: float) -> HeightMap:
    """Return a surface without waves below a cutoff (nm), on the coarsest grid for the others."""
    order_limit = _order_limit(height_map, cutoff)
    highest_order = int(order_limit)
    pixels = 2 * highest_order + 2
    transform = _transform_lowest_orders(height_map, highest_order)
    heights = scipy.fft.irfft2(_orders_on_grid(transform, order_limit, pixels), s=(pixels, pixels))
    heights *= (pixels / height_map.pixels) ** 2
    return replace(height_map, heights=heights, pixel_size=height_map.size / pixels)


def _order_limit(height_map: HeightMap, cutoff: float) -> float:
    """Return the highest order of waves at least as long as a cutoff (nm), not rounded."""
    # The margin keeps a wave at the cutoff in spite of rounding.
    order_limit = height_map.size / cutoff * (1 + 1e-12)
    if 2 * int(order_limit) + 2 > height_map.pixels:
        raise ValueError(
            f"cutoff: expected more than two pixels ({2 * height_map.pixel_size:.4g} nm), found "
            f"{cutoff:.4g} nm"
        )
    return order_limit


def _transform_lowest_orders(height_map: HeightMap, highest_order: int) -> Transform:
    """Return the transform up to an order: (order y, order x), along y in `_signed_orders`."""
    pixels = height_map.pixels
    transform = np.empty((pixels, highest_order + 1), complex)
    for start in range(0, pixels, BLOCK_ROWS):
        rows = slice(start, start + BLOCK_ROWS)
        block = height_map.heights[rows].astype(float)
        transform[rows] = scipy.fft.rfft(block, axis=1)[:, : highest_order + 1]
    transform = scipy.fft.fft(transform, axis=0, overwrite_x=True)
    return transform[_signed_orders(highest_order)]


def _signed_orders(highest_order: int) -> NDArray[np.int_]:
    """Return the orders along y in the sequence of a transform: 0, 1, ..., -2, -1."""
    return np.append(np.arange(highest_order + 1), np.arange(-highest_order, 0))


def _orders_on_grid(transform: Transform, order_limit: float, pixels: int) -> Transform:
    """Return the orders of a transform up to a limit, on a grid (pixels, order x)."""
    highest_order = int(order_limit)
    orders = _signed_orders(highest_order)
    low_orders = transform[orders, : highest_order + 1]
    low_orders[np.hypot(orders[:, None], np.arange(highest_order + 1)) > order_limit] = 0
    padded = np.zeros((pixels, highest_order + 1), transform.dtype)
    padded[orders] = low_orders
    return padded


def interpolate(height_map: HeightMap, pixels: int) -> HeightMap:
    """Return a surface on at least as many pixels by trigonometric interpolation, in float32."""
    coarse_pixels = height_map.pixels
    _refuse_coarser(coarse_pixels, pixels)
    transform = scipy.fft.rfft2(height_map.heights.astype(float))
    padded = np.zeros((pixels, transform.shape[1]), complex)
    highest_order = coarse_pixels // 2
    padded[: coarse_pixels - highest_order] = transform[: coarse_pixels - highest_order]
    padded[-highest_order:] = transform[-highest_order:]
    if coarse_pixels % 2 == 0 and pixels > coarse_pixels:
        # The coarse grid holds both signs of its highest order in one entry, the fine grid in two.
        padded[-highest_order] /= 2
        padded[highest_order] += padded[-highest_order]
        padded[:, -1] /= 2
    fine_heights = np.empty((pixels, pixels), np.float32)
    for rows, heights in _inverse_blocks(padded):
        fine_heights[rows] = heights * (pixels / coarse_pixels) ** 2
    return replace(height_map, heights=fine_heights, pixel_size=height_map.size / pixels)


def _refuse_coarser(min_pixels: int, pixels: int) -> None:
    """Raise ValueError for fewer pixels per row than a surface or its waves need."""
    if pixels < min_pixels:
        raise ValueError(
            f"pixels: expected at least {min_pixels} pixels to interpolate to, found {pixels}"
        )


def _inverse_blocks(padded: Transform) -> Iterator[tuple[slice, NDArray[np.floating]]]:
    """Yield rows and their heights from a transform (pixels, order x), which is overwritten."""
    pixels = len(padded)
    padded = scipy.fft.ifft(padded, axis=0, overwrite_x=True)
    for start in range(0, pixels, BLOCK_ROWS):
        rows = slice(start, start + BLOCK_ROWS)
        yield rows, scipy.fft.irfft(padded[rows], n=pixels, axis=1)


def filtered_series(
    height_map: HeightMap,
    side: str,
    cutoffs: Sequence[float | None],
    pixels: int,
    out: NDArray[np.float32] | None = None,
) -> Iterator[HeightMap]:
    """Yield a surface without the wavelengths beyond each cutoff (nm); None removes none.

    The side ``"short"`` removes shorter wavelengths, ``"long"`` longer ones. Each filtered surface
    overwrites `out` (pixels, pixels), if given. Raises ValueError if the pixels are too few.
    """
    order_limits = [
        None if cutoff is None else _order_limit(height_map, cutoff) for cutoff in cutoffs
    ]
    highest_order = max((int(limit) for limit in order_limits if limit is not None), default=0)
    unfiltered = height_map
    if side == "short" and None not in cutoffs:  # Nothing needs the unfiltered surface.
        _refuse_coarser(2 * highest_order + 2, pixels)
    elif pixels != height_map.pixels:
        unfiltered = interpolate(height_map, pixels)
    unfiltered = replace(unfiltered, pixel_size=height_map.size / pixels)
    scale = (pixels / height_map.pixels) ** 2
    transform = (_transform_lowest_orders(height_map, highest_order) * scale).astype(np.complex64)
    for limit in order_limits:
        if limit is None:
            yield unfiltered
            continue
        heights = np.empty((pixels, pixels), np.float32) if out is None else out
        for rows, long_waves in _inverse_blocks(_orders_on_grid(transform, limit, pixels)):
            heights[rows] = long_waves
            if side == "long":
                np.subtract(unfiltered.heights[rows], heights[rows], out=heights[rows])
        yield replace(unfiltered, heights=heights)
