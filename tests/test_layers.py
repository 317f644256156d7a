"""The layers of the library: each imports only from itself and from lower layers."""

import ast
import io
import re
import tokenize

import pytest
from repository import ROOT

import hardcontact

LIBRARY = ROOT / "workflow/hardcontact"
#: Layers in the order of the library's docstring.
LAYERS = re.findall(r"`(\w+)`", hardcontact.__doc__)
#: Code lines that the library may have, without docstrings, comments and blank lines, so that one
#: person can still read it. If a useful change needs more lines, raise the number in its commit and
#: say there what a user gets for it.
MAX_CODE_LINES = 16_666
LAYOUT = {"COMMENT", "NL", "NEWLINE", "INDENT", "DEDENT", "ENDMARKER"}


def layer_modules(layer):
    """The modules of a layer, or the module that is one."""
    return list((LIBRARY / layer).rglob("*.py")) or [LIBRARY / f"{layer}.py"]


def code_lines(source):
    """The number of lines with code: docstrings, comments and blank lines do not count."""
    lines = set()
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if tokenize.tok_name[token.type] not in LAYOUT:
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
    count = sum(code_lines(path.read_text("utf-8")) for path in LIBRARY.rglob("*.py"))
    assert count <= MAX_CODE_LINES, "raise it here, and say in the commit what a user gets for it"


def test_only_the_start_of_a_run_imports_snakemake():
    paths = {
        path.relative_to(LIBRARY).as_posix()
        for path in LIBRARY.rglob("*.py")
        if any(name.partition(".")[0] == "snakemake" for name in imported(path))
    }
    assert paths == {"run/lifecycle.py", "run/reruns.py"}
