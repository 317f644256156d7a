"""The command `hardcontact new`: from files of scans to a study of own surfaces.

It reads the files, prints what they hold, chooses what to compute and writes an overlay and a table
of surfaces. It prints one line per problem, all at once, and then writes nothing.
"""

import sys
import textwrap
from argparse import Namespace
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Any

import yaml

from hardcontact.base.whole_file import whole_file
from hardcontact.config.configuration import read_yaml
from hardcontact.config.faults import refuse_all, refuse_lines, validated
from hardcontact.config.limits import check_grids
from hardcontact.config.model import NONE, SMOOTH, configuration
from hardcontact.config.selection import CONTACT, SurfaceRow
from hardcontact.config.tables import measured_forces
from hardcontact.contact.contact import Contact
from hardcontact.own.inventory import (
    SPECTRUM,
    Entry,
    by_surface,
    inventory,
    printed_table,
    table_rows,
)
from hardcontact.own.proposal import Choice, Proposal, propose, refuse_unreliable
from hardcontact.own.request import (
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

#: Characters of a line of an overlay.
WIDTH = 100


def main() -> int:
    """Carry out the command line, `new` or `predict`; return the exit code."""
    try:
        # A terminal would obey control characters, and no table holds what is no UTF-8.
        refuse_lines(
            f"{word!r}: expected printable characters in UTF-8, found others"
            for word in sys.argv[1:]
            if not word.isprintable()
        )
        if sys.argv[1:2] == ["predict"]:
            from hardcontact.own.predict import predict, predict_arguments

            print(predict(predict_arguments(sys.argv[2:])))
        else:
            print(new_study(parsed(sys.argv[1:])))
    except ValueError as error:
        for line in dict.fromkeys(str(error).splitlines()):
            print(f"error: {line}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("Stopped before anything was written.", file=sys.stderr)
        return 130
    return 0


def new_study(arguments: Namespace) -> str:
    """Write the files of a study of own surfaces; return what was found, chosen and written.

    Raises ValueError with a line for each problem; then nothing is written.
    """
    refuse_another_clone(Path.cwd())
    quantities, faults = options(arguments)
    files, file_faults = sources(arguments, quantities["radius"].number)
    tip = quantities.get("tip")
    tip_text = tip.text if tip else ""
    entries, unreadable, problems = inventory(
        files, tip.number if tip else None, arguments.channel, arguments.unit
    )
    faults += [*file_faults, *problems]
    checks: list[Callable[[], Any]] = [
        partial(refuse_lines, [*name_faults(arguments), *faults]),
        *_checks(arguments, table_rows(entries, [], tip_text), [file.surface for file in files]),
    ]
    if not faults:  # Otherwise problems would be reported that vanish once these are mended.
        checks.append(partial(_plan, arguments, quantities, entries))
    *_, (proposal, choices, quick) = refuse_all(checks)
    overlay, table = f"config/{arguments.name}.yaml", f"config/{arguments.name}.tsv"
    run = f"snakemake --configfile {overlay}"
    head = ["Written by `hardcontact new`; config/README.md explains every key.", run]
    rows = table_rows(entries, proposal.contact, tip_text)
    write_files(
        {ROOT / overlay: overlay_text(head, choices, quick), ROOT / table: table_text(rows)}
    )
    report = [
        *_report_lines(entries, unreadable, proposal, choices),
        f"\nWritten: {overlay}, {table}. Now run, in {ROOT}:",
        f"{run} --config effort=quick   # a first answer",
        run,
    ]
    return "\n".join(report)


def _checks(
    arguments: Namespace, rows: Sequence[Mapping[str, str]], surfaces: Sequence[str]
) -> Iterator[Callable[[], object]]:
    """Yield the checks of cells of the table and of own forces."""
    for row in rows:  # The label of a surface is refused by itself, not with each of its files.
        cells = {**row, "label": row["surface"]}
        yield partial(validated, SurfaceRow, cells, f"{row['path']!r}: ")
    if arguments.forces is not None:
        substrates = [surface for surface in dict.fromkeys(surfaces) if surface != SPHERE]
        yield partial(measured_forces, arguments.forces, substrates, "--forces")


def _plan(
    arguments: Namespace, quantities: Mapping[str, Option], entries: Sequence[Entry]
) -> tuple[Proposal, list[Choice], list[Choice]]:
    """Return the proposal, all keys of the overlay and those that count at quick effort.

    Raises ValueError if the study would refuse these scans at either effort.
    """
    probe = Contact(
        radius=quantities["radius"].number,
        preload=quantities["preload"].number,
        hardness=quantities["hardness"].number,
        range=quantities["range"].number,
    )
    sphere = SPHERE if arguments.sphere else None
    proposal = propose(entries, sphere, probe, quantities["range"].given)
    choices = [*_named_choices(arguments, quantities), *proposal.choices]
    order = list(nested(choices, {}))
    choices.sort(key=lambda choice: order.index(choice.key.split(".")[0]))
    quick_name = arguments.name + QUICK_NAME
    quick = [
        Choice("study", quick_name, ""),
        # Masters of other pixels would take the place of those of the full effort.
        Choice("store", f"results/store-{quick_name}", ""),
        *proposal.quick,
    ]
    grids = {
        surface: scans[0].grid._replace(relief=max(scan.relief for scan in scans))
        for surface, scans in by_surface(proposal.contact).items()
    }
    paper = read_yaml("config/config.yaml")
    for keys in (choices, [*choices, *quick]):
        # Faults of keys that follow from the name are those of the name.
        others = [choice for choice in keys if choice.key not in ("study", "store")]
        check_grids(configuration(nested(others, paper)), grids)
    refuse_unreliable(entries)
    return proposal, choices, quick


def _named_choices(arguments: Namespace, quantities: Mapping[str, Option]) -> Iterator[Choice]:
    """Yield the keys that do not depend on the scans."""
    name = arguments.name
    yield Choice("study", name, f"results go to results/{name}/")
    yield Choice("store", f"results/store-{name}", "intermediates")
    yield Choice("published", NONE, "nothing of the paper is needed or judged")
    yield Choice("surfaces", f"config/{name}.tsv", "one row a scan")
    if arguments.unit != NONE:
        yield Choice("scan.unit", arguments.unit, "as given, of files that state none")
    if arguments.forces is not None:
        yield Choice("forces", path_from_root(arguments.forces), "own pull-off forces")
    surface, reason = (SPHERE, "its scans") if arguments.sphere else (SMOOTH, "no scans of it")
    yield Choice("sphere.surface", surface, reason)
    for option, (key, meaning) in QUANTITIES.items():
        if option != "range":  # which the scans may not permit
            quantity = quantities[option]
            origin = "as given" if quantity.given else f"the paper's; --{option} changes it"
            yield Choice(key, quantity.text, f"{meaning}: {origin}")


def _report_lines(
    entries: Sequence[Entry], unreadable: list[str], proposal: Proposal, choices: Sequence[Choice]
) -> Iterator[str]:
    """Yield the lines that say what was found and chosen."""
    contact = {id(entry) for entry in proposal.contact}
    yield "Found:"
    yield printed_table(
        entries, [CONTACT if id(entry) in contact else SPECTRUM for entry in entries]
    )
    labels = {entry.source.surface: entry.source.label for entry in entries}
    renamed = [f"{surface} is {label}" for surface, label in labels.items() if surface != label]
    if renamed:
        yield f"\nIn tables, own forces and paths: {', '.join(renamed)}"
    if unreadable:
        yield "\nLeft out:"
        yield from unreadable
    yield "\nContacts are made on:"
    yield from proposal.reasons
    yield "\nChosen:"
    for key, value, reason in choices:
        if isinstance(value, list):
            value = f"{len(value)} values, {value[0]} to {value[-1]}"
        yield f"{key}: {value}" + (f" ({reason})" if reason else "")
    if proposal.cautions:
        yield "\nTake care:"
        yield from (f"- {caution}" for caution in proposal.cautions)


def nested(choices: Sequence[Choice], base: Mapping[str, Any]) -> dict[str, Any]:
    """Return a copy of a configuration with the values of choices, of several the last."""
    config = dict(base)
    for key, value, _ in choices:
        *sections, name = key.split(".")
        section = config
        for part in sections:
            section[part] = dict(section.get(part, {}))
            section = section[part]
        section[name] = value
    return config


def overlay_text(head: Sequence[str], choices: Sequence[Choice], quick: Sequence[Choice]) -> str:
    """Return an overlay with a comment for every choice that has a reason, as YAML.

    Below the lines of a head stand the keys of the study, and those that count with `effort:
    quick`. Choices of one section follow each other.
    """
    quick_keys = [choice._replace(key=f"quick.{choice.key}") for choice in quick]
    lines = [*(f"# {line}" for line in head), "", *_keys(choices)]
    lines += ["", "# With --config effort=quick these replace those above.", *_keys(quick_keys)]
    return "\n".join(lines) + "\n"


def _keys(choices: Sequence[Choice]) -> Iterator[str]:
    """Yield the lines of choices below those of their sections."""
    above: list[str] = []
    for key, value, reason in choices:
        *sections, name = key.split(".")
        for depth, section in enumerate(sections):
            if above[: depth + 1] != sections[: depth + 1]:
                yield f"{depth * '  '}{section}:"
        above = sections
        yield from _commented(len(sections) * "  ", name, value, reason)


def _commented(indent: str, name: str, value: object, reason: str) -> list[str]:
    """Return a key with its value, and its reason beside it or, if that is too long, above it."""
    lines = [f"{indent}{name}: {_scalar(value)}"]
    if isinstance(value, list):
        # An item stays on one line: its spaces are no places to break at.
        items = ", ".join(_scalar(item).replace(" ", "\0") for item in value)
        lines = [line.replace("\0", " ") for line in _wrapped(f"{name}: [{items}]", indent, "  ")]
    beside = f"{lines[0]:32} # {reason}"
    if reason and len(lines) == 1 and len(beside) <= WIDTH:
        return [beside]
    return [*_wrapped(reason, f"{indent}# "), *lines]


def _wrapped(text: str, indent: str, hanging: str = "") -> list[str]:
    return textwrap.wrap(text, WIDTH, initial_indent=indent, subsequent_indent=f"{indent}{hanging}")


def _scalar(value: object) -> str:
    text = yaml.safe_dump([value], default_flow_style=True, allow_unicode=True, width=2**20)
    return str(text).strip()[1:-1]


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
