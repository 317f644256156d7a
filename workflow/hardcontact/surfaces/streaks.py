"""Streaks along the lines of a map, where the tip lost the surface or carried a particle."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

#: Least distance of a streak to both lines beside it, in typical steps from line to line; Gaussian
#: steps are so large once in 10⁹ pixels.
MIN_STREAK_STEPS = 6.0
#: Median distance of Gaussian steps from zero, in rms steps.
MEDIAN_STEP = 0.6745
#: Least number of pixels along a line: fewer may be a particle. A streak is also more than twice as
#: long as the longest such row of pixels across the lines, which the surface itself makes.
MIN_STREAK_PIXELS = 4
MAX_LENGTH_RATIO = 2
#: Least distance of the ends of a streak, in typical steps.
END_STEPS = 1.0
#: Widths of streaks in lines.
STREAK_WIDTHS = (1, 2, 3)
#: Streaks on neighbouring lines hide each other, and appear when the others are filled.
MAX_FILLINGS = 20


def find_streaks(heights: Floats) -> Mask:
    """Return the mask (y, x) of the narrowest streaks along x, either all above or all below.

    The ends of a streak may be lower than what tells it from the surface. A line between two
    streaks is not one: of both signs, that with more pixels counts.
    """
    for width in STREAK_WIDTHS:
        across = _distances(heights.T, width)
        longest_across = max(_run_lengths(steps > MIN_STREAK_STEPS).max() for steps in across)
        min_length = max(MIN_STREAK_PIXELS, MAX_LENGTH_RATIO * longest_across + 1)
        streaks = [
            _runs_with(steps > END_STEPS, _run_lengths(steps > MIN_STREAK_STEPS) >= min_length)
            for steps in _distances(heights, width)
        ]
        more = max(streaks, key=np.count_nonzero)
        if more.any():
            return more
    return np.zeros(heights.shape, bool)


def fill_streaks(heights: Floats) -> tuple[Floats, Mask]:
    """Return heights (y, x) whose streaks are filled from the lines beside them, and their mask."""
    filled = np.array(heights)
    is_filled = np.zeros(heights.shape, bool)
    for _ in range(MAX_FILLINGS):
        streaks = find_streaks(filled)
        if not streaks.any():
            break
        is_filled |= streaks
        for column in np.flatnonzero(is_filled.any(axis=0)):
            lines = np.flatnonzero(~is_filled[:, column])
            gaps = np.flatnonzero(is_filled[:, column])
            filled[gaps, column] = np.interp(gaps, lines, heights[lines, column])
    return filled, is_filled


def _distances(heights: Floats, width: int) -> tuple[Floats, Floats]:
    """Return how far pixels are above, and below, both lines a width before and after.

    Distances are in typical steps. Near the first and the last line only one of these is there.
    """
    padded = np.pad(heights, ((width, width), (0, 0)), constant_values=np.nan)
    before, after = padded[: -2 * width], padded[2 * width :]
    typical_step = np.median(np.abs(heights[width:] - heights[:-width])) / MEDIAN_STEP
    scale = max(typical_step, np.finfo(np.float32).tiny)
    return (
        (heights - np.fmax(before, after)) / scale,
        (np.fmin(before, after) - heights) / scale,
    )


def _runs(mask: Mask) -> Iterator[tuple[int, slice]]:
    """Yield the line and the pixels of each unbroken row of pixels of a mask along x."""
    ends = np.diff(np.pad(mask, ((0, 0), (1, 1))).astype(np.int8), axis=1)
    rows, starts = np.nonzero(ends == 1)
    _, stops = np.nonzero(ends == -1)
    for row, start, stop in zip(rows, starts, stops, strict=True):
        yield int(row), slice(start, stop)


def _run_lengths(mask: Mask) -> NDArray[np.intp]:
    """Return the length in pixels of the run in which each pixel lies, 0 for other pixels."""
    lengths = np.zeros(mask.shape, np.intp)
    for row, pixels in _runs(mask):
        lengths[row, pixels] = pixels.stop - pixels.start
    return lengths


def _runs_with(mask: Mask, seeds: Mask) -> Mask:
    """Return the mask of the runs of a mask that hold a seed."""
    kept = np.zeros(mask.shape, bool)
    if seeds.any():
        for row, pixels in _runs(mask):
            kept[row, pixels] = seeds[row, pixels].any()
    return kept
