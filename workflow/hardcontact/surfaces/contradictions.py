"""Measurements of one surface that contradict each other at the wavelengths they share.

A joined spectrum is the mean of its measurements, whatever these say: of two that differ by two
decades, for a wrong unit or another specimen, it is a spectrum that neither has.
"""

from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from hardcontact.numbers.printing import print_length
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
    """Two measurements, by their place, the first of which has the higher spectrum."""

    higher: int
    lower: int
    factor: float  #: C_iso of the first over that of the other, the mean of the logarithm.
    shortest: float  #: Wavelengths (nm) at which both are reliable.
    longest: float


def told_contradictions(found: Sequence[Contradiction], names: Sequence[str]) -> Iterator[str]:
    """Yield a line on the measurements, called by these names, that contradict each other most."""
    for pair in found[:1]:
        more = f"; more pairs that do: {len(found) - 1}" if found[1:] else ""
        yield (
            f"{names[pair.higher]} and {names[pair.lower]} contradict each other: at wavelengths "
            f"from {print_length(pair.shortest)} to {print_length(pair.longest)} the power "
            f"spectral density of the first is {pair.factor:.2g} times that of the other{more}"
        )


def contradictions(
    density: Floats, reliable: ArrayLike, kinds: Iterable[str], sizes: Iterable[float]
) -> list[Contradiction]:
    """Return which measurements contradict each other, the largest factor first.

    The arrays (measurement, bins) are C_iso in nm⁴ and whether it is reliable; kinds and sizes (nm)
    are those of the measurements, as of `waves_in_bins`. Compared are all bins that two of them
    share, and each half decade of these; what is told is the part in which they differ by most
    standard errors.
    """
    usable = np.asarray(reliable, bool) & np.isfinite(density)
    waves = np.array(list(map(waves_in_bins, kinds, sizes)))
    logs = np.log(np.where(usable, density, 1.0)) + bias_of_log(waves)
    scatter = variance_of_log(waves)
    found = []
    for one, other in combinations(range(len(logs)), 2):
        (bins,) = np.nonzero(usable[one] & usable[other])
        difference, variance = logs[one] - logs[other], scatter[one] + scatter[other]
        parts = [bins, *(bins[k : k + HALF_DECADE] for k in range(len(bins) - HALF_DECADE + 1))]
        compared = [(*_mean(difference[part], variance[part]), part) for part in parts if part.size]
        for mean, error, part in sorted(compared, key=lambda part: -abs(part[0]) / part[1])[:1]:
            if abs(mean) > ERRORS * error:
                pair = (one, other) if mean > 0 else (other, one)
                ends = 2 * np.pi / BIN_CENTRES[part[[-1, 0]]]
                found.append(Contradiction(*pair, float(np.exp(abs(mean))), *map(float, ends)))
    return sorted(found, key=lambda pair: -pair.factor)


def _mean(difference: Floats, variance: Floats) -> tuple[float, float]:
    """Return the mean difference of ln C over bins, of these variances, and its standard error.

    Bins count as in the joined spectrum. The calibration of a microscope is wrong at all its
    wavelengths alike: no number of bins averages it out.
    """
    weight = 1 / (variance + 2 * CALIBRATION**2)
    weight /= weight.sum()
    error = np.sqrt(weight**2 @ variance + 2 * CALIBRATION**2)
    return float(weight @ difference), float(error)
