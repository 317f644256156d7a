"""Interpolation and cutoff filters, against Fourier transforms of whole maps."""

import numpy as np
import pytest
from periodic_maps import periodic_map

from hardcontact.surfaces.filters import filtered_series, interpolate, lowpass


def filtered(surface, side, cutoff, pixels):
    return next(filtered_series(surface, side, [cutoff], pixels))


def noise():
    """White noise on a map of 640 nm."""
    return periodic_map(np.random.default_rng(0).standard_normal((64, 64)), 10.0)


def test_interpolation_reproduces_waves_down_to_two_pixels():
    def waves(x):  # The second wave has twelve periods, each of two of 24 pixels.
        return np.cos(2 * np.pi * (3 * x[:, None] - 5 * x)) + np.cos(24 * np.pi * x[:, None])

    surface = interpolate(periodic_map(waves(np.arange(24) / 24), 10.0), 100)
    np.testing.assert_allclose(surface.heights, waves(np.arange(100) / 100), atol=1e-6)


@pytest.mark.parametrize("cutoff", [25.0, 60.0, 333.0])
def test_lowpass_keeps_only_long_waves(cutoff):
    surface = noise()
    long_waves = lowpass(surface, cutoff)
    q = 2 * np.pi * np.fft.fftfreq(64, 10.0)
    is_long = np.hypot(q[:, None], q) <= 2 * np.pi / cutoff * (1 + 1e-12)
    expected_heights = np.fft.ifft2(np.fft.fft2(surface.heights) * is_long).real
    np.testing.assert_allclose(interpolate(long_waves, 64).heights, expected_heights, atol=1e-6)
    assert long_waves.size == pytest.approx(640.0)


def test_a_wave_at_the_cutoff_counts_as_longer():
    x = np.arange(64) / 64
    heights = np.cos(2 * np.pi * 8 * x)[None] * np.ones((64, 1))
    wave = periodic_map(heights, 10.0)  # 80 nm long
    assert np.std(lowpass(wave, 80.0).heights) == pytest.approx(np.std(wave.heights))
    np.testing.assert_allclose(filtered(wave, "long", 80.0, 64).heights, 0, atol=1e-6)


@pytest.mark.parametrize(
    ("side", "cutoff", "pixels", "message"),
    [
        ("short", 20.0, 64, "more than two pixels"),
        ("long", None, 32, "at least 64 pixels to interpolate to, found 32"),
        ("long", 100.0, 32, "at least 64 pixels to interpolate to, found 32"),
        # The highest order, 640 nm over 25 nm rounded down, needs 2 * 25 + 2 pixels.
        ("short", 25.0, 32, "at least 52 pixels to interpolate to, found 32"),
    ],
)
def test_waves_shorter_than_two_pixels_are_refused(side, cutoff, pixels, message):
    with pytest.raises(ValueError, match=message):
        filtered(noise(), side, cutoff, pixels)


@pytest.mark.parametrize("pixels", [64, 100])
@pytest.mark.parametrize("side", ["short", "long"])
def test_a_series_is_the_surface_filtered_at_each_cutoff(side, pixels):
    surface, cutoffs = noise(), [None, 25.0, 640.0, 60.0, None, 333.0]
    unfiltered = interpolate(surface, pixels).heights
    series = filtered_series(surface, side, cutoffs, pixels)
    for cutoff, filtered_surface in zip(cutoffs, series, strict=True):
        heights = unfiltered
        if cutoff is not None:
            long_waves = interpolate(lowpass(surface, cutoff), pixels).heights
            heights = long_waves if side == "short" else unfiltered - long_waves
        np.testing.assert_allclose(filtered_surface.heights, heights, atol=2e-6)
        assert filtered_surface.size == pytest.approx(surface.size)
