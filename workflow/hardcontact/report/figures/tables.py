"""Rows and columns of the tables of figures."""

from collections.abc import Iterable
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.statistics import bounds

#: First and last columns of a table; between them are the columns of independent variables.
ROW_COLUMNS = ("panel", "surface", "label", "basis", "origin", "quantity")
VALUE_COLUMNS = ("value", "low", "high", "unit")

#: Share of the sets of substitutes between `low` and `high`: the middle of all sets.
SHARE_OF_SETS = 0.9


def value_and_interval(data: xr.Dataset, name: str) -> xr.Dataset:
    """Return a variable as `value`, with the ends of its interval, if any, as `low` and `high`."""
    value = data[[name]].rename({name: "value"})
    if f"{name}_interval" not in data:
        return value
    low, high = bounds(data, name)
    return value.assign(low=low, high=high)


def number_rows(values: xr.Dataset | xr.DataArray) -> pd.DataFrame:
    """Return a row for each number, with its coordinates and variables."""
    is_array = isinstance(values, xr.DataArray)
    frame = values.to_dataframe("value") if is_array else values.to_dataframe()
    return frame.reset_index()


def computed_rows(values: xr.Dataset | xr.DataArray, **columns: Any) -> pd.DataFrame:
    """Return a row for each finite `value` of computed quantities, with further columns."""
    return number_rows(values).dropna(subset=["value"]).assign(origin="computed", **columns)


def quantity_rows(
    panel: str, quantity: str, unit: str, origin: str = "computed", **columns: Any
) -> pd.DataFrame:
    """Return the rows of a quantity; columns hold an array or a single number."""
    frame = pd.DataFrame({name: np.atleast_1d(values) for name, values in columns.items()})
    return frame.assign(panel=panel, quantity=quantity, unit=unit, origin=origin)


def summarize_sets(values: xr.DataArray) -> xr.Dataset:
    """Return the median over the sets as `value`, and SHARE_OF_SETS as `low` and `high`."""
    tail = (1 - SHARE_OF_SETS) / 2
    quantiles = values.quantile([0.5, tail, 1 - tail], "set", skipna=False)
    ends = zip(("value", "low", "high"), quantiles, strict=True)
    return xr.Dataset({name: quantile.drop_vars("quantile") for name, quantile in ends})


def value_and_bounds(data: xr.Dataset, name: str) -> dict[str, Any]:
    """Return `value`, `low` and `high` of a variable with a single number."""
    return {str(end): number.item() for end, number in value_and_interval(data, name).items()}


def published_rows(constants: pd.DataFrame, units: dict[str, str], panel: str) -> pd.DataFrame:
    """Return a row for each published constant in `units`, with the ends of its uncertainty."""
    rows = constants.loc[list(units)]
    value = rows["value"].to_numpy()
    spread = rows["uncertainty"].to_numpy()
    ends = {"value": value, "low": value - spread, "high": value + spread}
    labels = {"quantity": list(units), "unit": list(units.values())}
    return pd.DataFrame(labels | ends).assign(panel=panel, origin="published")


def published_edge(constants: pd.DataFrame, side: str) -> float:
    """Return the published edge (nm) of one side of the band."""
    return float(constants["value"][f"edge_{side}"])


def tidy_table(
    frames: Iterable[pd.DataFrame],
    data: xr.Dataset,
    *further_columns: str,
    surfaces: str = "surface",
) -> pd.DataFrame:
    """Return a table of ROW_COLUMNS, further columns and VALUE_COLUMNS, as `label_rows` does."""
    row_columns = (surfaces if column == "surface" else column for column in ROW_COLUMNS)
    return label_rows(frames, data, [*row_columns, *further_columns, *VALUE_COLUMNS], surfaces)


def label_rows(
    frames: Iterable[pd.DataFrame], data: xr.Dataset, columns: list[str], surfaces: str = "surface"
) -> pd.DataFrame:
    """Return the columns of all rows, with label and basis of the surface of each row.

    The column `surfaces` has the names of surfaces. Label and basis are empty for names that the
    dataset lacks.
    """
    labels = data[["label", "basis"]].to_dataframe()[["label", "basis"]]
    rows = pd.concat(frames, ignore_index=True).join(labels, on=surfaces)
    return rows.reindex(columns=columns)
