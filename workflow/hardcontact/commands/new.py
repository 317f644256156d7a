"""The command `hardcontact new`: from files of scans to a study of own surfaces.

It reads the files, tells what they hold, chooses what is computed and writes an overlay and a table
of surfaces. All problems are told at once, a line each, and then nothing is written.
"""

import sys
from argparse import Namespace
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from functools import partial
from pathlib import Path

from hardcontact.commands.inventory import (
    SPECTRUM,
    Entry,
    Found,
    inventory,
    printed_table,
    table_rows,
)
from hardcontact.commands.proposal import (
    Choice,
    Proposal,
    nested,
    overlay_text,
    propose,
    refuse_unreliable,
)
from hardcontact.commands.proposed_contact import Probe
from hardcontact.commands.request import (
    QUANTITIES,
    QUICK_NAME,
    ROOT,
    SPHERE,
    Option,
    name_faults,
    options,
    parsed,
    path_from_root,
    refuse_another_clone,
    sources,
)
from hardcontact.config.configuration import NONE, SMOOTH, configuration, read_yaml, refuse_all
from hardcontact.config.grids import Grid
from hardcontact.config.limits import check_grids
from hardcontact.config.schema import refuse, refuse_lines
from hardcontact.config.selection import CONTACT
from hardcontact.config.tables import measured_forces
from hardcontact.contact.bearing_area import Load
from hardcontact.records.whole_file import whole_file


def main() -> int:
    """Carry out the command line, `new` or `predict`; return the exit code."""
    command, rest = sys.argv[1:2], sys.argv[2:]
    try:
        if command == ["predict"]:
            from hardcontact.commands.predict import predict, predict_arguments

            print(predict(predict_arguments(rest)))
        else:
            print(new_study(parsed(sys.argv[1:])))
    except ValueError as error:
        for line in dict.fromkeys(str(error).splitlines()):
            print(f"error: {line}", file=sys.stderr)
        return 1
    return 0


def new_study(arguments: Namespace) -> str:
    """Write the files of a study of own surfaces; return what was found, chosen and written.

    All problems are a ValueError, a line each; then nothing is written.
    """
    refuse_another_clone(Path.cwd())
    given, option_faults = options(arguments)
    files, file_faults = sources(arguments, given["radius"].number)
    tip = given["tip"].text if "tip" in given else ""
    found = inventory(files, given["tip"].number if tip else None)
    faults = [*option_faults, *file_faults, *found.problems]
    surfaces = list(dict.fromkeys(file.surface for file in files if file.surface != SPHERE))
    plans: list[tuple[Proposal, list[Choice], list[Choice]]] = []
    checks: list[Callable[[], object]] = [
        partial(refuse_lines, [*name_faults(arguments.name, arguments.overwrite), *faults]),
        partial(_refuse_labels, arguments),
        partial(_refuse_cells, table_rows(found.entries, [], tip)),
    ]
    if arguments.forces is not None:
        checks.append(partial(_refuse_forces, arguments.forces, surfaces))
    if not faults:  # Else problems would be told that are none once these are mended.
        checks.append(lambda: plans.append(_plan(arguments, given, found.entries)))
    refuse_all(checks)
    ((proposal, choices, quick),) = plans
    overlay, table = f"config/{arguments.name}.yaml", f"config/{arguments.name}.tsv"
    rows = table_rows(found.entries, proposal.contact, tip)
    head = ["Written by `hardcontact new`; config/README.md explains every key.", _run(overlay)]
    texts = {overlay: overlay_text(head, choices, quick), table: table_text(rows)}
    write_files({ROOT / path: text for path, text in texts.items()})
    return "\n".join(_told(found, proposal, choices, overlay, table))


def _refuse_forces(path: str, surfaces: Sequence[str]) -> None:
    """Refuse own forces that the study would refuse."""
    try:
        measured_forces(path, surfaces)
    except ValueError as error:
        raise ValueError(str(error).replace("config key forces", "--forces")) from None


def _refuse_labels(arguments: Namespace) -> None:
    """Refuse labels that figures cannot have; the name of a study is one if files follow it."""
    label = read_yaml("workflow/schemas/surfaces.schema.yaml")["properties"]["label"]
    given = [("--surface", text) for text, *_ in arguments.surface]
    if arguments.files and not list(name_faults(arguments.name, True)):
        given.append(("NAME", arguments.name))
    refuse_all(
        partial(refuse, {f"{key}: label": text}, {"properties": {f"{key}: label": label}}, "")
        for key, text in given
    )


def _refuse_cells(rows: Sequence[Mapping[str, str]]) -> None:
    """Refuse paths and names of scans that the table of surfaces cannot have."""
    schema = read_yaml("workflow/schemas/surfaces.schema.yaml")
    # The label of a surface is refused by itself, not with each of its files.
    labelled = ({**row, "label": row["surface"]} for row in rows)
    refuse_all(partial(refuse, row, schema, f"{row['path']!r}: ") for row in labelled)


