"""The probe and where it touches: positions, common pixels, pairs of scans, its rough cap."""

import numpy as np
import pytest
from conftest import assert_says, heights, refusal

from hardcontact import contact, dataset, sphere

RADIUS = 250e3  # nm


def test_mirrored_contacts_of_the_array_are_all_different_places():
    # On a mirrored surface position p and n - 1 - p are alike; the array must not repeat itself.
    positions = sphere.contact_positions(1024, 20)
    folded = np.minimum(positions, 1023 - positions)
    assert len(np.unique(folded)) == 20
    assert np.diff(np.sort(folded)).min() >= 20


def test_common_pixels_interpolates_the_coarser_map():
    coarse, fine = 5.0 * heights(50, 50), heights(120, 120)
    substrate, roughness, pixel_size, stretch = sphere.common_pixels(coarse, 30.0, fine, 10.0)
    assert substrate.shape == (150, 150) and roughness.shape == (120, 120)
    assert pixel_size == 10.0 and stretch < 1e-12
    np.testing.assert_allclose(substrate[::3, ::3], coarse, atol=1e-5)
    # The apex lies in the middle of the sphere's scan, a quarter of its stitched period in.
    np.testing.assert_array_equal(roughness, np.roll(fine, (-30, -30), axis=(0, 1)))


def scans():
    """A substrate of 40 nm and a sphere of 25 nm a pixel."""
    return (
        dataset.height_map(values, pixel, periodic=True)
        for values, pixel in ((20.0 * heights(50, 50), 40.0), (heights(96, 96), 25.0))
    )


def test_a_pair_is_on_common_pixels_with_its_positions():
    substrate, rough = scans()
    found = sphere.pair(substrate, rough, 3000.0, 4)
    expected = sphere.common_pixels(substrate.heights.values, 40.0, rough.heights.values, 25.0)
    names = ("substrate", "roughness", "pixel_size", "stretch")
    for name, value in zip(names, expected, strict=True):
        np.testing.assert_array_equal(getattr(found, name), value)
    assert found.substrate.shape == (80, 80) and found.pixel_size == 25.0
    np.testing.assert_array_equal(found.positions, sphere.contact_positions(80, 4))
    assert found.window == sphere.window_pixels(3000.0, 25.0) == 120


def test_more_sampled_contacts_keep_the_fewer_and_none_comes_twice():
    few, more, every = (
        sphere.sampled_contacts(np.random.default_rng(3), 6, contacts) for contacts in (5, 20, 36)
    )
    np.testing.assert_array_equal(few, every[:5])
    np.testing.assert_array_equal(more, every[:20])
    assert {tuple(place) for place in every.tolist()} == set(np.ndindex(6, 6))
    other = sphere.sampled_contacts(np.random.default_rng(4), 6, 36)
    assert (other != every).any()


def test_more_contacts_than_there_are_is_refused():
    message = refusal(sphere.sampled_contacts, np.random.default_rng(0), 6, 37)
    assert_says(message, "at most 36 contacts", "found 37")


def test_a_sphere_without_roughness_is_its_paraboloid():
    pair = sphere.pair(*scans(), 3000.0, 4)._replace(roughness=np.zeros((96, 96)))
    found = sphere.rough_sphere(pair, RADIUS, (7, -30), 2)
    y, x = (np.arange(5)[:, None] + 5) * 25.0, (np.arange(5) - 32) * 25.0
    np.testing.assert_allclose(found, (y**2 + x**2) / (2 * RADIUS), rtol=1e-12)


@pytest.mark.parametrize("centre", [(0, 0), (7, -30), (-41, 44)])
def test_the_rough_sphere_is_the_gap_to_a_flat(centre):
    pair = sphere.pair(*scans(), 3000.0, 4)
    flat = np.zeros((80, 80))
    gap = contact.gap_map(flat, (3, 5), pair.pixel_size, RADIUS, 120, pair.roughness)
    rows, columns = (slice(60 + index - 10, 60 + index + 11) for index in centre)
    found = sphere.rough_sphere(pair, RADIUS, centre, 10)
    np.testing.assert_allclose(found, gap[rows, columns], atol=1e-12)
