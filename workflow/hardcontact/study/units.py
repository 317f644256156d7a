"""Units: nm, N, J/m² and Pa inside the study; in the configuration any unit of that dimension."""

import math
import re
import reprlib

import pint

__all__ = ["magnitude", "token"]

_registry: pint.UnitRegistry[float] = pint.UnitRegistry(cache_folder=None)

# A number and the name of a unit, and no expression: pint would evaluate 9**9**9 nm.
_QUANTITY = re.compile(r"\s*([+-]?\d+(?:\.\d*)?(?:[eE][+-]?\d{1,3})?)\s*([A-Za-zµμÅ]{1,20})\s*")


def magnitude(text: object, unit: str) -> float:
    """Return the number of a quantity such as ``"10 uN"`` in a unit.

    Parameters
    ----------
    text : object
        The quantity as the configuration has it.
    unit : str
        For example ``"N"``.

    Returns
    -------
    float
        Rounded to twelve digits.

    Raises
    ------
    ValueError
        In one line, if the quantity is no finite number with a unit of this dimension.
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


def token(text: str, unit: str) -> str:
    """Return a quantity as it stands in a path: ``"10 uN"`` in ``"uN"`` is ``"10uN"``."""
    return f"{magnitude(text, unit):.12g}{unit}"
