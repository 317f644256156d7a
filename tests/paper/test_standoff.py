"""Heights of the apex of the sphere that give a force, and NaN if no height gives it."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from hardcontact.paper.standoff import apex_height, infer_apex_heights

RADIUS = 250e3


@pytest.mark.parametrize(("rms_height", "height", "rho"), [(3.2, 12.7, 5.6), (17.0, 55.0, 8.0)])
def test_the_height_gives_the_mean_attraction_of_random_points_below_the_sphere(
    rms_height, height, rho
):
    points = np.random.default_rng(1).normal(0, rms_height, 4_000_000)
    share = np.where(points < height, np.exp((points - height) / rho), 0).mean()
    assert apex_height(share, rms_height, rho) == pytest.approx(height, rel=2e-3)
    assert np.isnan(apex_height(2.0, rms_height, rho))


def test_without_roughness_the_height_follows_the_exponential():
    share = 8.8e-6 / (2 * np.pi * RADIUS * 1e-9 * 0.0463)
    assert apex_height(share, 0.01, 5.6) == pytest.approx(-5.6 * np.log(share), rel=1e-3)


def test_equal_forces_have_equal_heights():
    forces = np.array([[2e-4, 3e-4], [1e-5, 4e-5]])  # (surface, rho) in N at 1 J/m²
    axes = ("surface", "scan", "sphere_scan", "rho", "contact_y", "contact_x")
    adhesion = xr.Dataset(
        {
            "pull_off_force": (axes, forces.reshape(2, 1, 1, 2, 1, 1)),
            "label": ("surface", ["A", "B"]),
            "basis": ("surface", ["substitute"] * 2),
        },
        {"surface": ["a", "b"], "rho": [2.0, 5.6]},
        {"sphere_radius": RADIUS},
    )
    published = pd.DataFrame({"mean_force": 0.05 * forces[:, 1]}, index=["a", "b"])
    published["median_force"] = published["mean_force"] / 2
    heights = infer_apex_heights(adhesion, published, 0.05, pd.Series({"a": 3.0, "b": 20.0}))
    pair_heights = heights.sel(rho=5.6)
    for work in ("published", "fitted"):
        required = pair_heights["height_from_published"].sel(work_source=work)
        np.testing.assert_allclose(
            required.sel(statistic="mean"),
            pair_heights["height_from_computed"].sel(statistic="mean"),
        )
        assert (required.sel(statistic="median") > required.sel(statistic="mean")).all()
