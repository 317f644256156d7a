"""Read YAML files and tables, and refuse those of the user with a line for each fault."""

import csv
import io
import math
import os
import re
from collections.abc import Callable, Collection, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, NamedTuple, TypeVar

import yaml
from pydantic import Field, WrapValidator

from hardcontact.config.faults import Model, quote_key, raise_faults, validate
from hardcontact.records.code import ROOT

#: Largest size of a table: about a hundred thousand rows.
MAX_TABLE_BYTES = 10_000_000
#: A number with a decimal comma.
DECIMAL_COMMA = re.compile(r"^([-+]?\d*),(\d+(?:[eE][-+]?\d+)?)$")
#: Cells by the name of their column.
Row = Mapping[str, str]
Result = TypeVar("Result")
#: A cell with a number, or a blank cell, which is NaN.
BLANK_AS_NAN = WrapValidator(lambda cell, parse: parse(cell) if cell else math.nan)
NumberCell = Annotated[float, Field(strict=False), BLANK_AS_NAN]


def read_yaml(path: str) -> Any:
    """Return a YAML file of the project, by its path from the top folder."""
    return yaml.safe_load((ROOT / path).read_text("utf-8"))


def refuse_unreadable(path: str | Path) -> None:
    """Refuse a file that is no YAML with keys at its top."""
    if not Path(path).exists():
        raise ValueError(
            f"{path}: expected a YAML file, found none (targets stand before --configfile)"
        )
    try:
        content = yaml.load(Path(path).read_bytes().decode("utf-8"), _StrictLoader)
        reason = quote_key(content) if content is not None else "nothing"
    except (OSError, RecursionError, ValueError, yaml.YAMLError) as error:
        text = " ".join(str(error).split())[:150]
        content = None
        reason = text if text.isprintable() else ascii(text)
    if not isinstance(content, dict):
        raise ValueError(f"{path}: expected YAML with keys at its top, found: {reason}")


class _StrictLoader(yaml.SafeLoader):
    """A loader that refuses repeated keys, of which YAML uses the last value."""

    def construct_mapping(self, node: Any, deep: bool = False) -> dict[Any, Any]:
        """Return the mapping of a node."""
        names = set[str]()
        for key, _ in node.value:
            name = str(key.value)
            if name in names:
                problem = f"the key {quote_key(name)} again"
                raise yaml.MarkedYAMLError(problem=problem, problem_mark=key.start_mark)
            names.add(name)
        return super().construct_mapping(node, deep)


class UserTable(NamedTuple):
    """A table that the user wrote: its header, and the cells of rows by line of the file."""

    path: str
    header: list[str]
    cells: dict[int, list[str]]

    def require_columns(
        self, columns: Sequence[str], content: str, allowed: Collection[str] | None = None
    ) -> None:
        """Refuse a table without rows, or with a missing or repeated column, or one not allowed."""
        complete = set(columns) <= set(self.header) <= set(allowed or self.header)
        if not (self.cells and complete and len(set(self.header)) == len(self.header)):
            header = quote_key(", ".join(self.header))
            raise ValueError(
                f"{self.path}: expected {content}, found {header} and {len(self.cells)} rows"
            )

    def map_rows(self, function: Callable[[Row], Result]) -> dict[int, Result]:
        """Return the results of a function of each row, by line; refuse a table with faulty rows.

        Faults that differ only in what was found make one line of the message. It names the first
        row and counts the others.
        """
        results = dict[int, Result]()
        faults = dict[str, list[tuple[int, str]]]()
        for line, cells in self.cells.items():
            try:
                if len(cells) != len(self.header):
                    too_many = len(cells) > len(self.header)
                    hint = "; decimal commas need semicolons between cells" if too_many else ""
                    raise ValueError(f"expected {len(self.header)} cells, found {len(cells)}{hint}")
                results[line] = function(dict(zip(self.header, cells, strict=True)))
            except ValueError as error:
                for text in str(error).splitlines():
                    faults.setdefault(text.partition(", found ")[0], []).append((line, text))
        raise_faults(
            f"{self.path}: line {line}{f' and {len(others)} more' if others else ''}: {text}"
            for (line, text), *others in faults.values()
        )
        return results


def decode_utf8(content: bytes) -> str:
    """Return a text in UTF-8, with or without a byte-order mark."""
    return content.decode("utf-8-sig")


def user_table(
    path: str | Path,
    content: str,
    *,
    form: str = "a CSV",
    separator: str = ",",
    decode: Callable[[bytes], str] = decode_utf8,
) -> UserTable:
    """Read a table that the user wrote; messages name the required content and form.

    Semicolons or tabs may separate cells, and decimals may then have a comma, as in spreadsheets.
    """
    if not os.path.isfile(path):
        raise ValueError(f"{path}: expected {content}, found no file")
    if os.path.getsize(path) > MAX_TABLE_BYTES:
        raise ValueError(
            f"{path}: expected {content}, of at most {MAX_TABLE_BYTES / 1e6:g} MB, found "
            f"{os.path.getsize(path) / 1e6:.0f} MB"
        )
    try:
        text = decode(Path(path).read_bytes())
        head = text.partition("\n")[0]
        cell_separator = next((mark for mark in (separator, ";", "\t") if mark in head), separator)
        reader = csv.reader(
            io.StringIO(text, newline=None),
            strict=True,
            delimiter=cell_separator,
            quoting=csv.QUOTE_NONE if cell_separator == "\t" else csv.QUOTE_MINIMAL,
        )
        rows = [(reader.line_num, [cell.strip() for cell in row]) for row in reader]
        if cell_separator != separator:
            for _, cells in rows:
                cells[:] = [DECIMAL_COMMA.sub(r"\1.\2", cell) for cell in cells]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise ValueError(f"{path}: expected {form} in UTF-8, found: {error}") from None
    written_rows = [(line, cells) for line, cells in rows if any(cells)]
    return UserTable(str(path), written_rows[0][1] if written_rows else [], dict(written_rows[1:]))


def read_rows(
    path: str | Path, model: type[Model], content: str, **options: Any
) -> dict[int, Model]:
    """Return the rows of a table as instances of a model, by line of the file.

    `content` describes the table, with ``{}`` for its columns; `options` are those of `user_table`.
    """
    fields = model.model_fields
    columns = [name for name, field in fields.items() if field.is_required()]
    allowed = fields if model.model_config["extra"] == "forbid" else None
    content = content.format(", ".join(columns))
    table = user_table(path, content, **options)
    table.require_columns(columns, content, allowed)
    return table.map_rows(lambda row: validate(model, row))


def parse_number(cell: str) -> float:
    """Return the number in a cell; NaN if the cell has none."""
    try:
        return float(cell)
    except ValueError:
        return math.nan
