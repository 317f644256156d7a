"""Rows of the table of a figure."""

import numpy as np
import pandas as pd


def select(rows: pd.DataFrame, **where: object) -> pd.DataFrame:
    """Return the rows with these values in these columns."""
    return rows[np.logical_and.reduce([rows[name] == value for name, value in where.items()])]
