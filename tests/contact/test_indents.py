"""Indents of two bodies, and indents that are drawn by hand."""

from dataclasses import replace

import numpy as np
import pytest
from periodic_maps import CONTACT, periodic_map, periodic_noise

from hardcontact.contact.bearing_area import all_contact_pixels
from hardcontact.contact.geometry import join_bodies
from hardcontact.contact.indents import MAP_HALF_WIDTH, indent_sizes, indents_of_scans

SHAPE = {"scan": 2, "sphere_scan": 2, "preload": 2, "contact_y": 3, "contact_x": 3}


def test_indents_of_scans_equal_those_of_each_pair():
    substrates = {k: periodic_map(periodic_noise(128, 20.0, k), 8.0) for k in (1, 4)}
    spheres = {k: periodic_map(periodic_noise(128, 0.5, 10 + k), 8.0) for k in (2, 3)}
    indents = indents_of_scans(substrates, spheres, CONTACT, [10e-6, 40e-6])
    assert {name: indents.depth.sizes[name] for name in indents.depth.dims} == SHAPE
    bodies = join_bodies(substrates[4], spheres[2], CONTACT)
    contact_pixels = all_contact_pixels(bodies, replace(CONTACT, preload=40e-6).pixel_count(8.0))
    depth = indents.depth.sel(scan=4, sphere_scan=2, preload=40e-6).values
    expected_depth = contact_pixels.reference_gaps[..., -1] - contact_pixels.reference_gaps[..., 0]
    np.testing.assert_allclose(depth, expected_depth, rtol=0, atol=1e-12)
    # The maps are of the contact whose depth is the median of all 36.
    indentation = indents.indentation.sel(preload=40e-6)
    median_depth = np.sort(indents.depth.sel(preload=40e-6), axis=None)[18]
    assert indentation.max() == pytest.approx(median_depth, rel=1e-12)
    assert indentation[MAP_HALF_WIDTH, MAP_HALF_WIDTH] == indentation.max()
    assert indents.sphere_height.shape == (2 * MAP_HALF_WIDTH + 1,) * 2


def test_indents_drawn_by_hand_have_known_sizes():
    # A row of three pixels with one more at a corner, and a lone pixel. The first is the deepest.
    offsets = np.array([[10, 10], [10, 11], [40, 40], [10, 12], [11, 13]])
    gaps = np.array([-3.0, -2.5, -2.0, -1.5, -1.0])
    depth, equal_area_side, longer_side, count = indent_sizes(gaps, offsets, 5.0)
    assert (depth, count) == (2.0, 2)
    assert equal_area_side == pytest.approx(2 * 5.0)  # four pixels
    assert longer_side == 4 * 5.0
