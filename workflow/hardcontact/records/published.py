"""Numbers that the paper prints, as tables of `resources/paper`."""

from pathlib import Path

import pandas as pd

#: Units of pull-off statistics: numbers in another one would be read as these.
UNITS = {"mean_force": "N", "median_force": "N", "effective_work_of_adhesion": "J/m2"}


def constants(path: str | Path) -> pd.DataFrame:
    """Return `parameters.csv`: single numbers of the paper, indexed by quantity.

    Columns: value and uncertainty (NaN where none is printed), both in `unit`; basis; source.
    """
    return pd.read_csv(path, index_col="quantity")


def pull_off(path: str | Path) -> pd.DataFrame:
    """Return `pull_off.csv`: statistics of the measured pull-off forces, indexed by surface.

    Columns: mean_force and median_force in N, effective_work_of_adhesion in J/m²; NaN where the
    paper has none. Another unit, an unknown quantity or a repeated row is a line of a ValueError.
    """
    rows = pd.read_csv(path)
    wrong = (rows["unit"] != rows["quantity"].map(UNITS)) | rows.duplicated(["surface", "quantity"])
    known = ", ".join(f"{name} in {unit}" for name, unit in UNITS.items())
    faults = [
        f"{path}: line {line}: expected each quantity of a surface once, one of {known}; "
        f"found {row.quantity} of {row.surface} in {row.unit}"
        for line, row in enumerate(rows.itertuples(), start=2)
        if wrong[line - 2]
    ]
    if faults:
        raise ValueError("\n".join(faults))
    return rows.pivot(index="surface", columns="quantity", values="value")


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
    """Return the rows of Table 1 that an attribute or variable `calibrated_to_table1` names."""
    return [row for row in stored.split(",") if row]
