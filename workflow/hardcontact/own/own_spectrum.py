"""The isotropic spectrum C_iso of the user's surface, from a table or from scans.

Scans give it at their reliable wavelengths alone, because noise, tip and levelling distort the
others.
"""

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
import xarray as xr

from hardcontact.base.arrays import generator
from hardcontact.base.units import parse_quantity
from hardcontact.config.faults import quote_key
from hardcontact.config.user_files import Row, UserTable, parse_number, user_table
from hardcontact.scans.both_bodies import combine_maps, combine_spectra
from hardcontact.scans.defects import defect_sentence, level_and_list_defects
from hardcontact.scans.heights import LENGTH_BOUNDS, TAKE_CARE, split_notes
from hardcontact.scans.joined_spectrum import ScanSpectrum, joined_spectrum, reliable_spectrum
from hardcontact.scans.measured_spectrum import ENOUGH_MODES, isotropic_from_profile
from hardcontact.scans.plain_text import ROW
from hardcontact.scans.reading import DEFAULT_OPTIONS, ReadingOptions, list_scans
from hardcontact.scans.reliable_band import ReliableBand
from hardcontact.scans.scan_pairs import (
    describe_contradictions,
    find_contradictions,
    repetition_notes,
)
from hardcontact.surfaces.height_map import HeightMap, mirror_in_float32
from hardcontact.surfaces.metrics import metrics
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


class OwnSpectrum(NamedTuple):
    """C_iso of the user's files, with notes on what reading changed and left out."""

    spectrum: Spectrum  #: A `ScanSpectrum` if it comes from scans.
    notes: tuple[str, ...]
    scans: tuple[HeightMap, ...] = ()  #: Levelled; empty for a table.
    #: The levelled maps of a substrate and of a rough sphere, whose sum is the only scan.
    body_maps: tuple[HeightMap, ...] = ()


def read_own_spectrum(
    files: Sequence[str | Path],
    options: ReadingOptions = DEFAULT_OPTIONS,
    *,
    dataset: str = "",
    sphere_radius: float | None = None,
) -> OwnSpectrum:
    """Return the spectrum of a table, or of scans of one surface at their reliable wavelengths.

    `dataset` is the only scan to read, `sphere_radius` (nm) that of scans of a sphere.
    """
    if not files:
        raise ValueError("files: expected a table of a spectrum or scans, found none")
    tables = [path for path in files if is_spectrum_table(path)]
    if tables and len(files) > 1:
        raise ValueError(f"{tables[0]}: expected one table, or scans alone, found other files, too")
    if tables:
        spectrum = read_spectrum_table(tables[0])
        zeros = np.count_nonzero(spectrum.density == 0)
        note = f"no roughness in {zeros} rows of the table, with a density of 0"
        return OwnSpectrum(spectrum, (note,) if zeros else ())
    scans = [
        level_and_list_defects(options.read_scan(path, name), sphere_radius, options.levelling)
        for path in files
        for name in ([dataset] if dataset else list_scans(path))
    ]
    for scan in scans:
        if np.ptp(scan.heights) < LENGTH_BOUNDS[0]:
            raise ValueError(f"{scan.path}: expected a rough surface, found constant height")
    return _spectrum_of_scans(scans, options.tip_radius)


def spectrum_of_map(scan: HeightMap) -> OwnSpectrum:
    """Return the spectrum of a map at its reliable wavelengths; the map is levelled once more."""
    return _spectrum_of_scans([level_and_list_defects(scan)])


def add_sphere_roughness(surface: OwnSpectrum, sphere: OwnSpectrum, seed: int) -> OwnSpectrum:
    """Return the sum of both spectra, and of both maps if each body has a single one.

    The seed decides which positions of the maps meet. Raises ValueError for a table.
    """
    substrate_spectrum, sphere_spectrum = surface.spectrum, sphere.spectrum
    if not isinstance(substrate_spectrum, ScanSpectrum) or not isinstance(
        sphere_spectrum, ScanSpectrum
    ):
        raise ValueError("--sphere: expected scans of both bodies, found a table of a spectrum")
    spectra = combine_spectra(substrate_spectrum.joined_dataset, sphere_spectrum.joined_dataset)
    notes = surface.notes + sphere.notes
    scans = surface.scans + sphere.scans
    if len(scans) > 2 or any(scan.kind != "map" for scan in scans):
        skewness = max(substrate_spectrum.skewness, sphere_spectrum.skewness, key=abs)
        return OwnSpectrum(reliable_spectrum(spectra, skewness), notes, scans)
    combined_map = _sum_of_maps(*scans, seed=seed)
    spectrum = reliable_spectrum(spectra, metrics(combined_map)["skewness"])
    return OwnSpectrum(spectrum, notes, (combined_map,), scans)


def _sum_of_maps(substrate: HeightMap, sphere: HeightMap, *, seed: int) -> HeightMap:
    """Return the levelled map of a substrate with the roughness of the sphere."""
    rng = generator(seed, "both bodies")
    mirrored = combine_maps(rng, mirror_in_float32(substrate), mirror_in_float32(sphere))
    heights = mirrored.heights[: substrate.pixels, : substrate.pixels]
    return replace(substrate, heights=heights, defects={**sphere.defects, **substrate.defects})


