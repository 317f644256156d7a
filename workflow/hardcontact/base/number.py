"""One number with unit, interval, status and source, as pages, files and programs use it."""

import math
from enum import StrEnum
from typing import Any, Literal, NamedTuple


class NumberStatus(StrEnum):
    """Codes of `Number.status` for any quantity.

    Codes of a single quantity are in the module that computes it. Pages turn codes into words.
    """

    #: Nothing to add to the number and its interval.
    PLAIN = ""
    #: Stands in JSON, where no status is empty, for PLAIN if the value is finite.
    KNOWN = "known"
    #: Only ends of the interval are known.
    ONLY_ENDS = "ends"
    #: The value is not known. Also stands in JSON for PLAIN if the value is NaN or infinite.
    NOT_KNOWN = "not_known"
    #: The interval has no known low end, which lies below `low`.
    INTERVAL_OPEN_LOW = "interval_open_low"
    #: The interval has no known high end, which lies above `high`.
    INTERVAL_OPEN_HIGH = "interval_open_high"
    #: There is no interval, because scans do not limit the number.
    NO_INTERVAL = "no_interval"


#: Codes for the origin of a number:
#: - computed: from forces on surfaces or from spectra;
#: - measured: a measured force, or an edge that rests on measured roughness;
#: - from_measured: computed from measured forces;
#: - extrapolated: with roughness beyond the reliable wavelengths;
#: - artificial: an edge of the paper's study at wavelengths of artificial roughness;
#: - unreliable: an edge where no scan is reliable, or over 90 % of whose change comes from there;
#: - partly_unreliable: an edge, 10 to 90 % of whose change comes from unreliable wavelengths;
#: - interval_unreliable: an edge of which only the interval reaches unreliable wavelengths;
#: - published: in the paper;
#: - given: a key of the configuration;
#: - assumed: a key with the paper's value, because the user gave none;
#: - file: a property of the file of a scan.
NumberSource = Literal[
    "computed", "measured", "from_measured", "extrapolated", "artificial", "unreliable",
    "partly_unreliable", "interval_unreliable", "published", "given", "assumed", "file",
]  # fmt: skip


class Number(NamedTuple):
    """A number with its interval; an unknown value or end is NaN or infinite.

    name: name of the quantity.
    value, low, high: the number and the ends of its interval, in `unit`.
    unit: a unit of datasets: "nm", "N", "J m-2", "1".
    status: a code for what is known of the number, such as why it has no interval.
    source: a code for the origin of the number.
    """

    name: str
    value: float
    unit: str = "1"
    low: float = math.nan
    high: float = math.nan
    status: StrEnum = NumberStatus.PLAIN
    source: NumberSource = "computed"

    def __repr__(self) -> str:
        """Return the name, the number and, if they exist, interval, unit and status."""
        is_bounded = math.isfinite(self.low + self.high)
        interval = f" [{self.low:.3g}, {self.high:.3g}]" if is_bounded else ""
        unit = f" {self.unit}" if self.unit != "1" else ""
        status = f", {self.status}" if self.status else ""
        return f"Number({self.name}: {self.value:.3g}{interval}{unit}{status})"


def numbers_by_name(*numbers: Number) -> dict[str, Number]:
    """Return numbers by their names; the last number if several have the same name."""
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
