"""Errors of contacts on a map against enumeration, resampling and known correlations."""

import numpy as np
import pytest
from periodic_maps import periodic_noise

from hardcontact.insight.scan_maps import (
    array_error,
    contacts_for_error,
    correlation,
    variation,
)
from hardcontact.insight.surface_maps import deviation_interval


def forces(pixels=60):
    return np.exp(0.5 * periodic_noise(2 * pixels, 1.0, 1)[:pixels, :pixels])


@pytest.mark.parametrize("count", [2, 3, 8, 14])
def test_error_of_arrays_is_that_of_every_array_on_the_stitched_map(count):
    force = forces()
    stitched = np.block([[force, force[:, ::-1]], [force[::-1], force[::-1, ::-1]]])
    step = -(-120 // count)
    start = [k * 120 // count for k in range(count)]
    means = [
        np.mean([stitched[(y + i) % 120, (x + j) % 120] for y in start for x in start])
        for i in range(step)
        for j in range(step)
    ]
    expected = np.sqrt(np.mean((np.array(means) / force.mean() - 1) ** 2))
    assert array_error(force, count) == pytest.approx(expected, rel=1e-12)


def test_ends_of_arrays():
    assert array_error(forces(), 1) == pytest.approx(variation(forces()), rel=1e-12)
    assert array_error(forces(), 120) == pytest.approx(0, abs=1e-12)


def test_variation_is_the_error_of_random_contacts():
    force, rng = forces(), np.random.default_rng(2)
    means = rng.choice(force.ravel(), (4000, 50)).mean(axis=1)
    error = np.sqrt(np.mean((means / force.mean() - 1) ** 2))
    assert variation(force) / np.sqrt(50) == pytest.approx(error, rel=0.05)


def test_an_array_does_better_than_random_only_where_forces_are_correlated():
    smooth, rough = forces(), np.exp(np.random.default_rng(3).normal(size=(240, 240)))
    assert array_error(smooth, 20) < 0.5 * variation(smooth) / 20
    # 576 arrays share the scan: their error is known to about 1/sqrt(2 x 576) = 3 %.
    assert array_error(rough, 10) == pytest.approx(variation(rough) / 10, rel=0.1)


def test_contacts_for_an_error_of_a_power_law():
    numbers = np.array([1, 4, 16, 64, 256])
    errors = 0.4 / numbers**0.7
    expected = (0.4 / 0.05) ** (1 / 0.7)
    assert contacts_for_error(numbers, errors, 0.05) == pytest.approx(expected)
    assert contacts_for_error(numbers, errors, 0.5) == 1
    assert np.isnan(contacts_for_error(numbers, errors, 0.001))
    # A number of contacts counts from where all larger ones keep within the error as well.
    assert 16 < contacts_for_error(numbers, [0.4, 0.04, 0.08, 0.02, 0.01], 0.05) < 64


def test_correlation_of_smoothed_noise():
    width, pixels, rng = 4.0, 512, np.random.default_rng(4)
    q = 2 * np.pi * np.fft.fftfreq(pixels)
    smoothing = np.exp(-(q[:, None] ** 2 + q[: pixels // 2 + 1] ** 2) * width**2 / 2)
    noise = np.fft.irfft2(np.fft.rfft2(rng.normal(size=(pixels, pixels))) * smoothing)
    # Its correlation is exp(-r²/4w²).
    length, area = correlation(noise, 5.0)
    assert length == pytest.approx(2 * width * 5, rel=0.04)
    assert area == pytest.approx(4 * np.pi * (width * 5) ** 2, rel=0.15)


def test_area_of_correlation_predicts_the_scatter_of_means():
    width, rng = 3.0, np.random.default_rng(5)
    q = 2 * np.pi * np.fft.fftfreq(512)
    smoothing = np.exp(-(q[:, None] ** 2 + q[:257] ** 2) * width**2 / 2)
    noise = np.fft.irfft2(np.fft.rfft2(rng.normal(size=(512, 512))) * smoothing)
    parts = noise.reshape(8, 64, 8, 64).mean(axis=(1, 3))
    expected = noise.std() * np.sqrt(correlation(noise, 1.0).area) / 64
    assert parts.std() == pytest.approx(expected, rel=0.2)


def test_interval_of_a_deviation_holds_it_as_often_as_it_says():
    drawn = np.random.default_rng(6).normal(size=(4000, 5)).std(axis=1, ddof=1)
    ends = deviation_interval(drawn, 5, 0.9)
    inside = (ends[:, 0] <= 1) & (1 <= ends[:, 1])
    assert inside.mean() == pytest.approx(0.9, abs=0.02)
    assert np.isnan(deviation_interval(drawn, 1, 0.9)).all()
