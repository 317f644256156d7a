"""Levelling: planes, bows and spheres are subtracted from scans, streaks filled, lines aligned.

A streak is a piece of one to three scan lines along which the tip loses the surface, or carries a
particle. Its neighbours are the lines before and after it.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
import scipy
import xarray as xr
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats
from hardcontact.base.statistics import MEDIAN_DEVIATION
from hardcontact.base.units import NM
from hardcontact.surfaces.height_map import (
    HeightMap,
    mirror_in_float32,
    refuse_line_scan,
    to_surface_topography,
)

Mask = NDArray[np.bool_]

#: Some pixel of a streak is farther than this from both neighbours, in typical steps between lines:
#: one Gaussian step in 10⁹ rises so far.
MIN_STREAK_STEPS = 6.0
#: All pixels of a streak are farther than this from both neighbours, in typical steps.
MIN_END_STEPS = 1.0
#: Least pixels of a streak along a line: fewer may be a particle on the surface.
MIN_STREAK_PIXELS = 8
#: A streak is longer than this multiple of the longest run across the lines, which is real.
MIN_LENGTH_RATIO = 2
#: Widths of streaks in lines.
STREAK_WIDTHS = (1, 2, 3)
#: Largest number of rounds: filling a streak may show another one beside it.
MAX_FILLINGS = 20


def level_plane(scan: HeightMap) -> HeightMap:
    """Return a scan minus its least-squares plane or line."""
    # This equals `detrend` of SurfaceTopography, whose import would be slow.
    heights = np.asarray(scan.heights, dtype=float).T
    axes = np.meshgrid(*(np.arange(count) / count for count in heights.shape), indexing="ij")
    design = np.column_stack([np.ones(heights.size), *(axis.ravel() for axis in axes)])
    offset, *slopes = np.linalg.lstsq(design, heights.ravel(), rcond=None)[0]
    levelled = heights - offset
    for slope, axis in zip(slopes, axes, strict=True):
        levelled = levelled - slope * axis
    return replace(scan, heights=levelled.T)


def squared_projections(half_phase: Floats) -> tuple[Floats, Floats]:
    """Return the shares of the mean square of a wave that the mean and slope of a line contain."""
    # Squared projections of exp(2 i `half_phase` u), |u| <= 1/2, on 1 and sqrt(12) u.
    spherical_jn = scipy.special.spherical_jn
    return spherical_jn(0, half_phase) ** 2, 3 * spherical_jn(1, half_phase) ** 2


def level_lines(scan: HeightMap) -> HeightMap:
    """Return a scan without streaks, its lines along x aligned, minus its least-squares plane."""
    heights, is_filled = fill_streaks(level_plane(scan).heights)
    scan = replace(scan, heights=heights)
    streak_lines = int(is_filled.any(axis=1).sum())
    if streak_lines:
        note = f"streaks along {streak_lines} lines filled from the lines beside them"
        scan = replace(scan, notes=(*scan.notes, note))
    # This removes drift and jumps, but also real roughness whose wavevector points along y.
    aligned = to_surface_topography(scan).scan_line_align(direction="x", mode="median", degree=1)
    return level_plane(replace(scan, heights=aligned.heights().T))


def level_quadratic(scan: HeightMap) -> HeightMap:
    """Return a scan minus its least-squares polynomial of second order, to remove a bow."""
    return replace(scan, heights=to_surface_topography(scan).detrend("curvature").heights().T)


#: Ways to level a scan, by their names in the configuration.
LEVELLING_METHODS: dict[str, Callable[[HeightMap], HeightMap]] = {
    "plane": level_plane,
    "lines": level_lines,
    "quadratic": level_quadratic,
}


def remove_form(
    scan: HeightMap, sphere_radius: float | None = None, levelling: str = "plane"
) -> HeightMap:
    """Return a levelled map without its sphere (radius in nm), or a line scan minus its line."""
    if levelling not in LEVELLING_METHODS:
        raise ValueError(f"levelling: expected {', '.join(LEVELLING_METHODS)}, found {levelling}")
    if scan.kind == "line scan":
        return level_plane(scan)
    if sphere_radius is not None:
        # An apex off the centre would only add a plane, which levelling removes.
        rows, columns = scan.heights.shape
        y = (np.arange(rows) - (rows - 1) / 2) * scan.pixel_size
        x = (np.arange(columns) - (columns - 1) / 2) * scan.pixel_size
        heights = scan.heights + (y[:, None] ** 2 + x**2) / (2 * sphere_radius)
        scan = replace(scan, heights=heights)
    return LEVELLING_METHODS[levelling](scan)


#: Titles of the files with the two results of `level_and_mirror`.
LEVELLED_TITLE = "levelled scan, the sphere subtracted if it shows one"
MIRRORED_TITLE = "scan and its mirror images, periodic"


def level_and_mirror(
    scan: HeightMap, sphere_radius: float | None = None, levelling: str = "plane"
) -> tuple[xr.Dataset, xr.Dataset]:
    """Return datasets of the levelled map, with its sphere as scanned, and of the mirrored map."""
    refuse_line_scan(scan)
    flat = remove_form(scan, sphere_radius, levelling)
    levelled = flat.to_dataset()
    levelled["heights"] = levelled["heights"].astype("float32")
    if sphere_radius is not None:
        attributes = NM | {"long_name": "height of the sphere as scanned"}
        levelled["as_scanned"] = (("y", "x"), scan.heights.astype("float32"), attributes)
    return levelled, mirror_in_float32(flat).to_dataset()


def _find_streaks(heights: Floats) -> Iterator[Mask]:
    """Yield a mask (y, x) of streaks for each width, all above or all below their neighbours.

    A run of pixels along x that all rise above their neighbours, or fall below, may be a streak. Or
    it may be a ridge or a valley of the surface, but those run along y, too, where streaks do not.
    So a run is a streak if it is more than twice as long as the longest run along y.
    """
    for width in STREAK_WIDTHS:
        x_lengths = [_run_lengths(_high_runs(steps)) for steps in _rise_and_fall(heights, width)]
        y_lengths = [_run_lengths(_high_runs(steps)) for steps in _rise_and_fall(heights.T, width)]
        longest_along_y = max(lengths.max() for lengths in y_lengths)
        min_length = max(MIN_STREAK_PIXELS, MIN_LENGTH_RATIO * longest_along_y + 1)
        is_above, is_below = np.array(x_lengths) >= min_length
        # A true line between two raised streaks looks like a sunken streak.
        yield is_above if is_above.sum() >= is_below.sum() else is_below


def fill_streaks(heights: Floats) -> tuple[Floats, Mask]:
    """Return heights (y, x) with streaks filled from their neighbours, and the mask of streaks.

    Each round finds streaks in the filled heights, adds them to the mask, and fills its pixels
    anew, by interpolation along y between measured pixels. The last round finds no new streak.
    """
    filled_heights = np.array(heights)
    is_filled = np.zeros(heights.shape, bool)
    for _ in range(MAX_FILLINGS):
        masks = (is_filled | streaks for streaks in _find_streaks(filled_heights))
        # Only a larger mask is progress: width 2 finds the middle of three lines again and again.
        larger_mask = next((mask for mask in masks if mask.sum() > is_filled.sum()), None)
        if larger_mask is None:
            break
        is_filled = larger_mask
        for column in np.flatnonzero(is_filled.any(axis=0)):
            lines = np.flatnonzero(~is_filled[:, column])
            gaps = np.flatnonzero(is_filled[:, column])
            filled_heights[gaps, column] = np.interp(gaps, lines, heights[lines, column])
    return filled_heights, is_filled


def _rise_and_fall(heights: Floats, width: int) -> tuple[Floats, Floats]:
    """Return how far pixels rise above and fall below both lines `width` away, in typical steps."""
    padded = np.pad(heights, ((width, width), (0, 0)), constant_values=np.nan)
    line_before, line_after = padded[: -2 * width], padded[2 * width :]
    # At the border, a streak of one line has one neighbour; wider ones have NaN.
    lower, upper = (np.fmin, np.fmax) if width == 1 else (np.minimum, np.maximum)
    typical_step = np.median(np.abs(heights[width:] - heights[:-width])) / MEDIAN_DEVIATION
    scale = max(typical_step, np.finfo(np.float32).tiny)  # Not zero on a flat scan.
    rise = heights - upper(line_before, line_after)
    fall = lower(line_before, line_after) - heights
    return rise / scale, fall / scale


def _number_runs(mask: Mask) -> NDArray[np.intp]:
    """Return the number (y, x) of the run along x that has each pixel; 0 for no run."""
    run_numbers, _ = scipy.ndimage.label(mask, structure=[[0, 0, 0], [1, 1, 1], [0, 0, 0]])
    return np.asarray(run_numbers, np.intp)


def _run_lengths(mask: Mask) -> NDArray[np.intp]:
    """Return the length (y, x) of the run along x that has each pixel; 0 for no run."""
    run_numbers = _number_runs(mask)
    lengths = np.bincount(run_numbers.ravel())
    lengths[0] = 0
    return np.asarray(lengths[run_numbers])


def _high_runs(steps: Floats) -> Mask:
    """Return the mask of runs along x above MIN_END_STEPS with a pixel above MIN_STREAK_STEPS."""
    is_certain = steps > MIN_STREAK_STEPS
    if not is_certain.any():
        return is_certain
    run_numbers = _number_runs(steps > MIN_END_STEPS)
    return np.isin(run_numbers, run_numbers[is_certain])
