"""Numbers of an answer: read from datasets, as answer.json lists them, and printed in words."""

import json
import math
import re
from collections.abc import Iterable, Mapping
from enum import StrEnum
from typing import Any

import xarray as xr
import yaml

from hardcontact.base.formatting import PRINTED_UNITS, format_as_paper, format_quantity
from hardcontact.base.number import Number, NumberSource, NumberStatus, json_value
from hardcontact.base.statistics import interval_ends
from hardcontact.report import TEXTS


class NoValue(StrEnum):
    """Why a number has no value."""

    NO_BAND = "no_band"  #: No wavelength changes the force.
    NO_HINDCAST = "no_hindcast"  #: No hindcast shows that roughness may be extrapolated.
    NO_EXPONENT = "no_exponent"  #: The scans do not determine the extrapolated spectrum.
    NO_AGREEMENT = "no_agreement"  #: No range and work of adhesion fit all measured forces.
    ONE_FORCE = "one_force"  #: One measured force does not determine range and work.


#: Words by the status of a number; number_words.yaml says where they stand.
_WORDS = yaml.safe_load((TEXTS / "templates/number_words.yaml").read_text("utf-8"))
NO_VALUE_WORDS: dict[str, str] = _WORDS["no_value"]
NO_INTERVAL_WORDS: dict[str, str] = _WORDS["no_interval"]
OPEN_WORDS: dict[str, str] = _WORDS["open"]


def number_of(
    dataset: xr.Dataset,
    variable: str,
    unit: str = "",
    *,
    name: str = "",
    source: NumberSource = "computed",
) -> Number:
    """Return a variable without dimensions, with its `<variable>_interval` if there is one.

    `unit` and `name` replace those of the variable. An interval from 0 to infinity becomes the
    status NO_INTERVAL.
    """
    unit = unit or str(dataset[variable].attrs.get("units", "1"))
    number = Number(name or variable, float(dataset[variable].item()), unit, source=source)
    if not math.isfinite(number.value) or f"{variable}_interval" not in dataset:
        return number
    low, high = interval_ends(dataset, variable)
    if low == 0 and high == math.inf:
        return number._replace(status=NumberStatus.NO_INTERVAL)
    return number._replace(low=low.item(), high=high.item())


def number_without_value(name: str, low: float, high: float, unit: str = "1") -> Number:
    """Return a number without a value, with the ends of its interval that are known, if any."""
    has_end = math.isfinite(low) or math.isfinite(high)
    status = NumberStatus.ONLY_ENDS if has_end else NumberStatus.NOT_KNOWN
    return Number(name, math.nan, unit, low, high, status)


def all_quantities(
    study_numbers: Iterable[Number], surface_numbers: Mapping[str, Iterable[Number]]
) -> list[dict[str, Any]]:
    """Return the numbers of the whole study, then of each surface, as the rows of answer.json."""
    return [
        {"surface": surface, **json_value(number)}
        for surface, numbers in {"": study_numbers, **surface_numbers}.items()
        for number in numbers
    ]


def numbers_of_answer(answer: Mapping[str, Any], surface: str = "") -> dict[str, Number]:
    """Return the numbers in answer.json of one surface, or of the whole study, by name."""
    numbers = {}
    for quantity in answer["quantities"]:
        if quantity["surface"] == surface:
            fields: dict[str, Any] = {
                key: math.nan if quantity[key] is None else quantity[key] for key in Number._fields
            }
            if fields["status"] in (NumberStatus.KNOWN, NumberStatus.NOT_KNOWN):
                fields["status"] = ""
            numbers[fields["name"]] = Number(**fields)
    return numbers


def answer_text(answer: Mapping[str, Any]) -> str:
    """Return the text of answer.json; raise ValueError if quantities of a surface share a name."""
    keys = [(quantity["surface"], quantity["name"]) for quantity in answer["quantities"]]
    repeated = sorted({key for key in keys if keys.count(key) > 1})
    if repeated:
        raise ValueError(f"expected quantities with different names, found twice: {repeated}")
    return json.dumps(answer, ensure_ascii=False, allow_nan=False, indent=1) + "\n"


def format_number(number: Number, digits: int = 3, end: str = "") -> str:
    """Return a known number with its interval, "67 [47, 74] nm", or an end, "low" or "high"."""
    _, _, open_end = number.status.partition("interval_open_")
    if end:
        number = Number(number.name, getattr(number, end), number.unit)
    print_number = format_quantity if number.unit in PRINTED_UNITS else format_as_paper
    return print_number(number.value, number.unit, (number.low, number.high), digits, open_end)


def describe_number(number: Number, digits: int = 3) -> str:
    """Return a number in words: its value and interval, its known ends, or why it has no value."""
    if math.isfinite(number.value):
        bound = OPEN_WORDS.get(number.status, "")
        return bound + format_number(number, digits) + _open_interval_words(number, digits)
    has_low, has_high = math.isfinite(number.low), math.isfinite(number.high)
    if has_low and has_high:
        low, high = (format_number(number, digits, end) for end in ("low", "high"))
        return low if low == high else f"{low} to {high}"
    if has_low:
        return f"at least {format_number(number, digits, 'low')}"
    if has_high:
        return f"at most {format_number(number, digits, 'high')}"
    return NO_VALUE_WORDS.get(number.status, "not known")


def describe_without_interval(number: Number) -> str:
    """Return a number in words without its interval.

    The value has the digits that it has beside its interval, or two if there is none.
    """
    return re.sub(r" \[[^]]*\]| \(.*\)", "", describe_number(number, 2))


def _open_interval_words(number: Number, digits: int) -> str:
    """Return the words after a value whose interval lacks one end or both, or an empty text."""
    has_low, has_high = math.isfinite(number.low), math.isfinite(number.high)
    if number.status in NO_INTERVAL_WORDS:
        return f" ({NO_INTERVAL_WORDS[number.status]})"
    if has_low and not has_high:
        return f" (at least {format_number(number, digits, 'low')})"
    if has_high and not has_low:
        return f" (at most {format_number(number, digits, 'high')})"
    return ""
