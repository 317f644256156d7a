"""Pull-off of all scans on all scans of the sphere: every force, and NaN for missing scans."""

import numpy as np
from periodic_maps import CONTACT, make_bodies, periodic_noise

from hardcontact.contact.pull_off import (
    pull_off_dataset,
    pull_off_with_checks,
    stack_pull_off_forces,
)

RANGES = [1.0, CONTACT.rho]
SUBSTRATE = periodic_noise(128, 20.0, 1)
#: Bodies on different pixels, as those of spheres with different pixel sizes.
BODIES_BY_SPHERE_SCAN = {
    3: make_bodies(SUBSTRATE, periodic_noise(128, 0.5, 2), 8.0, 320, 3),
    5: make_bodies(SUBSTRATE, periodic_noise(96, 0.5, 3), 6.0, 400, 3),
}


def test_a_smooth_sphere_and_the_effects_of_window_and_pixels_are_beside_the_forces():
    forces = pull_off_with_checks(BODIES_BY_SPHERE_SCAN, CONTACT, RANGES)
    smooth_bodies = make_bodies(SUBSTRATE, None, 8.0, 320, 3)
    smooth_forces = pull_off_dataset(smooth_bodies, CONTACT, RANGES)["pull_off_force"]
    np.testing.assert_allclose(
        forces["smooth_sphere_force"], smooth_forces.mean(["contact_y", "contact_x"])
    )
    assert forces["finer_pixel_ratio"].attrs["rho"] == min(RANGES)
    assert forces["wider_window_change"] > 0


def test_stacked_scans_are_nan_where_scans_are_missing_and_have_the_largest_pixel_count():
    scans = {
        ("a", 1): pull_off_with_checks(BODIES_BY_SPHERE_SCAN, CONTACT, RANGES),
        ("b", 2): pull_off_with_checks({3: BODIES_BY_SPHERE_SCAN[3]}, CONTACT, RANGES),
    }
    forces = stack_pull_off_forces(scans)
    for (surface, scan), scan_forces in scans.items():
        stacked = forces.sel(surface=surface, scan=scan, sphere_scan=scan_forces.sphere_scan)
        np.testing.assert_array_equal(stacked.pull_off_force, scan_forces.pull_off_force)
    assert forces.pull_off_force.sel(surface="a", scan=2).isnull().all()
    assert forces.pull_off_force.sel(surface="b", scan=2, sphere_scan=5).isnull().all()
    # 400 nm² carry the preload: 6.25 pixels of 8 nm, 11.1 pixels of 6 nm.
    assert forces.contact_pixel_count.values.tolist() == [1, 12]
    assert forces.wider_window_change.dims == ("surface", "scan")
    assert forces.attrs["work_of_adhesion"] == 1.0
