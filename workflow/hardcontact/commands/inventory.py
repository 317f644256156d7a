"""What the files of own surfaces hold: one entry a topography, and what cannot be read."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import PurePath
from typing import NamedTuple

import numpy as np

from hardcontact.commands.request import Source
from hardcontact.config.grids import Grid
from hardcontact.config.selection import CONTACT
from hardcontact.numbers.printing import print_length
from hardcontact.surfaces.contradictions import contradictions, told_contradictions
from hardcontact.surfaces.measured_spectrum import measured_psd
from hardcontact.surfaces.reliable_band import LIMITS, ReliableBand, reliable_band
from hardcontact.surfaces.scans import flattened, list_measurements, read_measurement
from hardcontact.surfaces.spectrum import Floats

#: The use of scans that only enter the spectrum of their surface.
SPECTRUM = "spectrum"
#: How undefined pixels are filled, so that what a file holds can be told.
FILLING = "harmonic"


@dataclass(frozen=True)
class Entry:
    """One topography: what its file says of it, and what was measured on it.

    Pixels are along an edge of a map, or points of a line scan. Heights in nm are levelled, of the
    sphere less its paraboloid, but `relief` is the largest difference levelled or not. The density
    (bins,) is C_iso in nm⁴. A tip radius (nm) that nothing states is None; `tip_given` says that
    the user gave it, as the file does not state it. Undefined pixels were filled, and notes say
    in words what was done in reading.
    """

    source: Source
    dataset: str
    channel: str
    file_unit: str
    kind: str
    pixels: int
    pixel_size: float
    rms_height: float
    peak_to_valley: float
    relief: float
    tip_radius: float | None
    tip_given: bool
    band: ReliableBand
    density: Floats
    undefined: int
    notes: tuple[str, ...]

    @property
    def undefined_share(self) -> float:
        """Share of undefined pixels of a map, or points of a line scan."""
        return self.undefined / (self.pixels**2 if self.kind == "map" else self.pixels)

    @property
    def size(self) -> float:
        """Edge of a map, or length of a line scan, in nm."""
        return self.pixels * self.pixel_size

    @property
    def grid(self) -> Grid:
        """The pixels of a map, as the checks of the study see them."""
        return Grid(self.pixels, self.pixel_size, self.size, self.relief)

    @property
    def name(self) -> str:
        """The file, without its folder, and of a container the data file in it."""
        file = PurePath(self.source.path).name
        return f"{file}/{self.dataset}" if self.dataset else file


class Found(NamedTuple):
    """What files hold: entries in their order, and what cannot be used, a line each.

    Unreadable are members of containers beside others that can be used; problems are whole files.
    """

    entries: list[Entry]
    unreadable: list[str]
    problems: list[str]


def inventory(
    sources: Sequence[Source],
    tip_radius: float | None,
    channel: str = "",
    unit: str = "none",
) -> Found:
    """Read all topographies of files, containers with all of theirs.

    A tip radius (nm) is that of scans whose files do not state it, None if it is not known; so is
    the unit of length, "none" if it is not. A channel is read of every file that is no container. A
    member of a container that cannot be used stops nothing: it cannot be taken out by hand.
    """
    found = Found([], [], [])
    for source in sources:
        entries, refusals = [], []
        try:
            for dataset in list_measurements(source.file):
                try:
                    entries.append(_entry(source, dataset or channel, tip_radius, unit))
                except ValueError as error:
                    file = f"{source.file}: "
                    refusals += [
                        f"{file}{dataset}: {line.removeprefix(file)}" if dataset else line
                        for line in str(error).splitlines()
                    ]
        except ValueError as error:
            refusals += str(error).splitlines()
        found.entries.extend(entries)
        (found.unreadable if entries else found.problems).extend(refusals)
    found.problems.extend(_twins(found.entries))
    return found


def _twins(entries: Sequence[Entry]) -> Iterator[str]:
    """Yield a line for each topography that stands among those of its surface before.

    A scan that counts twice makes intervals too narrow. Formats round differently: twins have the
    same pixels, and size and roughness that agree within 1e-4.
    """
    for one, other in combinations(entries, 2):
        pair = (one, other)
        alike = len({(scan.source.surface, scan.kind, scan.pixels) for scan in pair}) == 1
        first, second = ((scan.size, scan.rms_height, scan.peak_to_valley) for scan in pair)
        if alike and np.allclose(first, second, rtol=1e-4, atol=0):
            yield f"{other.name}: expected each scan once, found that of {one.name} again"


def contradicting(entries: Sequence[Entry]) -> Iterator[str]:
    """Yield a line for each surface whose scans contradict each other."""
    for surface in dict.fromkeys(entry.source.surface for entry in entries):
        scans = [entry for entry in entries if entry.source.surface == surface]
        found = contradictions(
            np.array([scan.density for scan in scans]),
            [scan.band.bins for scan in scans],
            [scan.kind for scan in scans],
            [scan.size for scan in scans],
        )
        yield from told_contradictions(found, [scan.name for scan in scans])


def _entry(source: Source, dataset: str, tip_radius: float | None, unit: str) -> Entry:
    measurement = read_measurement(source.file, dataset, FILLING, unit)
    relief = np.ptp(measurement.heights)
    if relief == 0:
        raise ValueError(f"{source.file}: expected a rough surface, found constant height")
    flat = flattened(measurement, source.sphere_radius)
    levelled = flat.heights
    if flat.kind != "map":  # A line scan is levelled by its mean line.
        place = np.arange(len(levelled))
        levelled = levelled - np.polynomial.Polynomial.fit(place, levelled, 1)(place)
    _, density = measured_psd(flat)
    stated = measurement.tip_radius
    radius = tip_radius if stated is None else stated
    return Entry(
        source=source,
        dataset=measurement.dataset,
        channel=measurement.channel,
        file_unit=measurement.file_unit,
        kind=measurement.kind,
        pixels=measurement.heights.shape[0],
        pixel_size=measurement.pixel_size,
        rms_height=float(levelled.std()),
        peak_to_valley=float(np.ptp(levelled)),
        relief=float(max(relief, np.ptp(levelled))),
        tip_radius=radius,
        tip_given=radius is not stated,
        band=reliable_band(flat, radius, density),
        density=density,
        undefined=measurement.undefined,
        notes=measurement.notes,
    )


def printed_table(entries: Sequence[Entry], uses: Sequence[str]) -> str:
    """Return a table of what was found, and used for what, as text with the notes below it.

    Notes say what was done in reading, and what ends the reliable wavelengths other than pixels.
    """
    columns = (
        "", "surface", "file", "channel", "kind", "size", "pixels", "unit", "rms",
        "peak to valley", "tip radius", "reliable", "used for",
    )  # fmt: skip
    cells = [_cells(entry, use) for entry, use in zip(entries, uses, strict=True)]
    rows = [columns, *((str(number), *row) for number, row in enumerate(cells, 1))]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = ["  ".join(map(str.ljust, row, widths)).rstrip() for row in rows]
    for number, entry in enumerate(entries, 1):
        lines += [f"{number}: {note}" for note in entry.notes]
        if entry.band.limited_by != "pixels":
            limit = LIMITS[entry.band.limited_by]
            lines.append(f"{number}: what is shorter is not reliable: {limit}")
    return "\n".join(lines)


def _cells(entry: Entry, use: str) -> tuple[str, ...]:
    edge = f"{entry.pixels} x {entry.pixels}" if entry.kind == "map" else str(entry.pixels)
    tip = "unknown" if entry.tip_radius is None else print_length(entry.tip_radius)
    shortest, longest = entry.band.shortest, entry.band.longest
    reliable = f"{print_length(shortest)} to {print_length(longest)}"
    return (
        entry.source.label,
        entry.name,
        entry.channel,
        "height map" if entry.kind == "map" else "line scan",
        print_length(entry.size),
        edge,
        entry.file_unit,
        print_length(entry.rms_height),
        print_length(entry.peak_to_valley),
        tip,
        reliable if shortest <= longest else "none",
        use,
    )


def table_rows(
    entries: Sequence[Entry], contact: Sequence[Entry], tip_radius: str
) -> list[dict[str, str]]:
    """Return the rows of the table of surfaces by column; scans that make contacts come first.

    Surface by surface in the order of the entries. The tip radius is a quantity that the user gave
    for scans whose files state none, or nothing.
    """
    in_contact = {id(entry) for entry in contact}
    rows = []
    for surface in dict.fromkeys(entry.source.surface for entry in entries):
        of_it = [entry for entry in entries if entry.source.surface == surface]
        of_it.sort(key=lambda entry: id(entry) not in in_contact)
        for number, entry in enumerate(of_it, 1):
            row = {
                "surface": surface,
                "label": entry.source.label,
                "scan": str(number),
                "source": "measured",
                "path": entry.source.path,
                "dataset": entry.dataset,
                "use": CONTACT if id(entry) in in_contact else SPECTRUM,
                "tip_radius": tip_radius if entry.tip_given else "",
            }
            rows.append(row)
    return rows
