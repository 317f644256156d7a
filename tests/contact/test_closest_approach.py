"""Closest approach by dilation against the search of each contact and against every pixel."""

from dataclasses import replace

import numpy as np
import pytest
from periodic_maps import over, periodic_noise

from hardcontact.contact.bearing_area import all_lowest_gaps, stacked_gaps
from hardcontact.contact.closest_approach import closest_gaps, touching_pixels
from hardcontact.contact.geometry import ContactGeometry, gap_map


@pytest.mark.parametrize("pixels", [30, 33])
@pytest.mark.parametrize("window", [8, 30, 34, 90])
@pytest.mark.parametrize("rms", [0.1, 5.0, 200.0])
def test_every_position_is_the_minimum_over_every_pixel_of_its_window(pixels, window, rms):
    pair = over(periodic_noise(pixels, rms, 1), None, 20.0, window, 2)
    everywhere = replace(pair.geometry, positions=np.arange(pixels))
    gaps = closest_gaps(pair.substrate.heights, everywhere)
    bodies = replace(pair, geometry=everywhere)
    expected = [gap_map(bodies, place).min() for place in np.ndindex(pixels, pixels)]
    np.testing.assert_allclose(gaps.ravel(), expected, rtol=0, atol=1e-12 * (1 + rms))


@pytest.mark.parametrize("contacts", [1, 2, 7])
def test_an_array_is_that_of_the_search_bit_by_bit(contacts):
    heights = periodic_noise(256, 60.0, 3).astype("float32")
    pair = over(heights, None, 5.0, 700, contacts)
    searched = stacked_gaps(all_lowest_gaps(pair, 1), pair.geometry)[..., 0]
    np.testing.assert_array_equal(closest_gaps(heights, pair.geometry), searched)


def test_the_touching_pixel_is_the_peak_that_stands_alone():
    heights = np.zeros((40, 40))
    heights[7, 31] = 100.0
    rows, columns = touching_pixels(heights, ContactGeometry(250e3, 20.0, 100, np.arange(40)))
    assert set(np.unique(rows % 40)) == {7} and set(np.unique(columns % 40)) == {31}
    offsets = rows - np.arange(40)[:, None]
    assert offsets.min() == -20 and offsets.max() == 19  # the nearest image, half a period away


def test_a_sphere_touches_a_plane_below_its_apex():
    geometry = ContactGeometry(250e3, 20.0, 100, np.arange(16))
    gaps = closest_gaps(np.zeros((16, 16)), geometry)
    np.testing.assert_array_equal(gaps, 0.0)
