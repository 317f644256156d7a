"""Sums over the window below a smooth sphere, for all contacts of an array at once.

The height of a paraboloid is a sum over both axes, y = y_row + y_column (`geometry`), so that
exp(-y/rho) is a product of both. Let G (contact, n) be exp(-y/rho) along one axis for each row of
contacts, and Z (n, n) be exp(z/rho) of the substrate. Then the sums at all contacts are the product

    G Z G^T  (contact_y, contact_x).

It takes some n^2 multiplications for each row of contacts, direct sums n^2 for each contact.
"""

from collections.abc import Iterable, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats
from hardcontact.contact.bearing_area import ContactPixels
from hardcontact.contact.force_sum.touched_pixels import SphereTerms, TouchedPixels, exponential
from hardcontact.contact.geometry import Bodies, ContactGeometry

#: Rows of the substrate in a block: few enough for the cache.
BLOCK_ROWS = 64


def sums_by_subtraction(
    bodies: Bodies, contact_pixels: ContactPixels, ranges: Sequence[float]
) -> Floats:
    """Return the sums (rho, contact_y, contact_x) outside contact.

    They are sums over all pixels of the window, less those over the pixels in contact.
    """
    heights = bodies.substrate.heights
    precision = heights.dtype.type  # `join_bodies` permits single and double precision.
    highest = float(heights.max())
    factors: list[NDArray[np.floating]] = [
        axis_factors(len(heights), bodies.geometry, rho).astype(precision) for rho in ranges
    ]
    distinct_heights, folded_factors = _fold_mirror_images(heights, factors)
    blocks = _row_blocks(distinct_heights, precision, highest, ranges)
    all_sums = _contact_sums(blocks, folded_factors)
    gaps = contact_pixels.reference_gaps
    largest_gap = gaps[..., -1]
    sums = np.empty_like(all_sums)
    for k, rho in enumerate(ranges):
        contact_sum = np.exp((largest_gap[..., None] - gaps) / rho).sum(axis=-1)
        sums[k] = np.exp((largest_gap + highest) / rho) * all_sums[k] - contact_sum
    return sums


def smooth_sphere_terms(
    bodies: Bodies, touched_pixels: TouchedPixels, ranges: Sequence[float]
) -> Iterator[SphereTerms]:
    """Yield the `SphereTerms` of each range.

    Mirror images are not folded, because the touched pixels that are left out are not mirrored.
    """
    factors = [axis_factors(bodies.substrate.pixels, bodies.geometry, rho) for rho in ranges]
    heights = bodies.substrate.heights
    blocks = _row_blocks(heights, np.float64, float(heights.max()), ranges, touched_pixels)
    all_untouched_sums = _contact_sums(blocks, factors)
    for untouched_sums, axis_factor in zip(all_untouched_sums, factors, strict=True):

        def sphere_factor_at(index: tuple[int, int], axis_factor: Floats = axis_factor) -> Floats:
            row_factor = axis_factor[index[0], touched_pixels.row]
            return np.asarray(row_factor * axis_factor[index[1], touched_pixels.column])

        yield SphereTerms(untouched_sums, sphere_factor_at)


def axis_factors(pixels: int, geometry: ContactGeometry, rho: float) -> Floats:
    """Return G = exp(-y/rho) (contact, n) along one axis, summed over the images in the window.

    Images are the pixels that a window wider than the substrate shows again, a period away.
    """
    offset = geometry.offsets()
    decay = np.exp(-geometry.paraboloid(offset) / rho)
    positions = geometry.contact_positions
    return np.array(
        [np.bincount((position + offset) % pixels, decay, pixels) for position in positions]
    )


def _contact_sums(
    blocks: Iterable[tuple[slice, Sequence[NDArray[np.floating]]]],
    factors: Sequence[NDArray[np.floating]],
) -> Floats:
    """Return the products G Z G^T (rho, contact_y, contact_x), added up over blocks of rows.

    `blocks` are rows of Z from `_row_blocks`; `factors` has G for each range (`axis_factors`).
    """
    transposed_factors = [np.ascontiguousarray(axis_factor.T) for axis_factor in factors]
    sums = np.zeros((len(factors), len(factors[0]), len(factors[0])))
    for rows, substrate_factors in blocks:
        for k, substrate_factor in enumerate(substrate_factors):
            sums[k] += factors[k][:, rows] @ (substrate_factor @ transposed_factors[k])
    return sums


def _row_blocks(
    heights: NDArray[np.floating],
    precision: type[np.floating],
    highest: float,
    ranges: Sequence[float],
    touched_pixels: TouchedPixels | None = None,
) -> Iterator[tuple[slice, list[NDArray[np.floating]]]]:
    """Yield blocks of rows, each with their Z = exp((z - highest)/rho) (row, n) for each range.

    Z is zero at touched pixels, if they are given.
    """
    for start in range(0, len(heights), BLOCK_ROWS):
        rows = slice(start, start + BLOCK_ROWS)
        block = heights[rows].astype(precision, copy=False)
        substrate_factors = _exponentials(block, highest, ranges)
        if touched_pixels is not None:
            for substrate_factor in substrate_factors:
                touched_pixels.leave_out(substrate_factor, start)
        yield rows, substrate_factors


def _exponentials(
    heights: NDArray[np.floating], highest: float, ranges: Sequence[float]
) -> list[NDArray[np.floating]]:
    """Return `exponential` at every range; at rho/2 it is faster as a square."""
    by_range: dict[float, NDArray[np.floating]] = {}
    for rho in sorted(ranges, reverse=True):
        root = by_range.get(2 * rho)
        by_range[rho] = exponential(heights, highest, rho) if root is None else root**2
    return [by_range[rho] for rho in ranges]


def _fold_mirror_images(
    heights: NDArray[np.floating], factors: list[NDArray[np.floating]]
) -> tuple[NDArray[np.floating], list[NDArray[np.floating]]]:
    """Return a quarter of mirrored heights and factors summed over images, or both unchanged."""
    if len(heights) % 2 or not _is_mirrored(heights):
        return heights, factors
    scan_pixels = len(heights) // 2
    folded_factors = [
        axis_factor[:, :scan_pixels] + axis_factor[:, scan_pixels:][:, ::-1]
        for axis_factor in factors
    ]
    return heights[:scan_pixels, :scan_pixels], folded_factors


def _is_mirrored(heights: NDArray[np.floating]) -> bool:
    """Return whether heights equal both mirror images."""
    return (
        np.array_equal(heights[0], heights[-1])
        and np.array_equal(heights, heights[::-1])
        and np.array_equal(heights, heights[:, ::-1])
    )
