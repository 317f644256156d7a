"""Tables that the user wrote, and what is wrong with them, a line a fault: one reader for all.

Own pull-off forces, of single tests or of a mean and a median a surface; descriptions of substitute
surfaces (`resources/README.md`), checked before a spectrum is made from them.
"""

import csv
import io
import math
import os
import re
from collections.abc import Callable, Collection, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import pandas as pd

from hardcontact.config.faults import plain, refuse_lines
from hardcontact.numbers.units import magnitude
from hardcontact.surfaces.spectrum import CALIBRATED, KNOWN, PARAMETERS, is_calibrated

#: A number with a decimal comma.
DECIMAL = re.compile(r"^([-+]?\d*),(\d+(?:[eE][-+]?\d+)?)$")
#: The largest table in bytes: some hundred thousand rows.
TABLE_LIMIT = 2**22
#: Cells by the name of their column.
Row = Mapping[str, str]
#: Columns of a table of single tests, and of one row a surface.
TESTS = ("surface", "value", "unit")
SUMMARIES = ("surface", "mean", "median", "count", "unit")
#: The least and the largest pull-off force in N: of an atom, and of a hundred kilograms.
FORCES = (1e-15, 1e3)
#: Models of a band; a power law continues the band above, so that it cannot come first.
MODELS = ("self-affine", "varying Hurst", "smooth roll-off", "profile", "power law")
#: Columns of numbers that may be below zero: local exponents of shoulders are.
SIGNED = ("hurst", "hurst_change")
#: The local exponent of a C_iso that is constant.
FLATTEST = -1.0
#: Columns of the points of a profile's spectrum.
POINTS = ("wavelength_nm", "c1d_nm3")


