"""Find defects of a scan that make forces wrong although its file is readable."""

from collections.abc import Mapping
from dataclasses import replace
from itertools import product
from pathlib import Path

import numpy as np
import yaml
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats
from hardcontact.base.formatting import format_length, format_share
from hardcontact.base.statistics import MEDIAN_DEVIATION
from hardcontact.scans.line_patterns import MIN_WAVES, find_line_patterns
from hardcontact.scans.reliable_wavelengths import FLATTEST_SLOPE, MIN_STANDARD_ERRORS
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.levelling import MIN_STREAK_STEPS, fill_streaks, remove_form

#: The numbers of a defect by name; empty without the defect.
Defect = dict[str, float]

#: Sentences on defects by code, with the names of their numbers in braces.
DEFECT_SENTENCES: dict[str, str] = yaml.safe_load(
    Path(__file__).with_name("defects.yaml").read_text("utf-8")
)
#: By code of a defect: its numbers with the units in which its sentence gives them.
DEFECTS = {
    "streaks": {
        "streak_lines": "lines", "first_streak_line": "lines", "last_streak_line": "lines",
        "rms_height_without_streaks": "nm",
    },
    "spikes": {"spike_share": "%", "rms_height_without_spikes": "nm"},
    "equal_lines": {"equal_line_share": "%"},
    "highest": {"highest_share": "%"},
    "lowest": {"lowest_share": "%"},
    "curvature": {"curvature_radius": "nm", "uncurved_share": "%"},
    "offset_lines": {"line_offset": "nm"},
    "lay": {"lay_ratio": "1"},
    "slopes": {"slope_along_x": "1", "slope_along_y": "1"},
    "sidewalls": {"sidewall_slope_share": "%"},
    "noise": {"noise_height": "nm", "rms_height_without_noise": "nm"},
}  # fmt: skip
#: The numbers of all defects with their units in datasets.
DEFECT_UNITS = {
    name: "nm" if unit == "nm" else "1"
    for units in DEFECTS.values()
    for name, unit in units.items()
}

#: Least height difference of a spike from its neighbours, in rms heights. In white Gaussian noise
#: one of 2·10⁹ pixels of a map, and one of 4·10⁶ points of a line scan, differs so much.
MIN_SPIKE_DISTANCE = 6.0
#: Largest share of equal lines in a sound scan: so few lines change a mean force little.
MAX_EQUAL_LINE_SHARE = 0.01
#: A clipped scan has more than this share, and this number, of pixels at an end: the highest or the
#: lowest height.
MAX_END_SHARE = 1e-3
MAX_END_PIXELS = 10
#: A clipped scan has more than this ratio of pixels at an end to pixels at the next height. The
#: ratio is below 1 for quantised heights, 2.4 for a flat summit, -r⁴.
MAX_CLIPPING_RATIO = 3.0
#: Share of the steepest pixels, which may be sidewalls.
SIDEWALL_PIXEL_SHARE = 0.05
#: Least share of sidewalls in the sum of squared slopes. The share of the steepest pixels is 0.2 to
#: 0.45 on rough surfaces, 0.8 to 1 with pillars and steps.
MIN_SIDEWALL_SLOPE_SHARE = 0.7
#: Least share of noise in the variance of heights: it changes the rms height by one per cent.
MIN_NOISE_SHARE = 0.02
#: A curvature is a defect if less than this share of the rms height is left without it.
MAX_UNCURVED_SHARE = 0.9
#: Least sum of squares of polynomials of second order relative to third and fourth order, for a
#: curvature. The largest ratio in 8100 self-affine maps without one (H from 0.5 to 1) is 34.
MIN_SECOND_ORDER_RATIO = 50.0
#: Least number of points per row to which polynomials are fitted, if a map has so many pixels.
POLYNOMIAL_POINTS = 32


def level_and_list_defects(
    scan: HeightMap, sphere_radius: float | None = None, levelling: str = "plane"
) -> HeightMap:
    """Return a scan levelled by `remove_form`, with its defects by code; the radius is in nm."""
    flat = remove_form(scan, sphere_radius, levelling)
    defects = _find_defects(scan, flat.heights)
    return replace(flat, defects={code: defects[code] for code in DEFECTS if defects.get(code)})


