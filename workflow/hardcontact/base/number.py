"""One number with unit, interval, status and source, as pages, files and programs use it."""

import math
from enum import StrEnum
from typing import Any, NamedTuple


class Status(StrEnum):
    """The codes of `Number.status` and of like variables of datasets.

    `report.quantities` and templates turn them into words.
    """

    #: Nothing else is known of the number.
    PLAIN = ""
    #: `value` is a bound: the number lies above or below it.
    OPEN_ABOVE, OPEN_BELOW = "open_above", "open_below"
    #: `low` or `high` is a bound.
    INTERVAL_OPEN_LOW, INTERVAL_OPEN_HIGH = "interval_open_low", "interval_open_high"
    #: A value is known; ends of its interval alone are known; nothing is known.
    KNOWN, ONLY_ENDS, NOT_KNOWN = "known", "ends", "not_known"
    #: An interval comes from scans or from quarters of scans.
    SCANS, QUARTERS = "scans", "quarters"
    #: There is no interval: scans do not bound the number, contacts touch too few patches, there
    #: is a single test, or a single part of scans.
    NO_INTERVAL, FEW_PATCHES, ONE_TEST = "no_interval", "few_patches", "one_test"
    ONE_PART = "none"
    #: An edge or the end of a region is found; no cutoff changes the force by the tolerance; no
    #: pair fits all forces. A variable has "none" for only one of these and ONE_PART.
    FOUND, NO_EDGE, NO_PAIR = "found", "none", "none"
    #: The region extends beyond the computed ranges; ripples of the filter hide the edge; there is
    #: no band.
    OPEN, RIPPLES, NO_BAND = "open", "ripples", "no_band"
    #: Artificial roughness is untested, or does not follow from the scans.
    NO_HINDCAST, NO_EXPONENT = "no_hindcast", "no_exponent"
    #: No pair fits the measured forces; a single force does not determine a pair.
    NO_AGREEMENT, ONE_FORCE = "no_agreement", "one_force"
    #: An input of the closed form is within the validated ranges or not.
    INSIDE, OUTSIDE = "inside", "outside"
    #: A change of the force by what the closed form leaves out.
    MATTERS, NEGLIGIBLE, UNKNOWN = "matters", "negligible", "unknown"
    #: Regimes: roughness hardly changes the force, many points carry it, or a few summits carry it.
    SMOOTH, MANY_POINTS, SINGLE_PEAKS = "smooth", "many_points", "single_peaks"
    #: Ends of the extrapolated spectrum.
    ATOMS, GRADIENT, HALF_LAPLACIAN = "atoms", "gradient", "half_laplacian"
    #: Bodies of a contact, by their elasticity.
    HARD, SOFT = "hard", "soft"
    #: Heights with steep sidewalls are not Gaussian: the closed form gives no force.
    STEEP_SIDEWALLS = "steep_sidewalls"
    #: A number of octaves is of a sum over the scan, or of the closed form.
    ON_SCAN, IN_CLOSED_FORM = "on_scan", "closed_form"
    #: No force on a scan: there is no map or more than one, it is too large, or the range of
    #: adhesion is too short for its pixels or its relief.
    NO_MAP, SEVERAL_SCANS = "no_map", "several_scans"
    TOO_LARGE, RANGE_TOO_SHORT = "too_large", "short_range"
    #: The closed form for the spectrum of a map, by its force relative to the force on the map.
    AGREES, NOT_GAUSSIAN = "agrees", "not_gaussian"
    #: A scan is smaller than twice the search size, or larger.
    SMALL, LARGE = "small", "large"
    #: An input is given, or the paper's.
    GIVEN, FROM_PAPER = "given", "paper"


class Number(NamedTuple):
    """A number with its interval; an unknown value or end is NaN or infinite.

    name: name of the quantity.
    value, low, high: the number and the ends of its interval, in `unit`.
    unit: a unit of datasets: "nm", "N", "J m-2", "1".
    status: what else is known of the number.
    source: a code for the origin: "computed", "measured", "from_measured", "extrapolated",
        "artificial", "partly_artificial", "interval_artificial", "published", "given", "assumed",
        "file".
    """

    name: str
    value: float
    unit: str = "1"
    low: float = math.nan
    high: float = math.nan
    status: Status = Status.PLAIN
    source: str = "computed"

    def __repr__(self) -> str:
        """Return name, number, interval, unit and status as far as there are any."""
        known = math.isfinite(self.low + self.high)
        interval = f" [{self.low:.3g}, {self.high:.3g}]" if known else ""
        unit = f" {self.unit}" if self.unit != "1" else ""
        status = f", {self.status}" if self.status else ""
        return f"Number({self.name}: {self.value:.3g}{interval}{unit}{status})"


def numbers_by_name(*numbers: Number) -> dict[str, Number]:
    """Return numbers by their names; of numbers with the same name, the last."""
    return {number.name: number for number in numbers}


def json_value(value: Any) -> Any:
    """Return a value for JSON: numbers as mappings, None in place of infinite values and NaN."""
    if isinstance(value, Number):
        known = Status.KNOWN if math.isfinite(value.value) else Status.NOT_KNOWN
        return json_value(value._asdict() | {"status": value.status or known})
    if isinstance(value, dict):
        return {key: json_value(item) for key, item in value.items()}
    if isinstance(value, list):
        return [json_value(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
