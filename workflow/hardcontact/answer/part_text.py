"""What the sentences of a part are made of: numbers with intervals, lists of names."""

import math
from collections.abc import Iterable, Sequence

import xarray as xr

from hardcontact.claims.quantity_text import print_as_paper
from hardcontact.statistics import bounds

__all__ = ["DIGITS", "labels", "listed", "print_bounded_as_paper", "print_percent"]

#: Of computed numbers: their intervals are wider than what more digits would say.
DIGITS = 2


def print_bounded_as_paper(dataset: xr.Dataset, name: str, unit: str) -> str:
    """Return a variable without dimensions, its interval `<name>_interval` and its unit.

    Parameters
    ----------
    dataset : xarray.Dataset
        Selected down to one number.
    name : str
        Of the variable.
    unit : str
        A key of `quantity_text.PRINTED`.

    Returns
    -------
    str
        For example "1.7 [1.4, 2.8] µm"; "no number" of NaN.
    """
    low, high = (end.item() for end in bounds(dataset, name))
    return print_as_paper(dataset[name].item(), unit, (low, high), DIGITS) or "no number"


def print_percent(share: float, low: float = math.nan, high: float = math.nan) -> str:
    """Return a share of 1, with its interval if it has one, as "16 [12, 67] %"."""
    within = (100 * low, 100 * high)
    return f"{print_as_paper(100 * share, '1', within, DIGITS)} %"


def listed(items: Iterable[str]) -> str:
    """Return items as "a, b and c"."""
    *others, last = items
    return f"{', '.join(others)} and {last}" if others else last


def labels(dataset: xr.Dataset, surfaces: Sequence[str]) -> str:
    """Return the labels of some surfaces of a dataset with `label(surface)`, as a list."""
    return listed(str(dataset["label"].sel(surface=surface).item()) for surface in surfaces)