def _find_defects(scan: HeightMap, heights: Floats) -> dict[str, Defect]:
    """Find the defects of a scan with levelled heights, by code; a defect without numbers is none.

    A defect is not looked for if another defect imitates or hides it. Equal lines look like a lay,
    for example, and sidewalls hide white noise. Defects are looked for in this order:

    | defect | in scans | not looked for with |
    |---|---|---|
    | curvature | maps | |
    | equal_lines | maps | |
    | streaks | maps | equal_lines |
    | highest, lowest | all | |
    | spikes | all | |
    | sidewalls | all | equal_lines, spikes |
    | offset_lines, lay | maps | equal_lines |
    | slopes | maps | equal_lines, offset_lines, lay |
    | noise | maps | equal_lines, spikes, sidewalls, offset_lines, quantised heights |

    The highest and lowest heights are those of the measured scan without equal lines. From spikes
    on, the heights are levelled, with filled streaks.
    """
    # Levelling makes equal heights unequal, so tests of equal heights need the measured ones.
    measured_heights = scan.heights
    defects: dict[str, Defect] = {}
    if scan.kind == "map":
        defects["curvature"] = _find_curvature(heights, scan.pixel_size)
        is_equal_row = _find_equal_lines(measured_heights)
        is_equal_column = _find_equal_lines(measured_heights.T)
        equal_line_share = float(max(is_equal_row.mean(), is_equal_column.mean()))
        if equal_line_share > MAX_EQUAL_LINE_SHARE:
            defects["equal_lines"] = {"equal_line_share": equal_line_share}
            measured_heights = measured_heights[~is_equal_row][:, ~is_equal_column]
        else:
            heights, defects["streaks"] = _find_and_fill_streaks(heights)
    defects |= _find_clipping(measured_heights)
    defects["spikes"] = _find_spikes(heights)
    if not (defects.get("equal_lines") or defects["spikes"]):
        defects["sidewalls"] = _find_sidewalls(heights)
    if scan.kind == "map" and not defects.get("equal_lines"):
        power = _wave_power(heights)
        defects |= find_line_patterns(heights, power, scan.pixel_size)
        # Rounding of quantised heights, most of which equal the next height, is noise, too.
        is_quantised = np.median(np.abs(np.diff(scan.heights, axis=0))) == 0
        hiding_defects = ("spikes", "sidewalls", "offset_lines")
        if not (is_quantised or any(defects.get(code) for code in hiding_defects)):
            defects["noise"] = _find_noise(heights.var(), power)
    return defects


def _find_and_fill_streaks(heights: Floats) -> tuple[Floats, Defect]:
    """Return a map with filled streaks, and the numbers of this defect; lines count from 1."""
    filled_heights, is_filled = fill_streaks(heights)
    lines = np.flatnonzero(is_filled.any(axis=1)) + 1
    if not lines.size:
        return heights, {}
    return filled_heights, {
        "streak_lines": float(lines.size),
        "first_streak_line": float(lines[0]),
        "last_streak_line": float(lines[-1]),
        "rms_height_without_streaks": float(filled_heights.std()),
    }


def _find_spikes(heights: Floats) -> Defect:
    """Return the share of spikes, and the rms height (nm) without them."""
    isolation = _isolation(heights)
    # Spikes raise the rms height, so a limit from the median deviation first leaves them out.
    median_deviation = np.median(np.abs(heights - np.median(heights)))
    max_isolation = MIN_SPIKE_DISTANCE * median_deviation / MEDIAN_DEVIATION
    rms_height = float(heights[isolation <= max_isolation].std())
    share = float((isolation > MIN_SPIKE_DISTANCE * rms_height).mean())
    return {"spike_share": share, "rms_height_without_spikes": rms_height} if share else {}


