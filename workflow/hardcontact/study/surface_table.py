"""The table of surfaces, one row a scan: read and checked.

Every fault is a ValueError of one line: the line or surface, what was expected, what was found.
"""

import os
import reprlib
from pathlib import Path
from typing import Literal

import pandas as pd

from hardcontact.study.schema import Schema, plain, refuse

__all__ = ["CONTACT", "TABLE_LIMIT", "selected_scans", "surface_table"]

#: The use of scans that contacts are made on; the others only enter the spectrum of their surface.
CONTACT = "contact"
#: The largest table, or description of a surface, in bytes: some ten thousand rows.
TABLE_LIMIT = 2**20


def surface_table(path: str | Path, schema: Schema) -> pd.DataFrame:
    """Return the table of surfaces, checked for what its rows say of each other.

    Parameters
    ----------
    path : str or Path
        Tab-separated table with a header.
    schema : mapping
        JSON schema of a row.

    Returns
    -------
    pandas.DataFrame
        One row a scan, indexed by the line of the file; columns as in the schema, `scan` as int.
        An optional column that the file lacks is empty, an empty `use` is CONTACT.

    Raises
    ------
    ValueError
        In one line, naming the file and the line or the surface.
    """
    (_, header), *rows = _cells(path) or [(1, [])]
    columns, known = schema["required"], schema["properties"]
    complete = set(columns) <= set(header) <= set(known) and len(header) == len(set(header))
    if not complete or not rows:
        raise ValueError(
            f"{path}: expected a table of surfaces, the columns {', '.join(columns)}, "
            "separated by tabs, and a row a scan; "
            f"found {plain(', '.join(header))} and {len(rows)} rows"
        )
    for line, cells in rows:
        if len(cells) != len(header):
            raise ValueError(
                f"{path}: line {line}: expected {len(header)} cells, separated by tabs, "
                f"found {len(cells)}"
            )
        refuse(dict(zip(header, cells, strict=True)), schema, f"{path}: line {line}, ")
    lines, values = zip(*rows, strict=True)
    table = pd.DataFrame(values, columns=header, index=lines, dtype=str)
    table = table.reindex(columns=[*known], fill_value="")
    table["scan"] = table["scan"].astype(int)
    table["use"] = table["use"].replace("", CONTACT)
    _refuse_repeated(path, table, ["surface", "scan"])
    _refuse_repeated(path, table[table.source == "measured"], ["path", "dataset"])
    _refuse_disagreement(path, table)
    for number, file in table.path.items():
        if not os.path.isfile(file):
            raise ValueError(f"{path}: line {number}: expected the file {file}, found no such file")
    return table


def selected_scans(table: pd.DataFrame, scans: Literal["all"] | list[int]) -> pd.DataFrame:
    """Return the rows of the table of surfaces that a study uses.

    Parameters
    ----------
    table : pandas.DataFrame
        As `surface_table` returns it.
    scans : "all" or list of int
        Numbers of scans.

    Returns
    -------
    pandas.DataFrame
        Rows of these numbers.

    Raises
    ------
    ValueError
        In one line, naming numbers that no surface has a scan of.
    """
    if scans == "all":
        return table
    known = sorted({int(scan) for scan in table.scan})
    if unknown := sorted({*scans} - {*known}):
        raise ValueError(
            f"config key scans: expected numbers of scans in the table {reprlib.repr(known)}, "
            f"found {reprlib.repr(unknown)}"
        )
    return table[table.scan.isin(scans)]


def _cells(path: str | Path) -> list[tuple[int, list[str]]]:
    """Return number and cells of every line of a table that is not blank."""
    if not os.path.isfile(path):
        raise ValueError(f"config key surfaces: expected a table of surfaces, found no file {path}")
    if os.path.getsize(path) > TABLE_LIMIT:
        raise ValueError(f"{path}: expected at most {TABLE_LIMIT} bytes, found more")
    try:
        lines = Path(path).read_bytes().decode("utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"{path}: expected a table of surfaces in UTF-8, found: {error}") from None
    return [(number, line.split("\t")) for number, line in enumerate(lines, 1) if line.strip()]


def _refuse_repeated(path: str | Path, table: pd.DataFrame, columns: list[str]) -> None:
    repeated = table[table.duplicated(columns)]
    if len(repeated):
        values = " ".join(str(repeated.iloc[0][column]) for column in columns)
        raise ValueError(
            f"{path}: line {repeated.index[0]}: expected each "
            f"{' and '.join(columns)} once, found again {values}"
        )


def _refuse_disagreement(path: str | Path, table: pd.DataFrame) -> None:
    """Refuse rows of one surface that differ in what belongs to the surface as a whole."""
    for surface, rows in table.groupby("surface"):
        columns = ["label", "source"]
        if rows.source.iloc[0] == "substitute":
            columns.append("path")
        if rows.source.iloc[0] == "substitute" and (rows.use != CONTACT).any():
            raise ValueError(
                f"{path}: surface {surface}: expected the use {CONTACT} of substitutes, "
                f"found {', '.join(rows.use.unique())}"
            )
        if not (rows.use == CONTACT).any():
            raise ValueError(
                f"{path}: surface {surface}: expected a scan with the use {CONTACT}, found none"
            )
        for column in columns:
            if rows[column].nunique() > 1:
                raise ValueError(
                    f"{path}: surface {surface}: expected one {column}, "
                    f"found {', '.join(rows[column].unique()[:5])}"
                )
