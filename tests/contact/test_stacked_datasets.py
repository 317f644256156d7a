"""Datasets of all surfaces have every number, and NaN for missing scans."""

import numpy as np
import xarray as xr

from hardcontact.base.dataset import stack
from hardcontact.contact import stacked_datasets

DESCRIBED = {"labels": {"a": "A", "b": "B"}, "source": {"a": "measured", "b": "substitute"}}
CONTACTS = ("contact_y", "contact_x")


def forces_on_scan(value, pixels):
    """Return forces on one scan, with contacts by number."""
    return xr.Dataset(
        {
            "pull_off_force": (CONTACTS, np.full((2, 2), value)),
            "contact_pixel_count": ("contact_model", [1, pixels], {"units": "1"}),
        },
        {axis: [0, 1] for axis in CONTACTS},
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
    forces = stacked_datasets.stack_pull_off_forces(scans, DESCRIBED)
    for k, (surface, scan, sphere_scan) in enumerate(keys):
        labels = {"surface": surface, "scan": scan, "sphere_scan": sphere_scan}
        np.testing.assert_array_equal(forces.pull_off_force.sel(labels), k)
    assert np.isnan(forces.pull_off_force.sel(surface="a", scan=2)).all()
    assert forces.contact_pixel_count.values.tolist() == [1, 13]
    assert forces.wider_window_change.dims == ("surface", "scan")
    np.testing.assert_array_equal(forces.wider_window_change, [[0.1, np.nan], [0.2, 0.3]])
    assert forces.label.values.tolist() == ["A", "B"]
    assert forces.source.values.tolist() == ["measured", "substitute"]
    assert forces.attrs["work_of_adhesion"] == 1.0
