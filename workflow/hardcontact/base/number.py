"""One number with unit, interval, status and source, as pages, files and programs use it."""

import math
from typing import Any, NamedTuple


class Number(NamedTuple):
    """A number with its interval; an unknown value or end is NaN or infinite.

    name: name of the quantity.
    value, low, high: the number and the ends of its interval, in `unit`.
    unit: a unit of datasets: "nm", "N", "J m-2", "1".
    status: a code, which `report.quantities` and templates turn into words: "open_above" or
        "open_below" if `value` is a bound, "interval_open_low" or "interval_open_high" if an end
        of the interval is a bound. Modules that make numbers list their codes as constants.
    source: a code for the origin: "computed", "measured", "from_measured", "extrapolated",
        "artificial", "partly_artificial", "interval_artificial", "published", "given", "assumed",
        "file".
    """

    name: str
    value: float
    unit: str = "1"
    low: float = math.nan
    high: float = math.nan
    status: str = ""
    source: str = "computed"

    def __repr__(self) -> str:
        """Return name, number, interval, unit and status as far as there are any."""
        known = math.isfinite(self.low + self.high)
        interval = f" [{self.low:.3g}, {self.high:.3g}]" if known else ""
        unit = f" {self.unit}" if self.unit != "1" else ""
        status = f", {self.status}" if self.status else ""
        return f"Number({self.name}: {self.value:.3g}{interval}{unit}{status})"


def plain(value: Any) -> Any:
    """Return a value for JSON: numbers as mappings, None in place of infinite values and NaN."""
    if isinstance(value, Number):
        known = "known" if math.isfinite(value.value) else "not_known"
        return plain(value._asdict() | {"status": value.status or known})
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, list):
        return [plain(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
