"""Rows and columns of the tables of figures."""

from collections.abc import Iterable
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.statistics import bounds

#: Columns that say what a row is, and those of its value, with what the value depends on between.
ROW_COLUMNS = ("panel", "surface", "label", "basis", "origin", "quantity")
VALUE_COLUMNS = ("value", "low", "high", "unit")

#: Share of the sets of substitutes between `low` and `high`, in the middle of all.
SHARE_OF_SETS = 0.9


def bounded(data: xr.Dataset, name: str) -> xr.Dataset:
    """Return a variable as `value`, and `low` and `high`, those of its interval if it has one."""
    value = data[[name]].rename({name: "value"})
    if f"{name}_interval" not in data:
        return value
    low, high = bounds(data, name)
    return value.assign(low=low, high=high)


def as_rows(values: xr.Dataset | xr.DataArray) -> pd.DataFrame:
    """Return a row for each number, with its dimensions and variables."""
    is_array = isinstance(values, xr.DataArray)
    frame = values.to_dataframe("value") if is_array else values.to_dataframe()
    return frame.reset_index()


def computed_rows(values: xr.Dataset | xr.DataArray, **columns: Any) -> pd.DataFrame:
    """Return a row for each known `value` of computed quantities, with these further columns."""
    return as_rows(values).dropna(subset=["value"]).assign(origin="computed", **columns)


def rows_of(
    panel: str, quantity: str, unit: str, origin: str = "computed", **columns: Any
) -> pd.DataFrame:
    """Return a row for each number of these columns, which may be single numbers."""
    frame = pd.DataFrame({name: np.atleast_1d(values) for name, values in columns.items()})
    return frame.assign(panel=panel, quantity=quantity, unit=unit, origin=origin)


def drawn_rows(data: xr.Dataset, *drawn: tuple[str, str, str]) -> pd.DataFrame:
    """Return the rows of variables of a dataset, each given by panel, name and unit."""
    return pd.concat(
        computed_rows(bounded(data, name), panel=panel, quantity=name, unit=unit)
        for panel, name, unit in drawn
    )


def over_sets(values: xr.DataArray) -> xr.Dataset:
    """Return the median over the sets as `value`, and SHARE_OF_SETS as `low` and `high`."""
    tail = (1 - SHARE_OF_SETS) / 2
    quantiles = values.quantile([0.5, tail, 1 - tail], "set", skipna=False)
    ends = zip(("value", "low", "high"), quantiles, strict=True)
    return xr.Dataset({name: quantile.drop_vars("quantile") for name, quantile in ends})


def value_and_bounds(data: xr.Dataset, name: str) -> dict[str, Any]:
    """Return `value`, `low` and `high` of a variable that is a single number with its interval."""
    return {str(end): number.item() for end, number in bounded(data, name).items()}


def published_rows(constants: pd.DataFrame, units: dict[str, str], panel: str) -> pd.DataFrame:
    """Return a row for each of these published constants, with the ends of its uncertainty."""
    rows = constants.loc[list(units)]
    value, spread = rows["value"].to_numpy(), rows["uncertainty"].to_numpy()
    ends = {"value": value, "low": value - spread, "high": value + spread}
    labels = {"quantity": list(units), "unit": list(units.values())}
    return pd.DataFrame(labels | ends).assign(panel=panel, origin="published")


def published_edge(constants: pd.DataFrame, side: str) -> float:
    """Return the published critical wavelength (nm) of one side of the band."""
    return float(constants["value"][f"critical_wavelength_{side}"])


def tidy(
    frames: Iterable[pd.DataFrame], data: xr.Dataset, *bounds_only: str, surfaces: str = "surface"
) -> pd.DataFrame:
    """Return a table of ROW_COLUMNS, those between and VALUE_COLUMNS, as `labelled` does."""
    row_columns = (surfaces if column == "surface" else column for column in ROW_COLUMNS)
    return labelled(frames, data, [*row_columns, *bounds_only, *VALUE_COLUMNS], surfaces)


def labelled(
    frames: Iterable[pd.DataFrame], data: xr.Dataset, columns: list[str], surfaces: str = "surface"
) -> pd.DataFrame:
    """Return these columns of all rows, with label and basis of the surface that each names.

    Names in the column `surfaces` that the dataset does not have get none.
    """
    labels = data[["label", "basis"]].to_dataframe()[["label", "basis"]]
    rows = pd.concat(frames, ignore_index=True).join(labels, on=surfaces)
    return rows.reindex(columns=columns)
