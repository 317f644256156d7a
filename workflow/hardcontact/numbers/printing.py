"""Numbers as a reader takes them: few digits, the fitting prefix, intervals as 67 [47, 74] nm."""

import math
from collections.abc import Mapping, Sequence

import xarray as xr

from hardcontact.numbers.statistics import bounds

#: Printed units by the unit of a dataset, the largest first, each in that unit.
UNITS = {
    "nm": {"mm": 1e6, "µm": 1e3, "nm": 1.0},
    "N": {"N": 1.0, "mN": 1e-3, "µN": 1e-6, "nN": 1e-9, "pN": 1e-12},
    "J m-2": {"J/m²": 1.0, "mJ/m²": 1e-3},
}
#: The same for the units that the paper prints, so that its numbers stand beside computed ones.
UNITS_OF_PAPER = {
    "nm": {"µm": 1e3, "nm": 1.0},
    "nm2": {"nm²": 1.0},
    "nm-1": {"nm⁻¹": 1.0},
    "N": {"µN": 1e-6},
    "J/m2": {"mJ/m²": 1e-3},
    "Pa": {"GPa": 1e9, "MPa": 1e6},
    "1": {"": 1.0},
}

#: Of computed numbers in sentences: their intervals are wider than what more digits would say.
DIGITS = 2
#: Intervals whose ends differ by more than this factor bound nothing.
ENDLESS = 1e6
#: An interval that reaches so many times beyond its value says only that there are too few scans.
BOUNDLESS = 100
NOT_BOUNDED = "[not bounded]"


def print_number(value: float, digits: int = 3) -> str:
    """Return a number with so many significant digits, and no exponent below a million."""
    return f"{float(f'{value:.{digits}g}'):g}"


def _bracketed(number: str, low: str, high: str, unit: str = "") -> str:
    """Return a number, its interval and its unit: the one style of all of them."""
    return f"{number} [{low}, {high}] {unit}".rstrip()


def _print(
    value: float,
    units: Mapping[str, float],
    interval: tuple[float, float],
    digits: int,
    open_end: str = "",
) -> str:
    """Return a number in the fitting one of its units, with its interval if both ends are known."""
    name, size = _fitting(value, units, digits)
    number, low, high = (print_number(one / size, digits) for one in (value, *interval))
    if any(map(math.isnan, interval)):
        return f"{number} {name}".rstrip()
    low += " or less" * (open_end == "low")
    high += " or more" * (open_end == "high")
    return _bracketed(number, low, high, name)


def _fitting(value: float, units: Mapping[str, float], digits: int) -> tuple[str, float]:
    """Return name and size of the unit in which a value, once rounded, is at least one."""
    # 999.9 nm is printed as 1 µm, not as 1000 nm: half of the last digit is enough.
    least = 1 - 0.5 * 10**-digits
    fitting = (name for name, size in units.items() if abs(value) >= least * size)
    name = next(fitting, list(units)[-1])
    return name, units[name]


def best_unit(value: float, unit: str) -> tuple[str, float]:
    """Return name and size of the unit in which a value is at least one, else the smallest.

    Parameters
    ----------
    value : float
        In `unit`.
    unit : str
        A key of UNITS: "nm", "N" or "J m-2".

    Returns
    -------
    name : str
        As it is printed.
    size : float
        In `unit`.
    """
    return _fitting(value, UNITS[unit], 3)


def print_quantity(value: float, unit: str, low: float = math.nan, high: float = math.nan) -> str:
    """Return a number with its unit and its interval, unless its ends are not known.

    Parameters
    ----------
    value, low, high : float
        The number and the ends of its interval, in `unit`: NaN of one that is not known, zero and
        infinity of one that bounds nothing.
    unit : str
        A key of UNITS: "nm", "N" or "J m-2".

    Returns
    -------
    str
        For example "1.7 µm" or "0.64 [0.5, 0.8] µN".
    """
    endless = (low == 0 and math.isinf(high)) or math.inf > high > ENDLESS * low > 0
    known = math.isfinite(low + high) and not endless
    text = _print(value, UNITS[unit], (low, high) if known else (math.nan, math.nan), 3)
    return f"{text} {NOT_BOUNDED}" if endless else text


def print_bounded(dataset: xr.Dataset, name: str, unit: str) -> str:
    """Return a variable without dimensions and its interval `<name>_interval` as printed."""
    low, high = (end.item() for end in bounds(dataset, name))
    return print_quantity(dataset[name].item(), unit, low, high)


def print_length(length: float) -> str:
    """Return a length (nm) with its unit, for example "37 nm"."""
    return print_quantity(length, "nm")


