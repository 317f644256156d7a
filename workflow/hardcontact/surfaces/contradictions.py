"""Measurements of one surface that contradict each other at the wavelengths they share.

A joined spectrum is the mean of its measurements. If two of them differ by two decades, because of
a wrong unit or another specimen, the mean describes neither.
"""

from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from hardcontact.base.formatting import format_length
from hardcontact.surfaces.measured_spectrum import (
    CALIBRATION_SCATTER,
    bias_of_log,
    variance_of_log,
    waves_in_bins,
)
from hardcontact.surfaces.spectrum import BIN_CENTRES, HALF_DECADE_BINS, Floats

#: Standard errors by which the mean logarithms of two measurements differ before they contradict
#: each other: a factor of 3.1 in C_iso, 1.8 in heights, if both have many waves.
MIN_STANDARD_ERRORS = 4


class Contradiction(NamedTuple):
    """Two measurements with different spectra, as indices into the measurements."""

    higher: int
    lower: int
    factor: float  #: Ratio of C_iso, higher to lower, by the mean of its logarithm.
    shortest: float  #: Wavelengths (nm) at which both are reliable.
    longest: float


def contradiction_lines(pairs: Sequence[Contradiction], names: Sequence[str]) -> Iterator[str]:
    """Yield a line on the first of some contradictions, with the names of the measurements."""
    for pair in pairs[:1]:
        remainder = f"; more pairs that do: {len(pairs) - 1}" if pairs[1:] else ""
        yield (
            f"{names[pair.higher]} and {names[pair.lower]} contradict each other: at wavelengths "
            f"from {format_length(pair.shortest)} to {format_length(pair.longest)} the power "
            f"spectral density of the first is {pair.factor:.2g} times that of the other{remainder}"
        )


def contradictions(
    density: Floats, reliable: ArrayLike, kinds: Iterable[str], sizes: Iterable[float]
) -> list[Contradiction]:
    """Return the pairs of measurements that contradict each other, the largest factor first.

    Two measurements are compared over all bins that they share, and over each half decade of them.
    A contradiction states the range with the largest difference in standard errors.

    density, reliable: (measurement, bins) C_iso in nm⁴, and whether it is reliable.
    kinds, sizes: arguments of `waves_in_bins` for each measurement; sizes in nm.
    Returns empty if no measurements contradict each other.
    """
    usable = np.asarray(reliable, bool) & np.isfinite(density)
    waves = np.array([waves_in_bins(kind, size) for kind, size in zip(kinds, sizes, strict=True)])
    logs = np.log(np.where(usable, density, 1.0)) + bias_of_log(waves)
    variances = variance_of_log(waves)
    pairs = []
    for left, right in combinations(range(len(logs)), 2):
        (shared,) = np.nonzero(usable[left] & usable[right])
        if not shared.size:
            continue
        difference = logs[left] - logs[right]
        variance = variances[left] + variances[right]
        half_decades = [
            shared[start : start + HALF_DECADE_BINS]
            for start in range(len(shared) - HALF_DECADE_BINS + 1)
        ]
        ranges = [
            (*_mean_difference(difference[bins], variance[bins]), bins)
            for bins in (shared, *half_decades)
        ]
        mean, error, bins = max(ranges, key=lambda item: abs(item[0]) / item[1])
        if abs(mean) > MIN_STANDARD_ERRORS * error:
            higher, lower = (left, right) if mean > 0 else (right, left)
            shortest, longest = 2 * np.pi / BIN_CENTRES[bins[[-1, 0]]]
            factor = float(np.exp(abs(mean)))
            pairs.append(Contradiction(higher, lower, factor, float(shortest), float(longest)))
    return sorted(pairs, key=lambda pair: -pair.factor)


def _mean_difference(difference: Floats, variance: Floats) -> tuple[float, float]:
    """Return the mean difference of ln C over bins with these variances, and its standard error.

    Bins have the weights of the joined spectrum. The calibration of a microscope is wrong by the
    same factor at all wavelengths: no number of bins averages it out.
    """
    weight = 1 / (variance + 2 * CALIBRATION_SCATTER**2)
    weight /= weight.sum()
    error = np.sqrt(weight**2 @ variance + 2 * CALIBRATION_SCATTER**2)
    return float(weight @ difference), float(error)
