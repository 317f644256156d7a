"""Numbers that the paper prints, as tables of `resources/paper`."""

from pathlib import Path

import pandas as pd


def constants(path: str | Path) -> pd.DataFrame:
    """Return `parameters.csv`: single numbers of the paper, indexed by quantity.

    Columns: value and uncertainty (NaN where none is printed), both in `unit`; basis; source.
    """
    return pd.read_csv(path, index_col="quantity")


def pull_off(path: str | Path) -> pd.DataFrame:
    """Return `pull_off.csv`: statistics of the measured pull-off forces, indexed by surface.

    Columns: mean_force and median_force in N, effective_work_of_adhesion in J/m²; NaN where the
    paper has none.
    """
    return pd.read_csv(path).pivot(index="surface", columns="quantity", values="value")


def printed_pull_off(path: str | Path) -> pd.DataFrame:
    """Return the same table as `pull_off`, as text with the digits that are printed."""
    rows = pd.read_csv(path, dtype=str)
    return rows.pivot(index="surface", columns="quantity", values="value")


def table1(path: str | Path) -> pd.DataFrame:
    """Return `table1.csv`: the roughness metrics of Table 1, one row a number.

    Columns: surface; quantity; value and uncertainty, both in `unit`; basis; source.
    """
    return pd.read_csv(path)


def rows_met(stored: str) -> list[str]:
    """Return the rows of Table 1 that an attribute or variable `table1_rows_met` names."""
    return [row for row in stored.split(",") if row]
