"""The rooms of the library: each imports only from itself and from those before it."""

import ast
import re

import pytest
from repository import ROOT

import hardcontact

LIBRARY = ROOT / "workflow/hardcontact"
#: Rooms in the order of the library's docstring.
ROOMS = re.findall(r"`(\w+)`", hardcontact.__doc__)


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
    modules = list((LIBRARY / room).rglob("*.py")) or [LIBRARY / f"{room}.py"]
    allowed_rooms = set(ROOMS[: ROOMS.index(room) + 1])
    for path in modules:
        names = [name for name in imported(path) if name.startswith("hardcontact.")]
        assert {name.split(".")[1] for name in names} <= allowed_rooms, path


def test_only_one_module_imports_snakemake():
    paths = [
        path.relative_to(LIBRARY).as_posix()
        for path in LIBRARY.rglob("*.py")
        if any(name.partition(".")[0] == "snakemake" for name in imported(path))
    ]
    assert paths == ["config/start.py"]
