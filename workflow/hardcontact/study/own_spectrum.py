"""The user's own power spectral density: a table with its units, turned into C_iso.

Every fault is one line: the file and its line, what was expected, what was found.
"""

import math
import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from hardcontact.study.schema import plain
from hardcontact.study.units import magnitude
from hardcontact.study.user_table import Row, UserTable, found, user_table
from hardcontact.surfaces.profile_conversion import isotropic_from_profile
from hardcontact.surfaces.spectrum import Spectrum

__all__ = ["COLUMNS", "own_spectrum"]

#: Columns of which a table has one of each pair, each with a column of its unit.
WAVES, DENSITIES = ("wavevector", "wavelength"), ("c_iso", "c_1d")
COLUMNS = "wavevector or wavelength, c_iso or c_1d, and the unit of each (wavevector_unit, ...)"
#: Powers of a length that a density has.
POWER = {"c_iso": 4, "c_1d": 3}
FEWEST = 5
#: Independent waves that each bin of a profile's density is taken to have when it is converted.
WAVES_OF_A_BIN = 20.0


def own_spectrum(path: str | Path) -> Spectrum:
    """Read the user's own power spectral density.

    Parameters
    ----------
    path : str or Path
        CSV with a header: `wavevector` (q = 2 pi/lambda) or `wavelength`; `c_iso` (h_rms² =
        1/(2 pi) ∫ q C_iso dq) or `c_1d` (h_rms² = (1/pi) ∫ C_1D dq); a column of the unit of each,
        named for it with `_unit`, such as rad/nm, nm, nm4, nm3. A c_iso of 0 says no roughness.

    Returns
    -------
    Spectrum
        C_iso in nm⁴ at its own wavevectors; of profiles by the inverse Abel transform.

    Raises
    ------
    ValueError
        One line a problem, all of them.
    """
    table = user_table(path, "a table of a power spectral density")
    wave, density = _quantities(table)
    problems = table.problems(lambda row: _faults(row, wave, density))
    points = {
        line: (_wavevector(row, wave), _density(row, density))
        for line, row in table.rows().items()
        if not _faults(row, wave, density)
    }
    problems += _repeated(path, points)
    rough = sum(value > 0 for _, value in points.values())
    if not problems and rough < FEWEST:
        problems.append(f"{path}: expected at least {FEWEST} wavelengths, found {rough}")
    if problems:
        raise ValueError("\n".join(problems))
    wavevector, values = np.array(sorted(points.values())).T
    if density == "c_1d":
        waves = np.full(values.shape, WAVES_OF_A_BIN)
        values = isotropic_from_profile(wavevector, values, waves)
    return Spectrum(wavevector, values)


def _quantities(table: UserTable) -> tuple[str, str]:
    """Return the names of the columns of waves and of densities."""
    path, header = table.path, table.header
    if not header:
        raise ValueError(f"{path}: expected the columns {COLUMNS}; found no column")
    faults, present = [], []
    for pair in (WAVES, DENSITIES):
        named = [name for name in pair if name in header]
        present += named[:1]
        if len(named) != 1:
            faults.append(
                f"{path}: expected one of the columns {' and '.join(pair)}, found "
                f"{'both' if named else plain(', '.join(header))}"
            )
    faults += [
        f"{path}: expected a column {name}_unit beside {name}, found none"
        for name in present
        if f"{name}_unit" not in header
    ]
    faults += [
        f"{path}: expected each column once, found {plain(name)} {header.count(name)} times"
        for name in dict.fromkeys(header)
        if header.count(name) > 1
    ]
    if faults:
        raise ValueError("\n".join(faults))
    wave, density = present
    return wave, density


def _faults(row: Row, wave: str, density: str) -> list[str]:
    """Return what is wrong with the cells of a row."""
    faults = []
    if not _number(row[wave]) > 0:
        faults.append(f"{wave}: expected a positive number, found {found(row[wave])}")
    if not (_number(row[density]) > 0 or (density == "c_iso" and _number(row[density]) == 0)):
        least = "a number of at least 0" if density == "c_iso" else "a positive number"
        faults.append(f"{density}: expected {least}, found {found(row[density])}")
    expected = "a length, such as nm"
    if wave == "wavevector":
        expected = "radians over a length, such as rad/nm (q = 2 pi/wavelength)"
    if math.isnan(_wavevector({**row, wave: "1"}, wave)):
        unit = row[f"{wave}_unit"]
        faults.append(f"{wave}_unit: expected {expected}, found {found(unit)}")
    if math.isnan(_density({**row, density: "1"}, density)):
        unit, power = row[f"{density}_unit"], POWER[density]
        faults.append(
            f"{density}_unit: expected a length to the power of {power}, such as nm{power}, "
            f"found {found(unit)}"
        )
    return faults


def _repeated(path: str | Path, points: Mapping[int, tuple[float, float]]) -> list[str]:
    """Return the lines of wavelengths that were there before."""
    first: dict[str, int] = {}
    faults = []
    for line, (wavevector, _) in points.items():
        before = first.setdefault(f"{wavevector:.9g}", line)
        if before != line:
            faults.append(
                f"{path}: line {line}: expected each wavelength once, found that of line {before}"
            )
    return faults


def _number(text: str) -> float:
    """Return a finite number; NaN if the text is none."""
    try:
        value = float(text)
    except ValueError:
        return math.nan
    return value if math.isfinite(value) else math.nan


def _wavevector(row: Row, name: str) -> float:
    """Return q in rad/nm; NaN if the unit is none of the quantity."""
    number, unit = _number(row[name]), row[f"{name}_unit"]
    if name == "wavelength":
        return 2 * math.pi / (number * _nanometres(unit))
    match = re.fullmatch(r"rad\s*/\s*(\S+)", unit)
    return number / _nanometres(match[1]) if match else math.nan


def _density(row: Row, name: str) -> float:
    """Return a density in powers of nm; NaN if the unit has another power."""
    digit = {3: "3³", 4: "4⁴"}[POWER[name]]
    match = re.fullmatch(rf"(\D+?)(?:\^|\*\*)?[{digit}]", row[f"{name}_unit"])
    length = _nanometres(match[1]) if match else math.nan
    return _number(row[name]) * length ** POWER[name]


def _nanometres(unit: str) -> float:
    """Return a unit of length in nm; NaN if it is none."""
    try:
        return magnitude(f"1 {unit}", "nm")
    except ValueError:
        return math.nan
