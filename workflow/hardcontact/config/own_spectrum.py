"""The user's own spectrum: a table of a power spectral density, or scans of a surface.

A table has its units and is turned into C_iso; every fault of it is one line: the file and its
line, what was expected, what was found. Of scans the wavelengths count at which they are reliable.
"""

import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hardcontact.config.schema import plain, refuse_lines
from hardcontact.config.tables import Row, UserTable, found, number, user_table
from hardcontact.numbers.printing import print_length
from hardcontact.numbers.units import magnitude
from hardcontact.surfaces.joined_spectrum import joined_spectrum
from hardcontact.surfaces.measured_spectrum import isotropic_from_profile
from hardcontact.surfaces.measurement import LENGTHS
from hardcontact.surfaces.scans import flat_measurement, list_measurements
from hardcontact.surfaces.spectrum import Spectrum, spectrum_from

#: Columns of which a table has one of each pair, each with a column of its unit.
WAVES, DENSITIES = ("wavevector", "wavelength"), ("c_iso", "c_1d")
COLUMNS = "wavevector or wavelength, c_iso or c_1d, and the unit of each (wavevector_unit, ...)"
#: Powers of a length that a density has.
POWER = {"c_iso": 4, "c_1d": 3}
FEWEST = 5
#: Independent waves that each bin of a profile's density is taken to have when it is converted.
WAVES_OF_A_BIN = 20.0
#: What a joined spectrum says of each measurement, as notes tell it.
OF_MEASUREMENT = (
    "path", "dataset", "shortest_reliable", "shortest_reason", "longest_reliable", "longest_reason",
    "notes",
)  # fmt: skip


class OwnSpectrum(NamedTuple):
    """C_iso of the user's files, and in words what was left out or done in reading them."""

    spectrum: Spectrum
    notes: tuple[str, ...]


def own_spectrum(
    files: Sequence[str | Path],
    *,
    dataset: str = "",
    tip_radius: float | None = None,
    undefined_pixels: str = "harmonic",
    levelling: str = "plane",
    sphere_radius: float | None = None,
    continued: bool = False,
) -> OwnSpectrum:
    """Read a table of a spectrum, or measure the spectrum of scans of one surface.

    The files are one table, as `table_spectrum` reads it, or height maps, line scans and
    containers, which are joined as `joined_spectrum` does; of these the dataset is the only member
    of a container that counts, or empty. The radius of the tip, in nm, is of files that state none;
    undefined pixels, levelling and sphere are as of `flat_measurement`. The spectrum of scans ends
    where they are reliable, or is continued as in the study. Faults are a ValueError, a line each.
    """
    if not files:
        raise ValueError("files: expected a table of a spectrum or scans, found none")
    tables = [path for path in files if _is_table(Path(path))]
    if tables and len(files) > 1:
        raise ValueError(f"{tables[0]}: expected one table, or scans alone, found other files, too")
    if tables:
        spectrum = table_spectrum(tables[0])
        zeros = np.count_nonzero(spectrum.density == 0)
        note = f"left out: {zeros} rows of the table with a density of 0, no roughness there"
        return OwnSpectrum(spectrum, (note,) if zeros else ())
    measurements = [
        flat_measurement(
            path,
            member,
            undefined_pixels=undefined_pixels,
            levelling=levelling,
            sphere_radius=sphere_radius,
        )
        for path in files
        for member in ([dataset] if dataset else list_measurements(path))
    ]
    for one in measurements:
        if np.ptp(one.heights) < LENGTHS[0]:
            raise ValueError(f"{one.path}: expected a rough surface, found constant height")
    joined = joined_spectrum(
        measurements, [tip_radius if one.tip_radius is None else None for one in measurements]
    )
    known = np.isfinite(joined.joined.values)
    reliable = Spectrum(joined.bin_wavevector.values[known], joined.joined.values[known])
    notes = [
        f"{path} {member}".strip() + f": reliable from {print_length(shortest)} ({why_shortest}) "
        f"to {print_length(longest)} ({why_longest})" + (f"; {read}" if read else "")
        for path, member, shortest, why_shortest, longest, why_longest, read in zip(
            *(joined[name].values for name in OF_MEASUREMENT), strict=True
        )
    ]
    return OwnSpectrum(spectrum_from(joined) if continued else reliable, tuple(notes))


def _is_table(path: Path) -> bool:
    """Return whether a file is a CSV by its name, or by a column of a spectrum in its first line.

    What is wrong with a file that cannot be read is told by the reader of scans.
    """
    if path.suffix.lower() == ".csv":
        return True
    try:
        with path.open("rb") as file:
            first = file.readline(1024).decode("utf-8-sig", "replace")
    except OSError:
        return False
    return not {*WAVES, *DENSITIES}.isdisjoint(cell.strip(' "\r\n') for cell in first.split(","))


def table_spectrum(path: str | Path) -> Spectrum:
    """Read the user's own power spectral density from a CSV with a header.

    Columns: `wavevector` (q = 2 pi/lambda) or `wavelength`; `c_iso` (h_rms² = 1/(2 pi) ∫ q C_iso
    dq) or `c_1d` (h_rms² = (1/pi) ∫ C_1D dq); one of the unit of each, named for it with `_unit`,
    such as rad/nm, nm, nm4, nm3. A c_iso of 0 says no roughness. Returned is C_iso in nm⁴ at its
    own wavevectors, of profiles by the inverse Abel transform; problems are a ValueError, a line
    each.
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
    refuse_lines(problems)
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
    refuse_lines(faults)
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
    value = number(text)
    return value if math.isfinite(value) else math.nan


def _wavevector(row: Row, name: str) -> float:
    """Return q in rad/nm; NaN if the unit is none of the quantity."""
    value, unit = _number(row[name]), row[f"{name}_unit"]
    if name == "wavelength":
        return 2 * math.pi / (value * _nanometres(unit))
    match = re.fullmatch(r"rad\s*/\s*(\S+)", unit)
    return value / _nanometres(match[1]) if match else math.nan


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
