"""Format numbers for readers: few digits, the best prefix, intervals such as 67 [47, 74] nm."""

import math
from collections.abc import Callable, Mapping, Sequence

#: For each unit of datasets: the units that are printed, largest first, with their sizes.
PRINTED_UNITS = {
    "nm": {"mm": 1e6, "µm": 1e3, "nm": 1.0},
    "N": {"N": 1.0, "mN": 1e-3, "µN": 1e-6, "nN": 1e-9, "pN": 1e-12},
    "J m-2": {"J/m²": 1.0, "mJ/m²": 1e-3},
}
#: For each unit of `claims.csv`: the units that the paper prints, largest first.
UNITS_OF_PAPER = {
    "nm": {"µm": 1e3, "nm": 1.0},
    "nm2": {"nm²": 1.0},
    "nm-1": {"nm⁻¹": 1.0},
    "N": {"µN": 1e-6},
    "J/m2": {"mJ/m²": 1e-3},
    "Pa": {"GPa": 1e9, "MPa": 1e6},
    "1": {"": 1.0},
}
#: Largest ratio of the ends of a printed interval: a wider one only says that scans are too few.
MAX_END_RATIO = 100
#: Relative and absolute difference up to which a number lies on a limit.
LIMIT_TOLERANCE = 1e-5


def _format_digits(value: float, digits: int) -> str:
    """Return a number with significant digits; with an exponent below 0.0001 and from 1e6 on."""
    return f"{float(f'{value:.{digits}g}'):g}"


def round_to_three_digits(value: float, rounding: Callable[[float], int]) -> float:
    """Return a positive number rounded by `math.floor` or `math.ceil`."""
    step = 10.0 ** (math.floor(math.log10(value)) - 2)
    return float(f"{rounding(value / step) * step:.3g}")


def format_value_and_ends(value: float, low: float, high: float, *limits: float) -> list[str]:
    """Return a number and both ends of its interval, rounded as the interval permits.

    Numbers of one sign that differ by more than three times have two digits each, others as many
    (up to four) as show a fifth of the width. Ends stay on their side of the `limits`.
    """
    numbers = (value, low, high)
    if not all(map(math.isfinite, numbers)):
        return [_format_digits(number, 2) for number in numbers]
    smallest, _, largest = sorted(map(abs, numbers))
    has_one_sign = low > 0 or high < 0
    if has_one_sign and largest > 3 * smallest:
        last_digits = [abs(number) / 10 or 1 for number in numbers]
    else:
        finest = min(high - low, smallest) if has_one_sign else high - low
        last_digits = [max(finest / 5, largest / 1000) or 1] * 3
    arguments = zip(numbers, last_digits, ((), limits, limits), strict=True)
    return [_format_to_place(*row) for row in arguments]


def _format_to_place(number: float, last_digit: float, limits: Sequence[float]) -> str:
    """Return a number with the decimal places of `last_digit`, or more to stay off the limits."""
    exponent = math.floor(math.log10(last_digit))
    text = f"{round(number, -exponent):z.{max(-exponent, 0)}f}"
    crosses_limit = any(
        (float(text) - limit) * (number - limit) <= 0
        for limit in limits
        if not math.isclose(number, limit, rel_tol=LIMIT_TOLERANCE, abs_tol=LIMIT_TOLERANCE)
    )
    return _format_to_place(number, last_digit / 10, limits) if crosses_limit else text


def _format_in_best_unit(
    value: float,
    units: Mapping[str, float],
    interval: tuple[float, float],
    digits: int,
    open_end: str = "",
    limits: Sequence[float] = (),
) -> str:
    """Return a number in the unit that fits best, with its interval if both ends are known."""
    # 999.9 nm is printed as 1 µm, not as 1000 nm: half of the last digit is enough.
    threshold = 1 - 0.5 * 10**-digits
    fitting_names = (name for name, size in units.items() if abs(value) >= threshold * size)
    name = next(fitting_names, list(units)[-1])
    if any(map(math.isnan, interval)):
        return f"{_format_digits(value / units[name], digits)} {name}".rstrip()
    scaled = [number / units[name] for number in (value, *interval, *limits)]
    number, low, high = format_value_and_ends(*scaled)
    if open_end:
        bound = f"at least {low}" if open_end == "high" else f"at most {high}"
        return f"{number} {name} ({bound} {name})"
    return f"{number} [{low}, {high}] {name}".rstrip()


def format_quantity(
    value: float,
    unit: str,
    interval: tuple[float, float] = (math.nan, math.nan),
    digits: int = 3,
    open_end: str = "",
) -> str:
    """Return a number with its unit and its interval: "1.7 µm" or "640 [500, 800] nN".

    Number and interval are in `unit`, a key of PRINTED_UNITS. Unknown ends are NaN; `digits` count
    without an interval. With the `open_end` "high": "640 nN (at least 500 nN)".
    """
    is_finite = math.isfinite(sum(interval))
    unbounded = is_finite and is_unbounded(value, *interval, unit)
    shown_interval = interval if is_finite and not unbounded else (math.nan, math.nan)
    text = _format_in_best_unit(value, PRINTED_UNITS[unit], shown_interval, digits, open_end)
    return f"{text} [not bounded]" if unbounded or interval == (0, math.inf) else text


def format_length(length: float) -> str:
    """Return a length (nm) with its unit."""
    return format_quantity(length, "nm")


def format_as_paper(
    value: float,
    unit: str,
    interval: tuple[float, float] = (math.nan, math.nan),
    digits: int = 3,
    open_end: str = "",
    limits: Sequence[float] = (),
) -> str:
    """Return a quantity in the units of the paper, with its interval: "1.7 [1.4, 2.8] µm".

    As `format_quantity`, but with any `unit`, and without text for NaN. Ends stay on their side of
    the `limits`.
    """
    if math.isnan(value):
        return ""
    limits = (*limits, 0, 1) if unit == "1" else limits
    units = UNITS_OF_PAPER.get(unit, {unit: 1.0})
    return _format_in_best_unit(value, units, interval, digits, open_end, limits)


def is_unbounded(value: float, low: float, high: float, unit: str) -> bool:
    """Return whether the ends differ by more than a factor of `MAX_END_RATIO`; False for NaN.

    If zero lies between them, the farther end is compared with the value.
    """
    near, far = sorted((abs(low), abs(high)))
    if low <= 0 <= high:
        # A number without a unit, such as an exponent, may be close to zero.
        near = max(abs(value), 1.0) if unit == "1" else abs(value)
    return far > MAX_END_RATIO * near


def format_share(share: float, format_spec: str = "g") -> str:
    """Return a share in percent: 0.95 is "95 %"."""
    return f"{100 * share:{format_spec}} %"


def format_estimate(estimate: Mapping[str, float], format_spec: str) -> str:
    """Return "0.056 [0.045, 0.068]", or "0.056" if an end of the interval is not finite."""
    value, low, high = (f"{estimate[name]:{format_spec}}" for name in ("value", "low", "high"))
    is_bounded = math.isfinite(estimate["low"] + estimate["high"])
    return f"{value} [{low}, {high}]" if is_bounded else value
