"""Units: nm, N, J/m² and Pa inside the study; in the configuration any unit of that dimension."""

import math
import re
import reprlib
from functools import cache

import pint

#: What has each unit, in words, and how users may write it.
QUANTITIES = {
    "nm": "a length with a unit, such as 5.6 nm or 250 um",
    "N": "a force with a unit, such as 10 uN",
    "Pa": "a pressure with a unit, such as 25 GPa",
    "J/m2": "an energy per area with a unit, such as 46.3 mJ/m2",
}

_registry: pint.UnitRegistry[float] = pint.UnitRegistry(cache_folder=None)

# A number and the name of a unit, and no expression: pint would evaluate 9**9**9 nm.
_QUANTITY = re.compile(
    r"\s*([+-]?\d+(?:\.\d*)?(?:[eE][+-]?\d{1,3})?)\s*([A-Za-zµμÅ]{1,20}(?:/[a-z]{1,2}(?:\^?2|²)?)?)\s*"
)


def magnitude(text: object, unit: str) -> float:
    """Return the number of a quantity such as ``"10 uN"`` in a unit such as ``"N"`` or ``"J/m2"``.

    It is rounded to twelve digits. A ValueError tells in one line that the quantity is no finite
    number with a unit of this dimension.
    """
    value = _magnitude(text, unit) if isinstance(text, str) else math.nan
    if math.isfinite(value):
        return value
    raise ValueError(f"expected {QUANTITIES[unit]}, found {reprlib.repr(text)}")


@cache
def _magnitude(text: str, unit: str) -> float:
    """Return the number of a quantity in a unit, NaN of what is none; pint takes its time."""
    match = _QUANTITY.fullmatch(text)
    if match is None:
        return math.nan
    try:
        quantity = _registry.Quantity(float(match[1]), _powered(match[2]))
        # Rounding to twelve digits undoes what the change of unit adds: 25 GPa is 2.5e10 Pa.
        return float(f"{quantity.m_as(_powered(unit)):.12g}")
    except (pint.PintError, ValueError, AttributeError):
        return math.nan  # not a unit, or not of this dimension


def printed(text: str) -> str:
    """Return a quantity as it is printed: ``"250um"`` is ``"250 µm"``."""
    match = _QUANTITY.fullmatch(text)
    if match is None:
        raise ValueError(f"expected a number with a unit, found {reprlib.repr(text)}")
    unit = re.sub(r"(?<=[a-z])\^?2$", "²", re.sub("^u(?=[mNJ])", "µ", match[2]))
    return f"{match[1]} {unit}"


def _powered(unit: str) -> str:
    """Return a unit as pint reads it, ``mJ/m**2`` for ``mJ/m2``, ``mJ/m^2`` and ``mJ/m²``."""
    return re.sub(r"(?<=[a-z])(\^?2|²)$", "**2", unit)


def token(text: str, unit: str) -> str:
    """Return a quantity as it stands in a path: ``"10 uN"`` in ``"uN"`` is ``"10uN"``."""
    return f"{magnitude(text, unit):.12g}{unit}"
