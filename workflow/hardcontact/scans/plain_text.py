"""Rewrite plain text of scans for the readers of SurfaceTopography.

The readers expect UTF-8, decimal points, blanks between numbers, and complete grids of points.
"""

import codecs
import re
from itertools import product

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from hardcontact.base.arrays import Floats
from hardcontact.scans.heights import MAX_UNDEFINED_SHARE, PIXEL_BOUNDS, POSITION_ROUNDING

#: Bytes that no text has, except in UTF-16.
BINARY = re.compile(rb"[\0-\x08\x0e-\x1f]")
#: A line or a cell of numbers and marks of undefined pixels.
NUMBERS = re.compile(r"(?=.*(?:\d|nan|bad))(?:[-+.,;\s\d]|e(?=[-+\d])|nan|inf|bad)+", re.I)
#: A comma that may be decimal, a comma that separates cells, and other signs between cells.
DECIMAL_COMMA = re.compile(r"(?<=\d),(?=\d)")
CELL_COMMA = re.compile(r"(?<!\d),|,(?!\d)|,\d+,")
BETWEEN_CELLS = re.compile(r"\d[ \t;]+[-+\d]")
#: A number or a word of a row.
CELL = re.compile(r"[^\s,;]+")
#: Columns of points x, y, height in a text: a matrix has more.
POINT_COLUMNS = 3
#: Beginnings of texts whose separators their readers know.
OWN_SEPARATORS = ("X;Y;valid", "Scan Parameters")
#: Bins of positions along an axis: eight for each line of the largest map.
POSITION_BINS = 2**16
#: Zeros pad the histogram of positions to this multiple of its length before its Fourier transform.
#: Peaks are then known to a sixteenth of a line.
ZERO_PADDING = 8
#: Number of corrections of heights on a grid. Each leaves at most a quarter of the error, if points
#: lie a tenth of a spacing beside the grid.
SPLINE_ITERATIONS = 10


def readable_text(content: bytes) -> tuple[bytes, list[str]]:
    """Return the bytes of a scan, which are rewritten if they are plain text, and notes.

    Rows are the lines of numbers. They are rewritten in this order: words in them become nan,
    decimal commas become points, other separators become blanks, and missing points of a grid are
    added.
    """
    text = _decode_text(content)
    if text is None:
        return content, []
    lines = text.splitlines()
    rows_start = next((index for index, line in enumerate(lines) if NUMBERS.fullmatch(line)), None)
    if rows_start is None:
        return content, []
    column_count = len(CELL.findall(lines[rows_start]))
    lines[rows_start:] = [_mark_undefined(line, column_count) for line in lines[rows_start:]]
    row_indices = [index for index, line in enumerate(lines) if NUMBERS.fullmatch(line)]
    lines, notes = _replace_decimal_commas(lines, "\n".join(lines[index] for index in row_indices))
    if not text.startswith(OWN_SEPARATORS):
        lines, grid_notes = _rewrite_rows(lines, row_indices)
        notes += grid_notes
    return ("\n".join(lines) + "\n").encode(), notes


def _replace_decimal_commas(lines: list[str], rows_text: str) -> tuple[list[str], list[str]]:
    """Return lines with points for commas, and a note, if all commas of the rows are decimal."""
    has_commas_only = "," in rows_text and "." not in rows_text
    if has_commas_only and BETWEEN_CELLS.search(rows_text) and not CELL_COMMA.search(rows_text):
        return [DECIMAL_COMMA.sub(".", line) for line in lines], ["decimal commas read"]
    return lines, []


def _rewrite_rows(lines: list[str], row_indices: list[int]) -> tuple[list[str], list[str]]:
    """Return lines whose rows have blanks between cells, or are all points of a grid; and notes."""
    rows = _separate_with_blanks([lines[index] for index in row_indices])
    points = _parse_points(rows)
    grid_rows, notes = ([], []) if points is None else _grid_points(points)
    if grid_rows:
        return [*lines[: row_indices[0]], *grid_rows], notes
    for index, row in zip(row_indices, rows, strict=True):
        lines[index] = row
    return lines, notes


def _decode_text(content: bytes) -> str | None:
    """Return the text of bytes; None if they are not text."""
    is_utf16 = content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    if BINARY.search(content) and not is_utf16:
        return None
    try:
        return content.decode("utf-16" if is_utf16 else "utf-8-sig")
    except UnicodeDecodeError:
        return None if is_utf16 else content.decode("latin-1")


def _mark_undefined(line: str, column_count: int) -> str:
    """Return a row of a matrix with nan for words, such as ***; other lines are unchanged."""
    cells = CELL.findall(line)
    if NUMBERS.fullmatch(line) or not POINT_COLUMNS < len(cells) <= column_count:
        return line
    # At least half of a row are numbers.
    if 2 * sum(NUMBERS.fullmatch(cell) is not None for cell in cells) < column_count:
        return line
    return CELL.sub(lambda cell: cell[0] if NUMBERS.fullmatch(cell[0]) else "nan", line)


def _separate_with_blanks(rows: list[str]) -> list[str]:
    """Return rows with blanks in place of semicolons or commas, and nan in empty cells."""
    separator = next((sign for sign in ";," if any(sign in row for row in rows)), None)
    if separator is None:
        return rows
    rows = [row.strip() for row in rows]
    if all(row.endswith(separator) for row in rows):
        rows = [row[:-1] for row in rows]
    return [" ".join(cell.strip() or "nan" for cell in row.split(separator)) for row in rows]


