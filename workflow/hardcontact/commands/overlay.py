"""The files of a study of own surfaces: its overlay and its table of surfaces, as text.

They are written whole or not at all.
"""

import textwrap
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import yaml

from hardcontact.commands.inventory import Entry
from hardcontact.commands.proposal import Choice
from hardcontact.config.selection import CONTACT
from hardcontact.records.whole_file import whole_file

__all__ = ["SPECTRUM", "nested", "overlay_text", "table_rows", "table_text", "write_files"]

#: The use of scans that only enter the spectrum of their surface.
SPECTRUM = "spectrum"
#: Characters of a line.
WIDTH = 100


def nested(choices: Sequence[Choice], base: Mapping[str, Any]) -> dict[str, Any]:
    """Return a configuration with the values of choices in the place of its own.

    Parameters
    ----------
    choices : sequence of Choice
        Later ones replace earlier ones.
    base : mapping
        As YAML gives it; unchanged.

    Returns
    -------
    dict
        With every key of both.
    """
    config = dict(base)
    for key, value, _ in choices:
        *branch, last = key.split(".")
        place = config
        for part in branch:
            place[part] = place = dict(place.get(part, {}))
        place[last] = value
    return config


def overlay_text(head: Sequence[str], choices: Sequence[Choice], quick: Sequence[Choice]) -> str:
    """Return an overlay with a comment for every choice that has a reason.

    Parameters
    ----------
    head : sequence of str
        Lines of the comment at the top.
    choices, quick : sequence of Choice
        Keys of the study, and those that count with `effort: quick`.

    Returns
    -------
    str
        YAML.
    """
    of_quick = [choice._replace(key=f"quick.{choice.key}") for choice in quick]
    lines = [f"# {line}" for line in head]
    lines += ["", *_section(choices), "", "# With --config effort=quick these replace those above."]
    return "\n".join([*lines, *_section(of_quick)]) + "\n"


def _section(choices: Sequence[Choice], depth: int = 0) -> Iterator[str]:
    """Yield the lines of choices whose keys are the same up to one depth."""
    groups: dict[str, list[Choice]] = {}
    for choice in choices:
        groups.setdefault(choice.key.split(".")[depth], []).append(choice)
    indent = depth * "  "
    for name, group in groups.items():
        if group[0].key.count(".") > depth:
            yield f"{indent}{name}:"
            yield from _section(group, depth + 1)
        else:
            yield from _commented(f"{indent}{name}: ", indent, group[0])


def _commented(start: str, indent: str, choice: Choice) -> Iterator[str]:
    """Yield a key with its value, and its reason beside it or, if that is too long, above it."""
    lines = _value_lines(start, indent, choice.value)
    beside = f"{lines[0]:32} # {choice.reason}"
    if choice.reason and len(lines) == 1 and len(beside) <= WIDTH:
        yield beside
        return
    if choice.reason:
        comment = f"{indent}# "
        yield from textwrap.wrap(
            choice.reason, WIDTH, initial_indent=comment, subsequent_indent=comment
        )
    yield from lines


def _value_lines(start: str, indent: str, value: object) -> list[str]:
    """Return a key and its value as YAML, long lists on several lines."""
    if not isinstance(value, list):
        return [start + _scalar(value)]
    # An item stays on one line: its spaces are no places to break at.
    items = ", ".join(_scalar(item).replace(" ", "\0") for item in value)
    text = f"{start.strip()} [{items}]"
    hanging = f"{indent}  "
    lines = textwrap.wrap(text, WIDTH, initial_indent=indent, subsequent_indent=hanging)
    return [line.replace("\0", " ") for line in lines]


def _scalar(value: object) -> str:
    text = yaml.safe_dump([value], default_flow_style=True, allow_unicode=True, width=2**20)
    return str(text).strip()[1:-1]


def table_rows(
    entries: Sequence[Entry], contact: Sequence[Entry], tip_radius: str
) -> list[dict[str, str]]:
    """Return the rows of the table of surfaces; the scans that make contacts come first.

    Parameters
    ----------
    entries : sequence of Entry
        Of all surfaces.
    contact : sequence of Entry
        Those that contacts are made on.
    tip_radius : str
        A quantity that the user gave for scans whose files state none, or nothing.

    Returns
    -------
    list of dict
        Text by column, surface by surface in the order of the entries.
    """
    surfaces = list(dict.fromkeys(entry.source.surface for entry in entries))
    uses = {True: CONTACT, False: SPECTRUM}
    rows = []
    for surface in surfaces:
        of_it = [entry for entry in entries if entry.source.surface == surface]
        ordered = sorted(of_it, key=lambda entry: not _among(entry, contact))
        for number, entry in enumerate(ordered, 1):
            rows.append(
                {
                    "surface": surface,
                    "label": entry.source.label,
                    "scan": str(number),
                    "source": "measured",
                    "path": entry.source.path,
                    "dataset": entry.dataset,
                    "use": uses[_among(entry, contact)],
                    "tip_radius": tip_radius if entry.tip_given else "",
                }
            )
    return rows


def _among(entry: Entry, others: Sequence[Entry]) -> bool:
    return any(entry is other for other in others)


def table_text(rows: Sequence[Mapping[str, str]]) -> str:
    """Return rows as a table, separated by tabs, with a header."""
    lines = [[*rows[0]], *([*row.values()] for row in rows)]
    return "\n".join("\t".join(cells) for cells in lines) + "\n"


def write_files(texts: Mapping[Path, str]) -> None:
    """Write all files or, of those that are not there yet, none.

    Parameters
    ----------
    texts : mapping
        Text by file; files that are there are replaced.

    Raises
    ------
    ValueError
        In one line, if a file cannot be written.
    """
    new = [path for path in texts if not path.exists()]
    try:
        with ExitStack() as files:
            for path, text in texts.items():
                Path(files.enter_context(whole_file(path))).write_text(text, "utf-8")
    except ValueError:
        for path in new:
            path.unlink(missing_ok=True)
        raise
