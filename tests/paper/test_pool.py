"""Pools of scans: rms heights, and sets at interpolated heights."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from refusals import assert_says, refusal
from small_pool import CONTACT, HEIGHTS, RANGES, SUBSTITUTE, pool_of, raw_scan

from hardcontact.base.arrays import generator
from hardcontact.base.statistics import student_log_interval
from hardcontact.contact.geometry import join_bodies
from hardcontact.contact.pull_off import pull_off_dataset
from hardcontact.inference.fit import spline_weights
from hardcontact.paper.pool import pool_rms_heights, sample_pool_scans
from hardcontact.paper.sets import scale_to_sampled_mean
from hardcontact.surfaces.height_map import mirror_scan
from hardcontact.surfaces.metrics import TABLE1_METRICS, metrics

SCAN_NUMBERS = range(1, 7)


def test_heights_of_the_pool_cover_those_of_any_set():
    # A scan beside four equal scans is the farthest from the mean, in standard deviations.
    heights = np.array([0.0, 0.0, 0.0, 0.0, 1.0])
    reach = (heights.max() - heights.mean()) / heights.std(ddof=1)
    np.testing.assert_allclose(HEIGHTS[[0, -1]], [10 - 4 * reach, 10 + 4 * reach])
    np.testing.assert_allclose(np.diff(np.sqrt(HEIGHTS), 2), 0, atol=1e-12)
    np.testing.assert_array_equal(pool_rms_heights(SUBSTITUTE.targets, 1, 7), [10.0])


def test_interpolation_is_exact_at_computed_heights_and_for_cubics():
    np.testing.assert_allclose(spline_weights(HEIGHTS, HEIGHTS), np.eye(7), atol=1e-12)
    heights = np.array([4.0, 9.9, 16.0])

    def cubic(height):
        return 1 + height - 0.3 * height**2 + 0.02 * height**3

    np.testing.assert_allclose(spline_weights(HEIGHTS, heights) @ cubic(HEIGHTS), cubic(heights))
    single_height = spline_weights(np.array([10.0]), heights, extrapolate=True)
    np.testing.assert_array_equal(single_height, np.ones((3, 1)))


def test_a_scan_of_the_pool_does_not_depend_on_other_scans():
    forces = pool_of(3, 4)["log_force"]
    np.testing.assert_array_equal(pool_of(4)["log_force"].sel(scan=4), forces.sel(scan=4))
    assert not np.allclose(forces.sel(scan=3), forces.sel(scan=4))


def test_a_set_has_the_forces_and_roughness_of_its_scans_at_the_sampled_heights():
    sampled_set = sample_pool_scans(pool_of(*SCAN_NUMBERS), generator(1, "draw"), 5)
    assert len(set(sampled_set["number"].values)) == 5
    assert sampled_set["rms_height"].mean().item() == pytest.approx(10.0, rel=1e-12)
    assert sampled_set["rms_height"].std(ddof=1).item() == pytest.approx(4.0, rel=1e-12)
    for _, sampled_scan in sampled_set.groupby("scan"):
        scan = raw_scan(sampled_scan["number"].item())
        height = sampled_scan["rms_height"].item()
        scaled_scan = replace(scan, heights=scan.heights * height / scan.heights.std())
        scaled_metrics = metrics(scaled_scan)
        for name in TABLE1_METRICS.values():
            assert sampled_scan[name].item() == pytest.approx(scaled_metrics[name], rel=1e-9)
        bodies = join_bodies(mirror_scan(scaled_scan), None, CONTACT)
        computed = pull_off_dataset(bodies, CONTACT, RANGES)["pull_off_force"].values
        forces = sampled_scan["pull_off_force"].squeeze("scan")
        # Means are interpolated better than single forces, and best at the longest range.
        np.testing.assert_allclose(forces, computed, rtol=0.15)
        means = forces.mean(["contact_y", "contact_x"])
        np.testing.assert_allclose(means.sel(rho=5.6), computed[:, 2].mean(axis=(1, 2)), rtol=1e-3)
        np.testing.assert_allclose(means, computed.mean(axis=(2, 3)), rtol=0.03)


def test_sets_that_would_need_a_smoother_scan_are_sampled_again_or_refused():
    wide = pool_of(*SCAN_NUMBERS).assign_attrs(rms_height_deviation=6.5)
    lowest = wide["rms_height_of_force"].min().item()
    heights = np.array(
        [sample_pool_scans(wide, generator(3, n), 3)["rms_height"] for n in range(20)]
    )
    assert (heights >= lowest * (1 - 1e-9)).all()
    np.testing.assert_allclose(heights.std(axis=1, ddof=1), 6.5)
    message = refusal(
        sample_pool_scans, wide.assign_attrs(rms_height_deviation=30.0), generator(3), 5
    )
    assert_says(message, "expected sets of 5 scans", "10 +- 30 nm", "found none")


def measured_forces(scan_count):
    """Return log-normal forces on scans and two scans of the sphere, correlated along the range."""
    rng = np.random.default_rng(scan_count)
    scan_effect = rng.normal(size=(scan_count, 1, 1, 1, 1, 1)) * np.array([0.3, 0.6])[:, None, None]
    contact_effect = 0.5 * rng.normal(size=(scan_count, 2, 1, 1, 3, 3))
    forces = np.exp(scan_effect + contact_effect + np.log([1.0, 2.0])[:, None, None, None])
    axes = ("scan", "sphere_scan", "contact_model", "rho", "contact_y", "contact_x")
    return xr.DataArray(
        forces, {"contact_model": ["rigid", "plastic"], "rho": [1.0, 5.6]}, axes, name="forces"
    )


def test_sampled_means_of_measured_scans_spread_over_their_interval():
    forces = measured_forces(5)
    scan_means = forces.mean(["sphere_scan", "contact_y", "contact_x"])
    low, high = np.moveaxis(student_log_interval(scan_means, 0.9, "scan").values, -1, 0)
    sampled_forces = [scale_to_sampled_mean(forces, generator(5, n)) for n in range(400)]
    axes = ["scan", "sphere_scan", "contact_y", "contact_x"]
    means = np.array([set_forces.mean(axes) for set_forces in sampled_forces])
    share = ((means > low) & (means < high)).mean(axis=0)
    np.testing.assert_allclose(share, 0.9, atol=4 * np.sqrt(0.9 * 0.1 / 400))
