"""Contact pixels have the smallest gaps of the window, and their area carries the load."""

import numpy as np
import pytest
from direct_sum import gap_of_bodies
from periodic_maps import MAP_CASES, make_bodies, periodic_noise

from hardcontact.contact.bearing_area import all_contact_pixels
from hardcontact.contact.contact import Contact


@pytest.mark.parametrize("case", MAP_CASES)
@pytest.mark.parametrize("contact_pixel_count", [1, 9000])
@pytest.mark.parametrize("rough", [False, True])
def test_contact_pixels_equal_those_of_the_whole_window(case, contact_pixel_count, rough):
    pixels, pixel_size, rms, period, window = case
    roughness = periodic_noise(period, 0.5, 2) if rough else None
    bodies = make_bodies(periodic_noise(pixels, rms, 1), roughness, pixel_size, window, 3)
    contact_pixels = all_contact_pixels(bodies, contact_pixel_count)
    for index in np.ndindex(contact_pixels.reference_gaps.shape[:2]):
        gaps, offsets = contact_pixels.reference_gaps[index], contact_pixels.offsets[index]
        window_gaps = gap_of_bodies(bodies, index)
        smallest_gaps = np.sort(window_gaps, axis=None)[:contact_pixel_count]
        np.testing.assert_allclose(gaps, smallest_gaps, atol=1e-9)
        np.testing.assert_allclose(window_gaps[tuple((offsets + window // 2).T)], gaps, atol=1e-9)
        assert len(np.unique(offsets, axis=0)) == contact_pixel_count


def test_contact_pixels_are_the_load_over_hardness_and_pixel_area():
    contact = Contact(radius=250e3, preload=10e-6, hardness=25e9)
    assert contact.pixel_count(2500 / 512) == 17  # 16.8 rounded up
    assert contact.pixel_count(5000 / 8192) == 1074  # 1073.7 rounded up
    assert contact.pixel_count(20.0) == 1  # 400 nm² is one pixel
    assert contact.area == pytest.approx(400.0)
