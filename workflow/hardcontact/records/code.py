"""Find the source files on which a script depends: itself and the modules that it imports."""

import ast
import os
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path

import hardcontact
from hardcontact.records.packages import PINS

#: The folder of the imported library.
LIBRARY = Path(str(hardcontact.__file__)).resolve().parent
#: The folder of the scripts beside it.
SCRIPTS = LIBRARY.parent / "scripts"
#: The top folder of the repository; studies name paths relative to it.
ROOT = LIBRARY.parents[1]


def page_templates() -> list[str]:
    """Return the templates of pages, with their style and script; an installed library has none."""
    return sorted(map(os.path.relpath, (LIBRARY.parent / "report/templates").iterdir()))


@cache
def code_inputs(script: str, *modules: str) -> Sequence[str]:
    """Return the source files of a script, relative to the working directory.

    They are the script, all modules of the library that it imports, and the lists of pinned
    packages. `modules` are further ones, imported by a name in a variable. Imports for type
    checkers do not count.
    """
    paths = {SCRIPTS / script, *(path for name in modules for path in _module_files(name))}
    pending = [*paths]
    while pending:
        new_paths = _imported_files(pending.pop()) - paths
        paths |= new_paths
        pending.extend(new_paths)
    return (*sorted(os.path.relpath(path) for path in paths), *PINS)


@cache
def _imported_files(path: Path) -> frozenset[Path]:
    """Return the files of the library that Python runs when it imports a file."""
    names = _imported_names(ast.parse(path.read_text("utf-8")))
    return frozenset(file for name in names for file in _module_files(name))


def _imported_names(tree: ast.AST) -> Iterator[str]:
    """Yield the full names of the modules, and of names in modules, that a file imports."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.If) and ast.unparse(node.test).endswith("TYPE_CHECKING"):
            continue
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield str(node.module)
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif not isinstance(node, ast.expr):  # An expression holds no import.
            yield from _imported_names(node)


@cache
def _module_files(name: str) -> list[Path]:
    """Return the files that Python runs to import a name, also those of its parent packages."""
    package, *names = name.split(".")
    if package != LIBRARY.name:
        return []
    path = LIBRARY
    files = [path / "__init__.py"]
    for name_in_package in names:
        path = path / name_in_package
        if path.is_dir():
            files.append(path / "__init__.py")
        elif path.with_suffix(".py").is_file():
            files.append(path.with_suffix(".py"))
    return files
