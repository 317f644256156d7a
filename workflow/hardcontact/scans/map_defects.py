"""Defects that only a map shows: a curvature, offset lines, a lay, slopes, white noise."""

import numpy as np

from hardcontact.base.arrays import Floats
from hardcontact.scans.reliable_band import FLATTEST_SLOPE, MIN_STANDARD_ERRORS

#: The numbers of a defect by name; empty without the defect.
Defect = dict[str, float]

#: Least ratio, for a lay, of the variance of profiles along its wavevector to that across.
MIN_LAY_RATIO = 3.0
#: Least share of a lay in the variance of heights: smaller ones are drift and noise of lines. Of
#: 5400 self-affine maps without a roll-off (H from 0.5 to 1), two exceed ratio and share.
MIN_LAY_SHARE = 0.1
#: Pixels of the shortest wave of profiles: shorter ones are noisy.
MIN_PIXELS_PER_WAVE = 4
#: Periods of the longest wave in the size: longer random waves are few.
MIN_WAVES = 4
#: Least share of noise in the variance of heights: it changes the rms height by one per cent.
MIN_NOISE_SHARE = 0.02
#: Largest share of the rms height without a curvature: the curvature has a tenth or more.
MAX_UNCURVED_SHARE = 0.9
#: Least sum of squares of polynomials of second order relative to third and fourth order. The
#: largest ratio in 8100 self-affine maps without a roll-off and curvature (H from 0.5 to 1) is 34.
MIN_SECOND_ORDER_RATIO = 50.0
#: Points per row to which polynomials are fitted.
POLYNOMIAL_POINTS = 32
#: Smallest correlation of a step from line to line with the next step. It is 0 if heights walk at
#: random, -0.5 if noise of the instrument offsets each line.
MIN_STEP_CORRELATION = -0.25
#: Largest ratio of powers: a pattern without noise would have an infinite ratio.
LARGEST_RATIO = 1e6


def wave_power(heights: Floats) -> Floats:
    """Return the power (y, x) of the waves in a map under a Hann window, |FFT|² in nm²."""
    window = np.hanning(len(heights) + 1)[:-1]
    return np.asarray(np.abs(np.fft.fft2(heights * np.outer(window, window))) ** 2)


