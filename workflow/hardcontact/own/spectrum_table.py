"""The spectrum C_iso of the user's surface from a table, converted from its units and from C_1D."""

import math
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from hardcontact.base.units import parse_quantity
from hardcontact.config.faults import quote_key
from hardcontact.config.tables import Row, UserTable, parse_number, user_table
from hardcontact.scans.measured_spectrum import ENOUGH_MODES, isotropic_from_profile
from hardcontact.scans.plain_text import ROW
from hardcontact.surfaces.spectrum import Spectrum

#: A table has one of these columns, and a column with its unit.
WAVE_COLUMNS = ("wavevector", "wavelength")
#: A table has one of these columns too, and a column with its unit.
DENSITY_COLUMNS = ("c_iso", "c_1d")
EXPECTED_COLUMNS = (
    "a table with one of the columns wavevector and wavelength, one of c_iso and c_1d, and the "
    "unit of each (wavelength_unit, ...)"
)
#: The unit of a column: a pattern around the unit of length, and words.
COLUMN_UNITS = {
    "wavevector": (
        r"rad\s*/\s*(\S+)",
        "radians over a length, such as rad/nm (q = 2 pi/wavelength)",
    ),
    "wavelength": ("(.*)", "a length, such as nm"),
    "c_iso": (r"(\D+?)(?:\^|\*\*)?[4⁴]", "a length to the power of 4, such as nm4"),
    "c_1d": (r"(\D+?)(?:\^|\*\*)?[3³]", "a length to the power of 3, such as nm3"),
}
#: Bytes of the first line that are read to tell a table from heights: more than any header has.
MAX_HEADER_BYTES = 1000
#: The first heading of a table of positions and heights.
POSITION_HEADING = re.compile(r"\W*(x|position|distance|lateral)\b", re.IGNORECASE)
#: Fewest wavelengths with roughness in a table. In a trial with roll-offs, five points over four
#: decades gave the rms height with an error of up to 41 %, four points up to 57 %.
MIN_WAVELENGTHS = 5


def is_spectrum_table(path: str | Path) -> bool:
    """Return whether a file is a table of a spectrum: a CSV whose header names no positions."""
    if Path(path).suffix.lower() != ".csv":
        return False
    if not Path(path).is_file():
        return True  # The reader of tables refuses a missing file.
    with open(path, "rb") as file:
        first_line = file.readline(MAX_HEADER_BYTES).decode("latin-1")
    return not (ROW.fullmatch(first_line.strip()) or POSITION_HEADING.match(first_line))


def read_spectrum_table(path: str | Path) -> Spectrum:
    """Read C_iso (nm⁴) from a CSV: the columns `wavevector` or `wavelength`, and `c_iso` or `c_1d`.

    The unit of each is in a column whose name ends with `_unit`. C_1D is converted by the inverse
    Abel transform. A density of 0 means no roughness. Raises ValueError with a line for each
    faulty row.
    """
    table = user_table(path, "a table of a power spectral density")
    wave = _find_column(table, WAVE_COLUMNS)
    density = _find_column(table, DENSITY_COLUMNS)
    points = table.convert(lambda row: _wavevector_and_density(row, wave, density))
    lines = dict[str, int]()
    for line, (wavevector, _) in points.items():
        first_line = lines.setdefault(f"{wavevector:.9g}", line)
        if first_line != line:
            message = f"line {line}: expected each wavelength once, found that of line {first_line}"
            raise ValueError(f"{path}: {message}")
    rough = sum(value > 0 for _, value in points.values())
    if rough < MIN_WAVELENGTHS:
        raise ValueError(f"{path}: expected at least {MIN_WAVELENGTHS} wavelengths, found {rough}")
    wavevectors, densities = np.array(sorted(points.values())).T
    if density == "c_1d":
        # A table does not state the modes of a bin: enough for the usual width of smoothing.
        modes = np.full(densities.shape, ENOUGH_MODES)
        densities = isotropic_from_profile(wavevectors, densities, modes)
    return Spectrum(wavevectors, densities)


def _find_column(table: UserTable, names: Sequence[str]) -> str:
    """Return the name of the column that a table has, out of two; its unit must be there, too."""
    present = [name for name in names if name in table.header]
    if len(present) != 1:
        raise ValueError(
            f"{table.path}: expected {EXPECTED_COLUMNS}, or a scan that begins with numbers or a "
            f"column x, found {quote_key(', '.join(table.header))}"
        )
    table.require([present[0], f"{present[0]}_unit"], EXPECTED_COLUMNS)
    return present[0]


def _wavevector_and_density(row: Row, wave: str, density: str) -> tuple[float, float]:
    """Return wavevector (1/nm) and density (C_iso in nm⁴, C_1D in nm³) of a row."""
    number = parse_number(row[wave])
    value = parse_number(row[density])
    power = 4 if density == "c_iso" else 3
    if not 0 < number < math.inf:
        raise ValueError(f"{wave}: expected a positive number, found {quote_key(row[wave])}")
    if not (0 < value < math.inf or (power == 4 and value == 0)):
        accepted = "a number of at least 0" if power == 4 else "a positive number"
        raise ValueError(f"{density}: expected {accepted}, found {quote_key(row[density])}")
    unit_length = _length_in_nm(row, wave)
    is_wavelength = wave == "wavelength"
    wavevector = 2 * math.pi / (number * unit_length) if is_wavelength else number / unit_length
    return wavevector, value * _length_in_nm(row, density) ** power


def _length_in_nm(row: Row, name: str) -> float:
    """Return the length in the unit of a column, in nm; refuse a unit of another quantity."""
    pattern, words = COLUMN_UNITS[name]
    unit = row[f"{name}_unit"]
    match = re.fullmatch(pattern, unit)
    try:
        return parse_quantity(f"1 {match[1]}" if match else None, "nm")
    except ValueError:
        raise ValueError(f"{name}_unit: expected {words}, found {quote_key(unit)}") from None
