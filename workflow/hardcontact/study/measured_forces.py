"""The user's own pull-off forces: a table of single tests, or of a mean and a median a surface.

Every fault is one line: the file and its line, what was expected, what was found.
"""

import csv
import io
import math
import os
from collections.abc import Collection, Mapping
from pathlib import Path

import pandas as pd

from hardcontact.study.schema import plain
from hardcontact.study.surface_table import TABLE_LIMIT
from hardcontact.study.units import magnitude

__all__ = ["measured_forces"]

#: Columns of a table of single tests, and of one row a surface.
TESTS = ("surface", "value", "unit")
SUMMARIES = ("surface", "mean", "median", "count", "unit")


def measured_forces(path: str | Path, surfaces: Collection[str]) -> pd.DataFrame:
    """Read the user's own pull-off forces.

    Parameters
    ----------
    path : str or Path
        CSV with a header: surface, value, unit, one row a test; or surface, mean, median, count,
        unit, one row a surface.
    surfaces : collection of str
        Names of the surfaces of the study.

    Returns
    -------
    pandas.DataFrame
        Indexed by line of the file. Columns: surface; mean and median in N, positive; count, the
        tests they are of. A single test is the mean and the median of one.

    Raises
    ------
    ValueError
        One line a problem, all of them.
    """
    header, rows = _table(path)
    forces, problems = {}, []
    for line, cells in rows:
        if len(cells) != len(header):
            faults = [f"expected {len(header)} cells, found {len(cells)}"]
        else:
            row = dict(zip(header, cells, strict=True))
            forces[line], faults = _force(row), _faults(row, surfaces)
        problems += [f"{path}: line {line}: {fault}" for fault in faults]
    table = pd.DataFrame.from_dict(
        forces, orient="index", columns=["surface", "mean", "median", "count"]
    ).rename_axis("line")
    if "count" in header:
        problems += [
            f"{path}: line {line}: expected each surface once, found again {plain(surface)}"
            for line, surface in table.surface[table.duplicated("surface")].items()
        ]
    if problems:
        raise ValueError("\n".join(problems))
    return table


def _table(path: str | Path) -> tuple[tuple[str, ...], list[tuple[int, list[str]]]]:
    """Return the header of a CSV, in its known order, and line and cells of every row."""
    if not os.path.isfile(path):
        raise ValueError(f"config key forces: expected a table of forces, found no file {path}")
    if os.path.getsize(path) > TABLE_LIMIT:
        raise ValueError(f"{path}: expected at most {TABLE_LIMIT} bytes, found more")
    try:
        text = Path(path).read_bytes().decode("utf-8-sig")
        reader = csv.reader(io.StringIO(text), strict=True)
        rows = [(reader.line_num, [cell.strip() for cell in row]) for row in reader]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise ValueError(f"{path}: expected a CSV in UTF-8, found: {error}") from None
    filled = [(line, cells) for line, cells in rows if any(cells)]
    names = filled[0][1] if filled else []
    for header in (TESTS, SUMMARIES):
        if sorted(names) == sorted(header) and len(filled) > 1:
            order = [names.index(name) for name in header]
            return header, [
                (line, [cells[place] for place in order] if len(cells) == len(header) else cells)
                for line, cells in filled[1:]
            ]
    raise ValueError(
        f"{path}: expected the columns {', '.join(TESTS)} or {', '.join(SUMMARIES)}, separated "
        f"by commas, and a row for each force; found {plain(', '.join(names)) or 'no column'} "
        f"and {max(len(filled) - 1, 0)} rows"
    )


def _faults(row: Mapping[str, str], surfaces: Collection[str]) -> list[str]:
    """Return what is wrong with the cells of a row, by column."""
    faults = []
    if row["surface"] not in surfaces:
        faults.append(f"surface: expected {' or '.join(surfaces)}, found {_found(row['surface'])}")
    if math.isnan(_newtons("1", row["unit"])):
        faults.append(f"unit: expected one of force, such as uN, found {_found(row['unit'])}")
    faults += [
        f"{name}: expected a positive number, found {_found(row[name])}"
        for name in ("value", "mean", "median")
        if name in row and not _newtons(row[name], "N") > 0
    ]
    if "count" in row and _count(row["count"]) < 1:
        faults.append(f"count: expected a number of tests, found {_found(row['count'])}")
    if "median" in row and _newtons(row["median"], "N") > _newtons(row["mean"], "N"):
        faults.append(
            "median: expected at most the mean, as of log-normal forces (or give single tests), "
            f"found {row['median']} beside {row['mean']}"
        )
    return faults


def _found(cell: str) -> str:
    """Return a cell as a message shows it."""
    return plain(cell) if cell else "nothing"


def _force(row: Mapping[str, str]) -> tuple[str, float, float, int]:
    """Return surface, mean and median in N, and count of tests; NaN and 0 of what is faulty."""
    mean, median = (
        _newtons(row.get(name, row.get("value", "")), row["unit"]) for name in ("mean", "median")
    )
    return row["surface"], mean, median, _count(row.get("count", "1"))


def _newtons(number: str, unit: str) -> float:
    """Return a force in N; NaN if it is no number with a unit of force."""
    try:
        return magnitude(f"{float(number)!r} {unit}", "N")
    except ValueError:
        return math.nan


def _count(text: str) -> int:
    """Return a whole number; 0 if it is none."""
    return int(text) if text.isascii() and text.isdigit() and len(text) < 10 else 0
