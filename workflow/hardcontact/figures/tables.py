"""Columns of the tables of figures: what a row is, values with their interval, labels."""

import pandas as pd
import xarray as xr

from hardcontact.statistics import bounds

__all__ = [
    "ROW_COLUMNS",
    "VALUE_COLUMNS",
    "bounded",
    "label_surfaces",
    "published_value",
    "value_and_bounds",
]

#: Columns that say what a row is, and those of its value, with what the value depends on between.
ROW_COLUMNS = ("panel", "surface", "label", "basis", "origin", "quantity")
VALUE_COLUMNS = ("value", "low", "high", "unit")


def bounded(data: xr.Dataset, name: str) -> xr.Dataset:
    """Return a variable and the bounds of its interval as variables `value`, `low` and `high`."""
    low, high = bounds(data, name)
    return data[[name]].rename({name: "value"}).assign(low=low, high=high)


def value_and_bounds(data: xr.Dataset, name: str) -> dict[str, float]:
    """Return `value`, `low` and `high` of a variable that is a single number with its interval."""
    return {str(end): number.item() for end, number in bounded(data, name).items()}


def published_value(constants: pd.DataFrame, name: str) -> dict[str, float]:
    """Return `value`, `low` and `high` of a published constant; NaN without an uncertainty."""
    value, spread = constants["value"][name], constants["uncertainty"][name]
    return {"value": value, "low": value - spread, "high": value + spread}


def label_surfaces(rows: pd.DataFrame, data: xr.Dataset, column: str = "surface") -> pd.DataFrame:
    """Add to each row the label and the basis of its surface.

    Parameters
    ----------
    rows : pandas.DataFrame
        With a column that names surfaces; label and basis of any other name are missing.
    data : xarray.Dataset
        With `label(surface)` and `basis(surface)`.
    column : str
        Name of that column.

    Returns
    -------
    pandas.DataFrame
        With the columns `label` and `basis`.
    """
    named = data[["label", "basis"]].to_dataframe()[["label", "basis"]]
    return rows.join(named, on=column)
