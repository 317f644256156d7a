"""Heights of scans as they are used: maps cropped to squares, gaps filled, profiles resampled.

The radius of the tip, where a file or a container states it.
"""

import re
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from hardcontact.surfaces.measurement import (
    LENGTHS,
    RefusedScan,
    check_lengths,
    check_points,
    unit_in_nm,
)

if TYPE_CHECKING:
    from SurfaceTopography import NonuniformLineScan, Topography, UniformLineScan

__all__ = ["Values", "map_values", "profile_values", "stated_tip_radius"]

#: How far points of a line scan may lie from uniform spacing, in spacings: files round positions.
ROUNDING = 0.05


class Values(NamedTuple):
    """Heights in nm on uniform spacing (nm), without gaps: (y, x), or (n,) of a line scan.

    The notes say what was done to them; `undefined` pixels were filled.
    """

    heights: np.ndarray
    pixel_size: float
    notes: list[str]
    undefined: int


def map_values(topography: "Topography", factor: float, undefined_pixels: str) -> Values:
    """Return the central square of a map with physical sizes, whose unit is `factor` nm.

    What is undefined beside the square does not count. Pixels that are undefined and may not be
    filled, or not square, and heights of no scan are a RefusedScan.
    """
    sizes = np.asarray(topography.physical_sizes, float) * factor
    along_x, along_y = sizes / topography.nb_grid_pts
    if not min(along_x, along_y) > 0 or abs(along_x / along_y - 1) > 1e-3:
        raise RefusedScan(f"expected square pixels, found {along_x:.6g} nm x {along_y:.6g} nm")
    heights, notes = _central_square(_masked(topography.heights()))
    undefined = _undefined(heights, undefined_pixels)
    filled = _interpolated(heights, undefined_pixels) if undefined else heights.data
    values, pixel_size = filled.T * factor, float(along_x + along_y) / 2
    check_lengths(values, pixel_size)
    return Values(values, pixel_size, notes + _gaps(undefined, heights.size), undefined)


def _masked(heights: NDArray[np.float64]) -> np.ma.MaskedArray:
    """Return heights whose undefined pixels are masked, however the reader marked them."""
    values = np.asarray(np.ma.getdata(heights), dtype=float)
    return np.ma.masked_array(values, np.ma.getmaskarray(heights) | ~np.isfinite(values))


def _central_square(heights: np.ma.MaskedArray) -> tuple[np.ma.MaskedArray, list[str]]:
    """Return the central square of heights (x, y), and what was cut if they are none."""
    columns, rows = heights.shape
    if rows == columns:
        return heights, []
    edge = min(rows, columns)
    left, low = (columns - edge) // 2, (rows - edge) // 2
    square = heights[left : left + edge, low : low + edge]
    return square, [f"cropped from {columns} x {rows} to {edge} x {edge} pixels"]


def _undefined(heights: np.ma.MaskedArray, undefined_pixels: str) -> int:
    """Return how many pixels are undefined; all, or any that may not be filled, are refused."""
    count = int(heights.mask.sum())
    if count == heights.size:
        raise RefusedScan(f"expected heights, found {count} undefined pixels and no other")
    if count and undefined_pixels == "refuse":
        raise RefusedScan(
            f"expected no undefined pixels, found {count}; "
            "the key scan.undefined_pixels: harmonic fills them"
        )
    return count


def _gaps(count: int, points: int) -> list[str]:
    """Return what is said of undefined pixels, if there are any."""
    return [f"{count} undefined pixels of {points} filled"] if count else []


def _interpolated(heights: np.ma.MaskedArray, method: str) -> NDArray[np.float64]:
    """Return heights (x, y) whose gaps are filled by an interpolation of SurfaceTopography."""
    from SurfaceTopography import Topography

    filled = Topography(heights, heights.shape).interpolate_undefined_data(method)
    return np.asarray(filled.heights())


def profile_values(
    line_scan: "UniformLineScan | NonuniformLineScan", factor: float, undefined_pixels: str
) -> Values:
    """Return a line scan on uniform spacing: the median of its own, if that varies.

    Its unit is `factor` nm; positions increase, or decrease, from each point to the next, and
    increase in what is returned. Between points heights are interpolated linearly. So are gaps: on
    a line, that is the harmonic function through their ends. A line scan that is reentrant, has
    undefined points that may not be filled or too many on the median spacing, and heights of no
    scan are a RefusedScan.
    """
    heights = _masked(line_scan.heights())
    positions = np.asarray(line_scan.positions(), float) * factor
    if positions[-1] < positions[0]:
        positions, heights = positions[::-1], heights[::-1]
    undefined = _undefined(heights, undefined_pixels)
    grid, notes = _uniform_grid(positions)
    defined = ~heights.mask
    values = np.interp(grid, positions[defined], heights.data[defined]) * factor
    pixel_size = float((grid[-1] - grid[0]) / (len(grid) - 1))
    check_lengths(values, pixel_size)
    return Values(values, pixel_size, notes + _gaps(undefined, heights.size), undefined)


def _uniform_grid(positions: NDArray[np.float64]) -> tuple[NDArray[np.float64], list[str]]:
    """Return positions on uniform spacing, and what was changed if these (nm) are not."""
    spacings = np.diff(positions)
    if not (spacings > 0).all():
        point = int(np.argmin(spacings > 0)) + 1
        raise RefusedScan(
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


#: "Tip radius: 8 nm", "Initial tip radii - 17 nm" and the like in the words of a container.
IN_WORDS = re.compile(r"\btip\s+radi(?:us|i)\b[\s:=~≈\-–]*(\d+(?:\.\d+)?)\s*(nm|µm|μm|um)\b", re.I)


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
    except (LookupError, TypeError, ValueError, RefusedScan):
        return None
    least, most = LENGTHS
    return radius if least <= radius <= most else None
