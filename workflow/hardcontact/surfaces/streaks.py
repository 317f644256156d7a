"""Find and fill streaks: where the tip loses the surface, or carries a particle, along a line."""

from collections.abc import Iterator

import numpy as np
import scipy
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats
from hardcontact.base.statistics import MEDIAN_DEVIATION

Mask = NDArray[np.bool_]

#: Least distance of a streak from both lines beside it, in typical steps from line to line: one
#: Gaussian step in 10⁹ is so large.
MIN_STREAK_STEPS = 6.0
#: Least number of pixels of a streak along a line: fewer may be a particle.
MIN_STREAK_PIXELS = 8
#: A streak is longer than this multiple of the longest run across the lines, which is real.
MIN_LENGTH_RATIO = 2
#: Least distance of all pixels of a streak from both lines, in typical steps.
MIN_END_STEPS = 1.0
#: Widths of streaks in lines.
STREAK_WIDTHS = (1, 2, 3)
#: Largest number of rounds: a streak may appear only when its neighbour is filled.
MAX_FILLINGS = 20


def find_streaks(heights: Floats) -> Iterator[Mask]:
    """Yield by width the mask (y, x) of streaks along x, all above or all below other lines.

    Only the sign with more pixels counts: a line between two streaks seems to have the other.
    """
    for width in STREAK_WIDTHS:
        along_x = [_run_lengths(_candidates(steps)) for steps in _distances(heights, width)]
        along_y = [_run_lengths(_candidates(steps)) for steps in _distances(heights.T, width)]
        longest_along_y = max(lengths.max() for lengths in along_y)
        min_length = max(MIN_STREAK_PIXELS, MIN_LENGTH_RATIO * longest_along_y + 1)
        is_above, is_below = np.array(along_x) >= min_length
        yield is_above if is_above.sum() >= is_below.sum() else is_below


def fill_streaks(heights: Floats) -> tuple[Floats, Mask]:
    """Return heights (y, x) whose streaks are filled from the lines beside them, and their mask."""
    filled = np.array(heights)
    is_filled = np.zeros(heights.shape, bool)
    for _ in range(MAX_FILLINGS):
        masks = (is_filled | streaks for streaks in find_streaks(filled))
        # A smaller mask is no progress: a width of two shows the middle of three lines for ever.
        larger_mask = next((mask for mask in masks if mask.sum() > is_filled.sum()), None)
        if larger_mask is None:
            break
        is_filled = larger_mask
        for column in np.flatnonzero(is_filled.any(axis=0)):
            lines = np.flatnonzero(~is_filled[:, column])
            gaps = np.flatnonzero(is_filled[:, column])
            filled[gaps, column] = np.interp(gaps, lines, heights[lines, column])
    return filled, is_filled


def _distances(heights: Floats, width: int) -> tuple[Floats, Floats]:
    """Return how far each pixel lies above, and how far below, both lines at a distance of `width`.

    Distances are in typical steps. At the border a width of 1 has only one line, others none.
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
    """Return the mask of runs above MIN_END_STEPS that reach MIN_STREAK_STEPS somewhere."""
    is_certain = steps > MIN_STREAK_STEPS
    if not is_certain.any():
        return is_certain
    labels = _label_runs(steps > MIN_END_STEPS)
    return np.isin(labels, labels[is_certain])
