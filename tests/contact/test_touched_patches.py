"""Contacts touch one patch on a particle or a cap, and many on rough surfaces."""

from dataclasses import replace

import numpy as np
import pytest
from measurements import self_affine_heights

from hardcontact.base.arrays import generator
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import join_bodies
from hardcontact.contact.pull_off import pull_off_dataset
from hardcontact.surfaces.height_map import HeightMap, mirror_scan

PIXEL, PIXELS = 40.0, 128
CONTACT = Contact(radius=250e3, preload=10e-6, hardness=25e9, window=12500.0, contacts_per_row=8)
Y, X = np.indices((PIXELS, PIXELS)) * PIXEL


def count_patches(heights, contact=CONTACT):
    scan = mirror_scan(HeightMap(heights, PIXEL))
    bodies = join_bodies(scan, None, contact)
    return int(pull_off_dataset(bodies, contact, [5.6]).touched_patches)


def rough_heights(seed, rms_height):
    return self_affine_heights(generator(seed), PIXELS, PIXEL, rms_height)


@pytest.mark.parametrize("seed", range(4))
def test_contacts_touch_one_patch_on_a_particle_and_many_on_a_rough_surface(seed):
    x, y = generator(seed, "place").uniform(1000, 4000, 2)
    smoother_surface = rough_heights(seed, 1.5)
    particle = 200.0 * np.exp(-((X - x) ** 2 + (Y - y) ** 2) / (2 * 90.0**2))
    assert count_patches(smoother_surface + particle) == 1
    # 64 contacts share patches, the more, the rougher the surface is.
    assert count_patches(smoother_surface) > 20
    assert count_patches(rough_heights(seed, 5.0)) >= 8


def test_neighbouring_pixels_of_one_cap_are_one_patch():
    """On a cap of radius 20 µm the point of contact moves 7 % of the way of the sphere's apex."""
    squared_distance = (X - 2560) ** 2 + (Y - 2560) ** 2
    cap = np.maximum(150.0 - squared_distance / 40e3, 0)
    one_pixel = replace(CONTACT, preload=1e-9, contacts_per_row=32)
    assert count_patches(cap, one_pixel) == 1