def _isolation(heights: Floats) -> Floats:
    """Return the least difference of each height from its neighbours; in a map the second least."""
    padded = np.pad(heights, 1, constant_values=np.inf)
    least = second_least = np.full(heights.shape, np.inf)
    for start in product(range(3), repeat=heights.ndim):
        if set(start) == {1}:  # the pixel itself
            continue
        window = (slice(i, i + count) for i, count in zip(start, heights.shape, strict=True))
        difference = np.abs(padded[tuple(window)] - heights)
        second_least = np.minimum(second_least, np.maximum(least, difference))
        least = np.minimum(least, difference)
    # One neighbour of a spike in a map may be a spike, too; a particle has more pixels.
    return second_least if heights.ndim == 2 else least


def _find_equal_lines(lines: Floats) -> NDArray[np.bool_]:
    """Return the mask (n,) of lines (n, points) that are constant or repeat the previous line."""
    is_equal = np.asarray(np.ptp(lines, axis=1) == 0)
    is_equal[1:] |= (lines[1:] == lines[:-1]).all(axis=1)
    return is_equal


def _find_clipping(heights: Floats) -> dict[str, Defect]:
    """Return the shares of pixels at the highest and the lowest height, each if it is clipped."""
    _, counts = np.unique(heights, return_counts=True)
    if len(counts) < 2:
        return {}
    defects = {}
    for code, (end_count, next_count) in (("highest", counts[::-1][:2]), ("lowest", counts[:2])):
        share = float(end_count / heights.size)
        max_count = max(MAX_CLIPPING_RATIO * next_count, MAX_END_PIXELS)
        if share > MAX_END_SHARE and end_count > max_count:
            defects[code] = {f"{code}_share": share}
    return defects


def _find_sidewalls(heights: Floats) -> Defect:
    """Return the share of the steepest pixels in the squared slopes, if they are sidewalls."""
    if heights.ndim == 2:
        squared_steps = np.diff(heights, axis=0)[:, 1:] ** 2 + np.diff(heights, axis=1)[1:] ** 2
    else:
        squared_steps = np.diff(heights) ** 2
    squared_steps = np.sort(squared_steps, axis=None)
    steepest = squared_steps[-max(1, round(SIDEWALL_PIXEL_SHARE * squared_steps.size)) :]
    total = squared_steps.sum()
    share = float(steepest.sum() / total) if total else 0.0
    return {"sidewall_slope_share": share} if share > MIN_SIDEWALL_SLOPE_SHARE else {}


def _wave_power(heights: Floats) -> Floats:
    """Return the power (y, x) of the waves in a map under a Hann window, |FFT|² in nm²."""
    window = np.hanning(len(heights) + 1)[:-1]
    return np.asarray(np.abs(np.fft.fft2(heights * np.outer(window, window))) ** 2)


