"""Units: nm, N, J/m² and Pa inside the study; any length, force or pressure unit at its door."""

import math
import re
import reprlib

import pint

__all__ = ["magnitude", "token"]

_registry = pint.UnitRegistry(cache_folder=None)

# A number and the name of a unit, nothing to be worked out: pint would evaluate 9**9**9 nm.
_QUANTITY = re.compile(r"\s*([+-]?\d+(?:\.\d*)?(?:[eE][+-]?\d{1,3})?)\s*([A-Za-zµμÅ]{1,20})\s*")


def magnitude(text, unit):
    """Number of a quantity such as ``"10 uN"`` in `unit`, e.g. ``"N"``.

    Raises ValueError if `text` is no finite number with a unit of the dimension of `unit`.
    """
    match = _QUANTITY.fullmatch(text) if isinstance(text, str) else None
    try:
        value = float(_registry.Quantity(float(match[1]), match[2]).m_as(unit)) if match else None
        if value is not None and math.isfinite(value):
            # Rounding to twelve digits undoes what the change of unit adds: 25 GPa is 2.5e10 Pa.
            return float(f"{value:.12g}")
    except (pint.PintError, ValueError, AttributeError):
        pass  # not a unit, or not of this dimension: refused below
    raise ValueError(
        f"expected a number with a unit convertible to {unit}, such as '1 {unit}', "
        f"found {reprlib.repr(text)}"
    )


def token(text, unit):
    """The quantity as it stands in a path, in `unit`: ``"10 uN"``, ``"uN"`` -> ``"10uN"``."""
    return f"{magnitude(text, unit):.12g}{unit}"
