"""Tables of the user's scans: the one that is printed, and the table of surfaces of the study."""

from collections.abc import Sequence

from hardcontact.base.formatting import format_length
from hardcontact.commands.command_line import align_cells
from hardcontact.commands.inventory import Entry, entries_by_surface
from hardcontact.config.selected_surfaces import CONTACT_USE
from hardcontact.scans.heights import split_notes
from hardcontact.scans.reliable_band import LIMIT_NAMES

#: The use of scans that only enter the spectrum of their surface.
SPECTRUM_USE = "spectrum"
#: Columns of the table that is printed.
ENTRY_COLUMNS = (
    "", "surface", "file", "channel", "kind", "size", "pixels", "unit", "rms", "peak to valley",
    "tip radius", "reliable", "used for",
)  # fmt: skip


def printed_table(entries: Sequence[Entry], contact_entries: Sequence[Entry]) -> str:
    """Return a table of the entries and their uses, with the notes on reading below."""
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
    """Return the rows of the table of surfaces by column; scans that make contacts come first.

    The tip radius is the quantity that the user gave for files that state none, or empty.
    """
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