def _find_curvature(heights: Floats, pixel_size: float) -> Defect:
    """Return the smallest radius (nm) of a curvature, and the share of the rms height without it.

    A polynomial of fourth order is fitted to some heights. Its terms are orthonormal and sorted by
    order, so the squared amplitudes of an order are what this order adds to the sum of squares. A
    ball or a bow is the second order, which roughness has, too. Hence it must be much stronger than
    the third and fourth order, which roughness has as well, but a ball or a bow has not.
    """
    step = max(1, len(heights) // POLYNOMIAL_POINTS)
    sampled_heights = heights[::step, ::step]
    axis = np.linspace(-1, 1, len(sampled_heights))
    exponents = np.array([(order - j, j) for order in range(5) for j in range(order + 1)])  # y, x
    orders = exponents.sum(axis=1)
    terms = [np.outer(axis**i, axis**j).ravel() for i, j in exponents]
    orthonormal_terms, triangle = np.linalg.qr(np.transpose(terms))
    amplitudes = orthonormal_terms.T @ sampled_heights.ravel()
    squares = [float((amplitudes[orders == order] ** 2).sum()) for order in range(5)]
    total = float((sampled_heights**2).sum()) - squares[0] - squares[1]  # without height and tilt
    uncurved_squares = max(total - squares[2], 0.0)
    is_weak = uncurved_squares >= MAX_UNCURVED_SHARE**2 * total
    if is_weak or squares[2] < MIN_SECOND_ORDER_RATIO * (squares[3] + squares[4]):
        return {}
    # The second order alone is yy y² + xy x y + xx x² plus a plane, with x and y from -1 to 1.
    coefficients = np.linalg.solve(triangle, np.where(orders == 2, amplitudes, 0))
    yy, xy, xx = coefficients[orders == 2]
    half_width = (len(sampled_heights) - 1) * step * pixel_size / 2
    curvatures = np.linalg.eigvalsh([[2 * yy, xy], [xy, 2 * xx]]) / half_width**2
    return {
        "curvature_radius": float(1 / np.abs(curvatures).max()),
        "uncurved_share": float(np.sqrt(uncurved_squares / total)),
    }


def _find_noise(variance: float, power: Floats) -> Defect:
    """Return the rms height (nm) of white noise, and the rms height of a map without it.

    White noise has the same power at all waves, and surfaces have less power at shorter waves. So
    noise makes the spectrum flat at the shortest waves, but not at longer ones. The slopes of the
    spectrum between mean powers of half octaves show this. The power of the shortest half octave
    then counts as noise at all waves, which is the most that it can be.
    """
    pixels = len(power)
    waves = np.fft.fftfreq(pixels, 1 / pixels)
    wavenumber = np.hypot(waves, waves[:, None])  # in waves across the map
    log_wavelength = np.log2(pixels / np.maximum(wavenumber, 1))  # of the wavelength in pixels
    # The half octaves are centred on these wavelengths in pixels: 2^1.5, 2^2, 2^2.5 and so on.
    wavelengths = 2 ** np.arange(1.5, np.log2(pixels / MIN_WAVES), 0.5)
    if len(wavelengths) < 2:
        return {}
    half_octave_masks = [np.abs(log_wavelength - np.log2(centre)) < 1 / 4 for centre in wavelengths]
    mean_powers = [power[mask].mean() for mask in half_octave_masks]
    counts = [np.count_nonzero(mask) for mask in half_octave_masks]
    # Slopes of the logarithmic spectrum against the wavenumber, shortest waves first. Mean powers
    # go from short to long waves, and two half octaves are one unit of log2.
    slopes = -2 * np.diff(np.log2(np.maximum(mean_powers, np.finfo(float).tiny)))
    # Under the window one wave of four is independent, and opposite wavevectors have equal power.
    relative_errors = np.sqrt(8 / np.array(counts))
    errors = 2 / np.log(2) * np.hypot(relative_errors[1:], relative_errors[:-1])
    margins = MIN_STANDARD_ERRORS * errors
    is_flat_at_short_waves = slopes[0] - margins[0] > FLATTEST_SLOPE
    is_steep_elsewhere = (slopes + margins).min() < FLATTEST_SLOPE
    # The mean square of the window is 3/8 along each axis.
    noise_variance = mean_powers[0] / (3 / 8 * pixels) ** 2
    is_weak = noise_variance < MIN_NOISE_SHARE * variance
    if is_weak or not (is_flat_at_short_waves and is_steep_elsewhere):
        return {}
    return {
        "noise_height": float(np.sqrt(noise_variance)),
        "rms_height_without_noise": float(np.sqrt(max(variance - noise_variance, 0))),
    }


def defect_sentence(code: str, numbers: Mapping[str, float]) -> str:
    """Return the sentence on a defect, without its subject, the scan, and without a full stop."""
    words = {name: _format_number(numbers[name], unit) for name, unit in DEFECTS[code].items()}
    words["sidewall_pixels"] = format_share(SIDEWALL_PIXEL_SHARE)
    return DEFECT_SENTENCES[code].format(**words, streak=MIN_STREAK_STEPS, spike=MIN_SPIKE_DISTANCE)


def _format_number(number: float, unit: str) -> str:
    """Return a number in words; its unit is one of those in DEFECTS."""
    if unit == "nm":
        return format_length(number)
    if unit == "lines":
        return f"{number:.0f}"
    rounded = float(f"{number:.2g}")
    return format_share(rounded) if unit == "%" else f"{rounded:g}"
