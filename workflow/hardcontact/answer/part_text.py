"""What the sentences of a part are made of: numbers with intervals, lists of names."""

import math
from collections.abc import Iterable, Sequence

import xarray as xr

from hardcontact.numbers.printing import print_as_paper
from hardcontact.numbers.statistics import bounds
from hardcontact.surfaces.synthesis import SIDES

__all__ = [
    "DIGITS",
    "EDGE_NAMES",
    "NEAR_ONE",
    "differs_from_one",
    "labels",
    "listed",
    "print_bounded_as_paper",
    "print_each",
    "print_percent",
    "print_within",
]

#: Of computed numbers: their intervals are wider than what more digits would say.
DIGITS = 2

#: Of ratios that are near one.
NEAR_ONE = 3

#: The edge of the band at each side.
EDGE_NAMES = dict(zip(SIDES, ("short", "long"), strict=True))

#: An interval that reaches so many times beyond its value says only that there are too few scans.
BOUNDLESS = 100


def print_bounded_as_paper(dataset: xr.Dataset, name: str, unit: str, digits: int = DIGITS) -> str:
    """Return a variable without dimensions, its interval `<name>_interval` and its unit.

    Parameters
    ----------
    dataset : xarray.Dataset
        Selected down to one number.
    name : str
        Of the variable.
    unit : str
        A key of `quantity_text.PRINTED`.
    digits : int
        Significant digits.

    Returns
    -------
    str
        For example "1.7 [1.4, 2.8] µm"; "no number" of NaN.
    """
    low, high = (end.item() for end in bounds(dataset, name))
    return print_within(dataset[name].item(), low, high, unit, digits) or "no number"


def print_within(
    value: float, low: float, high: float, unit: str = "1", digits: int = DIGITS
) -> str:
    """Return a number with its interval, in words where so few scans hardly bound it."""
    if max(low, -low, high, -high) > BOUNDLESS * abs(value) or 0 < low * BOUNDLESS < value:
        return f"{print_as_paper(value, unit, digits=digits)} (not bounded by so few scans)"
    return print_as_paper(value, unit, (low, high), digits)


def print_percent(share: float, low: float = math.nan, high: float = math.nan) -> str:
    """Return a share of 1, with its interval if it has one, as "16 [12, 67] %"."""
    number, *interval = print_within(100 * share, 100 * low, 100 * high).partition(" (")
    return "".join((number, " %", *interval))


def print_each(dataset: xr.Dataset, name: str, digits: int = DIGITS) -> str:
    """Return a number (surface,) with its interval for every surface of a dataset by label."""
    return "; ".join(
        f"{of_surface['label'].item()} {print_bounded_as_paper(of_surface, name, '1', digits)}"
        for of_surface in (dataset.sel(surface=one) for one in dataset["surface"].values)
    )


def differs_from_one(ratios: xr.Dataset, name: str) -> xr.DataArray:
    """Return where the interval of a ratio lies above or below one; false without an interval."""
    low, high = bounds(ratios, name)
    return (low > 1) | (high < 1)


def listed(items: Iterable[str]) -> str:
    """Return items as "a, b and c"."""
    *others, last = items
    return f"{', '.join(others)} and {last}" if others else last


def labels(dataset: xr.Dataset, surfaces: Sequence[str]) -> str:
    """Return the labels of some surfaces of a dataset with `label(surface)`, as a list."""
    return listed(str(dataset["label"].sel(surface=surface).item()) for surface in surfaces)
