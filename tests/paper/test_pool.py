"""Pools of scans: heights, forces against the direct sum, interpolation between heights."""

import numpy as np
import pytest
from direct_sum import direct_force, gap_to_sphere, mirror
from small_pool import CONTACT, GRID, HEIGHTS, RANGES, SUBSTITUTE, pool_of, raw_scan

from hardcontact.contact.pull_off import spline_weights
from hardcontact.paper.pool import pool_heights
from hardcontact.surfaces.metrics import TABLE1_METRICS, metrics


@pytest.fixture
def pool():
    return pool_of(3, 4)


def test_heights_of_the_pool_cover_those_of_any_set():
    # One scan differs from four equal scans: it is (n - 1)/sqrt(n) deviations from the mean.
    sample = np.array([0.0, 0.0, 0.0, 0.0, 1.0])
    reach = (sample.max() - sample.mean()) / sample.std(ddof=1)
    np.testing.assert_allclose(HEIGHTS[[0, -1]], [10 - 4 * reach, 10 + 4 * reach])
    np.testing.assert_allclose(np.diff(np.sqrt(HEIGHTS), 2), 0, atol=1e-12)
    np.testing.assert_array_equal(pool_heights(SUBSTITUTE.targets, 1, 7), [10.0])


def test_interpolation_is_exact_at_its_heights_and_of_cubics():
    np.testing.assert_allclose(spline_weights(HEIGHTS, HEIGHTS), np.eye(7), atol=1e-12)
    heights = np.array([4.0, 9.9, 16.0])

    def cubic(height):
        return 1 + height - 0.3 * height**2 + 0.02 * height**3

    np.testing.assert_allclose(spline_weights(HEIGHTS, heights) @ cubic(HEIGHTS), cubic(heights))
    single_height = spline_weights(np.array([10.0]), heights, extrapolate=True)
    np.testing.assert_array_equal(single_height, np.ones((3, 1)))


def test_forces_are_the_direct_sum_over_the_scan_at_each_height(pool):
    count = CONTACT.pixel_count(GRID.pixel_size)
    scan = raw_scan(4)
    assert count > 1
    forces = np.exp(pool["log_force"].sel(scan=4).values.astype(float))
    window = round(CONTACT.window / GRID.pixel_size)
    for i in (0, 6):
        heights = mirror(HEIGHTS[i] / scan.heights.std() * scan.heights)
        # Contacts of two per row begin a quarter of a step from the border.
        gap = gap_to_sphere(heights, (16, 80), window, GRID.pixel_size, CONTACT.radius)
        for k, rho in enumerate(RANGES):
            for model, pixels in enumerate((1, count)):
                force = direct_force(gap, pixels, rho, GRID.pixel_size)
                assert forces[i, model, k, 0, 1] == pytest.approx(force, rel=1e-5)


def test_the_pool_has_the_roughness_of_the_unscaled_scans(pool):
    values = metrics(raw_scan(3))
    for name in TABLE1_METRICS.values():
        assert pool[name].sel(scan=3).item() == pytest.approx(values[name], rel=1e-12)
    assert pool.attrs == {"mean_rms_height": 10.0, "rms_height_deviation": 4.0}


def test_a_scan_does_not_depend_on_the_other_scans(pool):
    single = pool_of(4)
    np.testing.assert_array_equal(single["log_force"].sel(scan=4), pool["log_force"].sel(scan=4))
    assert not np.allclose(pool["log_force"].sel(scan=3), pool["log_force"].sel(scan=4))
