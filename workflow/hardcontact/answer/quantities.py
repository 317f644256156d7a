"""Numbers with units as a reader takes them: three digits and the fitting prefix."""

import math

import xarray as xr

from hardcontact.statistics import bounds

__all__ = ["best_unit", "print_bounded", "print_length", "print_quantity"]

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
