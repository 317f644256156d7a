"""The configuration of a study and its table of surfaces, and the list of all its variables."""

from collections.abc import Mapping
from pathlib import Path

import xarray as xr
import yaml

from hardcontact.base.dataset import INTERVAL, read
from hardcontact.records.job import run_job

HEAD = """\
# The datasets of this study

The unit `1` says that a number has none. A variable with \\* has an interval beside it,
`<name>_interval`, over `end` (low, high).
"""
TABLE_HEAD = "| variable | dimensions | unit | meaning |\n| --- | --- | --- | --- |"


def dictionary_page(datasets: Mapping[str, xr.Dataset]) -> str:
    """Return the page in Markdown, a table for each dataset, by its name."""
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


with run_job(snakemake) as job:
    job.write_text(yaml.safe_dump(job.parameters, allow_unicode=True), "configuration")
    job.copy(job.input.surfaces, "surfaces")
    datasets = {Path(path).stem: read(path) for path in job.input.datasets}
    job.write_text(dictionary_page(datasets), "variables")
