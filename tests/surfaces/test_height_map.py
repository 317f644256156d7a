"""Height maps: planes, spheres, mirrors, metrics with known answers, maps as they are stored."""

import numpy as np
import pytest
from refusals import assert_says, refusal
from scan_files import truncate_file
from scipy import stats

from hardcontact.base import dataset
from hardcontact.surfaces.height_map import (
    HeightMap,
    level,
    level_lines,
    metrics,
    mirror_stitch,
    read_height_map,
    remove_form,
    to_surface_topography,
)

RADIUS = 250e3


def scan_of(heights, pixel_size=10.0):
    return HeightMap(heights, pixel_size, periodic=False, basis="measured")


def test_a_map_is_read_back_as_it_was_written(tmp_path):
    heights = np.random.default_rng(0).standard_normal((8, 12))
    surface = HeightMap(heights, 2500 / 512, periodic=True, basis="measured")
    dataset.write(surface.to_dataset(), tmp_path / "a.nc")
    read_scan = read_height_map(tmp_path / "a.nc")
    np.testing.assert_array_equal(read_scan.heights, heights)
    assert (read_scan.pixel_size, read_scan.periodic, read_scan.basis) == (
        2500 / 512,
        True,
        "measured",
    )
    message = refusal(read_height_map, truncate_file(tmp_path / "a.nc", 0.5))
    assert_says(message, "a.nc: expected a complete netCDF file, found")


@pytest.mark.parametrize("shape", [(64, 64), (9, 12)])
@pytest.mark.parametrize("dtype", [np.float32, float])
def test_levelling_equals_that_of_surface_topography(shape, dtype):
    scan = scan_of(np.random.default_rng(0).standard_normal(shape).cumsum(0).astype(dtype))
    library_heights = to_surface_topography(scan).detrend("height").heights().T
    np.testing.assert_array_equal(level(scan).heights, library_heights)


def test_levelling_by_lines_subtracts_a_fit_and_a_median_from_each_line():
    heights = np.random.default_rng(4).standard_normal((24, 24)).cumsum(axis=0).cumsum(axis=1)
    x = np.arange(24)
    lines = [line - np.polyval(np.polyfit(x, line, 1), x) for line in heights]
    aligned = np.array([line - np.median(line) for line in lines])
    levelled = level(scan_of(aligned)).heights
    np.testing.assert_allclose(level_lines(scan_of(heights)).heights, levelled, atol=1e-9)


def test_a_sphere_is_removed_wherever_its_apex_lies():
    wave = np.cos(2 * np.pi * np.arange(64) * 8 / 64) * np.ones((64, 1))
    y, x = (np.mgrid[:64, :64] - 20.3) * 40.0
    sphere = scan_of(wave - (x**2 + (y - 500) ** 2) / (2 * RADIUS), 40.0)
    flat = remove_form(sphere, RADIUS)
    np.testing.assert_allclose(flat.heights, level(scan_of(wave)).heights, atol=1e-8)


def test_a_stitched_map_is_mirror_symmetric():
    scan = scan_of(np.random.default_rng(0).standard_normal((7, 7)))
    stitched = mirror_stitch(scan)
    assert stitched.heights.shape == (14, 14) and stitched.periodic
    np.testing.assert_array_equal(stitched.heights[:7, :7], scan.heights)
    for axis in (0, 1):
        mirrored = np.flip(stitched.heights, axis)
        np.testing.assert_array_equal(stitched.heights, mirrored)


def test_a_wave_has_the_metrics_in_closed_form():
    pixels, pixel_size, amplitude, order = 256, 3.0, 2.0, 16
    wave = amplitude * np.sin(2 * np.pi * order * np.arange(pixels) / pixels)
    values = metrics(scan_of(wave * np.ones((pixels, 1)), pixel_size))
    rms, difference = amplitude / 2**0.5, 2 * np.sin(np.pi * order / pixels) / pixel_size
    assert values["rms_height"] == pytest.approx(rms)
    assert values["rms_gradient"] == pytest.approx(rms * difference, rel=0.01)
    assert values["rms_profile_slope"] == pytest.approx(rms * difference, rel=0.01)
    assert values["rms_laplacian"] == pytest.approx(rms * difference**2, rel=0.01)
    assert values["kurtosis"] == pytest.approx(1.5) and values["skewness"] == pytest.approx(0)
    assert values["peak_to_valley"] == pytest.approx(2 * amplitude)


@pytest.mark.parametrize("shape", [(64, 64), (30, 47)])
def test_metrics_equal_those_of_surface_topography_and_scipy(shape):
    scan = scan_of(np.random.default_rng(3).standard_normal(shape).cumsum(axis=0), 4.9)
    values, topography = metrics(scan), to_surface_topography(scan)
    for name, value in (
        ("rms_height", topography.Sq()),
        ("rms_gradient", topography.rms_gradient()),
        ("rms_profile_slope", topography.Rdq()),
        ("rms_half_laplacian", topography.rms_curvature_from_area()),
        ("rms_laplacian", 2 * topography.rms_curvature_from_area()),
        ("skewness", stats.skew(scan.heights, axis=None)),
        ("kurtosis", stats.kurtosis(scan.heights, axis=None, fisher=False)),
    ):
        assert values[name] == pytest.approx(value, rel=1e-13)
