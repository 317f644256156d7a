"""The tables of `config/README.md`, made from the models of the configuration.

``python -m hardcontact.config.key_tables``, in the top folder, writes them between their markers.
"""

import ast
import inspect
from collections.abc import Iterator, Sequence
from itertools import pairwise
from pathlib import Path
from types import ModuleType
from typing import Any, Literal, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from hardcontact.config import model, selection

README = Path("config/README.md")
COLUMNS = ("key", "meaning", "values", "default", "paper", "recomputes")
#: Lists of more entries are given by their number, first and last entry.
LIST_LIMIT = 4
#: Values of keys whose types have no bounds.
VALUES = {"scans": "`all` or a list: 1 to 9999", "quick": "a mapping"}


def documented(text: str) -> str:
    """Return Markdown with its tables made anew: of keys, of columns of a table of surfaces.

    They stand between the lines ``<!-- NAME: begin -->`` and ``<!-- NAME: end -->``, for the names
    ``keys`` and ``columns``.
    """
    text = _inserted(text, "keys", "\n\n".join(_sections()))
    meanings = _meanings(selection)
    rows = [
        (f"`{name}`", meanings["SurfaceRow", name], _values(field))
        for name, field in selection.SurfaceRow.model_fields.items()
    ]
    return _inserted(text, "columns", _table(("column", "content", "values"), rows))


def _inserted(text: str, name: str, lines: str) -> str:
    begin, end = f"<!-- {name}: begin -->\n", f"<!-- {name}: end -->\n"
    before, _, after = text.partition(begin)
    return f"{before}{begin}\n{lines}\n\n{end}{after.partition(end)[2]}"


def _meanings(module: ModuleType) -> dict[tuple[str, str], str]:
    """Return the string below each field of the models of a module, by their names."""
    return {
        (part.name, field.target.id): " ".join(str(string.value.value).split())
        for part in ast.parse(inspect.getsource(module)).body
        if isinstance(part, ast.ClassDef)
        for field, string in pairwise(part.body)
        if isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name)
        if isinstance(string, ast.Expr) and isinstance(string.value, ast.Constant)
    }


def _sections() -> Iterator[str]:
    """Yield heading, table and text of the keys at the top, and of each section of keys."""
    meanings = _meanings(model)
    sections: dict[str, type[BaseModel]] = {"": model.Study, **_subsections(model.Study)}
    for prefix, section in sections.items():
        heading, *texts = inspect.cleandoc(str(section.__doc__)).split("\n\n")
        yield f"### {heading.rstrip('.')}"
        rows = [_cells(*row, meanings) for row in _keys(prefix, section, nested=bool(prefix))]
        yield _table(COLUMNS, rows)
        yield from (" ".join(text.split()) for text in texts)


def _subsections(section: type[BaseModel]) -> dict[str, type[BaseModel]]:
    """Return the sections of a section, by their names with a dot."""
    parts = {f"{name}.": field.annotation for name, field in section.model_fields.items()}
    return {
        name: part
        for name, part in parts.items()
        if isinstance(part, type) and issubclass(part, BaseModel)
    }


def _keys(
    prefix: str, section: type[BaseModel], *, nested: bool
) -> Iterator[tuple[str, str, str, FieldInfo]]:
    """Yield full name, model, name and field of the keys of a section, of all levels if nested."""
    subsections = _subsections(section)
    for name, field in section.model_fields.items():
        if f"{name}." not in subsections:
            yield f"{prefix}{name}", section.__name__, name, field
        elif nested:
            yield from _keys(f"{prefix}{name}.", subsections[f"{name}."], nested=True)


def _cells(
    key: str, owner: str, name: str, field: FieldInfo, meanings: dict[tuple[str, str], str]
) -> tuple[str, ...]:
    about: Any = field.json_schema_extra
    values = VALUES.get(key) or _values(field)
    default = _default(field.default)
    return f"`{key}`", meanings[owner, name], values, default, about["paper"], about["recomputes"]


def _table(columns: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [columns, ["---"] * len(columns), *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def _values(field: FieldInfo) -> str:
    """Return which values a field may have, with their unit."""
    for part in field.metadata:
        if isinstance(part, model.Quantity | model.Matching):
            return part.expects
    kind: Any = field.annotation
    if get_origin(kind) is Literal:
        return " or ".join(_code(value) for value in get_args(kind) if value)
    if get_origin(kind) is list:
        return f"a list: {_values(FieldInfo.from_annotation(get_args(kind)[0]))}"
    if kind is bool:
        return "`true` or `false`"
    limits = {
        name: getattr(part, name)
        for part in field.metadata
        for name in ("ge", "le", "multiple_of")
        if hasattr(part, name)
    }
    multiple = f", a multiple of {limits['multiple_of']}" if "multiple_of" in limits else ""
    return f"{limits['ge']} to {limits['le']}{multiple}"


def _default(value: Any) -> str:
    if isinstance(value, list) and len(value) > LIST_LIMIT:
        return f"{len(value)} values, {_code(value[0])} to {_code(value[-1])}"
    return f"`[{', '.join(map(str, value))}]`" if isinstance(value, list) else _code(value)


def _code(value: Any) -> str:
    return f"`{str(value).lower() if isinstance(value, bool) else value}`"


if __name__ == "__main__":
    README.write_text(documented(README.read_text("utf-8")), "utf-8")
