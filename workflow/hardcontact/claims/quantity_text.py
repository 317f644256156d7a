"""Quantities in the units that the paper prints, so that its numbers stand beside computed ones."""

import math

__all__ = ["print_as_paper"]

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
