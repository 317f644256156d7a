"""The overlay of a study of own surfaces: what is chosen, as text with its reasons."""

import textwrap
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import yaml

#: Characters of a line.
WIDTH = 100


class Choice(NamedTuple):
    """A value that is chosen, as YAML has it: its key with dots, and a reason or nothing."""

    key: str
    value: object
    reason: str


def nested(choices: Sequence[Choice], base: Mapping[str, Any]) -> dict[str, Any]:
    """Return a configuration with the values of choices, the last of several, for its own."""
    config = dict(base)
    for key, value, _ in choices:
        *branch, last = key.split(".")
        place = config
        for part in branch:
            place[part] = place = dict(place.get(part, {}))
        place[last] = value
    return config


def overlay_text(head: Sequence[str], choices: Sequence[Choice], quick: Sequence[Choice]) -> str:
    """Return an overlay with a comment for every choice that has a reason, as YAML.

    Below the lines of a head stand the keys of the study, and those that count with `effort:
    quick`.
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
