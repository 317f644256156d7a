"""Scans are levelled as by SurfaceTopography, line by line, or after a sphere is removed."""

import numpy as np
import pytest

from hardcontact.surfaces.height_map import HeightMap, to_surface_topography
from hardcontact.surfaces.levelling import level_lines, level_plane, remove_form

RADIUS = 250e3  # nm


@pytest.mark.parametrize("shape", [(64, 64), (9, 12)])
@pytest.mark.parametrize("dtype", [np.float32, float])
def test_levelling_equals_that_of_surface_topography(shape, dtype):
    heights = np.random.default_rng(0).standard_normal(shape).cumsum(0).astype(dtype)
    scan = HeightMap(heights, 10.0)
    library_heights = to_surface_topography(scan).detrend("height").heights().T
    np.testing.assert_array_equal(level_plane(scan).heights, library_heights)


def test_levelling_by_lines_subtracts_a_fit_and_a_median_from_each_line():
    heights = np.random.default_rng(4).standard_normal((24, 24)).cumsum(axis=0).cumsum(axis=1)
    x = np.arange(24)
    lines = [line - np.polyval(np.polyfit(x, line, 1), x) for line in heights]
    aligned = np.array([line - np.median(line) for line in lines])
    levelled = level_plane(HeightMap(aligned, 10.0)).heights
    np.testing.assert_allclose(level_lines(HeightMap(heights, 10.0)).heights, levelled, atol=1e-9)


def test_a_sphere_is_removed_wherever_its_apex_lies():
    wave = np.cos(2 * np.pi * np.arange(64) * 8 / 64) * np.ones((64, 1))
    y, x = (np.mgrid[:64, :64] - 20.3) * 40.0  # The apex is at y = 500 nm, x = 0.
    sphere = HeightMap(wave - (x**2 + (y - 500) ** 2) / (2 * RADIUS), 40.0)
    flat = remove_form(sphere, RADIUS)
    np.testing.assert_allclose(flat.heights, level_plane(HeightMap(wave, 10.0)).heights, atol=1e-8)
