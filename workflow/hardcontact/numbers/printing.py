"""Numbers with units as a reader takes them: three digits and the fitting prefix.

Quantities in the units that the paper prints, so that its numbers stand beside computed ones.
"""

import math

import xarray as xr

from hardcontact.numbers.statistics import bounds

__all__ = ["best_unit", "print_as_paper", "print_bounded", "print_length", "print_quantity"]

#: Printed units by the unit of a dataset, the largest first, each in that unit.
UNITS = {
    "nm": {"mm": 1e6, "µm": 1e3, "nm": 1.0},
    "N": {"N": 1.0, "mN": 1e-3, "µN": 1e-6, "nN": 1e-9, "pN": 1e-12},
    "J m-2": {"J/m²": 1.0, "mJ/m²": 1e-3},
}

#: Intervals whose ends differ by more than this factor bound nothing.
ENDLESS = 1e6


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
    units = UNITS[unit]
    # 999.9 nm is printed as 1 µm, not as 1000 nm: half of the last of three digits is enough.
    fitting = (name for name, size in units.items() if abs(value) >= 0.9995 * size)
    name = next(fitting, list(units)[-1])
    return name, units[name]


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
        For example "1.7 µm" or "0.64 µN [0.5, 0.8]".
    """
    name, size = best_unit(value, unit)
    interval = ""
    if (low == 0 and math.isinf(high)) or math.inf > high > ENDLESS * low > 0:
        interval = " [not bounded]"
    elif math.isfinite(low + high):
        interval = f" [{_digits(low / size)}, {_digits(high / size)}]"
    return f"{_digits(value / size)} {name}{interval}"


def print_bounded(dataset: xr.Dataset, name: str, unit: str) -> str:
    """Return a variable without dimensions and its interval `<name>_interval` as printed."""
    low, high = (end.item() for end in bounds(dataset, name))
    return print_quantity(dataset[name].item(), unit, low, high)


def print_length(length: float) -> str:
    """Return a length (nm) with its unit, for example "37 nm"."""
    return print_quantity(length, "nm")


def _digits(value: float) -> str:
    """Return three digits without an exponent where numbers are not extreme."""
    return f"{float(f'{value:.3g}'):g}"


#: How each unit of the datasets is printed: by the first of these whose size the number reaches.
PRINTED = {
    "nm": (("µm", 1e3), ("nm", 1.0)),
    "nm2": (("nm²", 1.0),),
    "nm-1": (("nm⁻¹", 1.0),),
    "N": (("µN", 1e-6),),
    "J/m2": (("mJ/m²", 1e-3),),
    "Pa": (("GPa", 1e9), ("MPa", 1e6)),
    "1": (("", 1.0),),
}


def print_as_paper(
    value: float,
    unit: str,
    interval: tuple[float, float] = (math.nan, math.nan),
    digits: int = 3,
    open_end: str = "",
) -> str:
    """Return a quantity with its interval, as "1.66 [1.38, 2.84] µm".

    Parameters
    ----------
    value : float
        In `unit`; NaN, no number, is printed as nothing.
    unit : str
        Of the datasets; one that is not in `PRINTED` is printed as it is.
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
    scales = PRINTED.get(unit, ((unit, 1.0),))
    # 999.6 nm rounds to 1 µm, not to 1000 nm.
    fitting = (scale for scale in scales if abs(value) >= (1 - 0.5 * 10**-digits) * scale[1])
    name, size = next(fitting, scales[-1])
    low, high = (_rounded(end / size, digits) for end in interval)
    low += " or less" * (open_end == "low")
    high += " or more" * (open_end == "high")
    within = "" if any(map(math.isnan, interval)) else f" [{low}, {high}]"
    return f"{_rounded(value / size, digits)}{within} {name}".rstrip()


def _rounded(number: float, digits: int) -> str:
    """Return a number with so many significant digits, and no exponent below a million."""
    return f"{float(f'{number:.{digits}g}'):g}"
