"""Measured topographies: one value for each, and how it is made of what a reader returns.

Maps are cropped to squares, gaps filled, line scans resampled, tips looked up; what no scan can be
is refused: files, pixels, lengths and slopes beyond limits. SurfaceTopography is imported where it
is used.
"""

import re
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hardcontact.numbers.printing import print_length
from hardcontact.surfaces.limited_process import RefusedFile

Floats = NDArray[np.float64]


#: Pixels along an edge of a map: substitutes have no fewer, and masters at least twice as many.
PIXELS = (16, 8192)
#: Points of a line scan, as read and as resampled.
POINTS = (16, 2**20)
#: Pixels and heights of a scan in nm, 1 pm to 1 cm: the range of all microscopes, and squares of
#: these keep their digits. A damaged header may state any number.
LENGTHS = (1e-3, 1e7)
#: By what share edges of a square pixel may differ.
OBLONG = 1e-3
#: Share of undefined pixels beyond which a scan is more filled than measured.
MOST_UNDEFINED = 0.5
#: The largest mean slope: no tip follows 84 degrees; heights read from a wrong place in a file
#: are steeper.
SLOPE_LIMIT = 10
#: How far points of a line scan may lie from uniform spacing, in spacings: files round positions.
ROUNDING = 0.05
#: "Tip radius: 8 nm", "Initial tip radii - 17 nm" and the like in the words of a container.
IN_WORDS = re.compile(r"\btip\s+radi(?:us|i)\b[\s:=~≈\-–]*(\d+(?:\.\d+)?)\s*(nm|µm|μm|um)\b", re.I)


def check_points(counts: tuple[int, ...]) -> None:
    """Refuse a map (x, y) or a line scan (n,) of too few or too many points."""
    least, most = PIXELS if len(counts) == 2 else POINTS
    if not least <= min(counts) <= max(counts) <= most:
        found = " x ".join(map(str, counts))
        where = "pixels along an edge" if len(counts) == 2 else "points along a line scan"
        raise RefusedFile(f"expected {least} to {most} {where}, found {found}")


def _fields(heights: Floats, pixel_size: float, notes: list[str], undefined: int) -> dict[str, Any]:
    """Return these fields of a `Measurement`; refuse heights and a pixel size that no scan has.

    An offset that is larger than any relief, the place of a stage, is subtracted if the heights
    have digits below it.
    """
    least, most = LENGTHS
    offset = float(np.median(heights))
    if most < abs(offset) < least / np.finfo(float).eps:
        heights = heights - offset
        notes = [*notes, f"offset of {print_length(offset)} subtracted"]
    low, high = heights.min(), heights.max()
    if (
        not least <= pixel_size <= most
        or not max(-low, high) <= most  # also true of what is no number
        or 0 < high - low < least
    ):
        raise RefusedFile(
            f"expected pixels and differences of height from {least:g} to {most:g} nm, "
            f"found pixels of {pixel_size:.6g} nm and heights from {low:.6g} to {high:.6g} nm"
        )
    slope = np.abs(np.diff(heights)).mean() / pixel_size
    if slope > SLOPE_LIMIT:
        raise RefusedFile(f"expected a mean slope of at most {SLOPE_LIMIT}, found {slope:.3g}")
    return {"heights": heights, "pixel_size": pixel_size, "notes": notes, "undefined": undefined}


def unit_in_nm(unit: str) -> float:
    """Return a unit of length in nm; any other unit is refused."""
    from SurfaceTopography.Support.UnitConversion import get_unit_conversion_factor

    try:
        return float(get_unit_conversion_factor(unit, "nm"))
    except ValueError:
        raise RefusedFile(f"expected a unit of length, found {unit!r}") from None


def map_values(topography: Any, factor: float, undefined_pixels: str) -> dict[str, Any]:
    """Return fields of the `Measurement` of a map with physical sizes, whose unit is `factor` nm.

    It is the central square, on square pixels; what is undefined beside it does not count. Pixels
    that are undefined and may not be filled, and heights of no scan are a RefusedFile.
    """
    from SurfaceTopography import Topography

    sizes = np.asarray(topography.physical_sizes, float) * factor
    heights, pixel_size, notes = _square_pixels(
        _masked(topography.heights()), sizes / topography.nb_grid_pts
    )
    columns, rows = heights.shape
    if rows != columns:
        edge = min(rows, columns)
        left, low = (columns - edge) // 2, (rows - edge) // 2
        heights = heights[left : left + edge, low : low + edge]
        notes.append(f"cropped from {columns} x {rows} to {edge} x {edge} pixels")
    undefined, gaps = _undefined(heights, undefined_pixels)
    filled = heights.data
    if undefined:
        holed = Topography(heights, heights.shape)
        filled = np.asarray(holed.interpolate_undefined_data(undefined_pixels).heights())
    return _fields(filled.T * factor, pixel_size, notes + gaps, undefined)


