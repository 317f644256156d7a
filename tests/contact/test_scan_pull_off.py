"""Pull-off of one scan on all scans of the sphere has the forces on each of them."""

import numpy as np
from periodic_maps import CONTACT, make_bodies, periodic_noise

from hardcontact.contact.pull_off import pull_off_dataset
from hardcontact.contact.scan_pull_off import pull_off_with_checks

RANGES = [1.0, CONTACT.rho]
SUBSTRATE = periodic_noise(128, 20.0, 1)
#: Bodies on different pixels, as those of spheres with different pixel sizes.
BODIES_BY_SPHERE_SCAN = {
    3: make_bodies(SUBSTRATE, periodic_noise(128, 0.5, 2), 8.0, 320, 3),
    5: make_bodies(SUBSTRATE, periodic_noise(96, 0.5, 3), 6.0, 400, 3),
}


def test_the_forces_on_all_scans_are_joined_by_the_numbers_of_contacts():
    forces = pull_off_with_checks(BODIES_BY_SPHERE_SCAN, CONTACT, RANGES)
    assert forces["contact_x"].values.tolist() == [0, 1, 2]
    for number, bodies in BODIES_BY_SPHERE_SCAN.items():
        forces_on_sphere = pull_off_dataset(bodies, CONTACT, RANGES)["pull_off_force"]
        joined_forces = forces["pull_off_force"].sel(sphere_scan=number)
        np.testing.assert_array_equal(joined_forces, forces_on_sphere)


def test_a_smooth_sphere_and_the_effects_of_window_and_pixels_are_beside_the_forces():
    forces = pull_off_with_checks(BODIES_BY_SPHERE_SCAN, CONTACT, RANGES)
    smooth_bodies = make_bodies(SUBSTRATE, None, 8.0, 320, 3)
    smooth_forces = pull_off_dataset(smooth_bodies, CONTACT, RANGES)["pull_off_force"]
    np.testing.assert_allclose(
        forces["smooth_sphere_force"], smooth_forces.mean(["contact_y", "contact_x"])
    )
    assert forces["finer_pixel_ratio"].attrs["rho"] == min(RANGES)
    assert forces["wider_window_change"] > 0
