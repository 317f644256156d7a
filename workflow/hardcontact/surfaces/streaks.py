"""Streaks along the lines of a map, where the tip lost the surface or carried a particle."""

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
#: Widths of streaks in lines.
STREAK_WIDTHS = (1, 2)
#: Streaks on neighbouring lines hide each other, and appear when the others are filled.
MAX_FILLINGS = 10


def find_streaks(heights: Floats) -> Mask:
    """Return the mask (y, x) of streaks along x: pixels above, or below, the lines beside them."""
    is_streak = np.zeros(heights.shape, bool)
    for width in STREAK_WIDTHS:
        longest_across = max(_lengths(mask).max() for mask in _outlying(heights.T, width))
        min_length = max(MIN_STREAK_PIXELS, MAX_LENGTH_RATIO * longest_across + 1)
        for mask in _outlying(heights, width):
            is_streak |= _lengths(mask) >= min_length
    return is_streak


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


def _outlying(heights: Floats, width: int) -> tuple[Mask, Mask]:
    """Return masks of pixels above, and of those below, both lines a width before and after."""
    padded = np.pad(heights, ((width, width), (0, 0)), mode="reflect")
    before, after = padded[: -2 * width], padded[2 * width :]
    typical_step = np.median(np.abs(heights[width:] - heights[:-width])) / MEDIAN_STEP
    distance = MIN_STREAK_STEPS * typical_step
    return (
        heights - np.maximum(before, after) > distance,
        np.minimum(before, after) - heights > distance,
    )


def _lengths(mask: Mask) -> NDArray[np.intp]:
    """Return the number of pixels of the unbroken row along x in which each pixel lies, else 0."""
    lengths = np.zeros(mask.shape, np.intp)
    ends = np.diff(np.pad(mask, ((0, 0), (1, 1))).astype(np.int8), axis=1)
    rows, starts = np.nonzero(ends == 1)
    _, stops = np.nonzero(ends == -1)
    for row, start, stop in zip(rows, starts, stops, strict=True):
        lengths[row, start:stop] = stop - start
    return lengths
