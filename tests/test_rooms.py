"""The rooms of the library: each imports only from itself and from those before it."""

import ast
import re

import pytest
from repository import ROOT

import hardcontact

LIBRARY = ROOT / "workflow/hardcontact"
#: In the order in which the library's docstring names them.
ROOMS = re.findall(r"`(\w+)`", hardcontact.__doc__)


def imported(path):
    """Return the rooms that a module imports from, wherever in the module."""
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        names = []
        if isinstance(node, ast.ImportFrom):
            names = [f"{node.module}.{alias.name}" for alias in node.names]
        elif isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        yield from (name.split(".")[1] for name in names if name.startswith("hardcontact."))


def test_the_docstring_names_every_room():
    there = {path.stem for path in LIBRARY.glob("[a-z]*") if not path.name.startswith("py.")}
    assert there == set(ROOMS) and len(ROOMS) == len(there)


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_imports_from_those_before_it(room):
    modules = list((LIBRARY / room).glob("*.py")) or [LIBRARY / f"{room}.py"]
    before = set(ROOMS[: ROOMS.index(room) + 1])
    for path in modules:
        assert set(imported(path)) <= before, path
