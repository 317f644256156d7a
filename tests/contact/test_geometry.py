"""Positions of contacts, common pixels of two scans, heights of any type, and squares of gaps."""

import numpy as np
import pytest
from periodic_maps import RADIUS, periodic_map, periodic_noise

from hardcontact.contact import geometry
from hardcontact.contact.contact import Contact
from hardcontact.contact.pull_off import forces_at_loadings

CONTACT = Contact(radius=RADIUS, preload=1e-5, hardness=25e9, window=3000.0, contacts_per_row=4)


def heights(pixels):
    return np.random.default_rng(1).standard_normal((pixels, pixels))


def test_contacts_on_a_mirrored_surface_never_repeat_a_position():
    # On a mirrored surface the positions p and n - 1 - p are alike.
    positions = geometry.contact_positions(1024, 20)
    folded = np.minimum(positions, 1023 - positions)  # in steps of 25 or 26 pixels
    assert len(np.unique(folded)) == 20
    assert np.diff(np.sort(folded)).min() >= 20


def test_the_coarser_map_is_interpolated():
    coarse, fine = 5.0 * heights(50), heights(120)
    bodies = geometry.join_bodies(periodic_map(coarse, 30.0), periodic_map(fine, 10.0), CONTACT)
    assert bodies.substrate.pixels == 150 and bodies.sphere_roughness.pixels == 120
    assert bodies.geometry.pixel_size == 10.0
    np.testing.assert_allclose(bodies.substrate.heights[::3, ::3], coarse, atol=1e-5)
    # The apex lies in the middle of the sphere's scan, a quarter of its mirrored period in.
    shifted = np.roll(fine, (-30, -30), axis=(0, 1))
    np.testing.assert_array_equal(bodies.sphere_roughness.heights, shifted)
    np.testing.assert_array_equal(
        bodies.geometry.contact_positions, geometry.contact_positions(150, 4)
    )
    assert bodies.geometry.window_pixels == 300


def test_more_sampled_contacts_include_the_fewer_and_never_repeat():
    all_contacts = geometry.sample_contacts(np.random.default_rng(3), 6, 36)
    assert {tuple(contact) for contact in all_contacts.tolist()} == set(np.ndindex(6, 6))
    for count in (5, 20, 37):
        contacts = geometry.sample_contacts(np.random.default_rng(3), 6, count)
        np.testing.assert_array_equal(contacts, all_contacts[:count])


@pytest.mark.parametrize("dtype", [np.float32, ">f4", ">f8", np.float16, np.int64])
def test_heights_of_any_dtype_have_their_force(dtype):
    """Programs and classic netCDF files bring heights in other types and byte orders."""
    whole_numbers = np.round(periodic_noise(96, 20.0, 5))  # Every type holds them.
    contact = Contact(radius=250e3, preload=1e-6, hardness=25e9, window=4800.0, contacts_per_row=3)

    def forces(values):
        surface = periodic_map(values, 50.0)
        all_bodies = [geometry.join_bodies(surface, sphere, contact) for sphere in (surface, None)]
        return [forces_at_loadings(bodies, [contact], [5.6]) for bodies in all_bodies]

    np.testing.assert_allclose(
        forces(whole_numbers.astype(dtype)), forces(whole_numbers), rtol=1e-6
    )


@pytest.mark.parametrize("pixels", [3, 4, 9])
def test_the_square_around_the_lowest_point_ends_at_the_edges(pixels):
    for y, x in np.ndindex(9, 9):
        gap = np.arange(1.0, 82.0).reshape(9, 9)
        gap[y, x] = 0.0
        row = min(max(y - pixels // 2, 0), 9 - pixels)
        column = min(max(x - pixels // 2, 0), 9 - pixels)
        expected = gap[row : row + pixels, column : column + pixels]
        np.testing.assert_array_equal(geometry.square_around_lowest(gap, pixels), expected)
