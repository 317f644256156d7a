"""C_iso of single measurements, its scatter and slopes."""

import numpy as np
import pytest
from measurements import line_of, map_of, measurement
from random_scans import PIXEL, uncd
from scipy.ndimage import gaussian_filter1d

from hardcontact.numbers.random import generator
from hardcontact.surfaces.height_map import HeightMap, level
from hardcontact.surfaces.measured_spectrum import (
    axis_ratio,
    independent_waves,
    local_slopes,
    measured_psd,
    size_of,
    variance_of_log,
)
from hardcontact.surfaces.spectrum import measured_psds


def test_a_map_has_the_psd_of_the_levelled_scan():
    scan = map_of(generator(1), 64, PIXEL)
    wavevector, density = measured_psd(scan)
    expected = measured_psds(level(HeightMap(scan.heights, PIXEL, False, "measured")))
    np.testing.assert_array_equal(wavevector, expected[0])
    np.testing.assert_array_equal(density, expected[2])


def test_a_tilt_does_not_matter():
    for one in (map_of(generator(2), 64, PIXEL), line_of(generator(2), 300, PIXEL)):
        tilted = measurement(one.heights + 3.0 * np.arange(one.heights.shape[-1]), PIXEL)
        np.testing.assert_allclose(measured_psd(tilted)[1], measured_psd(one)[1], rtol=1e-6)


def test_line_scans_have_the_spectrum_of_their_surface():
    lines = [line_of(generator(3, k), 1000, 10.0) for k in range(40)]
    wavevector = measured_psd(lines[0])[0]
    mean = np.mean([measured_psd(line)[1] for line in lines], axis=0)
    wavelength = 2 * np.pi / wavevector
    seen = np.isfinite(mean) & (wavelength > 40) & (wavelength < size_of(lines[0]) / 3)
    np.testing.assert_allclose(np.log(mean[seen] / uncd(wavevector[seen])), 0, atol=0.5)
    assert np.median(mean[seen] / uncd(wavevector[seen])) == pytest.approx(1, abs=0.07)


@pytest.mark.parametrize("kind", ["map", "profile"])
def test_scatter_is_that_of_the_independent_waves(kind):
    draws = [
        map_of(generator(4, k), 64, 20.0) if kind == "map" else line_of(generator(5, k), 256, 20.0)
        for k in range(100)
    ]
    wavevector = measured_psd(draws[0])[0]
    logs = np.log([measured_psd(draw)[1] for draw in draws])
    wavelength = 2 * np.pi / wavevector
    seen = np.isfinite(logs).all(axis=0) & (wavelength > 60) & (wavelength < size_of(draws[0]) / 3)
    expected = np.sqrt(variance_of_log(independent_waves(draws[0])[seen]))
    assert np.median(logs.std(axis=0)[seen] / expected) == pytest.approx(1, abs=0.25)


def test_local_slopes_and_their_errors_are_those_of_power_laws():
    wavevector = np.geomspace(0.01, 10, 31)
    variance = np.full(31, 0.1)
    slope, error = local_slopes(wavevector, wavevector**-3.3, variance)
    np.testing.assert_allclose(slope, -3.3, atol=1e-9)
    rng = generator(6)
    noisy = [
        local_slopes(wavevector, wavevector**-3.3 * np.exp(rng.normal(0, 0.1**0.5, 31)), variance)[
            0
        ]
        for _ in range(400)
    ]
    np.testing.assert_allclose(np.std(noisy, axis=0) / error, 1, atol=0.15)


def test_a_lone_bin_has_no_slope():
    slope, error = local_slopes(np.array([0.01, 1.0]), np.array([2.0, 1.0]), np.ones(2))
    assert np.isnan(slope).all() and np.isinf(error).all()


def test_axes_differ_where_the_lines_of_a_scan_are_smoothed():
    scan = map_of(generator(7), 256, PIXEL)
    alike = axis_ratio(scan)
    smoothed = measurement(gaussian_filter1d(scan.heights, 3.0, axis=1), PIXEL)
    wavelength = 2 * np.pi / measured_psd(scan)[0]
    short = (wavelength > 4 * PIXEL) & (wavelength < 8 * PIXEL)
    assert (alike[short] < 1.2).all() and (axis_ratio(smoothed)[short] > 4).all()
    np.testing.assert_allclose(
        axis_ratio(measurement(smoothed.heights.T, PIXEL)), axis_ratio(smoothed)
    )
    assert (axis_ratio(line_of(generator(8), 100, PIXEL)) == 1).all()
