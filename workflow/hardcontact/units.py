"""Units: nm, N, J/m² and Pa inside the study; any length, force or pressure unit at its door."""

import pint

__all__ = ["magnitude", "token"]

_registry = pint.UnitRegistry(cache_folder=None)


def magnitude(text, unit):
    """Number of a quantity such as ``"10 uN"`` in `unit`, e.g. ``"N"``.

    Raises ValueError if `text` is no quantity or has another dimension than `unit`.
    """
    try:
        quantity = _registry.Quantity(text) if isinstance(text, str) else None
        if isinstance(quantity, _registry.Quantity):
            # Rounding to twelve digits undoes what the change of unit adds: 25 GPa is 2.5e10 Pa.
            return float(f"{float(quantity.m_as(unit)):.12g}")
    except (pint.PintError, ValueError, TypeError, ArithmeticError, AssertionError):
        pass
    raise ValueError(f"expected a quantity with a unit convertible to {unit}, found {text!r}")


def token(text, unit):
    """The quantity as it stands in a path, in `unit`: ``"10 uN"``, ``"uN"`` -> ``"10uN"``."""
    return f"{magnitude(text, unit):.12g}{unit}"
