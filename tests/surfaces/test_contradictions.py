"""Only measurements with contradicting heights are named."""

from dataclasses import replace

import numpy as np
import pytest
from measurements import line_of, map_of
from random_scans import uncd
from refusals import assert_says

from hardcontact.base.random import generator
from hardcontact.surfaces.joined_spectrum import joined_spectrum
from hardcontact.surfaces.mean_spectrum import contradiction_lines, contradictions
from hardcontact.surfaces.spectrum import BIN_CENTRES

NAMES = ["large.spm", "small.spm", "line.txt"]


def test_a_half_decade_in_which_two_scans_differ_is_named():
    density = np.tile(uncd(BIN_CENTRES), (2, 1))
    wavelength = 2 * np.pi / BIN_CENTRES
    reliable = (wavelength > 50) & (wavelength < 5000) & np.ones((2, 1), bool)  # 20 bins
    density[1, (wavelength > 50) & (wavelength < 150)] *= 0.01  # a blunt tip
    (pair,) = contradictions(density, reliable, ["map", "map"], [50e3, 50e3])
    assert pair[:2] == (0, 1) and pair.factor == pytest.approx(100, rel=0.05)
    assert pair.longest < 160


def find_pairs(seed, heights=1.0):
    """Return the contradictions of three measurements, the second with multiplied heights."""
    scans = [
        map_of(generator(seed, 0), 128, 80.0, uncd),
        map_of(generator(seed, 1), 128, 16.0, uncd),
        line_of(generator(seed, 2), 2000, 20.0, uncd),
    ]
    scans[1] = replace(scans[1], heights=heights * scans[1].heights)
    spectrum = joined_spectrum(scans, [None] * 3)
    return contradictions(*(spectrum[name].values for name in ("psd", "reliable", "kind", "size")))


def test_scans_of_one_surface_agree_within_their_scatter_and_calibration():
    assert not any(find_pairs(seed) for seed in range(20))
    assert not any(find_pairs(seed, 1.1) for seed in range(5))  # a calibration of ten per cent


@pytest.mark.parametrize(("heights", "order"), [(10.0, [1, 0]), (0.1, [0, 1])])
def test_a_scan_of_other_heights_is_named_with_the_square_of_their_factor(heights, order):
    pairs = find_pairs(1, heights)
    assert [sorted(pair[:2]) for pair in pairs] in ([[0, 1], [1, 2]], [[1, 2], [0, 1]])
    large_and_small = next(pair for pair in pairs if set(pair[:2]) == {0, 1})
    assert list(large_and_small[:2]) == order and large_and_small.factor == pytest.approx(
        100, rel=0.4
    )
    assert (
        320 <= large_and_small.shortest < large_and_small.longest <= 2048 / 3
    )  # four pixels, a third of the size
    (line,) = contradiction_lines([large_and_small, pairs[1]], NAMES)
    assert_says(line, "large.spm", "small.spm", "contradict", "times", "more pairs that do: 1")
