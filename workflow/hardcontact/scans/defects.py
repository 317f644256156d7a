"""Find defects of a scan that make forces wrong although its file is readable, and state them."""

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
from hardcontact.scans.map_defects import (
    Defect,
    find_curvature,
    find_line_patterns,
    find_noise,
    wave_power,
)
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.levelling import MIN_STREAK_STEPS, fill_streaks, remove_form

#: Sentences on defects by code, with the names of their numbers in braces.
DEFECT_SENTENCES: dict[str, str] = yaml.safe_load(
    Path(__file__).with_name("defects.yaml").read_text("utf-8")
)
#: By code of a defect: its numbers with their units.
DEFECTS = {
    "streaks": {
        "streak_lines": "1", "first_streak_line": "1", "last_streak_line": "1",
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
}  # fmt: skip
#: The numbers of all defects with their units.
DEFECT_UNITS = {name: unit for units in DEFECTS.values() for name, unit in units.items()}

#: Least distance of a spike from its neighbours, in rms heights: once in 10⁹ Gaussian pixels.
MIN_SPIKE_DISTANCE = 6.0
#: Largest share of equal lines: so few lines change a mean force little.
MAX_EQUAL_LINE_SHARE = 0.01
#: Largest share, and number, of the pixels at the highest or lowest height of an unclipped scan.
MAX_END_SHARE = 1e-3
MAX_END_PIXELS = 10
#: Largest ratio of pixels at the highest or lowest height to those at the next height. Quantised
#: heights have less than 1, a flat summit has 2.4.
MAX_CLIPPING_RATIO = 3.0
#: Share of the steepest pixels, which may be sidewalls.
SIDEWALL_PIXEL_SHARE = 0.05
#: Least share of sidewalls in the squared slopes. The steepest pixels have 0.2 to 0.45 of them on
#: rough surfaces, 0.8 to 1 with pillars and steps.
MIN_SIDEWALL_SLOPE_SHARE = 0.7


def scan_defects(
    raw_heights: Floats, levelled_heights: Floats, pixel_size: float
) -> dict[str, Defect]:
    """Return the defects of a scan by code, each with its numbers as in DEFECTS.

    Heights in nm are (y, x), or (n,) of a line scan. Beside some defects others are not looked for:
    equal lines look like a lay, sidewalls hide white noise.
    """
    defects: dict[str, Defect] = {}
    measured_heights = raw_heights
    if raw_heights.ndim == 2:
        defects["curvature"] = find_curvature(levelled_heights, pixel_size)
        rows, columns = _find_equal_lines(raw_heights), _find_equal_lines(raw_heights.T)
        share = float(max(rows.mean(), columns.mean()))
        if share > MAX_EQUAL_LINE_SHARE:
            defects["equal_lines"] = {"equal_line_share": share}
            measured_heights = raw_heights[~rows][:, ~columns]
        else:
            levelled_heights, defects["streaks"] = _fill_streaks(levelled_heights)
            power = wave_power(levelled_heights)
            defects |= find_line_patterns(levelled_heights, power, pixel_size)
    defects["spikes"] = _find_spikes(levelled_heights)
    defects |= _find_clipping(measured_heights)
    if not any(defects.get(code) for code in ("equal_lines", "spikes")):
        defects["sidewalls"] = _find_sidewalls(levelled_heights)
    hiding_defects = ("equal_lines", "spikes", "sidewalls", "offset_lines")
    # Quantised heights have noise from rounding.
    is_quantised = np.median(np.abs(np.diff(raw_heights, axis=0))) == 0
    is_noise_hidden = is_quantised or any(defects.get(code) for code in hiding_defects)
    if raw_heights.ndim == 2 and not is_noise_hidden:
        defects["noise"] = find_noise(levelled_heights.var(), power)
    return {code: defects[code] for code in DEFECTS if defects.get(code)}


def level_and_list_defects(
    scan: HeightMap, sphere_radius: float | None = None, levelling: str = "plane"
) -> HeightMap:
    """Return a scan levelled by `remove_form`, with its defects."""
    flat = remove_form(scan, sphere_radius, levelling)
    return replace(flat, defects=scan_defects(scan.heights, flat.heights, scan.pixel_size))


def _fill_streaks(heights: Floats) -> tuple[Floats, Defect]:
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
    isolation = _isolation(heights)
    # Spikes raise the rms height, so leave out pixels that are isolated by the median deviation.
    median_deviation = np.median(np.abs(heights - np.median(heights)))
    max_isolation = MIN_SPIKE_DISTANCE * median_deviation / MEDIAN_DEVIATION
    rms_height = float(heights[isolation <= max_isolation].std())
    share = float((isolation > MIN_SPIKE_DISTANCE * rms_height).mean())
    return {"spike_share": share, "rms_height_without_spikes": rms_height} if share else {}


def _isolation(heights: Floats) -> Floats:
    """Return the least difference of each height from its neighbours; in a map the second least.

    On a map one neighbour of a spike may be a spike, too; pixels of a particle have more.
    """
    padded = np.pad(heights, 1, constant_values=np.inf)
    nearest = second_nearest = np.full(heights.shape, np.inf)
    for start in product(range(3), repeat=heights.ndim):
        if set(start) == {1}:  # the pixel itself
            continue
        window = (slice(i, i + count) for i, count in zip(start, heights.shape, strict=True))
        distance = np.abs(padded[tuple(window)] - heights)
        second_nearest = np.minimum(second_nearest, np.maximum(nearest, distance))
        nearest = np.minimum(nearest, distance)
    return second_nearest if heights.ndim == 2 else nearest


def _find_equal_lines(lines: Floats) -> NDArray[np.bool_]:
    """Return the mask (y,) of lines of a map that are constant or repeat the previous line."""
    is_equal = np.asarray(np.ptp(lines, axis=1) == 0)
    is_equal[1:] |= (lines[1:] == lines[:-1]).all(axis=1)
    return is_equal


def _find_clipping(heights: Floats) -> dict[str, Defect]:
    """Return the shares of pixels at the highest and the lowest value, if they are clipped."""
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
    """Return the share of the squared slopes at the steepest pixels, if these are sidewalls."""
    if heights.ndim == 2:
        squares = np.diff(heights, axis=0)[:, 1:] ** 2 + np.diff(heights, axis=1)[1:] ** 2
    else:
        squares = np.diff(heights) ** 2
    squares = np.sort(squares, axis=None)
    steepest = squares[-max(1, round(SIDEWALL_PIXEL_SHARE * squares.size)) :]
    total = squares.sum()
    share = float(steepest.sum() / total) if total else 0.0
    return {"sidewall_slope_share": share} if share > MIN_SIDEWALL_SLOPE_SHARE else {}


def defect_sentence(code: str, numbers: Mapping[str, float]) -> str:
    """Return the sentence on a defect, without a full stop."""
    words = {name: _format_defect_number(name, number) for name, number in numbers.items()}
    words["sidewall_pixels"] = format_share(SIDEWALL_PIXEL_SHARE)
    return DEFECT_SENTENCES[code].format(**words, streak=MIN_STREAK_STEPS, spike=MIN_SPIKE_DISTANCE)


def _format_defect_number(name: str, number: float) -> str:
    """Return a number of a defect with its unit, a share in percent."""
    if DEFECT_UNITS[name] == "nm":
        return format_length(number)
    if name.endswith(("_lines", "_line")):
        return f"{number:.0f}"
    number = float(f"{number:.2g}")
    return format_share(number) if name.endswith("_share") else f"{number:g}"
