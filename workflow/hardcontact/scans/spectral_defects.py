"""Defects that the power of the waves in a map shows: a lay, and white noise."""

import numpy as np

from hardcontact.base.arrays import Floats
from hardcontact.scans.reliable_band import FLATTEST_SLOPE, MIN_STANDARD_ERRORS

#: A lay has at least this ratio of the variance of profiles along its wavevector to that across,
#: and this share of the variance of heights: smaller ones are drift and noise of lines. Of 5400
#: self-affine maps without a roll-off (H from 0.5 to 1) two exceed both. Profiles have waves of at
#: least four pixels, because shorter ones are noisy, and at most a quarter of the size, because
#: longer random waves are few.
MIN_LAY_RATIO = 3.0
MIN_LAY_SHARE = 0.1
MIN_PIXELS_PER_WAVE = 4
MIN_WAVES = 4
#: Least share of noise in the variance of heights: it changes the rms height by one per cent.
MIN_NOISE_SHARE = 0.02
#: Largest ratio of powers: a pattern without noise would have an infinite ratio.
LARGEST_RATIO = 1e6


def wave_power(heights: Floats) -> Floats:
    """Return the power (y, x) of the waves in a map under a Hann window, |FFT|² in nm²."""
    window = np.hanning(len(heights) + 1)[:-1]
    return np.asarray(np.abs(np.fft.fft2(heights * np.outer(window, window))) ** 2)


def lay_numbers(power: Floats) -> tuple[dict[str, float], float]:
    """Return the numbers of a lay, none without one, and the ratio of squared slopes.

    The number of a lay is the ratio of the variances of profiles along its wavevector and across.
    The ratio of squared slopes is that of the steepest direction and of the direction across.
    """
    pixels = len(power)
    waves = np.fft.fftfreq(pixels, 1 / pixels)
    wavevector = waves + 1j * waves[:, None]  # x + iy, in waves across the map
    size = np.abs(wavevector)
    is_resolved = (MIN_WAVES <= size) & (size <= pixels / MIN_PIXELS_PER_WAVE)
    # Opposite wavevectors have the same square.
    squares = (power[is_resolved] * (wavevector[is_resolved] / size[is_resolved]) ** 2).sum()
    direction = np.exp(0.5j * np.angle(squares))
    squared_slopes = (power * size**2)[is_resolved].sum()
    slope_difference = abs((power * wavevector**2)[is_resolved].sum())

    def profile_variance(axis: complex) -> float:
        component = np.abs((wavevector * np.conj(axis)).real)
        in_profile = (MIN_WAVES <= component) & (component <= pixels / MIN_PIXELS_PER_WAVE)
        return float(power[in_profile].sum())

    variance_along = profile_variance(direction)
    variance_across = profile_variance(1j * direction)
    is_lay = variance_along > max(MIN_LAY_RATIO * variance_across, MIN_LAY_SHARE * power.sum())
    slope_ratio = _ratio(squared_slopes + slope_difference, squared_slopes - slope_difference)
    lay = {"lay_ratio": _ratio(variance_along, variance_across)} if is_lay else {}
    return lay, slope_ratio


def _ratio(larger: float, smaller: float) -> float:
    """Return the ratio of two powers, at most LARGEST_RATIO; 1 if both are zero."""
    return float(larger / max(smaller, larger / LARGEST_RATIO)) if larger else 1.0


def noise_numbers(variance: float, power: Floats) -> dict[str, float]:
    """Return the rms of white noise and the rms height without it (nm); none without noise.

    The spectrum of a noisy scan is flatter than any self-affine spectrum at two to four pixels, but
    steeper at longer waves.
    """
    pixels = len(power)
    waves = np.fft.fftfreq(pixels, 1 / pixels)
    half_octave = np.round(2 * np.log2(pixels / np.maximum(np.hypot(waves, waves[:, None]), 1)))
    half_octaves = np.arange(3, 2 * np.log2(pixels / MIN_WAVES))
    if len(half_octaves) < 2:
        return {}
    in_half_octave = [half_octave == index for index in half_octaves]
    density = [power[mask].mean() for mask in in_half_octave]
    counts = [np.count_nonzero(mask) for mask in in_half_octave]
    slopes = -2 * np.diff(np.log2(np.maximum(density, np.finfo(float).tiny)))
    # The window makes one independent wave of four, and opposite wavevectors have the same power.
    relative_errors = np.sqrt(8 / np.array(counts))
    errors = 2 / np.log(2) * np.hypot(relative_errors[1:], relative_errors[:-1])
    margins = MIN_STANDARD_ERRORS * errors
    is_noisy = slopes[0] - margins[0] > FLATTEST_SLOPE > (slopes + margins).min()
    # The mean square of the window is 3/8 along each axis.
    noise = density[0] / (3 / 8 * pixels) ** 2
    if not is_noisy or noise < MIN_NOISE_SHARE * variance:
        return {}
    return {
        "noise_height": float(np.sqrt(noise)),
        "rms_height_without_noise": float(np.sqrt(max(variance - noise, 0))),
    }
