"""Turn a topography of SurfaceTopography into the fields of a scan: heights and pixel size.

Pixels become square, maps are cropped to squares, gaps are filled, uneven line scans are resampled.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
import scipy

from hardcontact.base.arrays import Floats
from hardcontact.base.formatting import format_length, format_share

#: Least and largest number of pixels per row of a map, as the key `substitutes.pixels` allows.
PIXEL_BOUNDS = (16, 8192)
#: Least and largest number of points of a line scan, as read and as resampled.
POINT_BOUNDS = (16, 2**20)
#: Bounds of pixel widths, height differences and tip radii in nm, 1 pm to 1 cm: the range of all
#: microscopes. A damaged header may state any number.
LENGTH_BOUNDS = (1e-3, 1e7)
#: Largest relative difference between the widths of a square pixel: files round them.
MAX_ASPECT_DEVIATION = 1e-3
#: Share of undefined pixels beyond which a scan is more filled than measured.
MAX_UNDEFINED_SHARE = 0.5
#: Least ratio of length to width of a strip, of which at most half is read.
MIN_STRIP_LENGTH = 2
#: Largest mean slope along an axis: no tip follows 84 degrees, but bytes that are no heights are
#: steeper.
MAX_MEAN_SLOPE = 10
#: Prefix of a note that is a caution.
TAKE_CARE = "take care: "
#: How far points may lie from uniform spacing, in spacings: files round positions.
POSITION_ROUNDING = 0.05


class RefusedFile(Exception):
    """A file that cannot be used."""


def split_notes(notes: Sequence[str]) -> tuple[list[str], list[str]]:
    """Return plain notes, and cautions without their prefix TAKE_CARE."""
    plain_notes = [note for note in notes if not note.startswith(TAKE_CARE)]
    cautions = [note.removeprefix(TAKE_CARE) for note in notes if note not in plain_notes]
    return plain_notes, cautions


def refuse_point_counts(counts: tuple[int, ...]) -> None:
    """Refuse a map (x, y) or a line scan (n,) of too few or too many points."""
    is_map = len(counts) == 2
    minimum, maximum = PIXEL_BOUNDS if is_map else POINT_BOUNDS
    if not minimum <= min(counts) <= max(counts) <= maximum:
        points_in_words = "pixels per row" if is_map else "points along a line scan"
        raise RefusedFile(
            f"expected {minimum} to {maximum} {points_in_words}, "
            f"found {' x '.join(map(str, counts))}"
        )


def unit_in_nm(unit: str) -> float:
    """Return a unit of length in nm; refuse any other unit."""
    from SurfaceTopography.Support.UnitConversion import get_unit_conversion_factor

    try:
        return float(get_unit_conversion_factor(unit, "nm"))
    except ValueError:
        raise RefusedFile(f"expected a unit of length, found {unit!r}") from None


def _scan_fields(
    heights: Floats, pixel_size: float, notes: list[str], undefined_count: int
) -> dict[str, Any]:
    """Return the arguments (nm) as fields of a `HeightMap`; refuse impossible numbers."""
    minimum, maximum = LENGTH_BOUNDS
    # An offset larger than any relief is the position of a stage. Beyond minimum / eps, heights
    # have lost their digits.
    offset = float(np.median(heights))
    if maximum < abs(offset) < minimum / np.finfo(float).eps:
        heights = heights - offset
        notes = [*notes, f"offset of {format_length(offset)} subtracted"]
    low, high = heights.min(), heights.max()
    if (
        not minimum <= pixel_size <= maximum
        or not max(-low, high) <= maximum  # also true of NaN
        or 0 < high - low < minimum
    ):
        raise RefusedFile(
            f"expected pixels and differences of height from {minimum:g} to {maximum:g} nm, "
            f"found pixels of {pixel_size:.6g} nm and heights from {low:.6g} to {high:.6g} nm"
        )
    mean_steps = [np.abs(np.diff(heights, axis=axis)).mean() for axis in range(heights.ndim)]
    slope = max(mean_steps) / pixel_size
    if slope > MAX_MEAN_SLOPE:
        raise RefusedFile(f"expected a mean slope of at most {MAX_MEAN_SLOPE}, found {slope:.3g}")
    return {
        "heights": heights,
        "pixel_size": pixel_size,
        "notes": notes,
        "undefined_count": undefined_count,
    }


def map_fields(topography: Any, factor: float, undefined_pixels: str) -> dict[str, Any]:
    """Return the fields of a scan from a square of a map, whose unit is `factor` nm."""
    from SurfaceTopography import Topography

    sizes = np.asarray(topography.physical_sizes, float) * factor
    heights, pixel_size, notes = _resample_to_square_pixels(
        _mask_undefined(topography.heights()), sizes / topography.nb_grid_pts
    )
    columns, rows = heights.shape
    heights = _crop_to_square(heights)
    refuse_point_counts(heights.shape)
    pixels = len(heights)
    if (pixels, pixels) != (columns, rows):
        caution = ""
        if max(rows, columns) >= MIN_STRIP_LENGTH * pixels:
            share = format_share(pixels / max(rows, columns))
            caution = f"{TAKE_CARE}only {share} of this strip is used: "
        notes.append(f"{caution}cropped from {columns} x {rows} to {pixels} x {pixels} pixels")
    undefined_count, undefined_notes = _count_undefined(heights, undefined_pixels)
    filled_heights = heights.data
    if undefined_count:
        square = Topography(heights, heights.shape)
        filled_heights = np.asarray(square.interpolate_undefined_data(undefined_pixels).heights())
    notes += undefined_notes
    return _scan_fields(filled_heights.T * factor, pixel_size, notes, undefined_count)


def _crop_to_square(heights: np.ma.MaskedArray) -> np.ma.MaskedArray:
    """Return the central square of a map, or a square within a round or rotated scan."""
    pixels = min(heights.shape)
    first_column, first_row = ((count - pixels) // 2 for count in heights.shape)
    central = heights[first_column : first_column + pixels, first_row : first_row + pixels]
    # The corners of a round or rotated scan are undefined. Filled, they would be too smooth.
    regions, _ = scipy.ndimage.label(heights.mask)
    corner_regions = regions[[0, 0, -1, -1], [0, -1, 0, -1]]  # 0 if a corner is defined
    if not corner_regions.all() or central.mask.mean() > MAX_UNDEFINED_SHARE:
        return central
    is_in_aperture = np.pad(~np.isin(regions, corner_regions), 1)
    # The largest square within the aperture is around the pixel farthest from its outside.
    distance = scipy.ndimage.distance_transform_cdt(is_in_aperture, "chessboard")[1:-1, 1:-1]
    centre = np.unravel_index(distance.argmax(), distance.shape)
    reach = int(distance.max()) - 1
    columns, rows = (slice(int(index) - reach, int(index) + reach + 1) for index in centre)
    return heights[columns, rows]


def _resample_to_square_pixels(
    heights: np.ma.MaskedArray, widths: Floats
) -> tuple[np.ma.MaskedArray, float, list[str]]:
    """Return heights (x, y) on square pixels, the pixel size, and notes; widths (x, y) in nm."""
    # Squares of the smaller width would lack short waves along one axis.
    widest = float(widths.max())
    if not 0 < widths.min() <= widest < np.inf:
        raise RefusedFile(f"expected pixels of positive widths, found widths of {widths} nm")
    if widest <= (1 + MAX_ASPECT_DEVIATION) * widths.min():
        return heights, float(widths.mean()), []
    resampled = heights.filled(np.nan)
    for axis, width in enumerate(widths):
        positions = np.arange(resampled.shape[axis]) * width
        # Rounding must not lose the last pixel.
        grid = np.arange(int(resampled.shape[axis] * width / widest * (1 + 1e-9))) * widest
        lines = [np.interp(grid, positions, line) for line in np.moveaxis(resampled, axis, -1)]
        resampled = np.moveaxis(np.array(lines), -1, axis)
    refuse_point_counts(resampled.shape)
    notes = [f"resampled from pixels of {widths[0]:.4g} nm x {widths[1]:.4g} nm to {widest:.4g} nm"]
    size_x, size_y = widths * heights.shape
    if abs(size_x / size_y - 1) <= MAX_ASPECT_DEVIATION:
        # Files of Bruker state the size of the full scan, also of one with fewer lines.
        square = " x ".join(format_length(count * widths.min()) for count in heights.shape)
        notes.append(
            f"{TAKE_CARE}the file states {format_length(size_x)} x {format_length(size_y)} for "
            f"{heights.shape[0]} x {heights.shape[1]} pixels, and is read so; if its pixels are "
            f"square, {square} were scanned, and heights are stretched "
            f"{widest / widths.min():.3g} times along {'xy'[widths.argmax()]}"
        )
    return _mask_undefined(resampled), widest, notes


def _mask_undefined(heights: Floats) -> np.ma.MaskedArray:
    """Return heights whose undefined pixels are masked, also those that readers give as NaN."""
    unmasked = np.asarray(np.ma.getdata(heights), dtype=float)
    return np.ma.masked_array(unmasked, np.ma.getmaskarray(heights) | ~np.isfinite(unmasked))


def _count_undefined(heights: np.ma.MaskedArray, undefined_pixels: str) -> tuple[int, list[str]]:
    """Return the number of undefined pixels and notes; refuse too many, or any on "refuse"."""
    count = int(heights.mask.sum())
    if count > MAX_UNDEFINED_SHARE * heights.size:
        raise RefusedFile(
            f"expected at most {MAX_UNDEFINED_SHARE:.0%} of the pixels undefined, "
            f"found {count} of {heights.size}"
        )
    if count and undefined_pixels == "refuse":
        raise RefusedFile(
            f"expected no undefined pixels, found {count}; "
            "scan.undefined_pixels: harmonic fills them"
        )
    return count, [f"{count} undefined pixels of {heights.size} filled"] if count else []


def line_scan_fields(line_scan: Any, factor: float, undefined_pixels: str) -> dict[str, Any]:
    """Return the fields of a scan from a line scan, whose unit is `factor` nm."""
    heights = _mask_undefined(line_scan.heights())
    positions = np.asarray(line_scan.positions(), float) * factor
    if positions[-1] < positions[0]:
        positions, heights = positions[::-1], heights[::-1]
    undefined_count, undefined_notes = _count_undefined(heights, undefined_pixels)
    grid, notes = _uniform_grid(positions)
    is_defined = ~heights.mask
    filled_heights = np.interp(grid, positions[is_defined], heights.data[is_defined]) * factor
    pixel_size = float((grid[-1] - grid[0]) / (len(grid) - 1))
    return _scan_fields(filled_heights, pixel_size, notes + undefined_notes, undefined_count)


def _uniform_grid(positions: Floats) -> tuple[Floats, list[str]]:
    """Return positions (nm) if they are uniform, else a grid of their median spacing, and notes."""
    spacings = np.diff(positions)
    if not (spacings > 0).all():
        raise RefusedFile(
            "expected positions that increase along a line scan, "
            f"found a reentrant one at point {int(np.argmin(spacings > 0)) + 2}"
        )
    uniform = np.linspace(positions[0], positions[-1], len(positions))
    if np.abs(positions - uniform).max() < POSITION_ROUNDING * spacings.mean():
        return positions, []
    spacing = float(np.median(spacings))
    count = int((positions[-1] - positions[0]) / spacing + 1 + 1e-9)  # 1e-9 for rounding
    refuse_point_counts((count,))
    note = (
        f"resampled from spacings of {spacings.min():.4g} to {spacings.max():.4g} nm "
        f"to their median of {spacing:.4g} nm"
    )
    return positions[0] + spacing * np.arange(count), [note]
