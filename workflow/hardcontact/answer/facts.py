"""Numbers of a page, and the codes beside them: what a template shows and says."""

import math
from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from hardcontact.numbers.number import Number
from hardcontact.numbers.printing import UNITS, is_boundless, print_as_paper, print_quantity
from hardcontact.numbers.statistics import bounds

#: Of a table: a number, a code or a label by the name of the column.
Cells = dict[str, Any]


class Row(NamedTuple):
    """A row of the table of an answer: a number whose name and source are codes.

    What else is known of it is `reason` of an open edge, `measured_share` of an edge or a force
    that comes from reliable wavelengths, `side`, `start` and `end` of continued roughness, `tests`
    of a measured force.
    """

    fact: Number
    about: dict[str, Any]


def number_of(
    dataset: xr.Dataset,
    variable: str,
    unit: str = "",
    missing: str = "",
    *,
    name: str = "",
    source: str = "computed",
    strict: bool = True,
) -> Number:
    """Return a variable without dimensions, with `<variable>_interval` if that bounds anything.

    The unit is for what has none in the dataset, `missing` is the status of what is no number, the
    name is by default that of the variable. If strict, an interval that reaches too far counts as
    none, and one without ends has a status.
    """
    unit = unit or str(dataset[variable].attrs.get("units", "1"))
    found = Number(name or variable, float(dataset[variable].item()), unit, source=source)
    if not math.isfinite(found.value):
        return found._replace(status=missing)
    if f"{variable}_interval" not in dataset:
        return found
    low, high = ends(dataset, variable)
    if (low, high) == (0, math.inf) or (strict and is_boundless(found.value, low, high, unit)):
        return found._replace(status="not_bounded")
    without = strict and not (math.isfinite(low) or math.isfinite(high))
    return found._replace(low=low, high=high, status="no_interval" if without else "")


def with_reason(fact: Number, source: xr.DataArray) -> Number:
    """Return a number of which no end of the interval is known with the reason as its status.

    The source of intervals is that of the dataset: "none" if every contact feels all of a scan.
    """
    if np.isfinite([fact.low, fact.high]).any() or fact.status not in ("", "not_bounded"):
        return fact
    return fact._replace(status="whole_scan" if source.item() == "none" else "few_parts")


def printed(number: Number, digits: int = 3, end: str = "") -> str:
    """Return a known number with its interval, "67 [47, 74] nm", or its "low" or "high" end.

    With the status "interval_open_high" the interval ends at a bound: "67 [47, 74 or more] nm".
    """
    open_end = (
        number.status.removeprefix("interval_open_") if "interval_open" in number.status else ""
    )
    if end:
        number = Number(number.name, getattr(number, end), number.unit)
    if number.unit in UNITS:
        return print_quantity(number.value, number.unit, number.low, number.high, digits, open_end)
    return print_as_paper(number.value, number.unit, (number.low, number.high), digits, open_end)


def number(name: str, value: float, unit: str, missing: str) -> Number:
    """Return a number without an interval, of this status where it is no number."""
    return Number(name, value, unit, status=missing if np.isnan(value) else "")


def between(
    name: str, low: float, high: float, unit: str = "1", missing: str = "not_known"
) -> Number:
    """Return what is known of the ends of something."""
    codes = {(True, True): "between", (True, False): "more_than", (False, True): "at_most"}
    status = codes.get((math.isfinite(low), math.isfinite(high)), missing)
    return Number(name, math.nan, unit, low, high, status)


def span(name: str, values: ArrayLike, unit: str = "1") -> Number:
    """Return the smallest and the largest of the numbers that are known."""
    found = [one for one in np.ravel(values) if np.isfinite(one)]
    return between(name, min(found, default=np.nan), max(found, default=np.nan), unit)


def percent(share: Number) -> Number:
    """Return a share of one in percent."""
    low, high = 100 * share.low, 100 * share.high
    return share._replace(value=100 * share.value, low=low, high=high, unit="%")


def bare(number: Number) -> Number:
    """Return a number without its interval; an open one remains a bound."""
    status = number.status if number.status in ("open_above", "open_below") else ""
    return number._replace(low=math.nan, high=math.nan, status=status)


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
