"""The table of a power spectral density that a user wrote, read as C_iso in nm⁴."""

import math
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from hardcontact.base.units import parse_quantity
from hardcontact.config.faults import quote_key
from hardcontact.config.user_files import Row, UserTable, parse_number, user_table
from hardcontact.scans.measured_spectrum import ENOUGH_MODES, isotropic_from_profile
from hardcontact.scans.plain_text import NUMBERS
from hardcontact.surfaces.spectrum import Spectrum

#: A table has one of these columns, and a column with its unit.
WAVE_COLUMNS = ("wavevector", "wavelength")
#: A table has one of these columns too, and a column with its unit.
DENSITY_COLUMNS = ("c_iso", "c_1d")
EXPECTED_COLUMNS = (
    "a table with one of the columns wavevector and wavelength, one of c_iso and c_1d, and the "
    "unit of each (wavelength_unit, ...)"
)
#: The unit of a column: a pattern whose group is the unit of length, and its words in messages.
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
#: Fewest wavelengths with roughness in a table. On spectra with a roll-off, five points over four
#: decades gave the rms height with an error of up to 41 %, four points up to 57 %.
MIN_WAVELENGTHS = 5


def is_spectrum_table(path: str | Path) -> bool:
    """Return whether a file is a table of a spectrum: a CSV with a header, but not of positions."""
    if Path(path).suffix.lower() != ".csv" or not Path(path).is_file():
        return False
    with open(path, "rb") as file:
        first_line = file.readline(MAX_HEADER_BYTES).decode("latin-1")
    return not (NUMBERS.fullmatch(first_line.strip()) or POSITION_HEADING.match(first_line))


def read_spectrum_table(path: str | Path) -> Spectrum:
    """Return C_iso (nm⁴) of a CSV; its C_1D is converted by the inverse Abel transform."""
    table = user_table(path, "a table of a power spectral density")
    wave_column = _find_column(table, WAVE_COLUMNS)
    density_column = _find_column(table, DENSITY_COLUMNS)
    points = table.map_rows(lambda row: _wavevector_and_density(row, wave_column, density_column))
    first_lines = dict[str, int]()
    for line, (wavevector, _) in points.items():
        first_line = first_lines.setdefault(f"{wavevector:.9g}", line)
        if first_line != line:
            message = f"line {line}: expected each wavelength once, found that of line {first_line}"
            raise ValueError(f"{path}: {message}")
    count = sum(density > 0 for _, density in points.values())
    if count < MIN_WAVELENGTHS:
        raise ValueError(f"{path}: expected at least {MIN_WAVELENGTHS} wavelengths, found {count}")
    wavevectors, densities = np.array(sorted(points.values())).T
    if density_column == "c_1d":
        # A table does not say how many waves each point averages. Assume enough, so that smoothing
        # has its usual width.
        modes = np.full(densities.shape, ENOUGH_MODES)
        densities = isotropic_from_profile(wavevectors, densities, modes)
    return Spectrum(wavevectors, densities)


def _find_column(table: UserTable, names: Sequence[str]) -> str:
    """Return the only column of these names; refuse a table without the column of its unit."""
    present = [name for name in names if name in table.header]
    if len(present) != 1:
        raise ValueError(
            f"{table.path}: expected {EXPECTED_COLUMNS}, or a scan that begins with numbers or a "
            f"column x, found {quote_key(', '.join(table.header))}"
        )
    table.require_columns([present[0], f"{present[0]}_unit"], EXPECTED_COLUMNS)
    return present[0]


def _wavevector_and_density(row: Row, wave_column: str, density_column: str) -> tuple[float, float]:
    """Return wavevector (rad/nm) and density (C_iso in nm⁴, C_1D in nm³) of a row."""
    wave = parse_number(row[wave_column])
    density = parse_number(row[density_column])
    is_isotropic = density_column == "c_iso"
    if not 0 < wave < math.inf:
        found = quote_key(row[wave_column])
        raise ValueError(f"{wave_column}: expected a positive number, found {found}")
    if not (0 < density < math.inf or (is_isotropic and density == 0)):
        accepted = "a number of at least 0" if is_isotropic else "a positive number"
        found = quote_key(row[density_column])
        raise ValueError(f"{density_column}: expected {accepted}, found {found}")
    unit_length = _length_in_nm(row, wave_column)
    is_wavelength = wave_column == "wavelength"
    wavevector = 2 * math.pi / (wave * unit_length) if is_wavelength else wave / unit_length
    exponent = 4 if is_isotropic else 3
    return wavevector, density * _length_in_nm(row, density_column) ** exponent


def _length_in_nm(row: Row, name: str) -> float:
    """Return the unit of length, in nm, in a column's unit; refuse a unit of another quantity."""
    pattern, words = COLUMN_UNITS[name]
    unit = row[f"{name}_unit"]
    match = re.fullmatch(pattern, unit)
    try:
        # None is refused like a wrong unit.
        return parse_quantity(f"1 {match[1]}" if match else None, "nm")
    except ValueError:
        raise ValueError(f"{name}_unit: expected {words}, found {quote_key(unit)}") from None
