"""Rewrite plain text of scans for the readers of SurfaceTopography.

The readers expect UTF-8, decimal points, and a matrix separated by blanks or a complete grid of
points x, y, height.
"""

import codecs
import re

import numpy as np

from hardcontact.base.arrays import Floats
from hardcontact.scans.point_grid import grid_points

#: Bytes that no text has, but for UTF-16.
BINARY = re.compile(rb"[\0-\x08\x0e-\x1f]")
#: A line or a cell of numbers and marks of undefined pixels.
NUMBERS = re.compile(r"(?=.*(?:\d|nan|bad))(?:[-+.,;\s\d]|e(?=[-+\d])|nan|inf|bad)+", re.I)
#: Commas within numbers.
DECIMAL_COMMA = re.compile(r"(?<=\d),(?=\d)")
#: Commas between numbers.
OTHER_COMMA = re.compile(r"(?<!\d),|,(?!\d)|,\d+,")
BETWEEN_CELLS = re.compile(r"\d[ \t;]+[-+\d]")
CELL = re.compile(r"[^\s,;]+")
#: Columns of points x, y, height in a text: a matrix has more.
POINT_COLUMNS = 3
#: Beginnings of texts whose readers know their own separators.
OWN_SEPARATORS = ("X;Y;valid", "Scan Parameters")


def readable_text(content: bytes) -> tuple[bytes, list[str]]:
    """Return the bytes of a scan, which are rewritten if they are plain text, and notes."""
    text = _decode_text(content)
    if text is None:
        return content, []
    lines = text.splitlines()
    first_row = next((index for index, line in enumerate(lines) if NUMBERS.fullmatch(line)), None)
    if first_row is None:
        return content, []
    width = len(CELL.findall(lines[first_row]))
    lines[first_row:] = [_mark_undefined(line, width) for line in lines[first_row:]]
    row_indices = [index for index, line in enumerate(lines) if NUMBERS.fullmatch(line)]
    notes = []
    if _has_decimal_commas("\n".join(lines[index] for index in row_indices)):
        lines = [DECIMAL_COMMA.sub(".", line) for line in lines]
        notes.append("decimal commas read")
    if not text.startswith(OWN_SEPARATORS):
        rows = _separate_with_blanks([lines[index] for index in row_indices])
        points = _parse_points(rows)
        grid_rows, grid_notes = ([], []) if points is None else grid_points(points)
        notes += grid_notes
        if grid_rows:
            lines = [*lines[:first_row], *grid_rows]
        else:
            for index, row in zip(row_indices, rows, strict=True):
                lines[index] = row
    return ("\n".join(lines) + "\n").encode(), notes


def _decode_text(content: bytes) -> str | None:
    """Return the text of bytes; None if they are not text."""
    is_utf16 = content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    if BINARY.search(content) and not is_utf16:
        return None
    try:
        return content.decode("utf-16" if is_utf16 else "utf-8-sig")
    except UnicodeDecodeError:
        return None if is_utf16 else content.decode("latin-1")


def _mark_undefined(line: str, width: int) -> str:
    """Return a row of a matrix, of which at least half are numbers, with nan in place of words."""
    cells = CELL.findall(line)
    if NUMBERS.fullmatch(line) or not POINT_COLUMNS < len(cells) <= width:
        return line
    if 2 * sum(NUMBERS.fullmatch(cell) is not None for cell in cells) < width:
        return line
    return CELL.sub(lambda cell: cell[0] if NUMBERS.fullmatch(cell[0]) else "nan", line)


def _has_decimal_commas(rows: str) -> bool:
    """Return True if all commas in rows are decimal, because other signs separate the numbers."""
    has_commas_alone = "," in rows and "." not in rows and not OTHER_COMMA.search(rows)
    return has_commas_alone and bool(BETWEEN_CELLS.search(rows))


def _separate_with_blanks(rows: list[str]) -> list[str]:
    """Return rows with blanks in place of semicolons or commas; empty cells are undefined."""
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
