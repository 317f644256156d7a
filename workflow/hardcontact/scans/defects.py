"""Find defects of a scan that make forces wrong although its file is readable.

Each defect has a code and numbers, such as the share of spikes, that its sentence states. DEFECTS
lists them all.
"""

from dataclasses import replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats
from hardcontact.base.statistics import MEDIAN_DEVIATION
from hardcontact.scans.spectral_defects import MIN_LAY_RATIO, lay_numbers, noise_numbers, wave_power
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.levelling import fill_streaks, remove_form

#: Numbers of a defect, by name; empty if a scan lacks it.
Numbers = dict[str, float]
#: By code of a defect: its numbers with their units. defects.yaml has a sentence on each.
DEFECTS = {
    "streaks": {
        "streak_lines": "1",
        "first_streak_line": "1",
        "last_streak_line": "1",
        "rms_height_without_streaks": "nm",
    },
    "spikes": {"spike_share": "1", "rms_height_without_spikes": "nm"},
    "equal_lines": {"equal_line_share": "1"},
    "highest": {"highest_share": "1"},
    "lowest": {"lowest_share": "1"},
    "curvature": {"curvature_radius": "nm", "uncurved_share": "1"},
    "offset_lines": {"line_offset": "nm"},
    "lay": {"lay_ratio": "1"},
    "slopes": {"slope_along_x": "1", "slope_along_y": "1"},
    "sidewalls": {"sidewall_slope_share": "1"},
    "noise": {"noise_height": "nm", "rms_height_without_noise": "nm"},
}
#: The numbers of all defects with their units.
DEFECT_UNITS = {name: unit for units in DEFECTS.values() for name, unit in units.items()}

#: Least distance of a spike from its neighbours, in rms heights: once in 10⁹ Gaussian pixels.
MIN_SPIKE_DISTANCE = 6.0
#: Largest share of equal lines: so few lines change a mean force little.
MAX_EQUAL_LINE_SHARE = 0.01
#: Largest share and number of pixels at an end of an unclipped range, and their ratio to the number
#: of pixels at the next height. Quantised heights have a ratio below 1, a flat summit whose height
#: falls with the fourth power of the distance 2.4.
MAX_END_SHARE = 1e-3
MAX_END_PIXELS = 10
MAX_END_RATIO = 3.0
#: Largest share of the rms height without a curvature: the curvature has a tenth or more.
MAX_UNCURVED_SHARE = 0.9
#: Least power of polynomials of second order relative to third and fourth order. The largest ratio
#: in 8100 self-affine maps without a roll-off and curvature (H from 0.5 to 1) is 34.
MIN_SECOND_ORDER_RATIO = 50.0
#: Points per row to which polynomials are fitted.
POLYNOMIAL_POINTS = 32
#: Smallest correlation of a step from line to line with the next step. It is 0 if heights walk at
#: random, and -0.5 if each line is offset at random, which is noise of the instrument.
MIN_STEP_CORRELATION = -0.25
#: Share of the steepest pixels, and their least share of the squared slopes if they are sidewalls.
#: On rough surfaces 5 % of the pixels have 0.2 to 0.45 of it; with pillars and steps, 0.8 to 1.
SIDEWALL_PIXEL_SHARE = 0.05
MIN_SIDEWALL_SLOPE_SHARE = 0.7


