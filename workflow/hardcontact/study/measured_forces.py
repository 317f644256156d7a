"""The user's own pull-off forces: a table of single tests, or of a mean and a median a surface.

Every fault is one line: the file and its line, what was expected, what was found.
"""

import math
from collections.abc import Collection
from pathlib import Path

import pandas as pd

from hardcontact.study.schema import plain
from hardcontact.study.units import magnitude
from hardcontact.study.user_table import Row, UserTable, found, user_table

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
    table = user_table(path, "a table of forces (config key forces)")
    _refuse_other_columns(table)
    problems = table.problems(lambda row: _faults(row, surfaces))
    forces = pd.DataFrame.from_dict(
        {line: _force(row) for line, row in table.rows().items()},
        orient="index",
        columns=["surface", "mean", "median", "count"],
    ).rename_axis("line")
    if "count" in table.header:
        problems += [
            f"{path}: line {line}: expected each surface once, found again {plain(surface)}"
            for line, surface in forces.surface[forces.duplicated("surface")].items()
        ]
    if problems:
        raise ValueError("\n".join(problems))
    return forces


def _refuse_other_columns(table: UserTable) -> None:
    """Refuse a table that is none of single tests and none of one row a surface."""
    if sorted(table.header) in (sorted(TESTS), sorted(SUMMARIES)) and table.cells:
        return
    raise ValueError(
        f"{table.path}: expected the columns {', '.join(TESTS)} or {', '.join(SUMMARIES)}, "
        f"separated by commas, and a row for each force; found "
        f"{plain(', '.join(table.header)) or 'no column'} and {len(table.cells)} rows"
    )


def _faults(row: Row, surfaces: Collection[str]) -> list[str]:
    """Return what is wrong with the cells of a row, by column."""
    faults = []
    if row["surface"] not in surfaces:
        faults.append(f"surface: expected {' or '.join(surfaces)}, found {found(row['surface'])}")
    if math.isnan(_newtons("1", row["unit"])):
        faults.append(f"unit: expected one of force, such as uN, found {found(row['unit'])}")
    faults += [
        f"{name}: expected a positive number, found {found(row[name])}"
        for name in ("value", "mean", "median")
        if name in row and not _newtons(row[name], "N") > 0
    ]
    if "count" in row and _count(row["count"]) < 1:
        faults.append(f"count: expected a number of tests, found {found(row['count'])}")
    if "median" in row and _newtons(row["median"], "N") > _newtons(row["mean"], "N"):
        faults.append(
            "median: expected at most the mean, as of log-normal forces (or give single tests), "
            f"found {row['median']} beside {row['mean']}"
        )
    return faults


def _force(row: Row) -> tuple[str, float, float, int]:
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
