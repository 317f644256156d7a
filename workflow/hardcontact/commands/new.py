"""The command `hardcontact new`: from files of scans to a study of your surfaces."""

from argparse import Namespace
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from hardcontact.base.atomic_file import write_text_file
from hardcontact.base.formatting import format_length
from hardcontact.commands.inventory import UserScan, read_inventory, scans_by_surface
from hardcontact.commands.options import (
    QuantityOption,
    contact_of_quantities,
    parse_quantities,
    reading_options,
    unit_questions,
)
from hardcontact.commands.outputs import align_cells
from hardcontact.commands.proposal import Choice, Proposal, propose_keys, values_by_key
from hardcontact.commands.request import (
    SPHERE,
    file_faults,
    list_scan_files,
    name_faults,
    path_from_root,
)
from hardcontact.commands.scan_cautions import refuse_unreliable
from hardcontact.config.configuration import (
    CONTACT_QUANTITIES,
    key_field,
    numeric_configuration,
    set_keys,
)
from hardcontact.config.faults import collect_faults, raise_faults, validate
from hardcontact.config.force_table import read_forces
from hardcontact.config.key_tables import commented_yaml
from hardcontact.config.keys import NONE, SMOOTH_SPHERE
from hardcontact.config.limits import refuse_unfit_values
from hardcontact.config.selected_surfaces import CONTACT_USE, SPECTRUM_USE, SurfaceRow
from hardcontact.config.user_files import read_yaml
from hardcontact.records.code import ROOT
from hardcontact.scans.heights import split_notes
from hardcontact.scans.reliable_wavelengths import LIMIT_NAMES


def new_study(arguments: Namespace) -> str:
    """Write the files of a study of your surfaces; return a report in words."""
    quantities, faults = parse_quantities(arguments)
    radius = quantities["radius"].number
    scan_files = list_scan_files(arguments, radius)
    scans, left_out, scan_faults = read_inventory(
        scan_files, reading_options(arguments, quantities), arguments.channel
    )
    faults += [*file_faults(arguments), *scan_faults]
    tip_text = quantities["tip"].text if "tip" in quantities else ""
    checked_rows = surface_rows(scans, contact_scans=[], tip_radius=tip_text)
    all_faults = [*name_faults(arguments), *faults, *_cell_faults(checked_rows)]
    if arguments.forces is not None:
        surfaces = dict.fromkeys(scan_file.surface for scan_file in scan_files)
        substrates = [surface for surface in surfaces if surface != SPHERE]
        with collect_faults(all_faults):
            read_forces(arguments.forces, substrates, radius, "--forces")
    if not faults:  # Faults of the input can cause faults of the proposal.
        with collect_faults(all_faults):
            proposal, choices = _propose_study(arguments, quantities, scans)
    if all_faults:
        raise_faults([*all_faults, *unit_questions(quantities)])
    rows = surface_rows(scans, proposal.contact_scans, tip_text)
    table_text = "".join("\t".join(cells) + "\n" for cells in _header_and_cells(rows))
    report = [
        *_report_lines(scans, left_out, proposal, choices),
        *_write_study(arguments.name, table_text, choices, proposal.quick),
    ]
    return "\n".join(report)


def _write_study(
    name: str, table_text: str, choices: Sequence[Choice], quick: Sequence[Choice]
) -> list[str]:
    """Write the table of surfaces and the overlay of a study; return lines on how to run it."""
    overlay_path, table_path = f"config/{name}.yaml", f"config/{name}.tsv"
    command = f"snakemake --configfile {overlay_path}"
    texts = {table_path: table_text, overlay_path: _overlay_text(command, choices, quick)}
    for path, text in texts.items():
        write_text_file(ROOT / path, text)
    return [
        f"\nWritten: {overlay_path}, {table_path}. Now run, in {ROOT}:\n",
        f"{command} --config effort=quick   # a first answer",
        command,
    ]


