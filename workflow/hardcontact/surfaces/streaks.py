"""Streaks along the lines of a map, where the tip lost the surface or carried a particle."""

import numpy as np
import scipy
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats
from hardcontact.base.statistics import MEDIAN_DEVIATION

Mask = NDArray[np.bool_]

#: Least distance of a streak from both lines beside it, in typical steps from line to line; one
#: Gaussian step in 10⁹ is so large.
MIN_STREAK_STEPS = 6.0
#: Least number of pixels of a streak along a line: fewer may be a particle. A streak is also more
#: than twice as long as the longest such run across the lines, which the surface itself makes.
MIN_STREAK_PIXELS = 8
MAX_LENGTH_RATIO = 2
#: Least distance of the ends of a streak, in typical steps.
END_STEPS = 1.0
#: Widths of streaks in lines.
STREAK_WIDTHS = (1, 2, 3)
#: Streaks on neighbouring lines hide each other, and appear when the others are filled.
MAX_FILLINGS = 20


def find_streaks(heights: Floats) -> Mask:
    """Return the mask (y, x) of the narrowest streaks along x, either all above or all below.

    The ends of a streak may stand out less than the pixels by which it is found. A line between two
    streaks looks like a streak of the other sign: only the sign with more pixels counts.
    """
    for width in STREAK_WIDTHS:
        along = [_run_lengths(_candidates(steps)) for steps in _distances(heights, width)]
        across = [_run_lengths(_candidates(steps)) for steps in _distances(heights.T, width)]
        longest_across = max(lengths.max() for lengths in across)
        min_length = max(MIN_STREAK_PIXELS, MAX_LENGTH_RATIO * longest_across + 1)
        above, below = (lengths >= min_length for lengths in along)
        streaks: Mask = above if above.sum() >= below.sum() else below
        if streaks.any():
            return streaks
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
    """Return how far each pixel lies above both, and how far below both, of two lines.

    The lines are `width` lines before and after the pixel; the first and the last line have only
    one. Distances are in typical steps between lines.
    """
    padded = np.pad(heights, ((width, width), (0, 0)), constant_values=np.nan)
    before, after = padded[: -2 * width], padded[2 * width :]
    lower, upper = (np.fmin, np.fmax) if width == 1 else (np.minimum, np.maximum)
    typical_step = np.median(np.abs(heights[width:] - heights[:-width])) / MEDIAN_DEVIATION
    scale = max(typical_step, np.finfo(np.float32).tiny)
    return (heights - upper(before, after)) / scale, (lower(before, after) - heights) / scale


def _label_runs(mask: Mask) -> NDArray[np.intp]:
    """Return the number from 1 of the run along x in which each pixel lies, 0 for other pixels."""
    labels, _ = scipy.ndimage.label(mask, structure=[[0, 0, 0], [1, 1, 1], [0, 0, 0]])
    return np.asarray(labels, np.intp)


def _run_lengths(mask: Mask) -> NDArray[np.intp]:
    """Return the length in pixels of the run in which each pixel lies, 0 for other pixels."""
    labels = _label_runs(mask)
    lengths = np.bincount(labels.ravel())
    lengths[0] = 0
    return np.asarray(lengths[labels])


def _candidates(steps: Floats) -> Mask:
    """Return the mask of runs of more than END_STEPS that reach MIN_STREAK_STEPS somewhere."""
    is_certain = steps > MIN_STREAK_STEPS
    if not is_certain.any():
        return is_certain
    labels = _label_runs(steps > END_STEPS)
    return np.isin(labels, labels[is_certain])
