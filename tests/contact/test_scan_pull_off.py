"""Pull-off of all scans on all scans of the sphere: every force, and NaN for missing scans."""

import numpy as np
import xarray as xr
from periodic_maps import CONTACT, make_bodies, periodic_noise

from hardcontact.base.dataset import stack
from hardcontact.contact.contact import CONTACT_AXES
from hardcontact.contact.pull_off import pull_off_dataset
from hardcontact.contact.scan_pull_off import pull_off_with_checks, stack_pull_off_forces

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


def forces_on_scan(value, pixels):
    """Return forces on one scan, with contacts by number."""
    return xr.Dataset(
        {
            "pull_off_force": (CONTACT_AXES, np.full((2, 2), value)),
            "contact_pixel_count": ("contact_model", [1, pixels], {"units": "1"}),
        },
        {axis: [0, 1] for axis in CONTACT_AXES},
        {"work_of_adhesion": 1.0},
    )


def test_forces_on_all_scans_are_stacked_with_nan_for_missing_scans():
    keys = [("a", 1, 1), ("a", 1, 2), ("b", 1, 1), ("b", 2, 1)]
    forces_by_key = {key: forces_on_scan(float(k), 10 + k) for k, key in enumerate(keys)}
    changes = {("a", 1): 0.1, ("b", 1): 0.2, ("b", 2): 0.3}
    scans = {
        scan: stack(
            {key[2:]: forces for key, forces in forces_by_key.items() if key[:2] == scan},
            ["sphere_scan"],
        ).assign(wider_window_change=((), change, {"units": "1"}))
        for scan, change in changes.items()
    }
    forces = stack_pull_off_forces(scans)
    for k, (surface, scan, sphere_scan) in enumerate(keys):
        labels = {"surface": surface, "scan": scan, "sphere_scan": sphere_scan}
        np.testing.assert_array_equal(forces.pull_off_force.sel(labels), k)
    assert np.isnan(forces.pull_off_force.sel(surface="a", scan=2)).all()
    assert forces.contact_pixel_count.values.tolist() == [1, 13]
    assert forces.wider_window_change.dims == ("surface", "scan")
    np.testing.assert_array_equal(forces.wider_window_change, [[0.1, np.nan], [0.2, 0.3]])
    assert forces.attrs["work_of_adhesion"] == 1.0
