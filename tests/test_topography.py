"""Height maps: planes, spheres, mirrors, metrics with known answers."""

import numpy as np
import pytest
import xarray as xr

from hardcontact import topography


def test_levelling_removes_a_plane_and_only_that():
    y, x = np.mgrid[:32, :32]
    wave = np.sin(2 * np.pi * 4 * x / 32) * np.sin(2 * np.pi * 3 * y / 32)
    levelled = topography.level(wave + 3 * x - 2 * y + 7, 10.0)
    assert abs(levelled.mean()) < 1e-9
    assert np.polyfit(x[0], levelled.mean(axis=0), 1)[0] == pytest.approx(0, abs=1e-9)
    assert levelled.std() == pytest.approx(wave.std(), rel=0.1)


def test_sphere_is_removed_wherever_its_apex_lies():
    y, x = (np.mgrid[:64, :64] - 20.3) * 40.0
    roughness = np.cos(2 * np.pi * np.arange(64) * 8 / 64)[None, :] * np.ones((64, 1))
    scan = roughness - (x**2 + (y - 500) ** 2) / (2 * 250e3)
    found = topography.subtract_sphere(scan, 40.0, 250e3)
    np.testing.assert_allclose(found, topography.level(roughness, 40.0), atol=1e-8)


def test_mirrored_edges_match():
    scan = np.random.default_rng(0).standard_normal((7, 7))
    stitched = topography.mirror_stitch(scan)
    assert stitched.shape == (14, 14)
    np.testing.assert_array_equal(stitched[:7, :7], scan)
    for axis in (0, 1):
        edges = np.take(stitched, [0, -1, 6, 7], axis=axis)
        first, last, middle, next_ = np.split(edges, 4, axis=axis)
        np.testing.assert_array_equal(first, last)
        np.testing.assert_array_equal(middle, next_)


def test_metrics_of_a_wave():
    pixels, pixel_size, amplitude, order = 256, 3.0, 2.0, 16
    x = np.arange(pixels) * pixel_size
    wave = amplitude * np.cos(2 * np.pi * order * x / (pixels * pixel_size))
    found = topography.metrics(wave[None] * np.ones((pixels, 1)), pixel_size)
    q = 2 * np.pi * order / (pixels * pixel_size)
    difference = 2 * np.sin(q * pixel_size / 2) / pixel_size
    rms = amplitude / np.sqrt(2)
    assert found["rms_height"] == pytest.approx(rms)
    assert found["rms_gradient"] == pytest.approx(rms * difference, rel=0.01)
    assert found["rms_profile_slope"] == pytest.approx(rms * difference, rel=0.01)
    assert found["rms_laplacian"] == pytest.approx(rms * difference**2, rel=0.01)
    assert found["rms_half_laplacian"] == pytest.approx(found["rms_laplacian"] / 2)
    assert found["kurtosis"] == pytest.approx(1.5) and found["skewness"] == pytest.approx(0)
    assert found["peak_to_valley"] == pytest.approx(2 * amplitude)


def test_averages_over_scans():
    scans = xr.Dataset(
        {
            name: (("surface", "scan"), [[1.0, 2.0, 3.0], [5.0, 7.0, np.nan]], {"units": "nm"})
            for name in topography.METRICS
        }
    )
    found = topography.averages(scans, 0.95)
    np.testing.assert_allclose(found["rms_height_mean"], [2, 6])
    np.testing.assert_allclose(found["rms_height_std"], [1, np.sqrt(2)])
    # Student's t: 4.303 for two degrees of freedom, 12.706 for one.
    np.testing.assert_allclose(
        found["rms_height_mean_high"], [2 + 4.3027 / 3**0.5, 6 + 12.7062], rtol=1e-4
    )
