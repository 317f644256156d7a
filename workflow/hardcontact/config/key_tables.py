"""Write the configuration of the paper and the table of columns in `config/README.md`.

``python -m hardcontact.config.key_tables``, in the top folder, writes both.
"""

import textwrap
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Literal, get_args, get_origin

import yaml
from pydantic.fields import FieldInfo

from hardcontact.config.configuration import set_keys
from hardcontact.config.faults import key_fields, section_model
from hardcontact.config.key_types import Matching, Quantity
from hardcontact.config.keys import Study
from hardcontact.config.selected_surfaces import SurfaceRow

YAML_HEADER = """\
# The paper: the defaults of the study, made from workflow/hardcontact/config/keys.py by
# python -m hardcontact.config.key_tables
# Above each key: its meaning; the section of the paper with the default; the values allowed.
# Another study: a file with the few keys that differ, given as
# snakemake --configfile my-study.yaml
"""
#: Accepted values in words, by type.
VALUES_IN_WORDS = {bool: "`true` or `false`", dict[Any, Any]: "a mapping", list[int]: "a list"}


def configuration_yaml() -> str:
    """Return all keys as YAML, below their meanings, sections of the paper and values."""
    fields = dict(key_fields(Study))
    comments = {
        key: f"{_meaning(field)}{_paper_section(field)} Allowed: {_values(field)}."
        for key, field in fields.items()
    }
    for section in {key.rpartition(".")[0] for key in fields} - {""}:
        comments[section] = str(section_model(Study, section.split(".")).__doc__)
    tree = set_keys({}, {key: field.default for key, field in fields.items()})
    return "\n".join([YAML_HEADER, *commented_yaml(tree, comments)]) + "\n"


def update_columns(text: str) -> str:
    """Return Markdown with a new table of columns."""
    begin, end = "<!-- columns: begin -->\n", "<!-- columns: end -->\n"
    fields = SurfaceRow.model_fields.items()
    rows = [f"| `{name}` | {_meaning(field)} | {_values(field)} |" for name, field in fields]
    table = "\n".join(["| column | meaning | values |", "| --- | --- | --- |", *rows])
    head, _, tail = text.partition(begin)
    return f"{head}{begin}\n{table}\n\n{end}{tail.partition(end)[2]}"


def _meaning(field: FieldInfo) -> str:
    """Return the docstring of a field on one line."""
    return " ".join(str(field.description).split())


def _paper_section(field: FieldInfo) -> str:
    """Return a sentence that names the section of the paper with a default, if any."""
    extra: Any = field.json_schema_extra or {}
    return f" Paper: {extra['paper']}." if extra.get("paper") else ""


def commented_yaml(
    tree: Mapping[str, Any], comments: Mapping[str, str], prefix: str = ""
) -> Iterator[str]:
    """Yield the lines of a configuration, or of a section with its prefix, with comments by key."""
    indent = "  " * prefix.count(".")
    for name, value in tree.items():
        is_section = isinstance(value, dict) and bool(value)
        if is_section:
            yield ""
        comment = textwrap.wrap(comments.get(f"{prefix}{name}", ""), 96)
        yield from (f"{indent}# {line}" for line in comment)
        yield f"{indent}{name}:" if is_section else f"{indent}{name}: {_inline_yaml(value)}"
        if is_section:
            yield from commented_yaml(value, comments, f"{prefix}{name}.")


def _values(field: FieldInfo) -> str:
    """Return the accepted values of a field in words, with their unit."""
    for item in field.metadata:
        if isinstance(item, Quantity | Matching):
            return item.expects
    annotation: Any = field.annotation
    if get_origin(annotation) is Literal:
        return " or ".join(f"`{value}`" for value in get_args(annotation) if value)
    if annotation in VALUES_IN_WORDS:
        return VALUES_IN_WORDS[annotation]
    if get_origin(annotation) is list:
        return f"a list: {_values(FieldInfo.from_annotation(get_args(annotation)[0]))}"
    names = ("ge", "le", "multiple_of")
    low, high, *steps = (
        getattr(item, name) for name in names for item in field.metadata if hasattr(item, name)
    )
    return f"{low} to {high}" + "".join(f", a multiple of {step}" for step in steps)


def _inline_yaml(value: Any) -> str:
    """Return a value as YAML on one line."""
    text: str = yaml.safe_dump([value], default_flow_style=True, allow_unicode=True, width=2**20)
    return text.strip()[1:-1]


if __name__ == "__main__":
    Path("config/config.yaml").write_text(configuration_yaml(), "utf-8")
    readme = Path("config/README.md")
    readme.write_text(update_columns(readme.read_text("utf-8")), "utf-8")
