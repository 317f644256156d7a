"""The tables of `config/README.md`, made from the schemas of the configuration.

``python -m hardcontact.config.key_tables``, in the top folder, writes them between their markers.
"""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import yaml

from hardcontact.config.schema import Schema, resolved

README = Path("config/README.md")
SCHEMAS = Path("workflow/schemas")
#: Lists of more entries are given by their number, first and last entry.
LIST_LIMIT = 4


def documented(text: str, keys: Schema, columns: Schema) -> str:
    """Return Markdown with its tables made anew: of keys, of columns of a table of surfaces.

    They stand between the lines ``<!-- NAME: begin -->`` and ``<!-- NAME: end -->``, for the names
    ``keys`` and ``columns``.
    """
    text = _inserted(text, "keys", "\n\n".join(_sections(keys)))
    cells = [
        (f"`{name}`", part["description"], _values(part))
        for name, part in columns["properties"].items()
    ]
    return _inserted(text, "columns", _table(("column", "content", "values"), cells))


def _inserted(text: str, name: str, lines: str) -> str:
    begin, end = f"<!-- {name}: begin -->\n", f"<!-- {name}: end -->\n"
    before, _, rest = text.partition(begin)
    return f"{before}{begin}\n{lines}\n\n{end}{rest.partition(end)[2]}"


def _sections(schema: Schema) -> Iterator[str]:
    """Give heading, text and table of the keys at the top, and of each group of keys below."""
    parts = schema["properties"].items()
    at_top = {key: part for key, part in parts if "properties" not in part}
    groups = {f"{key}.": part for key, part in parts if "properties" in part}
    for prefix, group in {"": {"title": "The study", "properties": at_top}, **groups}.items():
        columns = ("key", "meaning", "values", "default", "paper", "recomputes")
        cells = [_cells(name, part) for name, part in _keys(group, prefix, schema)]
        yield f"### {group['title']}"
        yield _table(columns, cells)
        if "description" in group:
            yield group["description"]


def _keys(group: Schema, prefix: str, root: Schema) -> Iterator[tuple[str, Schema]]:
    """Give the full name and the schema of every key of a group, without references."""
    for name, part in group["properties"].items():
        if "properties" in part:
            yield from _keys(part, f"{prefix}{name}.", root)
        else:
            yield f"{prefix}{name}", _without_references(part, root)


def _without_references(schema: Schema, root: Schema) -> Schema:
    whole = {**resolved(schema, root)}
    if "items" in whole:
        whole["items"] = _without_references(whole["items"], root)
    if "oneOf" in whole:
        whole["oneOf"] = [_without_references(choice, root) for choice in whole["oneOf"]]
    return whole


def _cells(name: str, schema: Schema) -> tuple[str, ...]:
    return (
        f"`{name}`",
        schema["description"],
        _values(schema),
        _default(schema["default"]),
        schema.get("paper", ""),
        schema["recomputes"],
    )


def _table(columns: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [columns, ["---"] * len(columns), *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def _values(schema: Schema) -> str:
    """Return which values a key may have, with their unit."""
    if choices := _choices(schema):
        return " or ".join(choices)
    if "unit" in schema:
        low, high = schema["between"]
        return f"{low:g} to {high:g} {schema['unit']}"
    if "minimum" in schema:
        multiple = f", a multiple of {schema['multipleOf']}" if "multipleOf" in schema else ""
        most = f"to {schema['maximum']}" if "maximum" in schema else "or more"
        return f"{schema['minimum']} {most}{multiple}"
    if schema["type"] == "array":
        return f"a list: {_values(schema['items'])}"
    return str(schema["title"] if "title" in schema else schema["expects"])


def _choices(schema: Schema) -> list[str]:
    if "oneOf" in schema:
        return [_values(choice) for choice in schema["oneOf"] if choice.get("const") != ""]
    if schema.get("type") == "boolean":
        return [_code(True), _code(False)]
    constants = [schema["const"]] if "const" in schema else []
    return [_code(value) for value in schema.get("enum", constants) if value != ""]


def _default(value: Any) -> str:
    if isinstance(value, list) and len(value) > LIST_LIMIT:
        return f"{len(value)} values, {_code(value[0])} to {_code(value[-1])}"
    return f"`[{', '.join(map(str, value))}]`" if isinstance(value, list) else _code(value)


def _code(value: Any) -> str:
    return f"`{str(value).lower() if isinstance(value, bool) else value}`"


def main() -> None:
    """Write the tables of the documentation, in the top folder."""
    keys, columns = (
        yaml.safe_load((SCHEMAS / f"{name}.schema.yaml").read_text("utf-8"))
        for name in ("config", "surfaces")
    )
    README.write_text(documented(README.read_text("utf-8"), keys, columns), "utf-8")


if __name__ == "__main__":
    main()