def _square_pixels(
    heights: np.ma.MaskedArray, edges: Floats
) -> tuple[np.ma.MaskedArray, float, list[str]]:
    """Return heights (x, y) of pixels with these edges (nm) on square ones, their edge, a note.

    They have the longer edge: on the shorter one waves would be missing along one axis. In between
    heights are interpolated linearly, and are undefined beside a pixel that is.
    """
    longer = float(edges.max())
    if not 0 < edges.min() <= longer < np.inf:
        found = " nm x ".join(f"{edge:.6g}" for edge in edges)
        raise RefusedFile(f"expected pixels of positive edges, found {found} nm")
    if longer <= (1 + OBLONG) * edges.min():
        return heights, float(edges.mean()), []
    values = heights.filled(np.nan)
    for axis, edge in enumerate(edges):
        given = np.arange(values.shape[axis]) * edge
        wanted = np.arange(int(values.shape[axis] * edge / longer * (1 + 1e-9))) * longer
        values = np.apply_along_axis(partial(np.interp, wanted, given), axis, values)
    check_points(values.shape)
    note = f"resampled from pixels of {edges[0]:.4g} nm x {edges[1]:.4g} nm to {longer:.4g} nm"
    return _masked(values), longer, [note]


def _masked(heights: Floats) -> np.ma.MaskedArray:
    """Return heights whose undefined pixels are masked, however the reader marked them."""
    values = np.asarray(np.ma.getdata(heights), dtype=float)
    return np.ma.masked_array(values, np.ma.getmaskarray(heights) | ~np.isfinite(values))


def _undefined(heights: np.ma.MaskedArray, undefined_pixels: str) -> tuple[int, list[str]]:
    """Return how many pixels are undefined, and what is said of them, if there are any.

    More than MOST_UNDEFINED, or any that may not be filled, are refused.
    """
    count = int(heights.mask.sum())
    if count > MOST_UNDEFINED * heights.size:
        raise RefusedFile(
            f"expected at most {MOST_UNDEFINED:.0%} of the pixels undefined, "
            f"found {count} of {heights.size}"
        )
    if count and undefined_pixels == "refuse":
        raise RefusedFile(
            f"expected no undefined pixels, found {count}; "
            "the key scan.undefined_pixels: harmonic fills them"
        )
    return count, [f"{count} undefined pixels of {heights.size} filled"] if count else []


def profile_values(line_scan: Any, factor: float, undefined_pixels: str) -> dict[str, Any]:
    """Return fields of the `Measurement` of a line scan, whose unit is `factor` nm.

    It is on uniform spacing, the median of its own if that varies. Positions increase, or decrease,
    from each point to the next, and increase in what is returned. Between points heights are
    interpolated linearly. So are gaps: on a line, that is the harmonic function through their ends.
    A line scan that is reentrant, has undefined points that may not be filled or too many on the
    median spacing, and heights of no scan are a RefusedFile.
    """
    heights = _masked(line_scan.heights())
    positions = np.asarray(line_scan.positions(), float) * factor
    if positions[-1] < positions[0]:
        positions, heights = positions[::-1], heights[::-1]
    undefined, gaps = _undefined(heights, undefined_pixels)
    grid, notes = _uniform_grid(positions)
    defined = ~heights.mask
    values = np.interp(grid, positions[defined], heights.data[defined]) * factor
    pixel_size = float((grid[-1] - grid[0]) / (len(grid) - 1))
    return _fields(values, pixel_size, notes + gaps, undefined)


def _uniform_grid(positions: Floats) -> tuple[Floats, list[str]]:
    """Return positions on uniform spacing, and what was changed if these (nm) are not."""
    spacings = np.diff(positions)
    if not (spacings > 0).all():
        point = int(np.argmin(spacings > 0)) + 1
        raise RefusedFile(
            "expected positions that increase along a line scan, found a reentrant one: "
            f"point {point + 1} is at {positions[point]:.6g} nm, "
            f"that before it at {positions[point - 1]:.6g} nm"
        )
    uniform = np.linspace(positions[0], positions[-1], len(positions))
    if np.abs(positions - uniform).max() < ROUNDING * spacings.mean():
        return positions, []
    spacing = float(np.median(spacings))
    count = int((positions[-1] - positions[0]) / spacing + 1 + 1e-9)
    check_points((count,))
    note = (
        f"resampled from spacings of {spacings.min():.4g} to {spacings.max():.4g} nm "
        f"to their median of {spacing:.4g} nm"
    )
    return positions[0] + spacing * np.arange(count), [note]


def stated_tip_radius(
    of_file: dict[str, Any], of_container: dict[str, Any]
) -> tuple[float | None, list[str]]:
    """Return the radius of the tip in nm, if one is stated, and notes for the user of where.

    What the file states counts before what its container does, and a number before words. Of
    several radii in words the largest counts: tips wear, and a scan shows no more than a worn one.
    """
    for source, metadata in (("file", of_file), ("container", of_container)):
        radius = _in_numbers(metadata)
        if radius is not None:
            return radius, [f"tip radius of {radius:.4g} nm stated by the {source}"]
    stated = IN_WORDS.findall(str(of_container.get("description") or ""))
    radii = [float(value) * unit_in_nm(unit) for value, unit in stated]
    if not radii:
        return None, []
    found = " and ".join(f"{radius:.4g} nm" for radius in radii)
    used = "" if len(radii) == 1 else ", of which the largest is used"
    return max(radii), [f"tip radius of {found} in the container's description{used}"]


def _in_numbers(metadata: dict[str, Any]) -> float | None:
    """Return the radius (nm) in metadata of an instrument, if they state one that a tip may have.

    These are the keys of ``InfoModel`` and of ``TopographyMeta`` of SurfaceTopography.
    """
    try:
        stated = metadata["instrument"]["parameters"]["tip_radius"]
        radius = float(stated["value"]) * unit_in_nm(stated["unit"])
    except (LookupError, TypeError, ValueError, RefusedFile):
        return None
    least, most = LENGTHS
    return radius if least <= radius <= most else None
