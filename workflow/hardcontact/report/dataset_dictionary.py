"""The dictionary of a study's datasets: every variable with its dimensions, unit and meaning."""

from collections.abc import Mapping

import xarray as xr

from hardcontact.base.dataset import INTERVAL

HEAD = """\
# The datasets of this study

The unit `1` says that a number has none. A variable with \\* has an interval beside it,
`<name>_interval`, over `end` (low, high).
"""
TABLE_HEAD = "| variable | dimensions | unit | meaning |\n| --- | --- | --- | --- |"


def dictionary_page(datasets: Mapping[str, xr.Dataset]) -> str:
    """Return the page in Markdown, with a table for each dataset, by its name."""
    return "\n".join([HEAD, *(_table(name, data) for name, data in datasets.items())])


def _table(name: str, dataset: xr.Dataset) -> str:
    """Return the title of a dataset and the table of its variables."""
    title = f"## {name}.nc\n\n{dataset.title[:1].upper()}{dataset.title[1:]}.\n"
    rows = [
        _row(str(variable), dataset)
        for variable in dataset.variables
        if not str(variable).endswith(INTERVAL)  # a mark of its variable stands for the interval
    ]
    return "\n".join([title, TABLE_HEAD, *rows, ""])


def _row(name: str, dataset: xr.Dataset) -> str:
    """Return the row of a variable."""
    variable = dataset[name]
    mark = " \\*" if f"{name}{INTERVAL}" in dataset else ""
    dimensions = ", ".join(map(str, variable.dims))
    unit = variable.attrs.get("units", "")  # a text has none
    return f"| `{name}`{mark} | {dimensions} | {unit} | {variable.attrs['long_name']} |"
