"""Measurements of one surface that contradict each other at the wavelengths they share.

A joined spectrum is the mean of its measurements. If two of them differ by two decades, because of
a wrong unit or another specimen, it is a spectrum that neither has.
"""

from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from hardcontact.base.printing import print_length
from hardcontact.surfaces.measured_spectrum import (
    CALIBRATION,
    bias_of_log,
    variance_of_log,
    waves_in_bins,
)
from hardcontact.surfaces.spectrum import BIN_CENTRES, HALF_DECADE, Floats

#: Standard errors by which the mean logarithms of two measurements differ before they contradict
#: each other: a factor of 3.1 in C_iso, 1.8 in heights, of measurements of many waves.
ERRORS = 4


class Contradiction(NamedTuple):
    """Two measurements, by their place, of which one has the higher spectrum."""

    higher: int
    lower: int
    factor: float  #: C_iso of the first over that of the other, the mean of the logarithm.
    shortest: float  #: Wavelengths (nm) at which both are reliable.
    longest: float


def told_contradictions(pairs: Sequence[Contradiction], names: Sequence[str]) -> Iterator[str]:
    """Yield a line on the measurements, called by these names, that contradict each other most."""
    for pair in pairs[:1]:
        more = f"; more pairs that do: {len(pairs) - 1}" if pairs[1:] else ""
        yield (
            f"{names[pair.higher]} and {names[pair.lower]} contradict each other: at wavelengths "
            f"from {print_length(pair.shortest)} to {print_length(pair.longest)} the power "
            f"spectral density of the first is {pair.factor:.2g} times that of the other{more}"
        )


def contradictions(
    density: Floats, reliable: ArrayLike, kinds: Iterable[str], sizes: Iterable[float]
) -> list[Contradiction]:
    """Return which measurements contradict each other, the largest factor first.

    All bins that two measurements share are compared, and each half decade of them. A contradiction
    states the part in which they differ by most standard errors.

    Parameters
    ----------
    density, reliable : array
        (measurement, bins) C_iso in nm⁴, and whether it is reliable.
    kinds, sizes : iterable
        Of the measurements, as of `waves_in_bins`; sizes in nm.
    """
    usable = np.asarray(reliable, bool) & np.isfinite(density)
    waves = np.array([waves_in_bins(kind, size) for kind, size in zip(kinds, sizes, strict=True)])
    logs = np.log(np.where(usable, density, 1.0)) + bias_of_log(waves)
    variances = variance_of_log(waves)
    pairs = []
    for first, second in combinations(range(len(logs)), 2):
        (shared,) = np.nonzero(usable[first] & usable[second])
        if not shared.size:
            continue
        difference = logs[first] - logs[second]
        variance = variances[first] + variances[second]
        half_decades = [
            shared[start : start + HALF_DECADE] for start in range(len(shared) - HALF_DECADE + 1)
        ]
        compared = [
            (*_mean(difference[bins], variance[bins]), bins) for bins in (shared, *half_decades)
        ]
        mean, error, bins = max(compared, key=lambda part: abs(part[0]) / part[1])
        if abs(mean) > ERRORS * error:
            higher, lower = (first, second) if mean > 0 else (second, first)
            shortest, longest = 2 * np.pi / BIN_CENTRES[bins[[-1, 0]]]
            factor = float(np.exp(abs(mean)))
            pairs.append(Contradiction(higher, lower, factor, float(shortest), float(longest)))
    return sorted(pairs, key=lambda pair: -pair.factor)


def _mean(difference: Floats, variance: Floats) -> tuple[float, float]:
    """Return the mean difference of ln C over bins, of these variances, and its standard error.

    Bins count as in the joined spectrum. The calibration of a microscope is wrong at all its
    wavelengths alike: no number of bins averages it out.
    """
    weight = 1 / (variance + 2 * CALIBRATION**2)
    weight /= weight.sum()
    error = np.sqrt(weight**2 @ variance + 2 * CALIBRATION**2)
    return float(weight @ difference), float(error)
