"""The contents of the user's files: an entry for each topography, and tables of the entries."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import PurePath

import numpy as np

from hardcontact.base.arrays import Floats
from hardcontact.base.formatting import format_length
from hardcontact.commands.outputs import align_cells
from hardcontact.commands.request import ScanFile
from hardcontact.config.selected_surfaces import CONTACT_USE
from hardcontact.contact.numerical_limits import Grid
from hardcontact.scans.defects import scan_with_defects
from hardcontact.scans.heights import split_notes
from hardcontact.scans.measured_spectrum import isotropic_psd
from hardcontact.scans.reading import DEFAULT_OPTIONS, ReadingOptions, list_scans
from hardcontact.scans.reliable_band import LIMIT_NAMES, ReliableBand, reliable_band
from hardcontact.scans.scan_pairs import coarse_map, repetition_notes
from hardcontact.surfaces.height_map import HeightMap

#: How undefined pixels are filled, so that the properties of the scan can be measured.
FILLING = DEFAULT_OPTIONS.undefined_pixels
#: The use of scans that only enter the spectrum of their surface.
SPECTRUM_USE = "spectrum"
#: Columns of the table that is printed.
ENTRY_COLUMNS = (
    "", "surface", "file", "channel", "kind", "size", "pixels", "unit", "rms", "peak to valley",
    "tip radius", "reliable", "used for",
)  # fmt: skip


@dataclass(frozen=True)
class Entry:
    """A topography: what its file states, and what is measured on it; lengths are in nm."""

    scan_file: ScanFile
    dataset: str
    channel: str
    file_unit: str
    kind: str
    pixels: int  #: Pixels per row of a map, or points of a line scan.
    pixel_size: float
    rms_height: float  #: Of the levelled scan, without the shape of a sphere.
    peak_to_valley: float  #: Of the levelled scan, without the shape of a sphere.
    relief: float  #: The largest difference in height, levelled or not.
    tip_radius: float | None
    tip_given: bool  #: Whether the user gave the radius, because the file states none.
    band: ReliableBand
    density: Floats  #: C_iso (bins,) in nm⁴
    undefined_count: int  #: Number of undefined pixels, which were filled.
    notes: tuple[str, ...]  #: What was done in reading.
    defects: Mapping[str, Mapping[str, float]]  #: From `scan_defects`.
    coarse: HeightMap  #: The levelled scan on few pixels, to find scans of the same area.

    @property
    def undefined_share(self) -> float:
        """Share of undefined pixels of a map, or points of a line scan."""
        return self.undefined_count / (self.pixels**2 if self.kind == "map" else self.pixels)

    @property
    def size(self) -> float:
        """Width of a map, or length of a line scan, in nm."""
        return self.pixels * self.pixel_size

    @property
    def grid(self) -> Grid:
        """The pixels of a map, as the checks of the study see them."""
        return Grid(self.pixels, self.pixel_size, self.size, self.relief)

    @property
    def is_blind(self) -> bool:
        """Whether no wavelength is reliable."""
        return self.band.shortest > self.band.longest

    @property
    def name(self) -> str:
        """The file without its folder, and for a container the data file in it."""
        file = PurePath(self.scan_file.path).name
        return f"{file}/{self.dataset}" if self.dataset else file


def read_inventory(
    scan_files: Sequence[ScanFile], options: ReadingOptions, channel: str = ""
) -> tuple[list[Entry], list[str], list[str]]:
    """Return the topographies of files, each area once, what is left out, and the problems."""
    entries: list[Entry] = []
    unreadable: list[str] = []
    problems: list[str] = []
    for scan_file in scan_files:
        file_entries, faults = _read_file(scan_file, options, channel)
        entries += file_entries
        # A dataset that cannot be used stops nothing: the user cannot take it out.
        (unreadable if file_entries or scan_file.is_in_folder else problems).extend(faults)
    if not entries and not problems:
        problems += unreadable
    problems += _twin_faults(entries)
    kept_entries, repeated = _leave_out_repeated_scans(entries)
    return kept_entries, unreadable + repeated, problems


def _read_file(
    scan_file: ScanFile, options: ReadingOptions, channel: str
) -> tuple[list[Entry], list[str]]:
    """Return the entries of a file, and a line for each fault of a dataset that is not usable."""
    try:
        datasets = list_scans(scan_file.file)
    except ValueError as error:
        return [], str(error).splitlines()
    entries = []
    faults = []
    for dataset in datasets:
        try:
            scan = options.read_scan(scan_file.file, dataset or channel)
            entries.append(_measure_scan(scan_file, scan, options))
        except ValueError as error:
            file = f"{scan_file.file}: "
            faults += [
                f"{file}{dataset}: {line.removeprefix(file)}" if dataset else line
                for line in str(error).splitlines()
            ]
    return entries, faults


def _twin_faults(entries: Sequence[Entry]) -> Iterator[str]:
    """Yield a line for each scan given twice, which would make intervals too narrow."""
    for entry, twin in combinations(entries, 2):
        is_twin = (entry.kind, entry.pixels) == (twin.kind, twin.pixels) and np.allclose(
            (entry.size, entry.rms_height, entry.peak_to_valley),
            (twin.size, twin.rms_height, twin.peak_to_valley),
            rtol=1e-4,  # File formats round differently.
            atol=0,
        )
        if is_twin and entry.scan_file.surface == twin.scan_file.surface:
            yield f"{twin.name}: expected each scan once, found that of {entry.name} again"


def _leave_out_repeated_scans(entries: Sequence[Entry]) -> tuple[list[Entry], list[str]]:
    """Return the entries whose area no earlier entry shows, and a line for each other entry."""
    kept_entries: list[Entry] = []
    lines: list[str] = []
    for scans in entries_by_surface(entries).values():
        repeated = repetition_notes([scan.coarse for scan in scans], [scan.name for scan in scans])
        kept_entries += [scan for number, scan in enumerate(scans) if number not in repeated]
        lines += repeated.values()
    return kept_entries, lines


def entries_by_surface(entries: Sequence[Entry]) -> dict[str, list[Entry]]:
    """Return the entries of each surface, in their order."""
    surfaces: dict[str, list[Entry]] = {}
    for entry in entries:
        surfaces.setdefault(entry.scan_file.surface, []).append(entry)
    return surfaces


def _measure_scan(scan_file: ScanFile, scan: HeightMap, options: ReadingOptions) -> Entry:
    """Return the entry of one topography; raise ValueError if it cannot be used."""
    relief = np.ptp(scan.heights)
    if relief == 0:
        raise ValueError(f"{scan_file.file}: expected a rough surface, found constant height")
    flat = scan_with_defects(scan, scan_file.sphere_radius, options.levelling)
    peak_to_valley = float(np.ptp(flat.heights))
    density = isotropic_psd(flat)
    tip_radius = options.tip_radius if scan.tip_radius is None else scan.tip_radius
    return Entry(
        scan_file=scan_file,
        dataset=scan.dataset,
        channel=scan.channel,
        file_unit=scan.file_unit,
        kind=scan.kind,
        pixels=scan.pixels,
        pixel_size=scan.pixel_size,
        rms_height=float(flat.heights.std()),
        peak_to_valley=peak_to_valley,
        relief=max(float(relief), peak_to_valley),
        tip_radius=tip_radius,
        tip_given=tip_radius is not scan.tip_radius,
        band=reliable_band(flat, tip_radius, density),
        density=density,
        undefined_count=scan.undefined_count,
        notes=flat.notes,
        defects=flat.defects,
        coarse=coarse_map(flat),
    )


def printed_table(entries: Sequence[Entry], contact_entries: Sequence[Entry]) -> str:
    """Return a table of the entries and their uses, with notes on their reading below."""
    contact_ids = {id(entry) for entry in contact_entries}
    rows = [ENTRY_COLUMNS]
    notes = []
    for number, entry in enumerate(entries, 1):
        is_map = entry.kind == "map"
        band = entry.band
        rows.append(
            (
                str(number),
                entry.scan_file.label,
                entry.name,
                entry.channel,
                "height map" if is_map else "line scan",
                format_length(entry.size),
                f"{entry.pixels} x {entry.pixels}" if is_map else str(entry.pixels),
                entry.file_unit,
                format_length(entry.rms_height),
                format_length(entry.peak_to_valley),
                "unknown" if entry.tip_radius is None else format_length(entry.tip_radius),
                "none"
                if entry.is_blind
                else f"{format_length(band.shortest)} to {format_length(band.longest)}",
                CONTACT_USE if id(entry) in contact_ids else SPECTRUM_USE,
            )
        )
        notes += [f"{number}: {note}" for note in split_notes(entry.notes)[0]]
        if band.limited_by != "pixels":
            limit = LIMIT_NAMES[band.limited_by]
            notes.append(f"{number}: shorter wavelengths are not reliable: {limit}")
    return "\n".join([*align_cells(rows), *notes])


def table_rows(
    entries: Sequence[Entry], contact_entries: Sequence[Entry], tip_radius: str
) -> list[dict[str, str]]:
    """Return the rows of the table of surfaces by column; scans that make contacts come first."""
    contact_ids = {id(entry) for entry in contact_entries}
    return [
        {
            "surface": surface,
            "label": entry.scan_file.label,
            "scan": str(number),
            "source": "measured",
            "path": entry.scan_file.path,
            "dataset": entry.dataset,
            "use": CONTACT_USE if id(entry) in contact_ids else SPECTRUM_USE,
            "tip_radius": tip_radius if entry.tip_given else "",
        }
        for surface, scans in entries_by_surface(entries).items()
        for number, entry in enumerate(
            sorted(scans, key=lambda scan: id(scan) not in contact_ids), 1
        )
    ]
