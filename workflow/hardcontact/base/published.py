"""Numbers that the paper prints, as tables of `resources/paper`."""

from pathlib import Path

import pandas as pd

#: The tables of what the paper prints, by the names under which rules and figures get them.
PUBLISHED_TABLES = {
    "published_constants": "resources/paper/parameters.csv",
    "published_pull_off": "resources/paper/pull_off.csv",
    "published_table1": "resources/paper/table1.csv",
}


def read_constants(path: str | Path) -> pd.DataFrame:
    """Read `parameters.csv`: single numbers of the paper.

    Returns by quantity: value and uncertainty (NaN if none is printed), both in `unit`; evidence;
        source.
    """
    return pd.read_csv(path, index_col="quantity")


def read_measured_statistics(path: str | Path) -> pd.DataFrame:
    """Read `pull_off.csv`: statistics of the measured pull-off forces.

    Returns by surface: mean_force and median_force in N, effective_work_of_adhesion in J/m²; NaN if
        the paper has none.
    """
    return pd.read_csv(path).pivot(index="surface", columns="quantity", values="value")


def read_printed_statistics(path: str | Path) -> pd.DataFrame:
    """Read `pull_off.csv` like `read_measured_statistics`, but keep the printed digits as text."""
    rows = pd.read_csv(path, dtype=str)
    return rows.pivot(index="surface", columns="quantity", values="value")


def read_table1(path: str | Path) -> pd.DataFrame:
    """Read `table1.csv`: the roughness metrics of Table 1, one row per number.

    Returns columns surface; quantity; value and uncertainty, both in `unit`; evidence; source.
    """
    return pd.read_csv(path)


def rows_met(stored: str) -> list[str]:
    """Return the rows of Table 1 that an attribute or variable `table1_rows_met` names."""
    return [row for row in stored.split(",") if row]
