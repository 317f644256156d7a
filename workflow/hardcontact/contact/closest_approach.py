"""Rigid closest approach of a smooth sphere at every position, by a dilation with its paraboloid.

The smallest gap min(s - h) at a position is the highest point of h - s. The paraboloid s is a sum
over both axes, so that each row is searched first, and then each column of what that found. Along
an axis the pixel that touches moves on with the sphere, because s is convex: the search at one
position ends at the pixels that touch at the positions before and after it. All positions of a row
of n pixels cost n log n steps, whatever the window, and no pixel of the window is left out.
"""

import numpy as np
from numpy.typing import NDArray

from hardcontact.contact.geometry import ContactGeometry

Floats = NDArray[np.float64]
Pixels = NDArray[np.int_]

ROWS = 32  # in a block: small enough for the cache


def closest_gaps(heights: NDArray[np.floating], geometry: ContactGeometry) -> Floats:
    """Return the smallest gap (nm) of every contact at zero approach: the first of `lowest_gaps`.

    The heights (n, n) of the substrate are in nm, periodic; the sphere is smooth, its positions
    (contact,) ascend. The gap (contact, contact) is minus the separation of rigid closest approach.
    """
    rows, columns = touching_pixels(heights, geometry)
    offset_y, offset_x = rows - geometry.positions[:, None], columns - geometry.positions
    sphere = geometry.paraboloid(offset_y) + geometry.paraboloid(offset_x)
    return np.asarray(sphere - heights[rows % len(heights), columns % len(heights)])


def touching_pixels(
    heights: NDArray[np.floating], geometry: ContactGeometry
) -> tuple[Pixels, Pixels]:
    """Return the pixel with the smallest gap of every contact, for arguments as in `closest_gaps`.

    The row and the column, each (contact, contact), are unfolded indices.
    """
    column = _touched_along_rows(heights, geometry)
    sphere = geometry.paraboloid(column - geometry.positions)
    place = np.arange(len(heights))[:, None]
    dilated = np.asarray(heights[place, column % len(heights)] - sphere)
    row = _touched_along_rows(np.ascontiguousarray(dilated.T), geometry).T
    return row, np.take_along_axis(column, row % len(heights), axis=0)


def _touched_along_rows(heights: NDArray[np.floating], geometry: ContactGeometry) -> Pixels:
    """Return the unfolded column (row, contact) of the highest point of h - s along each row."""
    blocks = [heights[start : start + ROWS] for start in range(0, len(heights), ROWS)]
    return np.concatenate([_touched_in_block(block, geometry) for block in blocks])


def _touched_in_block(heights: NDArray[np.floating], geometry: ContactGeometry) -> Pixels:
    """Return the same of a few rows: first of every 2^k-th position, then of those between."""
    positions, half, pixels = geometry.positions, geometry.window // 2, heights.shape[1]
    # Of the periodic images of a pixel only the nearest one can touch.
    first, last = -min(half, pixels // 2), min(half - 1, (pixels - 1) // 2)
    count = len(positions)
    touched = np.empty((len(heights), count), dtype=int)
    stride = 1 << count.bit_length()
    while stride > 1:
        at = np.arange(stride // 2, count + 1, stride) - 1  # the positions -1 and `count` are done
        before, after = at - stride // 2, at + stride // 2
        low = np.broadcast_to(positions[at] + first, (len(heights), len(at))).copy()
        high = np.broadcast_to(positions[at] + last, low.shape).copy()
        has, ends = before >= 0, after < count
        low[:, has] = np.maximum(low[:, has], touched[:, before[has]])
        high[:, ends] = np.minimum(high[:, ends], touched[:, after[ends]])
        touched[:, at] = _highest(heights, geometry, positions[at], low, high)
        stride //= 2
    return touched


def _highest(
    heights: NDArray[np.floating],
    geometry: ContactGeometry,
    positions: Pixels,
    low: Pixels,
    high: Pixels,
) -> Pixels:
    """Return the unfolded column of the highest h - s from `low` to `high`, the first of equals.

    heights: (row, n); positions: (k,); low, high: (row, k). Returns (row, k).
    """
    lengths = (high - low + 1).ravel()
    ends = np.cumsum(lengths)
    starts = ends - lengths
    place = np.arange(ends[-1])
    column = place + np.repeat(low.ravel() - starts, lengths)
    offset = column - np.repeat(np.tile(positions, len(low)), lengths)
    pixels = heights.shape[1]
    rows = np.repeat(np.arange(len(heights)) * pixels, lengths.reshape(low.shape).sum(axis=1))
    above = heights.ravel().take(rows + column % pixels) - geometry.paraboloid(offset)
    highest = np.repeat(np.maximum.reduceat(above, starts), lengths)
    equal = np.flatnonzero(above == highest)
    return np.asarray(column[equal[np.searchsorted(equal, starts)]].reshape(low.shape))