def _cell_faults(rows: Sequence[Mapping[str, str]]) -> list[str]:
    """Return the faults of the cells of the table of surfaces."""
    faults: list[str] = []
    # `label_faults` names a faulty label once. Rows would repeat it, so they get the id instead.
    for row in rows:
        with collect_faults(faults):
            validate(SurfaceRow, {**row, "label": row["surface"]}, f"{row['path']!r}: ")
    return faults


def _propose_study(
    arguments: Namespace, quantities: Mapping[str, QuantityOption], scans: Sequence[UserScan]
) -> tuple[Proposal, list[Choice]]:
    """Return a proposal that the study accepts at both efforts, and all choices of full effort."""
    contact = contact_of_quantities(quantities)
    sphere_surface = SPHERE if arguments.sphere else None
    proposal = propose_keys(scans, sphere_surface, contact, quantities["range"].is_given)
    proposal.cautions.extend(unit_questions(quantities))
    choices = [*_choices_without_scans(arguments, quantities), *proposal.choices]
    extents = {
        surface: surface_scans[0].extent._replace(relief=max(scan.relief for scan in surface_scans))
        for surface, surface_scans in scans_by_surface(proposal.contact_scans).items()
    }
    full_effort_values = values_by_key(choices)
    for values in (full_effort_values, full_effort_values | values_by_key(proposal.quick)):
        # `name_faults` checks the names of study and store.
        other_keys = {key: value for key, value in values.items() if key not in ("study", "store")}
        refuse_unfit_values(
            numeric_configuration(set_keys(read_yaml("config/config.yaml"), other_keys)), extents
        )
    refuse_unreliable(scans)
    return proposal, choices


def _choices_without_scans(
    arguments: Namespace, quantities: Mapping[str, QuantityOption]
) -> Iterator[Choice]:
    """Yield the choices that do not depend on the scans."""
    name = arguments.name
    yield Choice("study", name, f"results in results/{name}/, quick ones in results/{name}-quick/")
    yield Choice("store", f"results/store-{name}", "intermediates")
    yield Choice("published", NONE, "nothing of the paper is needed or judged")
    yield Choice("surfaces", f"config/{name}.tsv", "one row per scan")
    size = quantities["size"].text if "size" in quantities else NONE
    for key, value, files in (
        ("scan.unit", arguments.unit, "files that state none"),
        ("scan.map_size", size, "files that state none"),
        ("scan.mask", arguments.mask, "all files with a mask"),
        ("scan.levelling", arguments.levelling, "all height maps"),
    ):
        if value != key_field(key).default:
            yield Choice(key, value, f"as given, for {files}")
    if arguments.forces is not None:
        yield Choice("forces", path_from_root(arguments.forces), "your pull-off forces")
    given_quantities = [option for option in CONTACT_QUANTITIES if quantities[option].is_given]
    if given_quantities:
        yield Choice("given_quantities", given_quantities, "others like the paper's are assumed")
    sphere_reason = "its scans" if arguments.sphere else "no scans of it"
    yield Choice("sphere.surface", SPHERE if arguments.sphere else SMOOTH_SPHERE, sphere_reason)
    for option, (key, meaning) in CONTACT_QUANTITIES.items():
        if option != "range":  # which depends on the scans
            quantity = quantities[option]
            origin = "as given" if quantity.is_given else f"the paper's; --{option} changes it"
            yield Choice(key, quantity.text, f"{meaning}: {origin}")


def surface_rows(
    scans: Sequence[UserScan], contact_scans: Sequence[UserScan], tip_radius: str
) -> list[dict[str, str]]:
    """Return the row of each scan by column; of a surface, scans that make contacts come first."""
    return [
        {
            "surface": surface,
            "label": scan.scan_file.label,
            "scan": str(number),
            "source": "measured",
            "path": scan.scan_file.table_path,
            "dataset": scan.dataset,
            "use": CONTACT_USE if scan in contact_scans else SPECTRUM_USE,
            "tip_radius": tip_radius if scan.is_tip_given else "",
        }
        for surface, surface_scans in scans_by_surface(scans).items()
        for number, scan in enumerate(
            sorted(surface_scans, key=lambda scan: scan not in contact_scans), 1
        )
    ]