class UserTable(NamedTuple):
    """A table that the user wrote: its header, empty of an empty file, and the cells of other rows.

    Rows that are not empty are by line of the file.
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
        """Return one line a problem; a fault that many lines have is told of the first."""
        rows = self.rows()
        lines: dict[str, list[int]] = {}
        for line, cells in self.cells.items():
            many = len(cells) > len(self.header)
            hint = "; decimal commas need semicolons between cells" if many else ""
            wrong = [f"expected {len(self.header)} cells, found {len(cells)}{hint}"]
            for fault in faults(rows[line]) if line in rows else wrong:
                lines.setdefault(fault, []).append(line)
        return [
            f"{self.path}: line {first}{f' and {len(more)} more' if more else ''}: {fault}"
            for fault, (first, *more) in lines.items()
        ]


def user_table(
    path: str | Path, content: str, *, form: str = "a CSV", separator: str = ","
) -> UserTable:
    """Read a table that the user wrote, in UTF-8, with a header; between tabs nothing is quoted.

    Cells may stand between semicolons, as some spreadsheets write them; then decimals may have a
    comma.
    A ValueError of one line says what the table should hold (content) and be (form).
    """
    if not os.path.isfile(path):
        raise ValueError(f"{path}: expected {content}, found no file")
    if os.path.getsize(path) > TABLE_LIMIT:
        raise ValueError(f"{path}: expected at most {TABLE_LIMIT} bytes, found more")
    try:
        text = Path(path).read_bytes().decode("utf-8-sig")
        head = text.partition("\n")[0]
        if ";" in head and separator not in head:
            separator = ";"
        reader = csv.reader(
            io.StringIO(text, newline=None),
            strict=True,
            delimiter=separator,
            quoting=csv.QUOTE_NONE if separator == "\t" else csv.QUOTE_MINIMAL,
        )
        rows = [(reader.line_num, [cell.strip() for cell in row]) for row in reader]
        if separator == ";":
            rows = [(line, [DECIMAL.sub(r"\1.\2", cell) for cell in row]) for line, row in rows]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise ValueError(f"{path}: expected {form} in UTF-8, found: {error}") from None
    filled = [(line, cells) for line, cells in rows if any(cells)]
    return UserTable(str(path), filled[0][1] if filled else [], dict(filled[1:]))


def found(cell: str) -> str:
    """Return a cell as a message shows it."""
    return plain(cell) if cell else "nothing"


def number(cell: str) -> float:
    """Return a number, which may be infinite; NaN if the cell is none."""
    try:
        return float(cell)
    except ValueError:
        return math.nan


def in_unit(value: float, given: str, unit: str) -> float:
    """Return a value with a given unit in another; NaN if these have other dimensions."""
    try:
        return magnitude(f"{value!r} {given}", unit)
    except ValueError:
        return math.nan


def measured_forces(
    path: str | Path, surfaces: Collection[str], given_as: str = "config key forces"
) -> pd.DataFrame:
    """Read the user's own pull-off forces on the surfaces of a study.

    The file is a CSV with a header: surface, value, unit, one row a test; or surface, mean, median,
    count, unit, one row a surface. Returned are, by line of the file, the columns surface; mean and
    median in N, positive; count, the tests they are of: a single test is the mean and the median of
    one. A ValueError has one line a problem, all of them, and says how the table was given.
    """
    table = user_table(path, f"a table of forces ({given_as})")
    if sorted(table.header) not in (sorted(TESTS), sorted(SUMMARIES)) or not table.cells:
        raise ValueError(
            f"{path}: expected the columns {', '.join(TESTS)} or {', '.join(SUMMARIES)}, "
            f"separated by commas, and a row for each force; found "
            f"{plain(', '.join(table.header)) or 'no column'} and {len(table.cells)} rows"
        )
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
    refuse_lines(problems)
    return forces


def _faults(row: Row, surfaces: Collection[str]) -> list[str]:
    """Return what is wrong with the cells of a row, by column."""
    faults = []
    if row["surface"] not in surfaces:
        faults.append(f"surface: expected {' or '.join(surfaces)}, found {found(row['surface'])}")
    known = math.isfinite(in_unit(1.0, row["unit"], "N"))
    if not known:
        faults.append(f"unit: expected one of force, such as uN, found {found(row['unit'])}")
    least, most = FORCES
    for name in (name for name in ("value", "mean", "median") if name in row):
        if not 0 < number(row[name]) < math.inf:
            faults.append(f"{name}: expected a positive number, found {found(row[name])}")
        elif known and not least <= _newtons(row[name], row["unit"]) <= most:
            faults.append(
                f"{name}: expected {least:g} to {most:g} N, found {row[name]} {row['unit']}"
            )
    if "count" in row and _count(row["count"]) < 1:
        faults.append(f"count: expected a number of tests, found {found(row['count'])}")
    if "median" in row and number(row["median"]) > number(row["mean"]):
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


def _newtons(text: str, unit: str) -> float:
    """Return a force in N, of twelve digits; NaN if it is no number with a unit of force."""
    return float(f"{number(text) * in_unit(1.0, unit, 'N'):.12g}")


def _count(text: str) -> int:
    """Return a whole number; 0 if it is none."""
    return int(text) if text.isascii() and text.isdigit() and len(text) < 10 else 0


def refuse_description(path: str | Path, published: Collection[str]) -> None:
    """Refuse a description of no spectrum, given the rows of Table 1 that the surface has."""
    for line, row in _description(path, PARAMETERS, ("model", "table")).items():
        model, hurst = row["model"], row["hurst"]
        known = [name for name in MODELS if line > 2 or name != "power law"]
        missing = set() if hurst else set(CALIBRATED.get(model, ())).difference(published)
        expected = {
            f"a model, one of {', '.join(known)}; found {found(model)}": model not in known,
            f"a Hurst exponent, or of this surface the rows {', '.join(sorted(missing))} in "
            "resources/paper/table1.csv; found neither": missing,
            "a roll-off wavelength of a varying Hurst exponent, found none": (
                model == "varying Hurst" and not row["rolloff_nm"]
            ),
            f"a Hurst exponent of {FLATTEST:g} or more, below which a spectrum grows towards "
            f"short wavelengths, found {number(hurst):g}": number(hurst) < FLATTEST,
        }
        faults = [f"{path}: line {line}: expected {text}" for text, bad in expected.items() if bad]
        refuse_lines(faults[:1])
        if model == "profile":
            _description(Path(path).parent / row["table"], POINTS)


def refuse_of_paper(path: str | Path, surface: str, published: Collection[str]) -> None:
    """Refuse a substitute in a study of own surfaces that stands for one of the paper.

    As a ValueError of one line, given a description that `refuse_description` accepts and the
    surfaces in the paper's Table 1, which substitutes of these names are conditioned on.
    """
    bands = pd.read_csv(path)
    if surface in published or is_calibrated(bands):
        raise ValueError(
            "config key published: expected paper in a study with substitutes for its surfaces "
            f"({surface}), found none"
        )
    if not bands.basis.isin(KNOWN).any():
        raise ValueError(
            f"{path}: expected, in a study of own surfaces, a band whose basis is "
            f"{' or '.join(KNOWN)}, found {', '.join(map(plain, bands.basis.unique()))}"
        )


def _description(
    path: str | Path, numbers: Sequence[str], others: Sequence[str] = ()
) -> dict[int, Row]:
    """Return the rows of a small table by line: columns of numbers, or blanks, and others.

    Only a Hurst exponent and its change may be below zero.
    """
    columns = ", ".join([*numbers, *others])
    content = f"a table, comma-separated, with the columns {columns} (resources/README.md)"
    table = user_table(path, content)
    if missing := [name for name in (*numbers, *others) if name not in table.header]:
        raise ValueError(f"{path}: expected {content}; found: no {', '.join(missing)}")
    if not table.cells:
        raise ValueError(f"{path}: expected {content}; found: no row")

    def faults(row: Row) -> list[str]:
        return [
            f"{name}: expected a number{'' if name in SIGNED else ', none below zero'}, "
            f"found {found(row[name])}"
            for name in numbers
            if row[name] and not (number(row[name]) >= (-math.inf if name in SIGNED else 0))
        ]

    refuse_lines(table.problems(faults))
    return table.rows()
