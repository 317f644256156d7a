"""Facts of a page: a number, its interval, what is known of it, and where it comes from."""

import math
from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from hardcontact.numbers.printing import UNITS, is_boundless, print_as_paper, print_quantity
from hardcontact.numbers.statistics import bounds

#: Of a table: a fact, a code or a label by the name of the column.
Cells = dict[str, Any]


class Fact(NamedTuple):
    """One number of a page.

    Attributes
    ----------
    name : str
        What it is the number of.
    value, low, high : float or None
        The number and the ends of its interval, in `unit`; None of what is not known.
    unit : str
        Of the datasets: "nm", "N", "J m-2", "1".
    status : str
        What is known of the number, as a code for which a template has the words: "known",
        "open_above" and "open_below" where `value` is a bound, "not_bounded" where the interval
        says only that there are too few scans, "no_interval" where it should have one,
        "between", "more_than" and "at_most" where only ends are known, "not_known".
    source : str
        Where it comes from, as a code: "computed", "measured", "extrapolated", "artificial",
        "given", "file", "assumed".
    """

    name: str
    value: float | None
    unit: str
    low: float | None = None
    high: float | None = None
    status: str = "known"
    source: str = "computed"


def known(value: float) -> float | None:
    """Return a number, or None for what JSON cannot say and data cannot give."""
    return float(value) if math.isfinite(value) else None


def fact_of(
    dataset: xr.Dataset, variable: str, name: str, source: str = "computed", unit: str = ""
) -> Fact:
    """Return a variable without dimensions as a fact, with `<variable>_interval` if it is there.

    `unit` is for what has none in the dataset.
    """
    value = known(dataset[variable].item())
    unit = unit or str(dataset[variable].attrs.get("units", "1"))
    status = "not_known" if value is None else "known"
    low, high = None, None
    if f"{variable}_interval" in dataset:
        ends = [end.item() for end in bounds(dataset, variable)]
        if ends == [0, math.inf]:
            status = "not_bounded"
        else:
            low, high = map(known, ends)
    return Fact(name, value, unit, low, high, status, source)


def printed(fact: Fact, digits: int = 3) -> str:
    """Return a number that is known with its interval and unit, as "67 [47, 74] nm"."""
    numbers = fact.value, fact.low, fact.high
    value, low, high = (math.nan if one is None else one for one in numbers)
    if fact.unit in UNITS:
        return print_quantity(value, fact.unit, low, high, digits)
    return print_as_paper(value, fact.unit, (low, high), digits)


def bounded(dataset: xr.Dataset, name: str, unit: str = "", missing: str = "not_known") -> Fact:
    """Return a variable without dimensions as a fact, without an interval that bounds nothing.

    `unit` is for what has none in the dataset, `missing` the status of what is no number.
    """
    fact = fact_of(dataset, name, name, unit=unit)
    if fact.value is None:
        return fact._replace(low=None, high=None, status=missing)
    if f"{name}_interval" not in dataset:
        return fact
    if is_boundless(fact.value, *ends(dataset, name), fact.unit):
        return fact._replace(low=None, high=None, status="not_bounded")
    return fact._replace(status="no_interval") if fact.low is fact.high is None else fact


def number(name: str, value: float, unit: str = "1", missing: str = "not_known") -> Fact:
    """Return a number without an interval as a fact, of this status where it is no number."""
    return Fact(name, known(value), unit, status=missing if np.isnan(value) else "known")


def between(name: str, low: float, high: float, unit: str = "1") -> Fact:
    """Return what is known of the ends of something as a fact."""
    codes = {(True, True): "between", (True, False): "more_than", (False, True): "at_most"}
    status = codes.get((bool(np.isfinite(low)), bool(np.isfinite(high))), "not_known")
    return Fact(name, None, unit, known(low), known(high), status)


def span(name: str, values: ArrayLike, unit: str = "1") -> Fact:
    """Return the smallest and the largest of the numbers that are known as a fact."""
    found = [one for one in np.ravel(values) if np.isfinite(one)]
    return between(name, min(found, default=np.nan), max(found, default=np.nan), unit)


def percent(fact: Fact) -> Fact:
    """Return a share of one in percent."""
    value, low, high = (
        None if one is None else 100 * one for one in (fact.value, fact.low, fact.high)
    )
    return fact._replace(value=value, low=low, high=high, unit="%")


def ends(dataset: xr.Dataset, name: str) -> tuple[float, float]:
    """Return both ends of the interval of a variable without dimensions."""
    low, high = bounds(dataset, name)
    return low.item(), high.item()


def against(limit: float, dataset: xr.Dataset, name: str) -> str:
    """Return whether an interval lies "above" or "below" a limit, or leaves it "open"."""
    low, high = ends(dataset, name)
    return "above" if low > limit else "below" if high < limit else "open"


def surfaces(dataset: xr.Dataset) -> Iterator[tuple[Cells, xr.Dataset]]:
    """Yield the first cells of a row for every surface of a dataset, and what it has of it."""
    for name in dataset["surface"].values:
        one = dataset.sel(surface=name)
        yield {"surface": str(one["label"].item()), "basis": str(one["basis"].item())}, one


def count(rows: Iterable[Cells], name: str, *codes: str) -> int:
    """Return how many rows have one of these codes in a column."""
    return sum(row[name] in codes for row in rows)


def on_scans(scan_size: xr.Dataset) -> xr.Dataset:
    """Return what edges and forces are on mirrored windows of the size of the study's scans."""
    windows = scan_size.sel(edge_size=scan_size["mirrored"] == 1)
    return windows.sel(edge_size=scan_size.attrs["scan_size"], method="nearest")
