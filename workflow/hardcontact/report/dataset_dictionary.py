"""The dictionary of a study's datasets: every variable with its dimensions, unit and meaning."""

from collections.abc import Iterator, Mapping

import xarray as xr

from hardcontact.base.dataset import INTERVAL

HEAD = """\
# The datasets of this study

The unit `1` says that a number has none. A variable with \\* has an interval beside it,
`<name>_interval`, over `end` (low, high).
"""


def dictionary_page(datasets: Mapping[str, xr.Dataset]) -> str:
    """Return the page in Markdown, a table for each dataset, by its name."""
    return "\n".join([HEAD, *(_table(name, data) for name, data in datasets.items())])


def _table(name: str, dataset: xr.Dataset) -> str:
    """Return the title of a dataset and the table of its variables."""
    lines = [
        f"## {name}.nc",
        "",
        f"{dataset.title[:1].upper()}{dataset.title[1:]}.",
        "",
        "| variable | dimensions | unit | meaning |",
        "| --- | --- | --- | --- |",
        *_rows(dataset),
        "",
    ]
    return "\n".join(lines)


def _rows(dataset: xr.Dataset) -> Iterator[str]:
    """Yield a row for each variable but the intervals, which their variables mention."""
    for name, variable in dataset.variables.items():
        if str(name).removesuffix(INTERVAL) != name:
            continue
        mark = " \\*" if f"{name}{INTERVAL}" in dataset else ""
        dimensions = ", ".join(map(str, variable.dims))
        unit = variable.attrs.get("units", "")  # a text has none
        yield f"| `{name}`{mark} | {dimensions} | {unit} | {variable.attrs['long_name']} |"