def _plan(
    arguments: Namespace, given: Mapping[str, Option], entries: Sequence[Entry]
) -> tuple[Proposal, list[Choice], list[Choice]]:
    """Return what is computed, all keys of the overlay and those that count at quick effort.

    The study itself would accept them.
    """
    load: Load = {"preload": given["preload"].number, "hardness": given["hardness"].number}
    probe = Probe(given["radius"].number, load, given["range"].number, given["range"].given)
    proposal = propose(entries, SPHERE if arguments.sphere else None, probe)
    choices = [*_named_choices(arguments, given), *proposal.choices]
    order = list(nested(choices, {}))
    choices.sort(key=lambda choice: order.index(choice.key.split(".")[0]))
    quick_name = arguments.name + QUICK_NAME
    quick = [
        Choice("study", quick_name, ""),
        # Masters of other pixels would take the place of those of the full effort.
        Choice("store", f"results/store-{quick_name}", ""),
        *proposal.quick,
    ]
    _check(proposal.contact, choices, quick)
    refuse_unreliable(entries)
    return proposal, choices, quick


def _named_choices(arguments: Namespace, given: Mapping[str, Option]) -> Iterator[Choice]:
    """Yield the keys that do not depend on what is in the scans."""
    name = arguments.name
    yield Choice("study", name, f"results go to results/{name}/")
    yield Choice("store", f"results/store-{name}", "intermediates")
    yield Choice("published", NONE, "nothing of the paper is needed or judged")
    yield Choice("surfaces", f"config/{name}.tsv", "one row a scan")
    if arguments.forces is not None:
        yield Choice("forces", path_from_root(arguments.forces), "own pull-off forces")
    surface, reason = (SPHERE, "its scans") if arguments.sphere else (SMOOTH, "no scans of it")
    yield Choice("sphere.surface", surface, reason)
    for option, (key, meaning) in QUANTITIES.items():
        if option != "range":  # which the scans may not permit
            source = "as given" if given[option].given else f"the paper's; --{option} changes it"
            yield Choice(key, given[option].text, f"{meaning}: {source}")


def _check(contact: Sequence[Entry], choices: Sequence[Choice], quick: Sequence[Choice]) -> None:
    """Refuse what the study would refuse of these scans, at both efforts."""
    grids: dict[str, Grid] = {}
    for entry in contact:
        first = grids.setdefault(entry.source.surface, entry.grid)
        relief = max(first.relief, entry.relief)
        grids[entry.source.surface] = first._replace(relief=relief)
    schema = read_yaml("workflow/schemas/config.schema.yaml")
    base = read_yaml("config/config.yaml")
    for keys in (choices, [*choices, *quick]):
        # What is wrong with keys that follow from the name is told of the name.
        others = [choice for choice in keys if choice.key not in ("study", "store")]
        check_grids(configuration(nested(others, base), schema), grids)


def _run(overlay: str) -> str:
    return f"snakemake --configfile {overlay}"


def _told(
    found: Found, proposal: Proposal, choices: Sequence[Choice], overlay: str, table: str
) -> Iterator[str]:
    """Yield the lines that tell what was found, chosen and written."""
    contact = {id(entry) for entry in proposal.contact}
    uses = [CONTACT if id(entry) in contact else SPECTRUM for entry in found.entries]
    yield "Found:"
    yield printed_table(found.entries, uses)
    labels = {entry.source.surface: entry.source.label for entry in found.entries}
    spelled = [f"{name} is {label}" for name, label in labels.items() if name != label]
    if spelled:
        yield f"\nIn tables, own forces and paths: {', '.join(spelled)}"
    if found.unreadable:
        yield "\nLeft out:"
        yield from found.unreadable
    yield "\nContacts are made on:"
    yield from proposal.reasons
    yield "\nChosen:"
    for key, value, reason in choices:
        shown = (
            f"{len(value)} values, {value[0]} to {value[-1]}" if isinstance(value, list) else value
        )
        yield f"{key}: {shown}" + (f" ({reason})" if reason else "")
    if proposal.cautions:
        yield "\nTake care:"
        yield from (f"- {caution}" for caution in proposal.cautions)
    yield f"\nWritten: {overlay}, {table}. Now run, in {ROOT}:"
    yield f"{_run(overlay)} --config effort=quick   # a first answer"
    yield _run(overlay)


def table_text(rows: Sequence[Mapping[str, str]]) -> str:
    """Return rows as a table, separated by tabs, with a header."""
    lines = [[*rows[0]], *([*row.values()] for row in rows)]
    return "\n".join("\t".join(cells) for cells in lines) + "\n"


def write_files(texts: Mapping[Path, str]) -> None:
    """Write all files or, of those that are not there yet, none: a ValueError of one line."""
    new = [path for path in texts if not path.exists()]
    try:
        with ExitStack() as files:
            for path, text in texts.items():
                Path(files.enter_context(whole_file(path))).write_text(text, "utf-8")
    except ValueError:
        for path in new:
            path.unlink(missing_ok=True)
        raise
