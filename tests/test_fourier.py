"""Interpolation and cutoff filters: through the points, and every scale kept exactly once."""

import numpy as np
import pytest

from hardcontact import fourier


def noise(pixels, seed=0):
    return np.random.default_rng(seed).standard_normal((pixels, pixels))


@pytest.mark.parametrize("coarse, fine", [(16, 64), (15, 45), (32, 32), (20, 60)])
def test_interpolation_passes_through_the_points(coarse, fine):
    heights = noise(coarse)
    step = fine // coarse
    np.testing.assert_allclose(
        fourier.interpolate(heights, fine)[::step, ::step], heights, atol=2e-6
    )


def test_interpolation_of_a_wave_is_that_wave():
    x = np.arange(24) / 24
    wave = np.cos(2 * np.pi * (3 * x[:, None] - 5 * x))
    u = np.arange(100) / 100
    expected = np.cos(2 * np.pi * (3 * u[:, None] - 5 * u))
    np.testing.assert_allclose(fourier.interpolate(wave, 100), expected, atol=1e-6)


def test_interpolation_refuses_a_coarser_grid():
    with pytest.raises(ValueError, match="at least 16 pixels to interpolate to, found 8"):
        fourier.interpolate(noise(16), 8)


@pytest.mark.parametrize("cutoff", [25.0, 60.0, 333.0, 640.0])
def test_lowpass_and_highpass_make_the_surface(cutoff):
    heights = noise(64)
    band, _ = fourier.lowpass(heights, 10.0, cutoff)
    low = fourier.interpolate(band, 64)
    np.testing.assert_allclose(low + fourier.highpass(heights, 10.0, cutoff), heights, atol=1e-6)


@pytest.mark.parametrize("cutoff", [25.0, 60.0, 333.0])
def test_lowpass_keeps_just_the_long_waves(cutoff):
    heights = noise(64)
    band, _ = fourier.lowpass(heights, 10.0, cutoff)
    wave = 2 * np.pi * np.fft.fftfreq(64, 10.0)
    keep = np.hypot(wave[:, None], wave) <= 2 * np.pi / cutoff * (1 + 1e-12)
    expected = np.fft.ifft2(np.fft.fft2(heights) * keep).real
    np.testing.assert_allclose(fourier.interpolate(band, 64), expected, atol=1e-6)


def test_a_wave_at_the_cutoff_is_kept_once():
    x = np.arange(64) / 64
    wave = np.cos(2 * np.pi * 8 * x)[None] * np.ones((64, 1))  # 80 nm
    band, _ = fourier.lowpass(wave, 10.0, 80.0)
    assert np.std(band) == pytest.approx(np.std(wave))
    np.testing.assert_allclose(fourier.highpass(wave, 10.0, 80.0), 0, atol=1e-6)


def test_a_cutoff_of_two_pixels_is_refused():
    with pytest.raises(ValueError, match="more than two pixels"):
        fourier.lowpass(noise(64), 10.0, 20.0)


@pytest.mark.parametrize("pixels", [64, 100])
@pytest.mark.parametrize("cutoff", [60.0, 333.0])
def test_what_either_side_removes_makes_the_master(pixels, cutoff):
    master = noise(64)
    (whole, pixel), (long, _), (short, _) = (
        fourier.filtered(master, 10.0, side, wavelength, pixels)
        for side, wavelength in (("small", None), ("small", cutoff), ("large", cutoff))
    )
    assert pixel == 640 / pixels
    assert whole.shape == long.shape == short.shape == (pixels, pixels)
    np.testing.assert_allclose(long + short, whole, atol=3e-6)
    band, _ = fourier.lowpass(master, 10.0, cutoff)
    np.testing.assert_allclose(long, fourier.interpolate(band, pixels), atol=1e-12)


@pytest.mark.parametrize("side", ["small", "large"])
def test_without_a_cutoff_the_master_is_interpolated_alone(side):
    master = noise(64)
    np.testing.assert_array_equal(fourier.filtered(master, 10.0, side, None, 64)[0], master)
    finer, pixel = fourier.filtered(master, 10.0, side, None, 128)
    np.testing.assert_allclose(finer[::2, ::2], master, atol=2e-6)
    assert pixel == 5.0


def test_a_master_on_fewer_pixels_is_refused():
    for cutoff in (None, 100.0):
        with pytest.raises(ValueError, match="at least 64 pixels to interpolate to, found 32"):
            fourier.filtered(noise(64), 10.0, "large", cutoff, 32)
