"""What `hardcontact new` prints: a table of the scans, the choices and their reasons, cautions."""

from collections.abc import Iterator, Sequence

from hardcontact.base.formatting import format_length
from hardcontact.commands.inventory import UserScan
from hardcontact.commands.outputs import align_cells
from hardcontact.commands.proposal import Choice, Proposal
from hardcontact.config.configuration import CONTACT_QUANTITIES
from hardcontact.config.selected_surfaces import CONTACT_USE, SPECTRUM_USE
from hardcontact.scans.heights import split_notes
from hardcontact.scans.reliable_band import LIMIT_NAMES


def report_lines(
    scans: Sequence[UserScan], left_out: list[str], proposal: Proposal, choices: Sequence[Choice]
) -> Iterator[str]:
    """Yield the lines of the report on the scans and the choices."""
    yield "Found:"
    yield _scan_table(scans, proposal.contact_scans)
    labels = {scan.scan_file.surface: scan.scan_file.label for scan in scans}
    ids = [f"{surface} is {label}" for surface, label in labels.items() if surface != label]
    if ids:
        yield f"\nNames of surfaces in paths, tables and your table of forces: {', '.join(ids)}"
    if left_out:
        yield "\nLeft out:"
        yield from left_out
    yield "\nContacts are made on:"
    yield from proposal.reasons
    yield "\nChosen:"
    for key, value, reason in choices:
        if isinstance(value, list):
            is_short = len(value) <= len(CONTACT_QUANTITIES)
            ends = f"{len(value)} values, {value[0]} to {value[-1]}"
            value = ", ".join(value) if is_short else ends
        yield f"{key}: {value}" + (f" ({reason})" if reason else "")
    if proposal.cautions:
        yield "\nTake care:"
        yield from (f"- {caution}" for caution in proposal.cautions)


def _scan_table(scans: Sequence[UserScan], contact_scans: Sequence[UserScan]) -> str:
    """Return a table of the scans and their uses, with notes on their reading below."""
    rows = []
    notes = []
    for number, scan in enumerate(scans, 1):
        is_map = scan.kind == "map"
        band = scan.reliable_band
        band_ends = [format_length(end) for end in (band.shortest, band.longest)]
        rows.append(
            {
                "": str(number),
                "surface": scan.scan_file.label,
                "file": scan.name,
                "channel": scan.channel,
                "kind": "height map" if is_map else "line scan",
                "size": format_length(scan.size),
                "pixels": f"{scan.pixels} x {scan.pixels}" if is_map else str(scan.pixels),
                "unit": scan.file_unit,
                "rms": format_length(scan.rms_height),
                "peak to valley": format_length(scan.peak_to_valley),
                "tip radius": format_length(scan.tip_radius) if scan.tip_radius else "unknown",
                "reliable": " to ".join(band_ends) if scan.has_reliable_wavelengths else "none",
                "used for": CONTACT_USE if scan in contact_scans else SPECTRUM_USE,
            }
        )
        notes += [f"{number}: {note}" for note in split_notes(scan.notes)[0]]
        if band.limited_by != "pixels":
            limit = LIMIT_NAMES[band.limited_by]
            notes.append(f"{number}: shorter wavelengths are not reliable: {limit}")
    cells = [[*rows[0].keys()], *([*row.values()] for row in rows)]
    return "\n".join([*align_cells(cells), *notes])
