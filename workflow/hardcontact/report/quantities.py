"""Quantities of an answer: how they are read from datasets, printed, and listed in answer.json."""

import json
import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import xarray as xr

from hardcontact.base.formatting import (
    PRINTED_UNITS,
    format_as_paper,
    format_quantity,
    is_boundless,
)
from hardcontact.base.number import Number, plain
from hardcontact.base.statistics import bounds

QuantityMapping = dict[str, Any]

#: Words in place of an unknown value, by its status.
NO_VALUE = {
    "none": "",
    "not_computed": "not computed",
    "not_bounded": "not bounded",
    "no_edge": "no edge within the cutoffs computed",
    "no_band": "no band",
    "not_reached": "not reached",
    "not_printed": "not printed",
    "no_exponent": "not answered: the scans do not tell how their roughness goes on",
}
#: Words after a value without an interval, by its status.
NO_INTERVAL = {
    "not_bounded": "not bounded by so few scans",
    "no_interval": "no interval",
    "whole_scan": "not bounded: every contact feels the whole scan",
    "few_parts": "not bounded: too few parts, which differ too much",
    "few_places": "not bounded: contacts touch too few places",
}


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
    """Return a variable without dimensions, with its `<variable>_interval` if there is one.

    The unit replaces that of the dataset, and the name that of the variable. `missing` is the
    status of a value that is not finite. If strict, an interval that reaches too far counts as
    none, and an interval without ends has the status "no_interval".
    """
    unit = unit or str(dataset[variable].attrs.get("units", "1"))
    number = Number(name or variable, float(dataset[variable].item()), unit, source=source)
    if not math.isfinite(number.value):
        return number._replace(status=missing)
    if f"{variable}_interval" not in dataset:
        return number
    low, high = ends(dataset, variable)
    if (low, high) == (0, math.inf) or (strict and is_boundless(number.value, low, high, unit)):
        return number._replace(status="not_bounded")
    without = strict and not (math.isfinite(low) or math.isfinite(high))
    return number._replace(low=low, high=high, status="no_interval" if without else "")


def ends(dataset: xr.Dataset, name: str) -> tuple[float, float]:
    """Return both ends of the interval of a variable without dimensions."""
    low, high = bounds(dataset, name)
    return low.item(), high.item()


def bounds_only(
    name: str, low: float, high: float, unit: str = "1", missing: str = "not_known"
) -> Number:
    """Return a number of which only ends are known; the status says which."""
    codes = {(True, True): "between", (True, False): "more_than", (False, True): "at_most"}
    status = codes.get((math.isfinite(low), math.isfinite(high)), missing)
    return Number(name, math.nan, unit, low, high, status)


def bare(number: Number) -> Number:
    """Return a number without its interval; a bound remains a bound."""
    status = number.status if number.status in ("open_above", "open_below") else ""
    return number._replace(low=math.nan, high=math.nan, status=status)


def printed(number: Number, digits: int = 3, end: str = "") -> str:
    """Return a known number with its interval, "67 [47, 74] nm", or its "low" or "high" end.

    With the status "interval_open_high" the interval ends at a bound: "67 [47, 74 or more] nm".
    """
    open_end = ""
    if number.status.startswith("interval_open_"):
        open_end = number.status.removeprefix("interval_open_")
    if end:
        number = Number(number.name, getattr(number, end), number.unit)
    if number.unit in PRINTED_UNITS:
        return format_quantity(number.value, number.unit, number.low, number.high, digits, open_end)
    return format_as_paper(number.value, number.unit, (number.low, number.high), digits, open_end)


def in_words(number: Number, digits: int = 3) -> str:
    """Return a number with its interval in words, as its status asks for."""
    if number.status == "between":
        both = [printed(number, digits, end) for end in ("low", "high")]
        text = " to ".join(dict.fromkeys(both))
    elif number.status == "more_than":
        text = f"more than {printed(number, digits, 'low')}"
    elif number.status == "at_most":
        text = f"at most {printed(number, digits, 'high')}"
    elif math.isfinite(number.value):
        bound = {"open_above": "at least ", "open_below": "at most "}.get(number.status, "")
        text = bound + printed(number, digits) + _unbounded(number, digits)
    else:
        text = NO_VALUE.get(number.status, "not known")
    return text


def _unbounded(number: Number, digits: int) -> str:
    """Return the words for an interval without one end, or without both."""
    low, high = math.isfinite(number.low), math.isfinite(number.high)
    if number.status in NO_INTERVAL:
        return f" ({NO_INTERVAL[number.status]})"
    if low and not high:
        return f" [above {printed(number, digits, 'low')}]"
    if high and not low:
        return f" [below {printed(number, digits, 'high')}]"
    return ""


def quantity_mapping(number: Number, surface: str = "", name: str = "") -> QuantityMapping:
    """Return a number as a mapping for answer.json, with None for unknown values.

    number: the number with its interval, unit, status and source.
    surface: the surface that it belongs to; empty for a number of the whole study.
    name: its name in the list; by default that of the number.
    """
    return {"surface": surface, **plain(number), "name": name or number.name}


def numbers_within(prefix: str, mapping: Mapping[str, Any]) -> Iterator[Number]:
    """Yield the numbers among the values of a mapping, counts too, named `<prefix>_<key>`."""
    for key, value in mapping.items():
        if isinstance(value, Number):
            yield value._replace(name=f"{prefix}_{key}")
        elif isinstance(value, int) and not isinstance(value, bool):
            yield Number(f"{prefix}_{key}", value)


def answer_json(head: Mapping[str, Any], quantities: Iterable[QuantityMapping]) -> str:
    """Return the text of answer.json, as answer.schema.json describes it.

    head: the entries before the list.
    Raises ValueError if two quantities of one surface have the same name.
    """
    rows = list(quantities)
    names = [(row["surface"], row["name"]) for row in rows]
    repeated = sorted({name for name in names if names.count(name) > 1})
    if repeated:
        raise ValueError(f"expected quantities with different names, found twice: {repeated}")
    content = {**head, "quantities": rows}
    return json.dumps(content, ensure_ascii=False, allow_nan=False, indent=1) + "\n"
