"""Find pairs of scans that show the same area, and pairs that contradict each other.

Scans of one area, such as trace and retrace, are one sample. The mean spectrum of scans that
contradict each other, as with a wrong unit, describes neither.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import combinations
from typing import NamedTuple

import numpy as np
import scipy
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import ArrayLike, NDArray

from hardcontact.base.arrays import Floats
from hardcontact.base.formatting import format_length
from hardcontact.scans.measured_spectrum import (
    CALIBRATION_SCATTER,
    bias_of_log,
    independent_modes,
    variance_of_log,
)
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.spectrum import BIN_CENTRES, HALF_DECADE_BINS

#: Correlation of heights, after the best shift, above which two maps show the same area.
SAME_AREA_CORRELATION = 0.5
#: Largest number of pixels per row of compared maps: a mean over several has less noise.
COMPARED_PIXELS = 64
#: Longest wavelength that is compared, as a share of the smaller side: few longer
#: waves fit in, so different areas would correlate by chance.
LONGEST_COMPARED_SHARE = 1 / 4
#: Least overlapping area of two shifted maps, as a share of the smaller map.
MIN_OVERLAP = 0.5
#: Least product of variances, relative to the largest: rounding of Fourier transforms is smaller.
MIN_RELATIVE_VARIANCE_PRODUCT = 1e-9
#: Largest ratio of the sides of two maps: a smaller part of an area shows other waves.
MAX_SIZE_RATIO = 1.25
#: Least standard errors between the mean logarithms of scans that contradict each other. With many
#: modes, these are factors of 3.1 in C_iso and 1.8 in heights.
MIN_CONTRADICTION_ERRORS = 4


def coarse_map(scan: HeightMap) -> HeightMap:
    """Return a map on at most COMPARED_PIXELS per row; a line scan as it is."""
    if scan.kind == "line scan":
        return scan
    step = math.ceil(scan.pixels / COMPARED_PIXELS)
    count = scan.pixels // step
    square = scan.heights[: count * step, : count * step]
    means = square.reshape(count, step, count, step).mean(axis=(1, 3))
    return replace(scan, heights=means, pixel_size=step * scan.pixel_size)


def earlier_scans_of_areas(scans: Sequence[HeightMap]) -> list[int | None]:
    """Return for each levelled scan the index of the first scan of its area, None for that scan."""
    maps = [coarse_map(scan) for scan in scans]
    earlier_indices: list[int | None] = []
    for scan in maps:
        first_indices = [index for index, earlier in enumerate(earlier_indices) if earlier is None]
        same_area_indices = (index for index in first_indices if have_same_area(maps[index], scan))
        earlier_indices.append(next(same_area_indices, None))
    return earlier_indices


def repeated_area_notes(scans: Sequence[HeightMap], names: Sequence[str]) -> dict[int, str]:
    """Return a line, by index, on each scan that shows the area of an earlier scan."""
    return {
        index: f"{names[index]}: it shows the same area as {names[earlier]}, "
        "and an area counts once"
        for index, earlier in enumerate(earlier_scans_of_areas(scans))
        if earlier is not None
    }


def have_same_area(scan: HeightMap, other_scan: HeightMap) -> bool:
    """Return True if two levelled scans from `coarse_map` are maps of the same area.

    The short waves of both maps are compared on the same pixels. They must correlate at some shift,
    whereas the halves of one map must not.
    """
    if "line scan" in (scan.kind, other_scan.kind):
        return False
    smaller, larger = sorted([scan, other_scan], key=lambda compared: compared.size)
    if larger.size > MAX_SIZE_RATIO * smaller.size:
        return False
    pixel_size = max(scan.pixel_size, other_scan.pixel_size)
    longest_pixels = LONGEST_COMPARED_SHARE * smaller.size / pixel_size
    waves = _short_waves(smaller, pixel_size, longest_pixels)
    other_waves = _short_waves(larger, pixel_size, longest_pixels)
    if _best_correlation(waves, other_waves) <= SAME_AREA_CORRELATION:
        return False
    # If the halves of a map correlate as much, as on a grating, correlation proves nothing.
    halves = [np.array_split(waves, 2, axis=axis) for axis in (0, 1)]
    return all(_best_correlation(*pair) <= SAME_AREA_CORRELATION for pair in halves)


def _short_waves(scan: HeightMap, pixel_size: float, longest_pixels: float) -> Floats:
    """Return heights on pixels of `pixel_size` (nm) with waves up to `longest_pixels` long."""
    ratio = scan.pixel_size / pixel_size
    heights = scan.heights
    if ratio < 1:  # A Gaussian of 0.4 larger pixels weakens waves that they cannot show.
        heights = scipy.ndimage.zoom(scipy.ndimage.gaussian_filter(heights, 0.4 / ratio), ratio)
    # A Gaussian of this width keeps half of the longest wave.
    width = np.sqrt(2 * np.log(2)) * longest_pixels / (2 * np.pi)
    return np.asarray(heights - scipy.ndimage.gaussian_filter(heights, width), float)


def _best_correlation(heights: Floats, other_heights: Floats) -> float:
    """Return the largest correlation of two maps over all shifts that overlap enough.

    At each shift the correlation of heights h and g is sum(h g) / sqrt(sum(h²) sum(g²)), summed
    over the pixels in which both maps overlap.
    """

    def sums_over_shifts(fixed: Floats, shifted: Floats) -> Floats:
        """Return the sum of the product over the overlap, for every shift at once."""
        return np.asarray(scipy.signal.fftconvolve(fixed, shifted[::-1, ::-1]))

    ones, other_ones = np.ones(heights.shape), np.ones(other_heights.shape)
    overlap = sums_over_shifts(ones, other_ones)  # in pixels
    variance_products = sums_over_shifts(heights**2, other_ones)
    variance_products *= sums_over_shifts(ones, other_heights**2)
    # Where one map is constant, such as in unmeasured lines, rounding leaves no variance to trust.
    is_comparable = overlap >= MIN_OVERLAP * min(heights.size, other_heights.size)
    is_comparable &= variance_products > MIN_RELATIVE_VARIANCE_PRODUCT * variance_products.max()
    covariances = sums_over_shifts(heights, other_heights)
    correlations = covariances[is_comparable] / np.sqrt(variance_products[is_comparable])
    return float(correlations.max(initial=0.0))


class Contradiction(NamedTuple):
    """Two scans whose C_iso differs, most significantly in one group of bins."""

    higher: int  #: Index of the scan with the higher C_iso.
    lower: int
    factor: float  #: Ratio of C_iso, higher to lower: its geometric mean over the group.
    wavelengths: tuple[float, float]  #: Shortest and longest of the group in nm.


def describe_contradictions(contradictions: Sequence[Contradiction], names: Sequence[str]) -> str:
    """Return a line on the first contradiction, and the number of others."""
    worst = contradictions[0]
    remainder = f"; more pairs that do: {len(contradictions) - 1}" if contradictions[1:] else ""
    shortest, longest = worst.wavelengths
    return (
        f"{names[worst.higher]} and {names[worst.lower]} contradict each other: at wavelengths "
        f"from {format_length(shortest)} to {format_length(longest)} the power spectral density of "
        f"the first is {worst.factor:.2g} times that of the other{remainder}"
    )


def find_contradictions(
    density: Floats, reliable: ArrayLike, kinds: Iterable[str], sizes: Iterable[float]
) -> list[Contradiction]:
    """Return pairs of scans whose C_iso contradict each other, the largest factor first.

    Two scans contradict each other if the mean difference of their ln C over some group of bins is
    larger than MIN_CONTRADICTION_ERRORS of its standard errors. `density` in nm⁴ and `reliable` are
    (scan, bins); sizes are in nm.
    """
    usable = np.asarray(reliable, bool) & np.isfinite(density)
    scans = zip(kinds, sizes, strict=True)
    modes = np.array([independent_modes(kind, size) for kind, size in scans])
    log_densities = np.log(np.where(usable, density, 1.0)) + bias_of_log(modes)
    variances = variance_of_log(modes)
    contradictions = []
    for index, other_index in combinations(range(len(log_densities)), 2):
        (shared_bins,) = np.nonzero(usable[index] & usable[other_index])
        if not shared_bins.size:
            continue
        difference = log_densities[index] - log_densities[other_index]
        variance = variances[index] + variances[other_index]
        bins, mean, error = _most_significant_difference(difference, variance, shared_bins)
        if abs(mean) > MIN_CONTRADICTION_ERRORS * error:
            higher, lower = (index, other_index) if mean > 0 else (other_index, index)
            shortest, longest = (2 * np.pi / BIN_CENTRES[bins[[-1, 0]]]).tolist()
            factor = float(np.exp(abs(mean)))
            contradictions.append(Contradiction(higher, lower, factor, (shortest, longest)))
    return sorted(contradictions, key=lambda contradiction: -contradiction.factor)


def _most_significant_difference(
    difference: Floats, variance: Floats, shared_bins: NDArray[np.int_]
) -> tuple[NDArray[np.int_], float, float]:
    """Return the group of bins with the most significant `_mean_difference`, its mean and error.

    Groups are all bins in which both scans are reliable, and each half decade of these.
    """
    half_decades = sliding_window_view(shared_bins, min(HALF_DECADE_BINS, len(shared_bins)))
    groups = [shared_bins, *half_decades]
    means_and_errors = [_mean_difference(difference[bins], variance[bins]) for bins in groups]
    most_significant = int(np.argmax([abs(mean) / error for mean, error in means_and_errors]))
    return groups[most_significant], *means_and_errors[most_significant]


def _mean_difference(difference: Floats, variance: Floats) -> tuple[float, float]:
    """Return the weighted mean difference of ln C over bins, and its standard error."""
    weight = 1 / (variance + 2 * CALIBRATION_SCATTER**2)
    weight /= weight.sum()
    # A wrong calibration is the same in all bins, so that no number of bins averages it out.
    error = np.sqrt(weight**2 @ variance + 2 * CALIBRATION_SCATTER**2)
    return float(weight @ difference), float(error)
