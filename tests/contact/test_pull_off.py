"""Pull-off of two bodies against the direct sum over every pixel."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from direct_sum import direct_force, direct_total, gap_of_bodies
from periodic_maps import CONTACT, make_bodies, periodic_noise

from hardcontact.contact.pull_off import finer_pixel_ratio, pull_off_dataset, wider_window_change

RHOS = [1.0, 5.6]


def rough_bodies(seed=1):
    return make_bodies(
        periodic_noise(128, 20.0, seed), periodic_noise(128, 0.5, seed + 1), 8.0, 320, 3
    )


def test_the_pull_off_force_of_two_bodies_is_the_direct_sum_at_every_contact_and_range():
    bodies = rough_bodies()
    dataset = pull_off_dataset(bodies, CONTACT, RHOS)
    forces = dataset["pull_off_force"].values
    apex_heights = dataset["apex_height"].values
    count = CONTACT.pixel_count(8.0)
    assert forces.shape == (2, 2, 3, 3) and count == 7  # 400 nm² are 6.25 pixels
    assert dataset["contact_pixel_count"].values.tolist() == [1, count]
    for index in np.ndindex(3, 3):
        gap = gap_of_bodies(bodies, index)
        for model, contact_pixel_count in enumerate((1, count)):
            largest_gap = np.sort(gap, axis=None)[contact_pixel_count - 1]
            assert apex_heights[model][index] == pytest.approx(-largest_gap, abs=1e-9)
            for k, rho in enumerate(RHOS):
                direct_sum = direct_force(gap, contact_pixel_count, rho, 8.0)
                assert forces[model, k][index] == pytest.approx(direct_sum, rel=1e-9)


def test_the_change_by_a_wider_window_matches_the_direct_sum():
    all_bodies = [rough_bodies(seed) for seed in (1, 3)]
    count, rho = CONTACT.pixel_count(8.0), 5.6
    changes = []
    for bodies in all_bodies:
        wide_geometry = replace(bodies.geometry, window_pixels=320 + 2 * 128)
        wide_bodies = replace(bodies, geometry=wide_geometry)
        for index in np.ndindex(3, 3):
            narrow = direct_total(gap_of_bodies(bodies, index), count, rho)
            wide = direct_total(gap_of_bodies(wide_bodies, index), count, rho)
            changes.append(abs(wide / narrow - 1))
    forces = [pull_off_dataset(bodies, CONTACT, [rho]).pull_off_force for bodies in all_bodies]
    plastic_forces = xr.concat(forces, "sphere_scan").sel(contact_model="plastic", rho=rho)
    change = wider_window_change(iter(all_bodies), CONTACT, plastic_forces)
    assert change == pytest.approx(max(changes), rel=1e-6)


@pytest.mark.parametrize(("fine_pixels", "area_ratio"), [(1, 1 / 4), (4, 1), (40, 1)])
def test_finer_pixels_change_only_the_contact_area_at_a_small_range(fine_pixels, area_ratio):
    """At least one pixel of any size touches: one of 8 nm if one of 4 nm would suffice."""
    contact = replace(CONTACT, preload=fine_pixels / 4 * 25e9 * 64e-18, rho=0.02)
    forces = pull_off_dataset(rough_bodies(), contact, [contact.rho]).pull_off_force
    ratio = finer_pixel_ratio(rough_bodies(), contact, forces.sel(contact_model="plastic"))
    assert ratio == pytest.approx(area_ratio, rel=0.05)
