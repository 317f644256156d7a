"""Write and read netCDF datasets, and join those of several jobs along labelled dimensions."""

import csv
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.atomic_file import atomic_file

#: Table of the meanings of variables, by dataset (`*`: all datasets). No job depends on it: like a
#: comment, a changed meaning makes no file stale.
MEANINGS = Path(__file__).resolve().parents[2] / "report/variables.tsv"
#: Datasets by key; a key has a label for each dimension along which they are stacked.
DatasetsByLabels = Mapping[tuple[Any, ...], xr.Dataset]


def write_dataset(dataset: xr.Dataset, path: str | Path) -> None:
    """Write a dataset by `atomic_file`."""
    with atomic_file(path) as temporary:
        try:
            dataset.to_netcdf(temporary, engine="netcdf4")
        except RuntimeError as error:  # netCDF raises it for any error of the system
            raise OSError(str(error)) from error  # `atomic_file` makes it a ValueError.


@cache
def read_meanings(name: str) -> dict[str, str]:
    """Return the meanings of the variables of a dataset from the table `MEANINGS`."""
    table = pd.read_csv(MEANINGS, sep="\t", quoting=csv.QUOTE_NONE)
    rows = table[table.dataset.isin(["*", name])].sort_values("dataset")  # "*" is the first
    return dict(zip(rows.variable, rows.meaning, strict=True))


def describe_variables(dataset: xr.Dataset, meanings: Mapping[str, str]) -> xr.Dataset:
    """Return a dataset whose variables have meanings as `long_name`, and whole numbers a unit."""
    result = dataset.copy()
    for name, variable in result.variables.items():
        meaning = meanings.get(str(name).removesuffix("_interval"))
        if meaning is not None:
            variable.attrs["long_name"] = meaning
        if variable.dtype.kind in "biu":  # flags, counts and numbers of scans
            variable.attrs.setdefault("units", "1")
    return result


def read_dataset(path: str | Path) -> xr.Dataset:
    """Read a dataset into memory; raises ValueError if the file is missing or damaged."""
    try:
        with xr.open_dataset(path, engine="netcdf4") as dataset:
            # The encoding fixes the length of texts, and would cut longer ones when joined.
            return dataset.load().drop_encoding()
    except (OSError, RuntimeError, ValueError) as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        raise ValueError(
            f"{path}: expected a complete netCDF file, found: {reason}; delete it and run again"
        ) from None


def read_by_key(keys: Iterable[Sequence[Any]], paths: Iterable[str | Path]) -> DatasetsByLabels:
    """Read one dataset for each key."""
    return {tuple(key): read_dataset(path) for key, path in zip(keys, paths, strict=True)}


def read_by_name(names: Iterable[str], paths: Iterable[str | Path]) -> dict[str, xr.Dataset]:
    """Read one dataset for each name."""
    return {name: read_dataset(path) for name, path in zip(names, paths, strict=True)}


def concatenate(
    datasets: DatasetsByLabels, dimension: str, shared_label_count: int = 1
) -> DatasetsByLabels:
    """Join datasets along an existing dimension if their keys share their first labels."""
    groups: dict[tuple[Any, ...], list[xr.Dataset]] = {}
    for key, dataset in datasets.items():
        groups.setdefault(key[:shared_label_count], []).append(dataset)
    return {key: xr.concat(group, dimension) for key, group in groups.items()}


def stack(datasets: DatasetsByLabels, dimensions: Sequence[str]) -> xr.Dataset:
    """Join datasets along new dimensions, the outermost first; missing combinations are NaN."""
    if not dimensions:  # The recursion ends at a single dataset, whose key is empty.
        return datasets[()]
    groups: dict[Any, dict[tuple[Any, ...], xr.Dataset]] = {}
    for (outer, *inner), dataset in datasets.items():
        groups.setdefault(outer, {})[tuple(inner)] = dataset
    stacked_groups = [stack(group, dimensions[1:]) for group in groups.values()]
    # xarray cannot join a pandas index of strings that differ between datasets.
    labels = xr.DataArray(np.array(list(groups)), dims=dimensions[0], name=dimensions[0])
    return xr.concat(stacked_groups, labels, join="outer")


def variables_of_columns(
    columns: np.ndarray, dimensions: str | Sequence[str], units: Mapping[str, str]
) -> dict[str, Any]:
    """Return variables by name: one for each column (last axis), in the order of `units`."""
    return {
        name: (dimensions, columns[..., k], {"units": unit})
        for k, (name, unit) in enumerate(units.items())
    }


def add_labels_and_sources(dataset: xr.Dataset, parameters: Mapping[str, Any]) -> xr.Dataset:
    """Return a dataset with the label and the source of each surface, from a job's parameters."""
    surfaces = dataset["surface"].values.tolist()
    return dataset.assign(
        label=("surface", [parameters["labels"][surface] for surface in surfaces]),
        source=("surface", [parameters["source"][surface] for surface in surfaces]),
    )
