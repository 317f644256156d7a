"""Repeated contact: the sphere loses volume, and indents stay."""

import numpy as np
import pytest
from periodic_maps import make_bodies, periodic_noise

from hardcontact.contact.bearing_area import all_lowest_gaps
from hardcontact.contact.geometry import gap_map
from hardcontact.contact.repeated_contact import indented_area_ratio, repeated_contacts


def rough_pair(window=320):
    """Bodies whose periods differ from each other and from the window."""
    return make_bodies(periodic_noise(128, 5.0, 1), periodic_noise(100, 0.5, 2), 20.0, window, 3)


def places(bodies):
    return np.stack(np.meshgrid(*[bodies.geometry.positions] * 2, indexing="ij"), -1).reshape(-1, 2)


def test_contact_at_the_same_place_leaves_the_indent_as_it_is():
    heights = np.zeros((128, 128))
    heights[60:68, 61:66] = 10.0 + np.random.default_rng(3).random((8, 5))
    bodies = make_bodies(heights, np.zeros((64, 64)), 5.0, 128, 1)
    contacts = repeated_contacts(bodies, [[64, 64]] * 4, 17)
    depths = [(depth.copy(), first_contact) for first_contact, depth in contacts]
    first_depth, first_contact = depths[0]
    assert (
        first_contact.gaps[-1] - first_contact.gaps[0] > 0.2 and np.count_nonzero(first_depth) == 16
    )
    for later_depth, later_contact in depths[1:]:
        np.testing.assert_allclose(later_depth, first_depth, atol=1e-12)
        assert later_contact.gaps[-1] == pytest.approx(first_contact.gaps[-1], abs=1e-12)


def test_a_flat_under_a_smooth_sphere_is_indented_once():
    # Every place of a flat is the same; the indent is the cap cut off at the bearing area.
    bodies = make_bodies(np.zeros((128, 128)), None, 20.0, 128, 4)
    (gaps, _) = all_lowest_gaps(bodies, 37)[0, 0]
    for contact, depth in repeated_contacts(bodies, places(bodies), 37):
        assert depth.sum() == pytest.approx((gaps[-1] - gaps).sum(), abs=1e-10)
        assert contact.gaps[-1] == pytest.approx(gaps[-1], abs=1e-12)


def test_the_sphere_loses_exactly_the_penetrating_volume():
    bodies = rough_pair()
    lost, previous_depth = 0.0, np.zeros((320, 320))
    for contact, depth in repeated_contacts(bodies, places(bodies), 40):
        lost += (contact.gaps[-1] - contact.gaps).sum()
        change = depth - previous_depth
        is_touched = np.zeros_like(change, bool)
        is_touched[tuple((contact.offsets + 160).T)] = True
        assert change.min() >= 0 and not change[~is_touched].any()
        previous_depth = depth.copy()
    assert previous_depth.sum() == pytest.approx(lost, rel=1e-12)


def test_each_contact_starts_from_the_sphere_after_the_previous_contact():
    # The gaps from the whole window, with the depth so far taken off the sphere.
    bodies, previous_depth = rough_pair(), np.zeros((320, 320))
    contacts = repeated_contacts(bodies, places(bodies), 40)
    for indices, (contact, depth) in zip(np.ndindex(3, 3), contacts, strict=True):
        gap = np.sort((gap_map(bodies, indices) + previous_depth).ravel())
        np.testing.assert_allclose(contact.gaps, gap[:40], atol=1e-10)
        previous_depth = depth.copy()


def test_indents_of_a_flat_all_overlap_and_those_of_rough_surfaces_partly():
    flat = make_bodies(np.zeros((64, 64)), None, 10.0, 128, 1)
    assert indented_area_ratio(flat, 4, np.random.default_rng(1), 9) == pytest.approx(1 / 9)
    uneven = make_bodies(periodic_noise(64, 3.0, 1), periodic_noise(64, 0.3, 51), 10.0, 128, 1)
    ratio = indented_area_ratio(uneven, 4, np.random.default_rng(1), 9)
    assert 1 / 9 < ratio <= 1
