"""The user's own spectrum: a table of a power spectral density, or scans of a surface.

A table has its units and is turned into C_iso. Of scans the wavelengths count at which they are
reliable.
"""

import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
import xarray as xr

from hardcontact.config.faults import plain, refuse_lines
from hardcontact.config.tables import Row, UserTable, found, in_unit, number, user_table
from hardcontact.surfaces.contradictions import contradictions, told_contradictions
from hardcontact.surfaces.joined_spectrum import joined_spectrum
from hardcontact.surfaces.measured_spectrum import isotropic_from_profile
from hardcontact.surfaces.reliable_band import ReliableBand
from hardcontact.surfaces.scan_heights import LENGTHS
from hardcontact.surfaces.scans import flattened, list_measurements, read_measurement
from hardcontact.surfaces.spectrum import Spectrum

#: Columns of which a table has one of each pair, each with a column of its unit.
WAVES, DENSITIES = ("wavevector", "wavelength"), ("c_iso", "c_1d")
COLUMNS = "wavevector or wavelength, c_iso or c_1d, and the unit of each (wavevector_unit, ...)"
#: The unit of a column: how it is written about that of a length, and in words.
UNITS = {
    "wavevector": (
        r"rad\s*/\s*(\S+)",
        "radians over a length, such as rad/nm (q = 2 pi/wavelength)",
    ),
    "wavelength": ("(.*)", "a length, such as nm"),
    "c_iso": (r"(\D+?)(?:\^|\*\*)?[4⁴]", "a length to the power of 4, such as nm4"),
    "c_1d": (r"(\D+?)(?:\^|\*\*)?[3³]", "a length to the power of 3, such as nm3"),
}
#: The fewest wavelengths with roughness that a table must have.
FEWEST = 5
#: Independent waves that each bin of a profile's density is taken to have when it is converted.
WAVES_OF_A_BIN = 20.0


class OwnSpectrum(NamedTuple):
    """C_iso of the user's files, and in words what was left out or done in reading them."""

    spectrum: Spectrum
    notes: tuple[str, ...]
    joined: xr.Dataset | None  #: Of scans, as by `joined_spectrum`; None for a table.


def own_spectrum(
    files: Sequence[str | Path],
    *,
    dataset: str = "",
    tip_radius: float | None = None,
    undefined_pixels: str = "harmonic",
    unit: str = "none",
    levelling: str = "plane",
    sphere_radius: float | None = None,
) -> OwnSpectrum:
    """Read a table of a spectrum, or measure the spectrum of scans of one surface.

    The files are one table, as of `table_spectrum`, or scans, which are read by `read_measurement`,
    levelled by `flattened` and joined by `joined_spectrum`. A dataset is the only member of a
    container that counts; the radius of the tip (nm) is of files that state none. The spectrum of
    scans ends where they are reliable. Raises ValueError with a line for each fault.
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
        return OwnSpectrum(spectrum, (note,) if zeros else (), None)
    scans = [
        flattened(read_measurement(path, member, undefined_pixels, unit), sphere_radius, levelling)
        for path in files
        for member in ([dataset] if dataset else list_measurements(path))
    ]
    for scan in scans:
        if np.ptp(scan.heights) < LENGTHS[0]:
            raise ValueError(f"{scan.path}: expected a rough surface, found constant height")
    joined = joined_spectrum(
        scans, [tip_radius if scan.tip_radius is None else None for scan in scans]
    )
    measured = np.isfinite(joined.joined.values)
    reliable = Spectrum(joined.bin_wavevector.values[measured], joined.joined.values[measured])
    names = [f"{scan.path} {scan.dataset}".strip() for scan in scans]
    limits = ("shortest_reliable", "longest_reliable", "limited_by")
    notes = []
    for name, *band, read in zip(
        names, *(joined[limit].values for limit in limits), joined.notes.values, strict=True
    ):
        notes.append(f"{name}: reliable {ReliableBand(*band)}" + (f"; {read}" if read else ""))
    columns = (joined[name].values for name in ("psd", "reliable", "kind", "size"))
    differing = told_contradictions(contradictions(*columns), names)
    notes += [f"take care: {line}" for line in differing]
    return OwnSpectrum(reliable, tuple(notes), joined)


def _is_table(path: Path) -> bool:
    """Return whether a file is a CSV by its name, or by a column of a spectrum in its first line.

    The reader of scans says why a file cannot be read.
    """
    if path.suffix.lower() == ".csv":
        return True
    if not path.is_file():  # a pipe would be waited for
        return False
    try:
        with path.open("rb") as file:
            head = file.readline(1024).decode("utf-8-sig", "replace")
    except OSError:
        return False
    cells = {cell.strip(' "\r\n') for cell in re.split("[,;]", head)}
    return not cells.isdisjoint({*WAVES, *DENSITIES})


def table_spectrum(path: str | Path) -> Spectrum:
    """Read the user's own power spectral density from a CSV with a header.

    Columns: `wavevector` (q = 2 pi/lambda) or `wavelength`; `c_iso` (h_rms² = 1/(2 pi) ∫ q C_iso
    dq) or `c_1d` (h_rms² = (1/pi) ∫ C_1D dq); and the unit of each, named for it with `_unit`. A
    density of 0 says no roughness. Returns C_iso in nm⁴ at the table's own wavevectors, of profiles
    by the inverse Abel transform. Raises ValueError with a line for each problem.
    """
    table = user_table(path, "a table of a power spectral density")
    wave, density = _quantities(table)
    problems = table.problems(lambda row: _faults(row, wave, density))
    points, lines = [], dict[str, int]()
    for line, row in table.rows().items():
        if _faults(row, wave, density):
            continue
        value, length = float(row[wave]), _nanometres(row, wave)
        wavevector = 2 * math.pi / (value * length) if wave == "wavelength" else value / length
        power = 4 if density == "c_iso" else 3
        points.append((wavevector, float(row[density]) * _nanometres(row, density) ** power))
        before = lines.setdefault(f"{wavevector:.9g}", line)
        if before != line:
            problems.append(
                f"{path}: line {line}: expected each wavelength once, found that of line {before}"
            )
    rough = sum(value > 0 for _, value in points)
    if not problems and rough < FEWEST:
        problems.append(f"{path}: expected at least {FEWEST} wavelengths, found {rough}")
    refuse_lines(problems)
    wavevectors, densities = np.array(sorted(points)).T
    if density == "c_1d":
        waves = np.full(densities.shape, WAVES_OF_A_BIN)
        densities = isotropic_from_profile(wavevectors, densities, waves)
    return Spectrum(wavevectors, densities)


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
    return present[0], present[1]


def _faults(row: Row, wave: str, density: str) -> list[str]:
    """Return what is wrong with the cells of a row."""
    faults = []
    for name in (wave, density):
        value = number(row[name])
        if not (0 < value < math.inf or (name == "c_iso" and value == 0)):
            accepted = "a number of at least 0" if name == "c_iso" else "a positive number"
            faults.append(f"{name}: expected {accepted}, found {found(row[name])}")
    for name in (wave, density):
        if math.isnan(_nanometres(row, name)):
            unit = found(row[f"{name}_unit"])
            faults.append(f"{name}_unit: expected {UNITS[name][1]}, found {unit}")
    return faults


def _nanometres(row: Row, name: str) -> float:
    """Return the length in the unit of a column, in nm; NaN if it is no unit of the quantity."""
    match = re.fullmatch(UNITS[name][0], row[f"{name}_unit"])
    return in_unit(1, match[1], "nm") if match else math.nan
