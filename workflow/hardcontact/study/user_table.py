"""A table that the user wrote: a CSV with a header, and what is wrong with its rows by line."""

import csv
import io
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import NamedTuple

from hardcontact.study.schema import plain
from hardcontact.study.surface_table import TABLE_LIMIT

__all__ = ["Row", "UserTable", "found", "user_table"]

#: Cells by the name of their column.
Row = Mapping[str, str]


class UserTable(NamedTuple):
    """A table that the user wrote.

    Attributes
    ----------
    path : str
        Of the file.
    header : list of str
        Names of the columns; empty of an empty file.
    cells : dict of int to list of str
        Of every other row that is not empty, by line of the file.
    """

    path: str
    header: list[str]
    cells: dict[int, list[str]]

    def rows(self) -> dict[int, Row]:
        """Return, by line, the rows that have a cell for each column."""
        return {
            line: dict(zip(self.header, cells, strict=True))
            for line, cells in self.cells.items()
            if len(cells) == len(self.header)
        }

    def problems(self, faults: Callable[[Row], list[str]]) -> list[str]:
        """Return one line a problem; a fault that many lines have is told of the first.

        Parameters
        ----------
        faults : callable
            Takes a row and returns what is wrong with it.
        """
        rows = self.rows()
        lines: dict[str, list[int]] = {}
        for line, cells in self.cells.items():
            wrong = [f"expected {len(self.header)} cells, found {len(cells)}"]
            for fault in faults(rows[line]) if line in rows else wrong:
                lines.setdefault(fault, []).append(line)
        return [
            f"{self.path}: line {first}{f' and {len(more)} more' if more else ''}: {fault}"
            for fault, (first, *more) in lines.items()
        ]


def user_table(path: str | Path, content: str) -> UserTable:
    """Read a table that the user wrote.

    Parameters
    ----------
    path : str or Path
        CSV in UTF-8.
    content : str
        What the table should hold, for the messages.

    Raises
    ------
    ValueError
        In one line.
    """
    if not os.path.isfile(path):
        raise ValueError(f"{path}: expected {content}, found no file")
    if os.path.getsize(path) > TABLE_LIMIT:
        raise ValueError(f"{path}: expected at most {TABLE_LIMIT} bytes, found more")
    try:
        text = Path(path).read_bytes().decode("utf-8-sig")
        reader = csv.reader(io.StringIO(text), strict=True)
        rows = [(reader.line_num, [cell.strip() for cell in row]) for row in reader]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise ValueError(f"{path}: expected a CSV in UTF-8, found: {error}") from None
    filled = [(line, cells) for line, cells in rows if any(cells)]
    return UserTable(str(path), filled[0][1] if filled else [], dict(filled[1:]))


def found(cell: str) -> str:
    """Return a cell as a message shows it."""
    return plain(cell) if cell else "nothing"
