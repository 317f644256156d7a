"""The dictionary of datasets: every variable with its dimensions, unit and meaning.

``python -m hardcontact.report.dataset_dictionary RESULTS...`` makes workflow/report/datasets.md
from the datasets in the folders of finished studies. A meaning is the row of a variable in
workflow/report/variables.tsv, for one dataset or for all (``*``), or else its ``long_name``.
"""

import csv
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path

import xarray as xr

from hardcontact.base import dataset
from hardcontact.base.code import LIBRARY

REPORT = LIBRARY.parent / "report"
PAGE = REPORT / "datasets.md"
MEANINGS = REPORT / "variables.tsv"
#: In place of a dataset in the table: a variable means the same in all.
ALL = "*"
INTERVAL = "_interval"
HEAD = """\
# The datasets of a study

Every dataset in `results/<study>/`, with its variables. Made from finished studies by
`python -m hardcontact.report.dataset_dictionary RESULTS...`. The unit `1` says that a number has
none. A variable with \\* has an interval beside it, `<name>_interval`, over `bound` (low, high).
Studies of own surfaces have `adhesion`, `edges`, `fit`, `force`, `scales`, `spectra` and
`topography`. Of these the paper's study has all but `force` and `spectra`.
"""


def meanings() -> dict[tuple[str, str], str]:
    """Return the meanings in the table by dataset and variable."""
    with open(MEANINGS, encoding="utf-8", newline="") as file:
        rows = csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE)
        return {(row["dataset"], row["variable"]): row["meaning"] for row in rows}


def rows_of(
    name: str, data: xr.Dataset, known: Mapping[tuple[str, str], str]
) -> dict[str, tuple[str, str, str]]:
    """Return dimensions, unit and meaning of the variables of a dataset, by name.

    Raises ValueError with a line for each variable without a meaning.
    """
    rows = {}
    for variable, values in data.variables.items():
        label = str(variable)
        if label.endswith(INTERVAL) and label.removesuffix(INTERVAL) in data:
            continue
        long_name = str(values.attrs.get("long_name", ""))
        said = long_name[:1].upper() + long_name[1:] + ("." if long_name else "")
        meaning = known.get((name, label)) or said or known.get((ALL, label), "")
        marked = f"`{label}`" + (" \\*" if f"{label}{INTERVAL}" in data else "")
        dimensions = ", ".join(map(str, values.dims))
        rows[marked] = (dimensions, str(values.attrs.get("units", "")), meaning)
    if missing := [marked for marked, (*_, meaning) in rows.items() if not meaning]:
        raise ValueError(
            "\n".join(f"{MEANINGS.name}: expected {name} {marked}" for marked in missing)
        )
    return rows


def page(folders: Iterable[Path]) -> str:
    """Return the page in Markdown; of a dataset that several studies have all variables count."""
    known = meanings()
    titles = dict[str, str]()
    tables = dict[str, dict[str, tuple[str, str, str]]]()
    for path in (path for folder in folders for path in sorted(folder.glob("*.nc"))):
        data = dataset.read(path)
        titles.setdefault(path.stem, str(data.attrs["title"]))
        rows = tables.setdefault(path.stem, {})
        tables[path.stem] = rows_of(path.stem, data, known) | rows
    lines = [HEAD]
    for name, rows in sorted(tables.items()):
        title = titles[name]
        lines += [f"## {name}.nc\n", f"{title[:1].upper()}{title[1:]}.\n"]
        lines += ["| variable | dimensions | unit | meaning |", "| --- | --- | --- | --- |"]
        lines += [f"| {' | '.join((marked, *cells))} |" for marked, cells in rows.items()]
        lines.append("")
    return "\n".join(lines)


if __name__ == "__main__":
    PAGE.write_text(page(map(Path, sys.argv[1:])), "utf-8")
