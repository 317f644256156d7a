"""What the files of own surfaces hold: one entry a topography, and what cannot be read."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import PurePath
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hardcontact.config.grids import Grid
from hardcontact.numbers.printing import print_length
from hardcontact.surfaces.measurement import Measurement
from hardcontact.surfaces.reliable_band import ReliableBand, reliable_band
from hardcontact.surfaces.scans import flattened, list_measurements, read_measurement
from hardcontact.surfaces.topography import flat_map

__all__ = ["Entry", "FILLING", "Found", "Source", "inventory", "printed_table"]

#: How undefined pixels are filled, so that what a file holds can be told.
FILLING = "harmonic"

COLUMNS = (
    "", "surface", "file", "channel", "kind", "size", "pixels", "unit", "rms", "peak to valley",
    "tip radius", "reliable", "used for",
)  # fmt: skip


class Source(NamedTuple):
    """A file of a surface.

    Attributes
    ----------
    surface, label : str
        Its id and its name.
    file : str
        Where it is read.
    path : str
        As it stands in the table of surfaces.
    sphere_radius : float or None
        In nm, of a file of the sphere; None of other surfaces.
    """

    surface: str
    label: str
    file: str
    path: str
    sphere_radius: float | None = None


@dataclass(frozen=True)
class Entry:
    """One topography: what its file says of it, and what was measured on it.

    Attributes
    ----------
    source : Source
        Its file.
    dataset, channel, file_unit, kind : str
        As of a Measurement.
    pixels : int
        Along an edge of a map, or points of a line scan.
    pixel_size : float
        In nm.
    rms_height, peak_to_valley : float
        In nm, levelled; of the sphere less its paraboloid.
    relief : float
        Largest difference in height in nm, levelled or not.
    tip_radius : float or None
        In nm; None if nothing states it.
    tip_given : bool
        Whether the user gave it, as its file does not state it.
    band : ReliableBand
        The wavelengths at which it is reliable.
    undefined : int
        Undefined pixels, which were filled.
    notes : tuple of str
        What was done in reading, in words.
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
    undefined: int
    notes: tuple[str, ...]

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
    """What files hold.

    Attributes
    ----------
    entries : list of Entry
        In the order of the files.
    unreadable : list of str
        Members of containers that cannot be used, beside others that can: a line each.
    problems : list of str
        Files of which nothing can be used: a line each.
    """

    entries: list[Entry]
    unreadable: list[str]
    problems: list[str]


def inventory(sources: Sequence[Source], tip_radius: float | None) -> Found:
    """Read all topographies of files.

    Parameters
    ----------
    sources : sequence of Source
        Containers count with all their topographies.
    tip_radius : float or None
        In nm, of the scans whose files do not state it; None if it is not known.

    Returns
    -------
    Found
        A member of a container that cannot be used stops nothing: it cannot be taken out by hand.
    """
    found = Found([], [], [])
    for source in sources:
        entries, refusals = _read_file(source, tip_radius)
        found.entries.extend(entries)
        (found.unreadable if entries else found.problems).extend(refusals)
    return found


def _read_file(source: Source, tip_radius: float | None) -> tuple[list[Entry], list[str]]:
    """Return the topographies of a file, and why others in it cannot be used."""
    entries, refusals = [], []
    try:
        datasets = list_measurements(source.file)
    except ValueError as error:
        return [], str(error).splitlines()
    for dataset in datasets:
        try:
            entries.append(_entry(source, dataset, tip_radius))
        except ValueError as error:
            where = f"{source.file}: {dataset}: " if dataset else ""
            refusals += [
                where + line.removeprefix(f"{source.file}: ") if dataset else line
                for line in str(error).splitlines()
            ]
    return entries, refusals


def _entry(source: Source, dataset: str, tip_radius: float | None) -> Entry:
    measurement = read_measurement(source.file, dataset, FILLING)
    relief = np.ptp(measurement.heights)
    if relief == 0:
        raise ValueError(f"{source.file}: expected a rough surface, found constant height")
    flat = flattened(measurement, partial(flat_map, sphere_radius=source.sphere_radius))
    levelled = _levelled(flat)
    stated = measurement.tip_radius
    radius = tip_radius if stated is None else stated
    return Entry(
        source=source,
        dataset=dataset,
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
        band=reliable_band(flat, radius),
        undefined=measurement.undefined,
        notes=measurement.notes,
    )


def _levelled(flat: Measurement) -> NDArray[np.float64]:
    """Return the heights (nm) of a flat map, those of a line scan less their mean line."""
    if flat.kind == "map":
        return flat.heights
    place = np.arange(len(flat.heights))
    line = np.polynomial.Polynomial.fit(place, flat.heights, 1)
    return np.asarray(flat.heights - line(place))


def printed_table(entries: Sequence[Entry], uses: Sequence[str]) -> str:
    """Return a table of what was found, as text, with the notes below it.

    Parameters
    ----------
    entries : sequence of Entry
        One a row.
    uses : sequence of str
        What each is used for.

    Returns
    -------
    str
        Lines of columns, aligned.
    """
    cells = [_cells(entry, use) for entry, use in zip(entries, uses, strict=True)]
    rows = [COLUMNS, *((str(number), *row) for number, row in enumerate(cells, 1))]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = ["  ".join(map(str.ljust, row, widths)).rstrip() for row in rows]
    return "\n".join([*lines, *_notes(entries)])


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


def _notes(entries: Sequence[Entry]) -> Iterator[str]:
    """Yield what was done in reading, and what ends the reliable wavelengths other than pixels."""
    for number, entry in enumerate(entries, 1):
        for note in entry.notes:
            yield f"{number}: {note}"
        if "pixels" not in entry.band.shortest_reason:
            yield f"{number}: what is shorter is not reliable: {entry.band.shortest_reason}"
