"""Find scans that show the same area, such as trace and retrace: they are one sample, not two."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import scipy

from hardcontact.base.arrays import Floats
from hardcontact.surfaces.height_map import HeightMap

#: Correlation of heights, after the best shift, above which two maps show the same area.
SAME_AREA_CORRELATION = 0.5
#: Largest number of pixels per row of compared maps: means lower the noise, a pair takes 15 ms.
COMPARED_PIXELS = 64
#: Longest wavelength that is compared, as a share of the smaller side. Longer waves are few, so
#: that maps of different areas correlate by chance; levelling also changes them.
LONGEST_COMPARED_SHARE = 1 / 4
#: Least overlap after a shift, as a share of the smaller map.
MIN_OVERLAP = 0.5
#: Least product of variances, relative to the largest: rounding of Fourier transforms is smaller.
ROUNDING = 1e-9
#: Largest ratio of the sides of two maps: a smaller part of an area shows other waves.
MAX_SIZE_RATIO = 1.25


def coarse_map(scan: HeightMap) -> HeightMap:
    """Return a map on at most COMPARED_PIXELS per row; a line scan as it is."""
    if scan.kind == "line scan":
        return scan
    step = -(-scan.pixels // COMPARED_PIXELS)
    count = scan.pixels // step
    kept = scan.heights[: count * step, : count * step]
    means = kept.reshape(count, step, count, step).mean(axis=(1, 3))
    return replace(scan, heights=means, pixel_size=step * scan.pixel_size)


def earlier_scans_of_areas(scans: Sequence[HeightMap]) -> list[int | None]:
    """Return for each scan the index of the first scan that shows its area; None if it is new.

    Scans are levelled; line scans are never compared.
    """
    maps = [coarse_map(scan) for scan in scans]
    earlier: list[int | None] = []
    for scan in maps:
        new_areas = [index for index, first in enumerate(earlier) if first is None]
        same = (index for index in new_areas if show_same_area(maps[index], scan))
        earlier.append(next(same, None))
    return earlier


def repeated_scans(scans: Sequence[HeightMap], names: Sequence[str]) -> dict[int, str]:
    """Return a line on each scan that shows the area of an earlier scan, by its index."""
    return {
        index: f"{names[index]}: it shows the same area as {names[first]}, and an area counts once"
        for index, first in enumerate(earlier_scans_of_areas(scans))
        if first is not None
    }


def show_same_area(first: HeightMap, second: HeightMap) -> bool:
    """Return whether two levelled maps from `coarse_map` show the same area.

    If its own halves correlate as much, as on a grating, correlation proves nothing.
    """
    if "line scan" in (first.kind, second.kind):
        return False
    smaller, larger = sorted([first, second], key=lambda scan: scan.size)
    if larger.size > MAX_SIZE_RATIO * smaller.size:
        return False
    pixel_size = max(first.pixel_size, second.pixel_size)
    longest = LONGEST_COMPARED_SHARE * smaller.size / pixel_size
    waves, other_waves = (_short_waves(scan, pixel_size, longest) for scan in (smaller, larger))
    if _best_correlation(waves, other_waves) <= SAME_AREA_CORRELATION:
        return False
    halves = [np.array_split(waves, 2, axis=axis) for axis in (0, 1)]
    return all(_best_correlation(*pair) <= SAME_AREA_CORRELATION for pair in halves)


def _short_waves(scan: HeightMap, pixel_size: float, longest: float) -> Floats:
    """Return a map on pixels of a size (nm) without waves longer than `longest` (pixels)."""
    ratio = scan.pixel_size / pixel_size
    heights = scan.heights
    if ratio < 1:
        heights = scipy.ndimage.zoom(scipy.ndimage.gaussian_filter(heights, 0.4 / ratio), ratio)
    # A Gaussian of this width keeps half of the longest wave.
    width = np.sqrt(2 * np.log(2)) * longest / (2 * np.pi)
    return np.asarray(heights - scipy.ndimage.gaussian_filter(heights, width), float)


def _best_correlation(first: Floats, second: Floats) -> float:
    """Return the largest correlation of two maps over all shifts that overlap enough."""

    def sums_over_shifts(fixed: Floats, shifted: Floats) -> Floats:
        return np.asarray(scipy.signal.fftconvolve(fixed, shifted[::-1, ::-1]))

    first_weights, second_weights = np.ones(first.shape), np.ones(second.shape)
    overlap = sums_over_shifts(first_weights, second_weights)
    variances = sums_over_shifts(first**2, second_weights)
    variances *= sums_over_shifts(first_weights, second**2)
    # Where one map is constant, such as in unmeasured lines, rounding leaves no variance to trust.
    is_comparable = overlap >= MIN_OVERLAP * min(first.size, second.size)
    is_comparable &= variances > ROUNDING * variances.max()
    covariances = sums_over_shifts(first, second)
    correlations = covariances[is_comparable] / np.sqrt(variances[is_comparable])
    return float(correlations.max(initial=0.0))
