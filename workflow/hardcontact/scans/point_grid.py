"""Complete the grid on or near which points x, y, height lie.

Points that are missing become undefined pixels; heights beside the grid are interpolated on it.
"""

from itertools import product

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from hardcontact.base.arrays import Floats
from hardcontact.scans.heights import MAX_UNDEFINED_SHARE, PIXEL_BOUNDS, POSITION_ROUNDING

#: Bins of positions along an axis.
POSITION_BINS = 2**16
#: Zeros pad the histogram of positions to this multiple of its length before its Fourier transform.
#: Peaks are then known to a sixteenth of a line.
ZERO_PADDING = 8
#: Corrections of heights on a grid. Each leaves at most a quarter of the error, if points lie a
#: tenth of a spacing beside the grid.
SPLINE_ITERATIONS = 10


def grid_points(points: Floats) -> tuple[list[str], list[str]]:
    """Return texts "x y height" of all points of a grid, with nan for missing points, and notes.

    Return no texts if points (n, 3) need none, fill less than half of a grid, or share a pixel.
    """
    axes = [_grid_axis(positions) for positions in points[:, :2].T]
    if not all(len(axis) for axis in axes):
        return [], []
    steps = [np.ptp(axis) / (len(axis) - 1) for axis in axes]
    corner = [axis[0] for axis in axes]
    positions_in_steps = (points[:, :2] - corner) / steps
    indices = np.rint(positions_in_steps).astype(np.intp)
    shape = (len(axes[0]), len(axes[1]))
    pixel_indices = np.ravel_multi_index(indices.T, shape)
    size = shape[0] * shape[1]
    shares_pixels = len(np.unique(pixel_indices)) < len(pixel_indices)
    if shares_pixels or len(pixel_indices) < (1 - MAX_UNDEFINED_SHARE) * size:
        return [], []
    offsets = positions_in_steps - indices
    distance = float(np.abs(offsets).max())
    is_beside = distance > POSITION_ROUNDING
    if len(pixel_indices) == size and not is_beside:
        return [], []
    heights = np.full(size, np.nan)
    heights[pixel_indices] = points[:, 2]
    notes = []
    if is_beside:
        heights = _heights_on_grid(heights.reshape(shape), indices, offsets).ravel()
        notes = [f"points up to {distance:.2g} spacings beside a grid interpolated on it"]
    positions = product(*(axis.tolist() for axis in axes))
    rows = zip(positions, heights.tolist(), strict=True)
    return [f"{x:.17g} {y:.17g} {height:.17g}" for (x, y), height in rows], notes


def _heights_on_grid(heights: Floats, indices: NDArray[np.intp], offsets: Floats) -> Floats:
    """Return heights (x, y) on a grid whose cubic spline passes through points beside it.

    The points have indices and offsets (n, 2) in spacings.
    """
    is_missing = np.isnan(heights)
    nearest = ndimage.distance_transform_edt(
        is_missing, return_distances=False, return_indices=True
    )
    known_heights = heights[tuple(nearest)]
    positions = np.indices(heights.shape, dtype=float)
    positions[:, indices[:, 0], indices[:, 1]] += offsets.T
    grid_heights = known_heights
    for _ in range(SPLINE_ITERATIONS):
        spline = ndimage.map_coordinates(grid_heights, positions, order=3, mode="nearest")
        grid_heights = grid_heights + known_heights - spline
    return np.where(is_missing, np.nan, grid_heights)


def _grid_axis(positions: Floats) -> Floats:
    """Return evenly spaced positions (k,) of a grid near positions; none if these are all equal."""
    extent = float(np.ptp(positions))
    if not 0 < extent < np.inf:
        return np.empty(0)
    steps = np.diff(np.unique(positions))
    spacing = np.median(steps[steps > POSITION_ROUNDING * steps.max()])
    if extent <= spacing * PIXEL_BOUNDS[1]:
        axis = np.linspace(positions.min(), positions.max(), round(extent / spacing) + 1)
        nearest = np.rint((positions - axis[0]) / extent * (len(axis) - 1)).astype(np.intp)
        if (np.abs(axis[nearest] - positions) <= POSITION_ROUNDING * spacing).all():
            return axis
    return _crowded_axis(positions, extent)


def _crowded_axis(positions: Floats, extent: float) -> Floats:
    """Return the evenly spaced positions (k,) near which positions (n,) crowd most."""
    counts, edges = np.histogram(positions, POSITION_BINS)
    crowding = np.fft.rfft(counts, ZERO_PADDING * POSITION_BINS)
    minimum, maximum = (ZERO_PADDING * (count - 1) for count in PIXEL_BOUNDS)
    peak = minimum + int(np.abs(crowding[minimum : maximum + 1]).argmax())
    spacing = ZERO_PADDING * extent / peak
    # The phase of the peak gives the offset of the lines from the centre of the first bin.
    offset = 0.5 / POSITION_BINS * extent - np.angle(crowding[peak]) / (2 * np.pi) * spacing
    first_step = round((positions.min() - edges[0] - offset) / spacing)
    last_step = round((positions.max() - edges[0] - offset) / spacing)
    return np.asarray(edges[0] + offset + spacing * np.arange(first_step, last_step + 1))