def scan_defects(
    raw_heights: Floats, levelled_heights: Floats, pixel_size: float
) -> dict[str, Numbers]:
    """Return the defects of a scan by code, each with its numbers as in DEFECTS; empty for none.

    Heights in nm, before and after levelling, are (y, x) or (n,) of a line scan. The pixel size in
    nm is the spacing of a line scan.
    """
    numbers: dict[str, Numbers] = {}
    power: Floats | None = None  # of a map without equal lines
    measured_heights = raw_heights
    if raw_heights.ndim == 2:
        rows, columns = _find_equal_lines(raw_heights), _find_equal_lines(raw_heights.T)
        share = float(max(rows.mean(), columns.mean()))
        numbers["curvature"] = _curvature_numbers(levelled_heights, pixel_size)
        if share > MAX_EQUAL_LINE_SHARE:
            numbers["equal_lines"] = {"equal_line_share": share}
            measured_heights = raw_heights[~rows][:, ~columns]
        else:  # Unmeasured lines would look like a lay or like streaks.
            levelled_heights, numbers["streaks"] = _without_streaks(levelled_heights)
            power = wave_power(levelled_heights)
            numbers |= _direction_numbers(levelled_heights, power, pixel_size)
    numbers["spikes"] = _spike_numbers(levelled_heights)
    numbers |= _clipping_numbers(measured_heights)
    # Spikes and unmeasured lines look like sidewalls, spikes also like noise. White noise is hidden
    # by sidewalls and offset lines, and quantised heights add to it.
    if not numbers["spikes"] and "equal_lines" not in numbers:
        numbers["sidewalls"] = _sidewall_numbers(levelled_heights)
        has_levels = np.median(np.abs(np.diff(raw_heights, axis=0))) == 0
        hides_noise = has_levels or numbers["sidewalls"] or numbers.get("offset_lines")
        if power is not None and not hides_noise:
            numbers["noise"] = noise_numbers(levelled_heights.var(), power)
    return {code: numbers[code] for code in DEFECTS if numbers.get(code)}


def _direction_numbers(heights: Floats, power: Floats, pixel_size: float) -> dict[str, Numbers]:
    """Return the numbers of offset lines and a lay, or else of slopes that depend on direction."""
    lay, slope_ratio = lay_numbers(power)
    numbers = {"offset_lines": _line_offset_numbers(heights), "lay": lay}
    if slope_ratio > MIN_LAY_RATIO and not any(numbers.values()):
        numbers["slopes"] = _slope_numbers(heights, pixel_size)
    return numbers


def scan_with_defects(
    scan: HeightMap, sphere_radius: float | None = None, levelling: str = "plane"
) -> HeightMap:
    """Return a scan from `remove_form`, with its defects."""
    flat = remove_form(scan, sphere_radius, levelling)
    return replace(flat, defects=scan_defects(scan.heights, flat.heights, scan.pixel_size))


def _without_streaks(heights: Floats) -> tuple[Floats, Numbers]:
    """Return heights without streaks, and the lines of streaks and the rms height (nm) without."""
    filled, is_filled = fill_streaks(heights)
    lines = np.flatnonzero(is_filled.any(axis=1)) + 1
    if not lines.size:
        return heights, {}
    return filled, {
        "streak_lines": float(lines.size),
        "first_streak_line": float(lines[0]),
        "last_streak_line": float(lines[-1]),
        "rms_height_without_streaks": float(filled.std()),
    }


def _spike_numbers(heights: Floats) -> Numbers:
    """Return the share of spikes and the rms height (nm) without them.

    On a map one neighbour of a spike may be a spike, too. Even the pixel at the corner of a
    particle has three neighbours on it.
    """
    isolation = _isolation(heights)
    # Spikes raise the rms height, so leave out pixels that are isolated by the median distance.
    distance = np.median(np.abs(heights - np.median(heights)))
    rms_height = float(heights[isolation <= MIN_SPIKE_DISTANCE * distance / MEDIAN_DEVIATION].std())
    share = float((isolation > MIN_SPIKE_DISTANCE * rms_height).mean())
    return {"spike_share": share, "rms_height_without_spikes": rms_height} if share else {}


def _isolation(heights: Floats) -> Floats:
    """Return the distance of each height to its nearest neighbour, or second nearest in a map."""
    padded = np.pad(heights, 1, constant_values=np.inf)
    nearest = second_nearest = np.full(heights.shape, np.inf)
    for start in product(range(3), repeat=heights.ndim):
        if set(start) == {1}:
            continue
        window = (slice(i, i + count) for i, count in zip(start, heights.shape, strict=True))
        distance = np.abs(padded[tuple(window)] - heights)
        second_nearest = np.minimum(second_nearest, np.maximum(nearest, distance))
        nearest = np.minimum(nearest, distance)
    return second_nearest if heights.ndim == 2 else nearest


def _find_equal_lines(lines: Floats) -> NDArray[np.bool_]:
    """Return the mask (y,) of lines of a map that are constant or repeat the previous line."""
    equal = np.asarray(np.ptp(lines, axis=1) == 0)
    equal[1:] |= (lines[1:] == lines[:-1]).all(axis=1)
    return equal


