"""Rewrite plain text of scans for the readers of SurfaceTopography.

These read UTF-8, decimal points, matrices separated by blanks, and points x, y, height on a
complete grid.
"""

import codecs
import io
import re

import numpy as np
from numpy.typing import NDArray

from hardcontact.surfaces.scan_heights import MAX_UNDEFINED_SHARE, PIXEL_BOUNDS, POSITION_ROUNDING

#: Bytes that no text has, but for UTF-16.
BINARY = re.compile(rb"[\0-\x08\x0e-\x1f]")
#: A line of numbers, and of marks of undefined pixels; a comma within a number, and others.
ROW = re.compile(r"(?=.*(?:\d|nan|bad))(?:[-+.,;\s\d]|e(?=[-+\d])|nan|inf|bad)+", re.I)
DECIMAL_COMMA = re.compile(r"(?<=\d),(?=\d)")
OTHER_COMMA = re.compile(r"(?<!\d),|,(?!\d)|,\d+,")
BETWEEN_CELLS = re.compile(r"\d[ \t;]+[-+\d]")
CELL = re.compile(r"[^\s,;]+")
#: Columns of points x, y, height in a text: a matrix has more.
POINT_COLUMNS = 3
#: Beginnings of texts whose readers know their own separators.
OWN_SEPARATORS = ("X;Y;valid", "Scan Parameters")


def readable_text(content: bytes) -> tuple[bytes, list[str]]:
    """Return the bytes of a scan, as UTF-8 with blanks and decimal points if they are plain text.

    Points (x, y, height) on a grid with gaps gain points of undefined height. Any other content
    stays as it is. The list has a note for the user if decimal commas were read.
    """
    text = _decode(content)
    if text is None:
        return content, []
    lines = text.splitlines()
    first_row = next((number for number, line in enumerate(lines) if ROW.fullmatch(line)), None)
    if first_row is None:
        return content, []
    width = len(CELL.findall(lines[first_row]))
    lines[first_row:] = [_mark_undefined(line, width) for line in lines[first_row:]]
    numbers = [number for number, line in enumerate(lines) if ROW.fullmatch(line)]
    notes = []
    if _has_decimal_commas("\n".join(lines[number] for number in numbers)):
        lines = [DECIMAL_COMMA.sub(".", line) for line in lines]
        notes.append("decimal commas read")
    if not text.startswith(OWN_SEPARATORS):
        rows = _separate_with_blanks([lines[number] for number in numbers])
        complete = _fill_gaps(rows)
        if complete is not None:
            lines = [*lines[:first_row], *complete]
        else:
            for number, row in zip(numbers, rows, strict=True):
                lines[number] = row
    return ("\n".join(lines) + "\n").encode(), notes


def _decode(content: bytes) -> str | None:
    """Return the text of bytes; None if they are not text."""
    if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        encodings = ["utf-16"]
    else:
        encodings = [] if BINARY.search(content) else ["utf-8-sig", "latin-1"]
    for encoding in encodings:
        try:
            return content.decode(encoding)
        except UnicodeDecodeError:
            continue
    return None


def _mark_undefined(line: str, width: int) -> str:
    """Return a row of a matrix with words, such as ***, replaced by nan.

    Lines with less than half of the numbers of the first row are unchanged.
    """
    cells = CELL.findall(line)
    if ROW.fullmatch(line) or not POINT_COLUMNS < len(cells) <= width:
        return line
    if 2 * sum(ROW.fullmatch(cell) is not None for cell in cells) < width:
        return line
    return CELL.sub(lambda cell: cell[0] if ROW.fullmatch(cell[0]) else "nan", line)


def _has_decimal_commas(rows: str) -> bool:
    """Return True if all commas in rows are decimal and other signs separate the numbers.

    If every row is two whole numbers with a comma between, the comma is ambiguous: False.
    """
    return (
        "," in rows
        and "." not in rows
        and not OTHER_COMMA.search(rows)
        and bool(BETWEEN_CELLS.search(rows))
    )


def _separate_with_blanks(rows: list[str]) -> list[str]:
    """Return rows with blanks in place of semicolons or commas; empty cells are undefined."""
    separator = next((sign for sign in ";," if any(sign in row for row in rows)), None)
    if separator is None:
        return rows
    rows = [row.strip() for row in rows]
    if all(row.endswith(separator) for row in rows):
        rows = [row[:-1] for row in rows]
    return [" ".join(cell.strip() or "nan" for cell in row.split(separator)) for row in rows]


def _fill_gaps(rows: list[str]) -> list[str] | None:
    """Return points on a grid as rows, with the missing points added with the height NaN.

    None if the rows are not points on a grid, or if the grid is complete.
    """
    cells = [row.split() for row in rows]
    if any(len(row) != POINT_COLUMNS for row in cells):
        return None
    try:
        points = np.array(cells, float)
    except ValueError:  # a mark of an undefined pixel
        return None
    axes = []
    indices = []
    for positions in points[:, :2].T:
        axis, axis_indices = _grid_axis(positions)
        if not len(axis):
            return None
        axes.append(axis)
        indices.append(axis_indices)
    size = len(axes[0]) * len(axes[1])
    flat = indices[0] * len(axes[1]) + indices[1]
    if not MAX_UNDEFINED_SHARE * size <= len(np.unique(flat)) == len(flat) < size:
        return None
    heights = np.full(size, np.nan)
    heights[flat] = points[:, 2]
    x, y = np.meshgrid(*axes, indexing="ij")
    text = io.StringIO()
    np.savetxt(text, np.column_stack([x.ravel(), y.ravel(), heights]), fmt="%.17g")
    return text.getvalue().splitlines()


def _grid_axis(positions: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """Return evenly spaced positions (n,) and the index of each position among them.

    Positions may be rounded. Both arrays are empty if the positions are not evenly spaced.
    """
    empty = np.empty(0), np.empty(0, np.intp)
    steps = np.diff(np.unique(positions))
    if not steps.size or not np.isfinite(steps).all():
        return empty
    spacing = np.median(steps[steps > POSITION_ROUNDING * steps.max()])
    extent = float(np.ptp(positions))
    if extent > spacing * PIXEL_BOUNDS[1]:
        return empty
    axis = np.linspace(positions.min(), positions.max(), round(extent / spacing) + 1)
    axis_indices = np.rint((positions - axis[0]) / extent * (len(axis) - 1)).astype(np.intp)
    is_near = np.abs(axis[axis_indices] - positions) <= POSITION_ROUNDING * spacing
    return (axis, axis_indices) if is_near.all() else empty
