"""Format numbers for readers: few digits, the best prefix, intervals such as 67 [47, 74] nm."""

import math
from collections.abc import Callable, Mapping, Sequence

#: By the unit of a dataset: the units that are printed, largest first, each in that unit.
PRINTED_UNITS = {
    "nm": {"mm": 1e6, "µm": 1e3, "nm": 1.0},
    "N": {"N": 1.0, "mN": 1e-3, "µN": 1e-6, "nN": 1e-9, "pN": 1e-12},
    "J m-2": {"J/m²": 1.0, "mJ/m²": 1e-3},
}
#: Printed units of numbers that are compared with the paper: the units that the paper prints.
UNITS_OF_PAPER = {
    "nm": {"µm": 1e3, "nm": 1.0},
    "nm2": {"nm²": 1.0},
    "nm-1": {"nm⁻¹": 1.0},
    "N": {"µN": 1e-6},
    "J/m2": {"mJ/m²": 1e-3},
    "Pa": {"GPa": 1e9, "MPa": 1e6},
    "1": {"": 1.0},
}

#: Largest ratio of the ends of a printed interval; a wider one only says that scans are too few.
MAX_END_RATIO = 100
#: Relative and absolute difference from a limit up to which a number counts as at the limit.
NEAR = 1e-5


def format_number(value: float, digits: int = 3) -> str:
    """Return a number with this many significant digits, without exponent below a million."""
    return f"{float(f'{value:.{digits}g}'):g}"


def round_with(rounding: Callable[[float], int], value: float) -> float:
    """Return a positive number rounded to three digits by `math.floor` or `math.ceil`."""
    step = 10.0 ** (math.floor(math.log10(value)) - 2)
    return float(f"{rounding(value / step) * step:.3g}")


def format_value_and_ends(value: float, low: float, high: float, *limits: float) -> list[str]:
    """Return a number and both ends of its interval, with the same number of decimals.

    The last digit is about a fifth of the interval's width or of the smallest number. If the ends
    have the same sign and a ratio above three, or an end is infinite, each number has two
    digits instead. An end gets more digits if rounding would move it to or across a limit.
    """
    numbers = (value, low, high)
    if not all(map(math.isfinite, numbers)):
        return [format_number(number, 2) for number in numbers]
    smallest, _, largest = sorted(map(abs, numbers))
    has_one_sign = low > 0 or high < 0
    finest = min(high - low, smallest) if has_one_sign else high - low
    last_digits = [max(finest / 5, largest / 1000) or 1] * 3
    if has_one_sign and largest > 3 * smallest:
        last_digits = [abs(number) / 10 or 1 for number in numbers]
    arguments = zip(last_digits, numbers, ((), limits, limits), strict=True)
    return [_format_down_to(*row) for row in arguments]


def _format_down_to(last_digit: float, number: float, limits: Sequence[float] = ()) -> str:
    """Return a number rounded to the decimal place of `last_digit`: 0.03 keeps hundredths.

    More digits are kept until rounding moves the number across no limit, except limits NEAR it.
    """
    exponent = math.floor(math.log10(last_digit))
    text = f"{round(number, -exponent):z.{max(-exponent, 0)}f}"
    is_hidden = any(
        (float(text) - limit) * (number - limit) <= 0
        for limit in limits
        if not math.isclose(number, limit, rel_tol=NEAR, abs_tol=NEAR)
    )
    return _format_down_to(last_digit / 10, number, limits) if is_hidden else text


