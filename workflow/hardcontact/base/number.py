"""One number with unit, interval, status and source, as pages, files and programs use it.

The status says what is known of a number, the source where it comes from. Both are codes. Files
have the codes: answer.json has both, `hardcontact predict --json` the status. Pages have words.

Statuses. A number has a status of one of the classes in its row, or of NumberStatus:

    in answers (pages: report/templates/number_words.yaml)
    edge                    inference.edges.EdgeStatus: open_above "at least", open_below "at most",
                            ripples "none: the filter's ripples ..."
    edge, force             inference.scan_parts.IntervalSource: few_patches "not bounded: ..."
    without a value         report.quantities.NoValue: no_band "not found", no_hindcast and
                            no_exponent "not answered", no_agreement "none agrees", one_force
    tabor_parameter         contact.hertz_jkr_dmt.Elasticity
    any                     NumberStatus: no_interval "not bounded by these scans"

    in predictions (text: commands/predict.txt)
    force, edges            theory.validity.Validity, inference.edges.EdgeStatus: found, none
    checks, limits, changes theory.prediction.Effect, theory.validity.Validity
    weibull_modulus         theory.closed_form.Regime
    extrapolated_hurst      scans.extrapolation.TailEnd
    tabor_parameter         contact.hertz_jkr_dmt.Elasticity
    force_on_scan           own.scan_contact.Obstacle, inference.scan_parts.IntervalSource
    closed_form_on_scan     own.scan_force.ClosedFormStatus
    search_size             own.scan_force.ScanSize
    contact and modulus     commands.predict.QuantityStatus

Sources, with the words for them on pages (own_part.html):

    computed                "computed": all numbers of no other source
    measured                "measured": a measured force, or an edge that rests on measured
                            roughness; for a substitute "published statistics"
    from_measured           "measured over computed force": computed from measured forces
    extrapolated            "extrapolated": an edge where no scan is reliable, or a number of which
                            over 90 % come from there; a force or a work of adhesion with
                            artificial roughness, which pages call "artificial roughness below ..."
                            or "above"; Hurst exponent and roll-off of the extrapolated spectrum
    partly_extrapolated     "partly extrapolated": 10 to 90 % come from unreliable wavelengths
    interval_extrapolated   "measured; interval partly extrapolated": an edge of which only the
                            interval reaches unreliable wavelengths
    artificial              "artificial roughness": an edge of the paper's study in artificial
                            roughness, or a ratio of such edges
    published               no word: a number of the paper
    given                   no word: a key of the configuration, or a constant of the program
    assumed                 no word: a key with the paper's value, because the user gave none
    file                    no word: a property of the file of a scan
"""

import math
from enum import StrEnum
from typing import Any, Literal, NamedTuple


class NumberStatus(StrEnum):
    """Codes of `Number.status` for any number; the table above names the classes of the others."""

    PLAIN = ""  #: Nothing to add. In JSON KNOWN or NOT_KNOWN replaces it.
    KNOWN = "known"  #: The value is finite.
    NOT_KNOWN = "not_known"
    ONLY_ENDS = "ends"  #: Only ends of the interval are known.
    INTERVAL_OPEN_LOW = "interval_open_low"  #: The low end is not known; it lies below `low`.
    INTERVAL_OPEN_HIGH = "interval_open_high"  #: The high end is not known; it lies above `high`.
    NO_INTERVAL = "no_interval"


#: Codes for the origin of a number: see the table above.
NumberSource = Literal[
    "computed", "measured", "from_measured", "extrapolated", "partly_extrapolated",
    "interval_extrapolated", "artificial", "published", "given", "assumed", "file",
]  # fmt: skip


class Number(NamedTuple):
    """A quantity with the ends of its interval; an unknown value or end is NaN or infinite."""

    name: str
    value: float
    unit: str = "1"  #: A unit of datasets: "nm", "N", "J m-2", "1".
    low: float = math.nan
    high: float = math.nan
    status: StrEnum = NumberStatus.PLAIN  #: What is known, such as why there is no interval.
    source: NumberSource = "computed"  #: Where the number comes from.

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