def _overlay_text(command: str, choices: Sequence[Choice], quick: Sequence[Choice]) -> str:
    """Return an overlay as YAML: the command that runs it, and a reason above each key."""
    reasons = {choice.key: choice.reason for choice in choices}
    reasons["quick"] = "With --config effort=quick these keys replace those above."
    tree = set_keys({}, values_by_key(choices)) | {"quick": set_keys({}, values_by_key(quick))}
    lines = commented_yaml(tree, reasons)
    head = "# Written by `hardcontact new`; config/config.yaml explains every key.\n"
    return f"{head}# {command}\n" + "".join(f"{line}\n" for line in lines)


def _report_lines(
    scans: Sequence[UserScan], left_out: list[str], proposal: Proposal, choices: Sequence[Choice]
) -> Iterator[str]:
    """Yield the lines of the report: a table of the scans, then choices that the paper lacks.

    The overlay has all choices, with the reason of each.
    """
    yield "Found:"
    yield _scan_table(scans, proposal.contact_scans)
    labels = {scan.scan_file.surface: scan.scan_file.label for scan in scans}
    ids = [f"{surface} for {label}" for surface, label in labels.items() if surface != label]
    if ids:
        yield f"\nNames of surfaces in paths, tables and your table of forces: {', '.join(ids)}"
    if left_out:
        yield "\nLeft out:"
        yield from left_out
    yield "\nContacts are made on:"
    yield from proposal.reasons
    yield "\nChosen, unlike the paper:"
    for key, value, reason in choices:
        if value == key_field(key).default:
            continue
        words = value
        if isinstance(value, list):
            is_short = len(value) <= len(CONTACT_QUANTITIES)
            ends = f"{len(value)} values, {value[0]} to {value[-1]}"
            words = ", ".join(value) if is_short else ends
        yield f"{key}: {words}" + (f" ({reason})" if reason else "")
    if assumed := _assumed_options(values_by_key(choices)):
        yield f"\nNot given, so as in the paper: {' '.join(assumed)}"
    if proposal.cautions:
        yield "\nTake care:"
        yield from (f"- {caution}" for caution in proposal.cautions)


def _assumed_options(values: Mapping[str, Any]) -> list[str]:
    """Return the options of quantities that were not given, with the paper's values."""
    return [
        f"--{option} {values[key].replace(' ', '')}"
        for option, (key, _) in CONTACT_QUANTITIES.items()
        if option not in values.get("given_quantities", ())
        and values[key] == key_field(key).default
    ]


def _scan_table(scans: Sequence[UserScan], contact_scans: Sequence[UserScan]) -> str:
    """Return a table of the scans and their uses, with notes on their reading below."""
    rows = []
    notes = []
    for number, scan in enumerate(scans, 1):
        is_map = scan.kind == "map"
        wavelengths = scan.reliable_wavelengths
        ends = [format_length(end) for end in (wavelengths.shortest, wavelengths.longest)]
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
                "reliable": " to ".join(ends) if scan.has_reliable_wavelengths else "none",
                "used for": CONTACT_USE if scan in contact_scans else SPECTRUM_USE,
            }
        )
        notes += [f"{number}: {note}" for note in split_notes(scan.notes)[0]]
        if wavelengths.limited_by != "pixels":
            limit = LIMIT_NAMES[wavelengths.limited_by]
            notes.append(f"{number}: shorter wavelengths are not reliable: {limit}")
    return "\n".join([*align_cells(_header_and_cells(rows)), *notes])


def _header_and_cells(rows: Sequence[Mapping[str, str]]) -> list[list[str]]:
    """Return the names of the columns of a table, then the cells of each row."""
    return [list(rows[0]), *(list(row.values()) for row in rows)]
