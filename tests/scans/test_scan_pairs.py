"""Scans of one area are recognised, and scans of different surfaces contradict each other."""

from dataclasses import replace

import numpy as np
import pytest
from measurements import measurement, random_line, random_map, self_affine_heights, uncd_density
from refusals import assert_says

from hardcontact.base.arrays import generator
from hardcontact.scans.joined_spectrum import joined_spectrum
from hardcontact.scans.scan_pairs import (
    coarse_map,
    describe_contradictions,
    earlier_scans_of_areas,
    find_contradictions,
    have_same_area,
)
from hardcontact.surfaces.levelling import level_lines, level_plane
from hardcontact.surfaces.spectrum import BIN_CENTRES

PIXELS, PIXEL = 128, 10.0  # nm


def large_heights(seed, hurst=0.8, rolloff=1e9):
    """Heights in nm of three times PIXELS per row, by default without a roll-off."""
    return self_affine_heights(generator(seed), 3 * PIXELS, PIXEL, 20.0, hurst, rolloff)


def coarse(heights, pixel_size=PIXEL, levelling=level_plane):
    return coarse_map(levelling(measurement(heights, pixel_size)))


def cut(heights, y=0, x=0, side=PIXELS):
    return heights[y : y + side, x : x + side]


@pytest.mark.parametrize("hurst", [0.5, 0.9])
def test_copies_of_an_area_are_recognised(hurst):
    surface = large_heights(1, hurst)
    trace = coarse(cut(surface))
    noise = generator(2).standard_normal((PIXELS, PIXELS))
    y = np.arange(PIXELS)[:, None]
    for copy in (
        coarse(cut(surface, x=3) + noise),  # retrace
        coarse(cut(surface, 20, 15) + 0.3 * y),  # drift and tilt
        coarse(cut(surface), levelling=level_lines),
        coarse(cut(surface)[::2, ::2], 2 * PIXEL),
        coarse(cut(surface, 5, 5, 7 * PIXELS // 8)),  # a smaller scan
    ):
        assert have_same_area(trace, copy) and have_same_area(copy, trace)


@pytest.mark.parametrize(("hurst", "rolloff"), [(0.5, 1e9), (1.0, 1e9), (0.8, PIXELS * PIXEL / 8)])
def test_other_areas_are_not_the_same(hurst, rolloff):
    surface = large_heights(3, hurst, rolloff)
    areas = [coarse(cut(surface, y, x)) for y in (0, 128, 256) for x in (0, 128, 256)]
    assert earlier_scans_of_areas(areas) == [None] * 9
    assert earlier_scans_of_areas([*areas[:2], areas[0]]) == [None, None, 0]


def test_flat_maps_are_no_copies():
    flat, step = np.zeros((PIXELS, PIXELS)), np.zeros((PIXELS, PIXELS))
    step[:5] = 3.0
    assert not have_same_area(coarse(flat), coarse(step))


def test_areas_of_one_grating_or_lay_are_not_the_same():
    grating = 20 * np.sin(np.arange(3 * PIXELS) * 2 * np.pi / 12)
    lay = large_heights(5)[0]
    for lines in (grating, lay, lay[:, None]):
        surface = large_heights(4) / 20 + lines
        assert not have_same_area(coarse(cut(surface)), coarse(cut(surface, 250, 220)))


# Contradictions


def test_a_half_decade_in_which_two_scans_differ_is_named():
    density = np.tile(uncd_density(BIN_CENTRES), (2, 1))
    wavelength = 2 * np.pi / BIN_CENTRES
    reliable = (wavelength > 50) & (wavelength < 5000) & np.ones((2, 1), bool)  # 20 bins
    density[1, (wavelength > 50) & (wavelength < 150)] /= 100  # a blunt tip
    (contradiction,) = find_contradictions(density, reliable, ["map", "map"], [50e3, 50e3])
    assert (contradiction.higher, contradiction.lower) == (0, 1)
    assert contradiction.factor == pytest.approx(100, rel=1e-12)
    assert contradiction.wavelengths[1] < 150


def simulate_contradictions(seed, height_factor=1.0):
    """Return the contradictions of three measurements, the second with multiplied heights."""
    scans = [
        random_map(generator(seed, 0), 128, 80.0, uncd_density),
        random_map(generator(seed, 1), 128, 16.0, uncd_density),
        random_line(generator(seed, 2), 2000, 20.0, uncd_density),
    ]
    scans[1] = replace(scans[1], heights=height_factor * scans[1].heights)
    spectrum = joined_spectrum(scans, [None] * 3)
    return find_contradictions(
        *(spectrum[name].values for name in ("psd", "reliable", "kind", "size"))
    )


def test_scans_of_one_surface_agree_within_their_scatter_and_calibration():
    assert not any(simulate_contradictions(seed) for seed in range(8))
    assert not any(simulate_contradictions(seed, 1.1) for seed in range(3))  # 10 % calibration


@pytest.mark.parametrize(("height_factor", "higher"), [(10.0, 1), (0.1, 0)])
def test_a_scan_of_wrong_heights_is_named_with_the_square_of_their_factor(height_factor, higher):
    contradictions = simulate_contradictions(1, height_factor)
    pairs = [{pair.higher, pair.lower} for pair in contradictions]
    assert sorted(map(sorted, pairs)) == [[0, 1], [1, 2]]
    large_and_small = contradictions[pairs.index({0, 1})]
    assert large_and_small.higher == higher
    assert large_and_small.factor == pytest.approx(100, rel=0.4)
    shortest, longest = large_and_small.wavelengths
    assert 320 <= shortest < longest <= 2048 / 3  # four pixels, a third of the size
    (other,) = (pair for pair in contradictions if pair is not large_and_small)
    names = ["large.spm", "small.spm", "line.txt"]
    line = describe_contradictions([large_and_small, other], names)
    assert_says(line, "large.spm", "small.spm", "contradict", "times", "more pairs that do: 1")
