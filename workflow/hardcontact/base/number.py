"""One number with unit, interval, status and source, as pages, files and programs use it."""

import math
from enum import StrEnum
from typing import Any, Literal, NamedTuple


class NumberStatus(StrEnum):
    """Codes of `Number.status` for any quantity; other modules have those of a single quantity."""

    PLAIN = ""  #: Nothing to add. In JSON KNOWN or NOT_KNOWN replaces it.
    KNOWN = "known"  #: The value is finite.
    NOT_KNOWN = "not_known"
    ONLY_ENDS = "ends"  #: Only ends of the interval are known.
    INTERVAL_OPEN_LOW = "interval_open_low"  #: The low end is not known; it lies below `low`.
    INTERVAL_OPEN_HIGH = "interval_open_high"  #: The high end is not known; it lies above `high`.
    NO_INTERVAL = "no_interval"


#: Codes for the origin of a number, besides `computed` and `published`:
#: - measured: a measured force, or an edge that rests on measured roughness;
#: - from_measured: computed from measured forces;
#: - extrapolated: with roughness beyond the reliable wavelengths;
#: - artificial: an edge of the paper's study in artificial roughness, or a ratio of such edges;
#: - unreliable: an edge where no scan is reliable, or a number of which over 90 % come from there;
#: - partly_unreliable: a number of which 10 to 90 % come from unreliable wavelengths;
#: - interval_unreliable: an edge of which only the interval reaches unreliable wavelengths;
#: - given: a key of the configuration, or a constant of the program;
#: - assumed: a key with the paper's value, because the user gave none;
#: - file: a property of the file of a scan.
NumberSource = Literal[
    "computed", "measured", "from_measured", "extrapolated", "artificial", "unreliable",
    "partly_unreliable", "interval_unreliable", "published", "given", "assumed", "file",
]  # fmt: skip


class Number(NamedTuple):
    """A quantity with the ends of its interval; an unknown value or end is NaN or infinite."""

    name: str
    value: float
    unit: str = "1"  #: A unit of datasets: "nm", "N", "J m-2", "1".
    low: float = math.nan
    high: float = math.nan
    status: StrEnum = NumberStatus.PLAIN  #: What is known, such as why there is no interval.
    source: NumberSource = "computed"

    def __repr__(self) -> str:
        """Return the number in one line."""
        is_bounded = math.isfinite(self.low + self.high)
        interval = f" [{self.low:.3g}, {self.high:.3g}]" if is_bounded else ""
        unit = f" {self.unit}" if self.unit != "1" else ""
        status = f", {self.status}" if self.status else ""
        return f"Number({self.name}: {self.value:.3g}{interval}{unit}{status})"


def numbers_by_name(*numbers: Number) -> dict[str, Number]:
    """Return numbers by their names."""
    return {number.name: number for number in numbers}


def json_value(value: Any) -> Any:
    """Return a value for JSON: numbers as mappings, None in place of infinite values and NaN."""
    if isinstance(value, Number):
        is_known = math.isfinite(value.value)
        status = value.status or (NumberStatus.KNOWN if is_known else NumberStatus.NOT_KNOWN)
        return json_value(value._asdict() | {"status": status})
    if isinstance(value, dict):
        return {key: json_value(item) for key, item in value.items()}
    if isinstance(value, list):
        return [json_value(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
