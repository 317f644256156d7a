"""Plain arrays in netCDF, without xarray, for jobs that are run a thousand times.

Importing xarray takes longer than many of these jobs compute. `dataset.read` reads what they write
as any other dataset, and `read` here what `dataset.write` wrote.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import netCDF4
import numpy as np

from hardcontact.records.whole_file import whole_file

__all__ = ["Arrays", "Variable", "damaged", "read", "whole_netcdf", "write"]

#: Names of dimensions, values and attributes of one array.
Variable = tuple[tuple[str, ...], Any, dict[str, Any]]


class Arrays(NamedTuple):
    """Named arrays, in the order in which `xarray.Dataset` takes them.

    Attributes
    ----------
    variables, coordinates : dict of str to Variable
        Each with the names of its dimensions, its values (numbers or texts) and its attributes.
    attributes : dict
        Global attributes.
    """

    variables: dict[str, Variable]
    coordinates: dict[str, Variable]
    attributes: dict[str, Any]


def write(arrays: Arrays, path: str | Path) -> None:
    """Write arrays whole or not at all; a file that cannot be written is a ValueError."""
    with (
        whole_netcdf(path) as temporary,
        netCDF4.Dataset(temporary, "w", format="NETCDF4") as file,
    ):
        _fill(file, arrays)


@contextmanager
def whole_netcdf(path: str | Path) -> Iterator[str]:
    """Give a temporary path as `whole_file`; an error of netCDF in the block is one of writing."""
    with whole_file(path) as temporary:
        try:
            yield temporary
        except RuntimeError as error:  # netCDF raises it for any error of the system
            raise OSError(str(error)) from error


def _fill(file: netCDF4.Dataset, arrays: Arrays) -> None:
    """Write arrays to an open file; a global attribute names coordinates, as xarray writes it."""
    for name, (dimensions, values, attributes) in (arrays.coordinates | arrays.variables).items():
        values = np.asarray(values)
        for dimension, size in zip(dimensions, values.shape, strict=True):
            if dimension not in file.dimensions:
                file.createDimension(dimension, size)
        text = values.dtype.kind == "U"
        variable = file.createVariable(name, str if text else values.dtype, dimensions)
        variable.setncatts(attributes)
        variable[...] = values.astype(object) if text else values
    file.setncatts(arrays.attributes)
    named = [name for name, (dims, _, _) in arrays.coordinates.items() if tuple(dims) != (name,)]
    if named:
        file.setncattr("coordinates", " ".join(named))


def read(path: str | Path) -> Arrays:
    """Read arrays into memory; a missing, damaged or truncated file is a ValueError.

    Coordinates are the variables that have the name of their only dimension or that an attribute
    ``coordinates`` names.
    """
    try:
        with netCDF4.Dataset(path) as file:
            file.set_auto_mask(False)
            stored = {name: _variable(variable) for name, variable in file.variables.items()}
            attributes = dict(file.__dict__)
    except (OSError, RuntimeError, ValueError) as error:
        raise damaged(path, error) from None
    own_attributes = [own for _, _, own in stored.values()]
    named = {
        name for one in (attributes, *own_attributes) for name in one.pop("coordinates", "").split()
    }
    coordinates = {
        name: variable
        for name, variable in stored.items()
        if variable[0] == (name,) or name in named
    }
    variables = {name: stored[name] for name in stored if name not in coordinates}
    return Arrays(variables, coordinates, attributes)


def _variable(variable: netCDF4.Variable) -> Variable:
    """Read one array; texts as an array of texts of any shape."""
    values = variable[...]
    attributes = dict(variable.__dict__)
    attributes.pop("_FillValue", None)  # of missing values, which are NaN here
    return (
        variable.dimensions,
        np.asarray(values, dtype=str if variable.dtype is str else None),
        attributes,
    )


def damaged(path: str | Path, error: Exception) -> ValueError:
    """Return the error, in one line, of a file that cannot be read whole."""
    reason = " ".join(str(error).split()) or type(error).__name__
    return ValueError(
        f"{path}: expected a complete netCDF file, found: {reason}; delete it and run again"
    )
