"""Interpolation and cutoff filters: through the points, and every scale kept exactly once."""

import numpy as np
import pytest
from periodic_maps import periodic_map

from hardcontact.surfaces.filters import filtered_series, interpolate, lowpass


def filtered(master, side, cutoff, pixels):
    return next(filtered_series(master, side, [cutoff], pixels))


def noise():
    return periodic_map(np.random.default_rng(0).standard_normal((64, 64)), 10.0)


def test_interpolation_reproduces_waves_down_to_two_pixels():
    coarse_wave, fine_wave = (
        np.cos(2 * np.pi * (3 * x[:, None] - 5 * x)) + np.cos(24 * np.pi * x[:, None])
        for x in (np.arange(24) / 24, np.arange(100) / 100)
    )
    surface = interpolate(periodic_map(coarse_wave, 10.0), 100)
    np.testing.assert_allclose(surface.heights, fine_wave, atol=1e-6)


@pytest.mark.parametrize("cutoff", [25.0, 60.0, 333.0])
def test_lowpass_keeps_only_long_waves(cutoff):
    surface = noise()
    band = lowpass(surface, cutoff)
    wave = 2 * np.pi * np.fft.fftfreq(64, 10.0)
    is_long = np.hypot(wave[:, None], wave) <= 2 * np.pi / cutoff * (1 + 1e-12)
    long_waves = np.fft.ifft2(np.fft.fft2(surface.heights) * is_long).real
    np.testing.assert_allclose(interpolate(band, 64).heights, long_waves, atol=1e-6)
    assert band.size == pytest.approx(640.0)


def test_a_wave_at_the_cutoff_belongs_to_one_side():
    x = np.arange(64) / 64
    waves = np.cos(2 * np.pi * 8 * x)[None] * np.ones((64, 1))  # 80 nm
    wave = periodic_map(waves, 10.0)
    assert np.std(lowpass(wave, 80.0).heights) == pytest.approx(np.std(wave.heights))
    np.testing.assert_allclose(filtered(wave, "long", 80.0, 64).heights, 0, atol=1e-6)


@pytest.mark.parametrize(
    ("side", "cutoff", "pixels", "message"),
    [
        ("short", 20.0, 64, "more than two pixels"),
        ("long", None, 32, "at least 64 pixels to interpolate to, found 32"),
        ("long", 100.0, 32, "at least 64 pixels to interpolate to, found 32"),
        ("short", 25.0, 32, "at least 52 pixels to interpolate to, found 32"),
    ],
)
def test_waves_shorter_than_two_pixels_are_refused(side, cutoff, pixels, message):
    with pytest.raises(ValueError, match=message):
        filtered(noise(), side, cutoff, pixels)


@pytest.mark.parametrize("pixels", [64, 100])
@pytest.mark.parametrize("side", ["short", "long"])
def test_a_series_is_the_master_filtered_at_each_cutoff(side, pixels):
    master, cutoffs = noise(), [None, 25.0, 640.0, 60.0, None, 333.0]
    unfiltered = interpolate(master, pixels).heights
    for cutoff, surface in zip(
        cutoffs, filtered_series(master, side, cutoffs, pixels), strict=True
    ):
        heights = unfiltered
        if cutoff is not None:
            low = interpolate(lowpass(master, cutoff), pixels).heights
            heights = low if side == "short" else unfiltered - low
        np.testing.assert_allclose(surface.heights, heights, atol=2e-6)
        assert surface.size == pytest.approx(master.size)
