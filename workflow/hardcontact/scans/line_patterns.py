"""Find patterns of the lines of a map: lines that are offset at random, a lay, unequal slopes.

A lay is a direction along which profiles vary much more than across it, such as that of grooves.
"""

import numpy as np
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats

#: A lay has more than this ratio of the variance of profiles along its wavevector to the variance
#: across; the defect "slopes", of squared slopes.
MIN_LAY_RATIO = 3.0
#: Least share of a lay in the variance of heights: smaller ones are drift and noise of lines. Of
#: 5400 self-affine maps without a roll-off (H from 0.5 to 1), two exceed ratio and share.
MIN_LAY_SHARE = 0.1
#: Least wavelength in profiles, in pixels: shorter waves are noisy.
MIN_PIXELS_PER_WAVE = 4
#: Least number of periods of a wave in the size: longer random waves are few.
MIN_WAVES = 4
#: Least correlation of a step from line to line with the next step, if lines have no offsets. It is
#: 0 if heights walk at random, -0.5 if noise of the instrument offsets each line.
MIN_STEP_CORRELATION = -0.25
#: Largest ratio of powers that is stated: a pattern without noise has an infinite ratio.
LARGEST_RATIO = 1e6


def find_line_patterns(
    heights: Floats, power: Floats, pixel_size: float
) -> dict[str, dict[str, float]]:
    """Find the defects offset_lines and lay, or else slopes; a defect without numbers is none.

    `heights` (nm) are levelled, `power` is that of their waves; the pixel size is in nm.
    """
    pixels = len(power)
    waves = np.fft.fftfreq(pixels, 1 / pixels)
    wavevector = waves + 1j * waves[:, None]  # x + iy, in waves across the map
    patterns = {"offset_lines": _find_line_offsets(heights), "lay": _find_lay(power, wavevector)}
    if not any(patterns.values()) and _slope_ratio(power, wavevector) > MIN_LAY_RATIO:
        patterns["slopes"] = _find_directional_slopes(heights, pixel_size)
    return patterns


def _is_resolved(wavenumber: Floats, pixels: int) -> NDArray[np.bool_]:
    """Return whether waves are short enough to be many in a map, and long enough for its pixels."""
    return (MIN_WAVES <= wavenumber) & (wavenumber <= pixels / MIN_PIXELS_PER_WAVE)


def _find_lay(power: Floats, wavevector: NDArray[np.complex128]) -> dict[str, float]:
    """Return the ratio of the variance of profiles along the wavevector of a lay to that across.

    The direction along which profiles vary most is a mean over waves, weighted by their power. A
    wave has two opposite wavevectors, at angles that differ by 180°, and their mean would be zero.
    So the mean is taken of the doubled angles, which are equal, and then halved. For example, a
    power of 3 at 0° and 180°, and of 1 at 90° and 270°, sums to 3 at 0° and 1 at 180°, thus to 2 at
    0°: the direction is 0°.

    A profile shows of a wavevector only the component along the profile, so the variance of
    profiles is the power of all waves of which this component is resolved.
    """
    pixels = len(power)
    wavenumber = np.abs(wavevector)
    is_resolved = _is_resolved(wavenumber, pixels)
    # The square of a complex number has the doubled angle.
    directions = wavevector[is_resolved] / wavenumber[is_resolved]
    doubled_angle = np.angle((power[is_resolved] * directions**2).sum())
    lay_wavevector = np.exp(0.5j * doubled_angle)  # of unit length

    def profile_variance(direction: complex) -> float:
        component = np.abs((wavevector * np.conj(direction)).real)
        return float(power[_is_resolved(component, pixels)].sum())

    variance_along = profile_variance(lay_wavevector)
    variance_across = profile_variance(1j * lay_wavevector)
    is_lay = variance_along > max(MIN_LAY_RATIO * variance_across, MIN_LAY_SHARE * power.sum())
    return {"lay_ratio": _limited_ratio(variance_along, variance_across)} if is_lay else {}


def _slope_ratio(power: Floats, wavevector: NDArray[np.complex128]) -> float:
    """Return the ratio of squared slopes of resolved waves along the steepest direction to across.

    The squared slope of a wave is its power times its squared wavenumber. Its sum is that of the
    squared slopes along both directions. The length of the sum at doubled angles is the difference:
    squared slopes of 3 along x and 1 along y have the sum 4, the difference 2, and the ratio 3.
    """
    wavenumber = np.abs(wavevector)
    is_resolved = _is_resolved(wavenumber, len(power))
    squared_slopes = (power * wavenumber**2)[is_resolved].sum()
    difference = abs((power * wavevector**2)[is_resolved].sum())
    return _limited_ratio(squared_slopes + difference, squared_slopes - difference)


def _limited_ratio(larger: float, smaller: float) -> float:
    """Return the ratio of two powers, at most LARGEST_RATIO; 1 if both are zero."""
    return float(larger / max(smaller, larger / LARGEST_RATIO)) if larger else 1.0


def _find_line_offsets(heights: Floats) -> dict[str, float]:
    """Return the rms offset (nm) of lines that are offset at random."""
    steps = np.diff(heights, axis=0)
    line_steps = steps.mean(axis=1)
    is_large = line_steps.var() > steps.var() / 2
    is_random = _correlation_of_steps(line_steps) < MIN_STEP_CORRELATION
    return {"line_offset": float(line_steps.std() / np.sqrt(2))} if is_large and is_random else {}


def _correlation_of_steps(steps: Floats) -> float:
    """Return the correlation of each step with the next step along the first axis."""
    return float((steps[1:] * steps[:-1]).mean() / max((steps**2).mean(), np.finfo(float).tiny))


def _find_directional_slopes(heights: Floats, pixel_size: float) -> dict[str, float]:
    """Return the rms slopes along x and y; none if noise of lines makes the larger one."""
    steps = [np.diff(lines, axis=0) for lines in (heights.T, heights)]
    slopes = [float(axis_steps.std()) / pixel_size for axis_steps in steps]
    is_noise = _correlation_of_steps(steps[int(np.argmax(slopes))]) < MIN_STEP_CORRELATION
    return {} if is_noise else {"slope_along_x": slopes[0], "slope_along_y": slopes[1]}
