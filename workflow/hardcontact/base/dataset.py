"""Labelled datasets on disk: whole or absent, with their origin, checked when read."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

import pandas as pd
import xarray as xr

from hardcontact.base.whole_file import whole_file

#: Formats of netCDF; scan readers know the classic ones only.
FileFormat = Literal["NETCDF4", "NETCDF3_64BIT"]


def write(dataset: xr.Dataset, path: str | Path, file_format: FileFormat = "NETCDF4") -> None:
    """Write a dataset whole or not at all; a file that cannot be written is a ValueError."""
    with whole_file(path) as temporary:
        try:
            dataset.to_netcdf(temporary, format=file_format, engine="netcdf4")
        except RuntimeError as error:  # netCDF raises it for any error of the system
            raise OSError(str(error)) from error


def read(path: str | Path) -> xr.Dataset:
    """Read a dataset into memory; a missing, damaged or truncated file is a ValueError."""
    try:
        with xr.open_dataset(path, engine="netcdf4") as dataset:
            return dataset.load()
    except (OSError, RuntimeError, ValueError) as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        raise ValueError(
            f"{path}: expected a complete netCDF file, found: {reason}; delete it and run again"
        ) from None


def read_all(
    keys: Iterable[Sequence[Any]], paths: Iterable[str | Path]
) -> dict[tuple[Any, ...], xr.Dataset]:
    """Read one dataset for each key (its labels), in the same order: the mapping for `stack`."""
    return {tuple(key): read(path) for key, path in zip(keys, paths, strict=True)}


def stack(parts: Mapping[tuple[Any, ...], xr.Dataset], dimensions: Sequence[str]) -> xr.Dataset:
    """Join datasets along new dimensions, the outermost first.

    A key has the labels of the dataset, one of each dimension; NaN where a combination of labels is
    missing. Labels are in the order of the keys; those of an inner dimension are sorted if they are
    not the same for all outer labels.
    """
    if not dimensions:
        return parts[()]
    groups: dict[Any, dict[tuple[Any, ...], xr.Dataset]] = {}
    for (first, *rest), part in parts.items():
        groups.setdefault(first, {})[tuple(rest)] = part
    inner = [stack(group, dimensions[1:]) for group in groups.values()]
    return xr.concat(inner, pd.Index(list(groups), name=dimensions[0]), join="outer")
