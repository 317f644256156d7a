"""Scans of one area are recognised after shifts, noise and levelling; other areas are not."""

import numpy as np
import pytest
from measurements import measurement, self_affine_heights

from hardcontact.base.arrays import generator
from hardcontact.scans.repeated_scans import coarse_map, earlier_scans_of_areas, show_same_area
from hardcontact.surfaces.levelling import level, level_lines

PIXELS, PIXEL = 128, 10.0


def large_map(seed, hurst=0.8, rolloff=1e9):
    return self_affine_heights(generator(seed), 3 * PIXELS, PIXEL, 20.0, hurst, rolloff)


def coarse(heights, pixel_size=PIXEL, levelling=level):
    return coarse_map(levelling(measurement(heights, pixel_size)))


def cut(heights, y=0, x=0, side=PIXELS):
    return heights[y : y + side, x : x + side]


@pytest.mark.parametrize("hurst", [0.5, 0.9])
def test_copies_of_an_area_are_recognised(hurst):
    surface = large_map(1, hurst)
    trace = coarse(cut(surface))
    noise = generator(2).standard_normal((PIXELS, PIXELS))
    y = np.arange(PIXELS)[:, None]
    for copy in (
        coarse(cut(surface, x=3) + noise),  # retrace
        coarse(cut(surface, 20, 15) + 0.3 * y),  # drift and tilt
        coarse(cut(surface), levelling=level_lines),
        coarse(cut(surface)[::2, ::2], 2 * PIXEL),
        coarse(cut(surface, 5, 5, 7 * PIXELS // 8)),
    ):
        assert show_same_area(trace, copy) and show_same_area(copy, trace)


@pytest.mark.parametrize(("hurst", "rolloff"), [(0.5, 1e9), (1.0, 1e9), (0.8, PIXELS * PIXEL / 8)])
def test_other_areas_are_not_the_same(hurst, rolloff):
    surface = large_map(3, hurst, rolloff)
    areas = [coarse(cut(surface, y, x)) for y in (0, 128, 256) for x in (0, 128, 256)]
    assert earlier_scans_of_areas(areas) == [None] * 9
    assert earlier_scans_of_areas([*areas[:2], areas[0]]) == [None, None, 0]


def test_flat_maps_are_no_copies():
    flat, step = np.zeros((PIXELS, PIXELS)), np.zeros((PIXELS, PIXELS))
    step[:5] = 3.0
    assert not show_same_area(coarse(flat), coarse(step))


def test_gratings_and_lays_resemble_themselves_everywhere():
    grating = 20 * np.sin(np.arange(3 * PIXELS) * 2 * np.pi / 12)
    lay = large_map(5)[0]
    for lines in (grating, lay, lay[:, None]):
        surface = large_map(4) / 20 + lines
        assert not show_same_area(coarse(cut(surface)), coarse(cut(surface, 250, 220)))
