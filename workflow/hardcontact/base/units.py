"""Units: nm, N, J/m² and Pa inside the study; in files of the user any of `FACTORS`."""

import math
import re
import reprlib

#: The quantity that a message asks for, by unit of the study. Examples have no blanks, because a
#: command line would split them there.
EXPECTED_QUANTITY = {
    "nm": "a length with a unit, such as 5.6nm or 250um",
    "N": "a force with a unit, such as 10uN",
    "Pa": "a pressure with a unit, such as 25GPa",
    "J/m2": "an energy per area with a unit, such as 46.3mJ/m2",
}
#: Powers of ten of the prefixes; both signs of micro are in use.
PREFIXES = {
    "f": -15, "p": -12, "n": -9, "u": -6, "µ": -6, "μ": -6, "m": -3, "c": -2, "": 0, "k": 3, "M": 6,
    "G": 9, "T": 12,
}  # fmt: skip
#: By unit of the study: the factor of each accepted unit of the same dimension.
FACTORS: dict[str, dict[str, float]] = {
    "nm": {"Å": 0.1},
    "N": {"dyn": 1e-5},
    "Pa": {"bar": 1e5, "N/mm2": 1e6},
    "J/m2": {"erg/cm2": 1e-3, "dyn/cm": 1e-3},
}
for _prefix, _power in PREFIXES.items():
    FACTORS["nm"][f"{_prefix}m"] = 10.0 ** (_power + 9)
    FACTORS["N"][f"{_prefix}N"] = 10.0**_power
    FACTORS["N"][f"{_prefix}gf"] = 9.80665e-3 * 10.0**_power
    FACTORS["Pa"][f"{_prefix}Pa"] = 10.0**_power
    FACTORS["J/m2"][f"{_prefix}J/m2"] = FACTORS["J/m2"][f"{_prefix}N/m"] = 10.0**_power
#: Units of formulas, in SI units.
NANOMETRE = NANONEWTON = 1e-9
GIGAPASCAL = 1e9
#: Attributes of variables of datasets, by their unit.
NM = {"units": "nm"}
NM4 = {"units": "nm4"}
RAD_PER_NM = {"units": "rad nm-1"}
NEWTON = {"units": "N"}
PASCAL = {"units": "Pa"}
JOULE_PER_M2 = {"units": "J m-2"}
DIMENSIONLESS = {"units": "1"}
_QUANTITY = re.compile(
    r"\s*([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3})?)\s*([A-Za-zµμÅ/]+)(\^?2|²)?\s*"
)


def parse_quantity(text: object, unit: str) -> float:
    """Return the number of a quantity such as ``"10 uN"`` in a unit of the study such as ``"N"``.

    Raises ValueError, with one line, if the quantity is no finite number with such a unit.
    """
    match = _QUANTITY.fullmatch(text) if isinstance(text, str) else None
    unit_symbol = f"{match[2]}{'2' if match[3] else ''}" if match else ""
    if match and unit_symbol in FACTORS[unit]:
        # Rounding to twelve digits undoes what the change of unit adds: 25 GPa is 2.5e10 Pa.
        value = float(f"{float(match[1]) * FACTORS[unit][unit_symbol]:.12g}")
        if math.isfinite(value):
            return value
    meant = " or ".join(name for name in FACTORS[unit] if name.lower() == unit_symbol.lower())
    question = f" (did you mean {meant}?)" if meant and meant != unit_symbol else ""
    raise ValueError(f"expected {EXPECTED_QUANTITY[unit]}, found {reprlib.repr(text)}{question}")


def format_exact(value: float, unit: str) -> str:
    """Return a quantity of the study with all its digits: ``(1e-5, "N")`` is ``"10 µN"``."""
    name = "m" if unit == "nm" else unit
    for prefix in ("G", "M", "k", "", "m", "µ", "n", "p", "f"):
        number = float(f"{value / FACTORS[unit][prefix + name]:.12g}")
        if abs(number) >= 1:
            break
    return f"{number:.12g} {prefix}{name.replace('2', '²')}"


def path_token(value: float, prefixed_unit: str) -> str:
    """Return a quantity of the study for a path: ``(1e-5, "uN")`` is ``"10uN"``."""
    (factor,) = (units[prefixed_unit] for units in FACTORS.values() if prefixed_unit in units)
    return f"{value / factor:.12g}{prefixed_unit}"