def print_edge(wavelength: float, low: float, high: float) -> str:
    """Return a wavelength and its interval (nm), with as few digits as tell its numbers apart.

    Parameters
    ----------
    wavelength, low, high : float
        In nm; NaN of an end that is open.

    Returns
    -------
    str
        For example "32 [10, 1000] nm", "320 nm [above 10 nm]" or "32 nm [not bounded]".
    """
    digits, units = _digits_apart([wavelength, low, high]), UNITS_OF_PAPER["nm"]
    text = _print(wavelength, units, (low, high), digits)
    if math.isfinite(low) and math.isfinite(high):
        return text
    if math.isnan(low) and math.isnan(high):
        return f"{text} {NOT_BOUNDED}"
    name, size = _fitting(wavelength, units, digits)
    where, end = ("above", low) if math.isfinite(low) else ("below", high)
    return f"{text} [{where} {print_number(end / size, digits)} {name}]"


def _digits_apart(values: Sequence[float]) -> int:
    """Return the fewest significant digits, from two to six, that tell the known numbers apart."""
    known = {value for value in values if math.isfinite(value)}
    enough = (n for n in range(2, 6) if len({print_number(one, n) for one in known}) == len(known))
    return next(enough, 6)


def print_as_paper(
    value: float,
    unit: str,
    interval: tuple[float, float] = (math.nan, math.nan),
    digits: int = 3,
    open_end: str = "",
) -> str:
    """Return a quantity in the units of the paper, with its interval: "1.66 [1.38, 2.84] µm".

    Parameters
    ----------
    value : float
        In `unit`; NaN, no number, is printed as nothing.
    unit : str
        Of the datasets; one that is not in `UNITS_OF_PAPER` is printed as it is.
    interval : tuple of float
        Low and high, in `unit`; NaN if there is none.
    digits : int
        Significant digits of each number.
    open_end : str
        End of the interval that is a bound on it: "low", "high" or none.

    Returns
    -------
    str
        Plain text; an open interval as "250 [175, 250 or more] nm".
    """
    if math.isnan(value):
        return ""
    return _print(value, UNITS_OF_PAPER.get(unit, {unit: 1.0}), interval, digits, open_end)


def print_within(
    value: float, low: float, high: float, unit: str = "1", digits: int = DIGITS
) -> str:
    """Return a number as `print_as_paper` does, in words where few scans hardly bound it.

    Parameters
    ----------
    value, low, high : float
        The number and the ends of its interval, in `unit`; NaN of what is not known.
    unit : str
        As `print_as_paper` takes it.
    digits : int
        Significant digits.

    Returns
    -------
    str
        For example "5.9 [2.2, 35]" or "5.9 (not bounded by so few scans)".
    """
    if _is_boundless(value, low, high, unit):
        return f"{print_as_paper(value, unit, digits=digits)} (not bounded by so few scans)"
    return print_as_paper(value, unit, (low, high), digits)


def _is_boundless(value: float, low: float, high: float, unit: str) -> bool:
    """Return whether an interval reaches `BOUNDLESS` times beyond its value.

    Exponents and relative changes have no unit and may have either sign: where their interval holds
    zero, they are compared with one, for their own size says nothing if they are near zero.
    """
    scale = abs(value)
    if unit == "1" and low <= 0 <= high:
        scale = max(scale, 1.0)
    return max(abs(low), abs(high)) > BOUNDLESS * scale or 0 < low * BOUNDLESS < value


def print_bounded_as_paper(dataset: xr.Dataset, name: str, unit: str, digits: int = DIGITS) -> str:
    """Return a variable without dimensions, its interval `<name>_interval` and its unit.

    Parameters
    ----------
    dataset : xarray.Dataset
        Selected down to one number.
    name : str
        Of the variable.
    unit : str
        As `print_as_paper` takes it.
    digits : int
        Significant digits.

    Returns
    -------
    str
        For example "1.7 [1.4, 2.8] µm"; "no number" of NaN.
    """
    low, high = (end.item() for end in bounds(dataset, name))
    return print_within(dataset[name].item(), low, high, unit, digits) or "no number"


def print_percent(share: float, low: float = math.nan, high: float = math.nan) -> str:
    """Return a share of 1, with its interval if it has one, as "16 [12, 67] %"."""
    boundless = _is_boundless(share, low, high, "1")
    interval = (math.nan, math.nan) if boundless else (100 * low, 100 * high)
    text = _print(100 * share, {"%": 1.0}, interval, DIGITS)
    return f"{text} (not bounded by so few scans)" if boundless else text


def print_share(share: float) -> str:
    """Return a share of 1 in percent, as a confidence of 0.95 is printed: "95 %"."""
    return f"{100 * share:g} %"


def print_formatted(ends: Mapping[str, float], form: str) -> str:
    """Return `value`, `low`, `high` as "0.056 [0.045, 0.068]", or the value if it has no others.

    Parameters
    ----------
    ends : mapping of str to float
        The three numbers; NaN of what is not known.
    form : str
        How each is formatted, such as ".2g".

    Returns
    -------
    str
        Without a unit.
    """
    number, low, high = (f"{ends[name]:{form}}" for name in ("value", "low", "high"))
    return _bracketed(number, low, high) if math.isfinite(ends["low"] + ends["high"]) else number