def _parse_points(rows: list[str]) -> Floats | None:
    """Return points (n, 3) from rows of three numbers; None if there are other rows."""
    cells = [row.split() for row in rows]
    if any(len(row) != POINT_COLUMNS for row in cells):
        return None
    try:
        return np.array(cells, float)
    except ValueError:  # a mark of an undefined pixel
        return None


def _grid_points(points: Floats) -> tuple[list[str], list[str]]:
    """Return texts "x y height" of all points of a grid, with nan for missing points, and notes.

    Return no texts if points (n, 3) are a complete grid, lie on none, share a pixel, or fill less
    than half.
    """
    axes = [_grid_axis(positions) for positions in points[:, :2].T]
    if not all(len(axis) for axis in axes):
        return [], []
    steps = [np.ptp(axis) / (len(axis) - 1) for axis in axes]
    corner = [axis[0] for axis in axes]
    positions_in_steps = (points[:, :2] - corner) / steps
    indices = np.rint(positions_in_steps).astype(np.intp)
    shape = (len(axes[0]), len(axes[1]))
    pixel_indices = np.ravel_multi_index(indices.T, shape)
    size = shape[0] * shape[1]
    shares_pixels = len(np.unique(pixel_indices)) < len(pixel_indices)
    if shares_pixels or len(pixel_indices) < (1 - MAX_UNDEFINED_SHARE) * size:
        return [], []
    offsets = positions_in_steps - indices
    distance = float(np.abs(offsets).max())
    is_off_grid = distance > POSITION_ROUNDING
    if len(pixel_indices) == size and not is_off_grid:
        return [], []
    heights = np.full(size, np.nan)
    heights[pixel_indices] = points[:, 2]
    notes = []
    if is_off_grid:
        heights = _heights_on_grid(heights.reshape(shape), indices, offsets).ravel()
        notes = [f"points up to {distance:.2g} spacings beside a grid interpolated on it"]
    positions = product(*(axis.tolist() for axis in axes))
    rows = zip(positions, heights.tolist(), strict=True)
    return [f"{x:.17g} {y:.17g} {height:.17g}" for (x, y), height in rows], notes


def _heights_on_grid(heights: Floats, indices: NDArray[np.intp], offsets: Floats) -> Floats:
    """Return heights (x, y) on a grid, whose cubic spline has given heights at points beside it.

    `heights` are NaN without a point; `indices` and `offsets` (n, 2) of the points are in pixels.
    """
    is_missing = np.isnan(heights)
    nearest = ndimage.distance_transform_edt(
        is_missing, return_distances=False, return_indices=True
    )
    point_heights = heights[tuple(nearest)]
    positions = np.indices(heights.shape, dtype=float)
    positions[:, indices[:, 0], indices[:, 1]] += offsets.T
    grid_heights = point_heights
    for _ in range(SPLINE_ITERATIONS):
        spline = ndimage.map_coordinates(grid_heights, positions, order=3, mode="nearest")
        grid_heights = grid_heights + point_heights - spline
    return np.where(is_missing, np.nan, grid_heights)


def _grid_axis(positions: Floats) -> Floats:
    """Return evenly spaced positions (k,) of a grid near points (n,); none if all are equal."""
    extent = float(np.ptp(positions))
    if not 0 < extent < np.inf:
        return np.empty(0)
    steps = np.diff(np.unique(positions))
    # Smaller steps come from rounding.
    spacing = np.median(steps[steps > POSITION_ROUNDING * steps.max()])
    if extent <= spacing * PIXEL_BOUNDS[1]:
        axis = np.linspace(positions.min(), positions.max(), round(extent / spacing) + 1)
        nearest = np.rint((positions - axis[0]) / extent * (len(axis) - 1)).astype(np.intp)
        if (np.abs(axis[nearest] - positions) <= POSITION_ROUNDING * spacing).all():
            return axis
    return _crowded_axis(positions, extent)


def _crowded_axis(positions: Floats, extent: float) -> Floats:
    """Return the evenly spaced positions (k,) near which positions (n,) crowd most.

    Positions that crowd near evenly spaced lines have a histogram that is nearly periodic. Its
    spectrum has a peak, which gives the spacing of the lines, and with its phase their offset.
    """
    counts, edges = np.histogram(positions, POSITION_BINS)
    spectrum = np.fft.rfft(counts, ZERO_PADDING * POSITION_BINS)
    # The spectrum of n lines has its peak at n - 1 periods.
    minimum, maximum = (ZERO_PADDING * (count - 1) for count in PIXEL_BOUNDS)
    peak = minimum + int(np.abs(spectrum[minimum : maximum + 1]).argmax())
    spacing = ZERO_PADDING * extent / peak
    # The phase of the peak gives the offset of the lines from the centre of the first bin.
    offset = 0.5 / POSITION_BINS * extent - np.angle(spectrum[peak]) / (2 * np.pi) * spacing
    first_step = round((positions.min() - edges[0] - offset) / spacing)
    last_step = round((positions.max() - edges[0] - offset) / spacing)
    return np.asarray(edges[0] + offset + spacing * np.arange(first_step, last_step + 1))