def _spectrum_of_scans(scans: Sequence[HeightMap], tip_radius: float | None = None) -> OwnSpectrum:
    """Return the joined spectrum of scans of different areas, with cautions and other notes.

    Later scans of the same area are left out. The tip radius (nm) serves scans without their own.
    """
    names = [scan.name for scan in scans]
    repeated = repetition_notes(scans, names)
    scans = [scan for number, scan in enumerate(scans) if number not in repeated]
    names = [name for number, name in enumerate(names) if number not in repeated]
    defects = [
        (name, defect_sentence(code, numbers))
        for name, scan in zip(names, scans, strict=True)
        for code, numbers in scan.defects.items()
    ]
    tips = [tip_radius if scan.tip_radius is None else None for scan in scans]
    try:
        spectra = joined_spectrum(scans, tips)
    except ValueError as error:  # Spikes, for example, look like a noise floor.
        lines = [f"{name}: expected a sound scan, found: {line}" for name, line in defects]
        raise ValueError("\n".join([str(error), *lines])) from None
    notes = [f"{TAKE_CARE}{line}" for line in repeated.values()]
    notes += _reading_notes(scans, names, spectra)
    columns = (spectra[name].values for name in ("psd", "reliable", "kind", "size"))
    if contradictions := find_contradictions(*columns):
        notes.append(f"{TAKE_CARE}{describe_contradictions(contradictions, names)}")
    notes += [f"{TAKE_CARE}{name}: {line}" for name, line in defects]
    skewnesses = [metrics(scan)["skewness"] for scan in scans if scan.kind == "map"]
    spectrum = reliable_spectrum(spectra, max(skewnesses, key=abs, default=0.0))
    return OwnSpectrum(spectrum, tuple(notes), tuple(scans))


def _reading_notes(
    scans: Sequence[HeightMap], names: Sequence[str], spectra: xr.Dataset
) -> Iterator[str]:
    """Yield notes on the reliable band of each scan, on changes in reading it and cautions."""
    bands = (spectra[key].values for key in ("shortest_reliable", "longest_reliable", "limited_by"))
    for name, scan, *band in zip(names, scans, *bands, strict=True):
        changes, cautions = split_notes(scan.notes)
        yield "; ".join([f"{name}: reliable {ReliableBand(*band)}", *changes])
        yield from (f"{TAKE_CARE}{name}: {line}" for line in cautions)


def is_spectrum_table(path: str | Path) -> bool:
    """Return whether a file is a table of a spectrum: a CSV whose header names no positions."""
    if Path(path).suffix.lower() != ".csv" or not Path(path).is_file():
        return False
    with open(path, "rb") as file:
        first_line = file.readline(MAX_HEADER_BYTES).decode("latin-1")
    return not (ROW.fullmatch(first_line.strip()) or POSITION_HEADING.match(first_line))


def read_spectrum_table(path: str | Path) -> Spectrum:
    """Return C_iso (nm⁴) of a CSV.

    Its columns are `wavevector` or `wavelength`, `c_iso` or `c_1d`, and the unit of each with the
    end `_unit`. C_1D is converted by the inverse Abel transform. A density of 0 means no roughness.
    """
    table = user_table(path, "a table of a power spectral density")
    wave_column = _find_column(table, WAVE_COLUMNS)
    density_column = _find_column(table, DENSITY_COLUMNS)
    points = table.map_rows(lambda row: _wavevector_and_density(row, wave_column, density_column))
    lines = dict[str, int]()
    for line, (wavevector, _) in points.items():
        first_line = lines.setdefault(f"{wavevector:.9g}", line)
        if first_line != line:
            message = f"line {line}: expected each wavelength once, found that of line {first_line}"
            raise ValueError(f"{path}: {message}")
    count = sum(density > 0 for _, density in points.values())
    if count < MIN_WAVELENGTHS:
        raise ValueError(f"{path}: expected at least {MIN_WAVELENGTHS} wavelengths, found {count}")
    wavevectors, densities = np.array(sorted(points.values())).T
    if density_column == "c_1d":
        # A table does not state the modes of a bin: enough for the usual width of smoothing.
        modes = np.full(densities.shape, ENOUGH_MODES)
        densities = isotropic_from_profile(wavevectors, densities, modes)
    return Spectrum(wavevectors, densities)


def _find_column(table: UserTable, names: Sequence[str]) -> str:
    """Return which of two columns a table has; the column of its unit must be there, too."""
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
    power = 4 if density_column == "c_iso" else 3
    if not 0 < wave < math.inf:
        found = quote_key(row[wave_column])
        raise ValueError(f"{wave_column}: expected a positive number, found {found}")
    if not (0 < density < math.inf or (power == 4 and density == 0)):
        accepted = "a number of at least 0" if power == 4 else "a positive number"
        found = quote_key(row[density_column])
        raise ValueError(f"{density_column}: expected {accepted}, found {found}")
    unit_length = _length_in_nm(row, wave_column)
    is_wavelength = wave_column == "wavelength"
    wavevector = 2 * math.pi / (wave * unit_length) if is_wavelength else wave / unit_length
    return wavevector, density * _length_in_nm(row, density_column) ** power


def _length_in_nm(row: Row, name: str) -> float:
    """Return the length in the unit of a column, in nm; refuse a unit of another quantity."""
    pattern, words = COLUMN_UNITS[name]
    unit = row[f"{name}_unit"]
    match = re.fullmatch(pattern, unit)
    try:
        return parse_quantity(f"1 {match[1]}" if match else None, "nm")
    except ValueError:
        raise ValueError(f"{name}_unit: expected {words}, found {quote_key(unit)}") from None
