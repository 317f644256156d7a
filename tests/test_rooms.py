"""The rooms of the library: each imports only from itself and from those before it."""

import ast
import io
import re
import tokenize

import pytest
from repository import ROOT

import hardcontact

LIBRARY = ROOT / "workflow/hardcontact"
#: Rooms in the order of the library's docstring.
ROOMS = re.findall(r"`(\w+)`", hardcontact.__doc__)
#: Code lines that the library may have, without docstrings, comments and blank lines. A commit that
#: raises it says what a user gets for it.
MAX_CODE_LINES = 17_700
NO_CODE = {
    tokenize.COMMENT,
    tokenize.NL,
    tokenize.NEWLINE,
    tokenize.INDENT,
    tokenize.DEDENT,
    tokenize.ENDMARKER,
}


def room_modules(room):
    """The modules of a room, or the module that is one."""
    return list((LIBRARY / room).rglob("*.py")) or [LIBRARY / f"{room}.py"]


def code_lines(source):
    """The number of lines with code: docstrings, comments and blank lines do not count."""
    lines = set()
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type not in NO_CODE:
            lines |= set(range(token.start[0], token.end[0] + 1))
    for node in ast.walk(ast.parse(source)):
        documented = (ast.Module, ast.ClassDef, ast.FunctionDef)
        if isinstance(node, documented) and ast.get_docstring(node) is not None:
            lines -= set(range(node.body[0].lineno, node.body[0].end_lineno + 1))
    return len(lines)


def imported(path):
    """Yield the names that a module imports, wherever in the module."""
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.ImportFrom):
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)


def test_the_docstring_names_every_room():
    rooms = {path.stem for path in LIBRARY.glob("[a-z]*") if not path.name.startswith("py.")}
    assert rooms == set(ROOMS) and len(ROOMS) == len(rooms)


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_imports_from_those_before_it(room):
    allowed_rooms = set(ROOMS[: ROOMS.index(room) + 1])
    for path in room_modules(room):
        names = [name for name in imported(path) if name.startswith("hardcontact.")]
        assert {name.split(".")[1] for name in names} <= allowed_rooms, path


def test_the_library_does_not_grow():
    count = sum(code_lines(path.read_text("utf-8")) for path in LIBRARY.rglob("*.py"))
    assert count <= MAX_CODE_LINES, "raise it here, and say in the commit what a user gets for it"


def test_only_the_start_of_a_run_imports_snakemake():
    paths = {
        path.relative_to(LIBRARY).as_posix()
        for path in LIBRARY.rglob("*.py")
        if any(name.partition(".")[0] == "snakemake" for name in imported(path))
    }
    assert paths == {"run/reruns.py", "run/start.py"}