def _format(
    value: float,
    units: Mapping[str, float],
    interval: tuple[float, float],
    digits: int,
    open_end: str = "",
    limits: Sequence[float] = (),
) -> str:
    """Return a number in the unit that fits best, with its interval if both ends are known.

    `digits` is the number of significant digits if there is no interval, and `open_end` the end,
    "low" or "high", that is only a bound.
    """
    # 999.9 nm is printed as 1 µm, not as 1000 nm: half of the last digit is enough.
    threshold = 1 - 0.5 * 10**-digits
    fitting = (name for name, size in units.items() if abs(value) >= threshold * size)
    name = next(fitting, list(units)[-1])
    if any(map(math.isnan, interval)):
        return f"{format_number(value / units[name], digits)} {name}".rstrip()
    scaled = [number / units[name] for number in (value, *interval, *limits)]
    number, low, high = format_value_and_ends(*scaled)
    bounds = {"": f"{low}, {high}", "high": f"at least {low}", "low": f"at most {high}"}
    return f"{number} [{bounds[open_end]}] {name}".rstrip()


def format_quantity(
    value: float,
    unit: str,
    interval: tuple[float, float] = (math.nan, math.nan),
    digits: int = 3,
    open_end: str = "",
) -> str:
    """Return a number with its unit and its interval: "1.7 µm" or "0.64 [0.5, 0.8] µN".

    Number and interval are in `unit`, a key of PRINTED_UNITS. Ends of the interval are NaN if they
    are unknown, zero and infinity if nothing is excluded. `open_end` is the end, "low" or "high",
    that is only a bound: "0.64 [at least 0.5] µN".
    """
    is_finite = math.isfinite(sum(interval))
    unbounded = is_finite and is_unbounded(value, *interval, unit)
    shown_interval = interval if is_finite and not unbounded else (math.nan, math.nan)
    text = _format(value, PRINTED_UNITS[unit], shown_interval, digits, open_end)
    return f"{text} [not bounded]" if unbounded or interval == (0, math.inf) else text


def format_length(length: float) -> str:
    """Return a length (nm) with its unit, for example "37 nm"."""
    return format_quantity(length, "nm")


def format_as_paper(
    value: float,
    unit: str,
    interval: tuple[float, float] = (math.nan, math.nan),
    digits: int = 3,
    open_end: str = "",
    limits: Sequence[float] = (),
) -> str:
    """Return a quantity in the units of the paper, with its interval: "1.66 [1.38, 2.84] µm".

    Number and interval are in `unit`, a unit of the datasets; a unit that is not in
    `UNITS_OF_PAPER` is printed as it is. An unknown interval is NaN. The text is empty if the value
    is NaN. `open_end` is the end, "low" or "high", that is only a bound: "250 [at least 175] nm".
    Ends have enough digits to show whether they lie above or below each of the `limits`; a number
    without a unit has the limits 0 and 1, too.
    """
    if math.isnan(value):
        return ""
    limits = (*limits, 0, 1) if unit == "1" else limits
    return _format(value, UNITS_OF_PAPER.get(unit, {unit: 1.0}), interval, digits, open_end, limits)


def is_unbounded(value: float, low: float, high: float, unit: str) -> bool:
    """Return whether the ends of an interval differ by more than `MAX_END_RATIO`; False for NaN.

    Value and ends are in `unit`. If the interval contains zero, its farther end is compared with
    the value instead. A number without a unit, such as an exponent or a relative change, may be
    near zero: its farther end is compared with one if the value is below one.
    """
    near, far = sorted((abs(low), abs(high)))
    if low <= 0 <= high:
        near = max(abs(value), 1.0) if unit == "1" else abs(value)
    return far > MAX_END_RATIO * near


def format_share(share: float, form: str = "g") -> str:
    """Return a share in percent: 0.95 is "95 %"."""
    return f"{100 * share:{form}} %"


def format_with_interval(ends: Mapping[str, float], form: str) -> str:
    """Return `value`, `low`, `high` as "0.056 [0.045, 0.068]", or the value if ends are NaN.

    `form` is the format of each number, such as ".2g". No unit is printed.
    """
    number, low, high = (f"{ends[name]:{form}}" for name in ("value", "low", "high"))
    return f"{number} [{low}, {high}]" if math.isfinite(ends["low"] + ends["high"]) else number
