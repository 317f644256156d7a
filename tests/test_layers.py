"""The layers of the library: each imports only from itself and from lower layers."""

import ast
import re
from functools import cache

import pytest
from repository import ROOT

import hardcontact

LIBRARY = ROOT / "workflow/hardcontact"
#: The layers, the lowest first: all words in backticks of the library's docstring.
LAYERS = re.findall(r"`(\w+)`", hardcontact.__doc__)
#: Code lines that the library may have, without docstrings, comments and blank lines, so that one
#: person can still read it. If a useful change needs more lines, raise the number in its commit and
#: say there what a user gets for it.
MAX_CODE_LINES = 16_787


def layer_modules(layer):
    """The modules in the folder of a layer, or the module that is the layer."""
    return list((LIBRARY / layer).rglob("*.py")) or [LIBRARY / f"{layer}.py"]


@cache
def read_module(path):
    """The source of a module, and its syntax tree."""
    source = path.read_text("utf-8")
    return source, ast.parse(source)


def code_lines(path):
    """The number of lines with code: docstrings, comments and blank lines do not count."""
    source, tree = read_module(path)
    lines = {
        number
        for number, line in enumerate(source.splitlines(), start=1)
        if line.strip() and not line.lstrip().startswith("#")
    }
    for node in ast.walk(tree):
        documented = (ast.Module, ast.ClassDef, ast.FunctionDef)
        if isinstance(node, documented) and ast.get_docstring(node) is not None:
            lines -= set(range(node.body[0].lineno, node.body[0].end_lineno + 1))
    return len(lines)


def imported(path):
    """Yield the names that a module imports, wherever in the module."""
    for node in ast.walk(read_module(path)[1]):
        if isinstance(node, ast.ImportFrom):
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)


def test_the_docstring_names_every_layer():
    layers = {path.stem for path in LIBRARY.glob("[a-z]*") if not path.name.startswith("py.")}
    assert layers == set(LAYERS) and len(LAYERS) == len(layers)


@pytest.mark.parametrize("layer", LAYERS)
def test_a_layer_imports_from_lower_layers(layer):
    allowed_layers = set(LAYERS[: LAYERS.index(layer) + 1])
    for path in layer_modules(layer):
        names = [name for name in imported(path) if name.startswith("hardcontact.")]
        assert {name.split(".")[1] for name in names} <= allowed_layers, path


def test_the_library_does_not_grow():
    count = sum(code_lines(path) for path in LIBRARY.rglob("*.py"))
    assert count <= MAX_CODE_LINES, "raise it here, and say in the commit what a user gets for it"


def test_only_the_start_of_a_run_imports_snakemake():
    paths = {
        path.relative_to(LIBRARY).as_posix()
        for path in LIBRARY.rglob("*.py")
        if any(name.partition(".")[0] == "snakemake" for name in imported(path))
    }
    assert paths == {"run/preparation.py", "run/reruns.py"}