def find_curvature(heights: Floats, pixel_size: float) -> Defect:
    """Find a curvature: the part of second order in a polynomial fit of fourth order."""
    step = max(1, len(heights) // POLYNOMIAL_POINTS)
    points = heights[::step, ::step]
    axis = np.linspace(-1, 1, len(points))
    exponents = np.array([(order - j, j) for order in range(5) for j in range(order + 1)])
    terms = [np.outer(axis**i, axis**j).ravel() for i, j in exponents]
    polynomials, triangle = np.linalg.qr(np.transpose(terms))
    amplitudes = polynomials.T @ points.ravel()
    orders = exponents.sum(axis=1)
    squares = [float((amplitudes[orders == order] ** 2).sum()) for order in range(5)]
    total = float((points**2).sum()) - squares[0] - squares[1]
    uncurved_squares = max(total - squares[2], 0.0)
    is_weak = uncurved_squares >= MAX_UNCURVED_SHARE**2 * total
    if is_weak or squares[2] < MIN_SECOND_ORDER_RATIO * (squares[3] + squares[4]):
        return {}
    coefficients = np.linalg.solve(triangle, np.where(orders == 2, amplitudes, 0))
    yy, xy, xx = coefficients[orders == 2]
    half_width = (len(points) - 1) * step * pixel_size / 2
    curvatures = np.linalg.eigvalsh([[2 * yy, xy], [xy, 2 * xx]]) / half_width**2
    return {
        "curvature_radius": float(1 / np.abs(curvatures).max()),
        "uncurved_share": float(np.sqrt(uncurved_squares / total)),
    }


def find_line_patterns(heights: Floats, power: Floats, pixel_size: float) -> dict[str, Defect]:
    """Find offset lines and a lay, or else slopes that depend on direction."""
    lay, slope_ratio = _find_lay(power)
    patterns = {"offset_lines": _find_line_offsets(heights), "lay": lay}
    if slope_ratio > MIN_LAY_RATIO and not any(patterns.values()):
        patterns["slopes"] = _find_directional_slopes(heights, pixel_size)
    return patterns


def _find_lay(power: Floats) -> tuple[Defect, float]:
    """Find a lay; also return the ratio of squared slopes along and across the steepest direction.

    The ratio of a lay compares variances of profiles along and across most wavevectors.
    """
    pixels = len(power)
    waves = np.fft.fftfreq(pixels, 1 / pixels)
    wavevector = waves + 1j * waves[:, None]  # x + iy, in waves across the map
    wavenumber = np.abs(wavevector)
    is_resolved = (MIN_WAVES <= wavenumber) & (wavenumber <= pixels / MIN_PIXELS_PER_WAVE)
    # Opposite wavevectors have the same square.
    squares = power[is_resolved] * (wavevector[is_resolved] / wavenumber[is_resolved]) ** 2
    direction = np.exp(0.5j * np.angle(squares.sum()))
    squared_slopes = (power * wavenumber**2)[is_resolved].sum()
    slope_difference = abs((power * wavevector**2)[is_resolved].sum())

    def profile_variance(axis: complex) -> float:
        component = np.abs((wavevector * np.conj(axis)).real)
        is_in_profile = (MIN_WAVES <= component) & (component <= pixels / MIN_PIXELS_PER_WAVE)
        return float(power[is_in_profile].sum())

    variance_along = profile_variance(direction)
    variance_across = profile_variance(1j * direction)
    is_lay = variance_along > max(MIN_LAY_RATIO * variance_across, MIN_LAY_SHARE * power.sum())
    slope_ratio = _limited_ratio(
        squared_slopes + slope_difference, squared_slopes - slope_difference
    )
    lay = {"lay_ratio": _limited_ratio(variance_along, variance_across)} if is_lay else {}
    return lay, slope_ratio


def _limited_ratio(larger: float, smaller: float) -> float:
    """Return the ratio of two powers, at most LARGEST_RATIO; 1 if both are zero."""
    return float(larger / max(smaller, larger / LARGEST_RATIO)) if larger else 1.0


def _find_line_offsets(heights: Floats) -> Defect:
    """Return the rms offset (nm) of lines that are offset at random."""
    steps = np.diff(heights, axis=0)
    line_steps = steps.mean(axis=1)
    is_most = line_steps.var() > steps.var() / 2
    is_random = _correlation_of_steps(line_steps) < MIN_STEP_CORRELATION
    return {"line_offset": float(line_steps.std() / np.sqrt(2))} if is_most and is_random else {}


def _correlation_of_steps(steps: Floats) -> float:
    """Return the correlation of each step with the next step along the first axis."""
    return float((steps[1:] * steps[:-1]).mean() / max((steps**2).mean(), np.finfo(float).tiny))


def _find_directional_slopes(heights: Floats, pixel_size: float) -> Defect:
    """Find the rms slopes along x and y, unless noise of lines makes the steeper one."""
    steps = [np.diff(lines, axis=0) for lines in (heights.T, heights)]
    slopes = [float(axis_steps.std()) / pixel_size for axis_steps in steps]
    is_noise = _correlation_of_steps(steps[int(np.argmax(slopes))]) < MIN_STEP_CORRELATION
    return {} if is_noise else {"slope_along_x": slopes[0], "slope_along_y": slopes[1]}


def find_noise(variance: float, power: Floats) -> Defect:
    """Find white noise, with which a spectrum is flat at short waves and steeper at longer ones."""
    pixels = len(power)
    waves = np.fft.fftfreq(pixels, 1 / pixels)
    half_octave = np.round(2 * np.log2(pixels / np.maximum(np.hypot(waves, waves[:, None]), 1)))
    # Wavelengths of 2^(3/2) pixels and more, in half octaves.
    half_octaves = np.arange(3, 2 * np.log2(pixels / MIN_WAVES))
    if len(half_octaves) < 2:
        return {}
    half_octave_masks = [half_octave == index for index in half_octaves]
    density = [power[mask].mean() for mask in half_octave_masks]
    counts = [np.count_nonzero(mask) for mask in half_octave_masks]
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