def _clipping_numbers(heights: Floats) -> dict[str, Numbers]:
    """Return the shares of pixels at the highest and the lowest value, if they are clipped."""
    _, counts = np.unique(heights, return_counts=True)
    if len(counts) < 2:
        return {}
    numbers = {}
    for code, (end_count, next_count) in (("highest", counts[::-1][:2]), ("lowest", counts[:2])):
        share = float(end_count / heights.size)
        if share > MAX_END_SHARE and end_count > max(MAX_END_RATIO * next_count, MAX_END_PIXELS):
            numbers[code] = {f"{code}_share": share}
    return numbers


def _curvature_numbers(heights: Floats, pixel_size: float) -> Numbers:
    """Return the radius (nm) of a curvature, and the relative rms height without it."""
    step = max(1, len(heights) // POLYNOMIAL_POINTS)
    points = heights[::step, ::step]
    axis = np.linspace(-1, 1, len(points))
    powers = np.array([(order - j, j) for order in range(5) for j in range(order + 1)])
    terms = [np.outer(axis**i, axis**j).ravel() for i, j in powers]
    polynomials, triangle = np.linalg.qr(np.transpose(terms))
    amplitudes = polynomials.T @ points.ravel()
    orders = powers.sum(axis=1)
    power = [float((amplitudes[orders == order] ** 2).sum()) for order in range(5)]
    total = float((points**2).sum()) - power[0] - power[1]
    uncurved_power = max(total - power[2], 0.0)
    higher_orders = power[3] + power[4]
    is_weak = uncurved_power >= MAX_UNCURVED_SHARE**2 * total
    if is_weak or power[2] < MIN_SECOND_ORDER_RATIO * higher_orders:
        return {}
    terms_of_order = np.linalg.solve(triangle, np.where(orders == 2, amplitudes, 0))
    yy, xy, xx = terms_of_order[orders == 2]
    half_width = (len(points) - 1) * step * pixel_size / 2
    curvatures = np.linalg.eigvalsh([[2 * yy, xy], [xy, 2 * xx]]) / half_width**2
    return {
        "curvature_radius": float(1 / np.abs(curvatures).max()),
        "uncurved_share": float(np.sqrt(uncurved_power / total)),
    }


def _line_offset_numbers(heights: Floats) -> Numbers:
    """Return the rms offset (nm) of lines that are offset at random."""
    steps = np.diff(heights, axis=0)
    line_steps = steps.mean(axis=1)
    is_most = line_steps.var() > steps.var() / 2
    is_random = _correlation_of_steps(line_steps) < MIN_STEP_CORRELATION
    offset = float(line_steps.std() / np.sqrt(2))
    return {"line_offset": offset} if is_most and is_random else {}


def _correlation_of_steps(steps: Floats) -> float:
    """Return the correlation of steps with the next ones along the first axis."""
    return float((steps[1:] * steps[:-1]).mean() / max((steps**2).mean(), np.finfo(float).tiny))


def _slope_numbers(heights: Floats, pixel_size: float) -> Numbers:
    """Return the rms slopes along x and y; none if noise of lines makes the steeper one."""
    steps = [np.diff(lines, axis=0) for lines in (heights.T, heights)]
    slopes = [float(axis_steps.std()) / pixel_size for axis_steps in steps]
    is_noise = _correlation_of_steps(steps[int(np.argmax(slopes))]) < MIN_STEP_CORRELATION
    return {} if is_noise else {"slope_along_x": slopes[0], "slope_along_y": slopes[1]}


def _sidewall_numbers(heights: Floats) -> Numbers:
    """Return the share of the squared slopes at the steepest pixels, which are sidewalls."""
    if heights.ndim == 2:
        squares = np.diff(heights, axis=0)[:, 1:] ** 2 + np.diff(heights, axis=1)[1:] ** 2
    else:
        squares = np.diff(heights) ** 2
    squares = np.sort(squares, axis=None)
    steepest = squares[-max(1, round(SIDEWALL_PIXEL_SHARE * squares.size)) :]
    share = float(steepest.sum() / squares.sum())
    return {"sidewall_slope_share": share} if share > MIN_SIDEWALL_SLOPE_SHARE else {}
