"""The code that files depend on: source files of scripts, and pinned versions of packages."""

import ast
import os
import re
from collections.abc import Iterator, Sequence
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import hardcontact
from hardcontact.base.atomic_file import remove_incomplete_files, write_text_file

#: The file of the packages that the study imports.
ENVIRONMENT = "environment.txt"
#: The file of these packages and of all that they need in turn.
LOCK = "workflow/lock.txt"
#: Copies of both without comments and hashes, on which jobs depend: a comment makes no file stale.
ENVIRONMENT_PINS, LOCK_PINS = "results/environment.txt", "results/lock.txt"
PIN_FILES = (ENVIRONMENT_PINS, LOCK_PINS)
#: A line such as ``numpy==2.3.1``: name and version.
PIN = re.compile(r"^([\w.-]+)(?:\[[^]]*\])?==([^\s;\\]+)", re.MULTILINE)
LIBRARY = Path(str(hardcontact.__file__)).resolve().parent
SCRIPTS = LIBRARY.parent / "scripts"
#: The top folder of the repository; studies name paths relative to it.
ROOT = LIBRARY.parents[1]


def read_pins(path: str | Path) -> dict[str, str]:
    """Return the pinned versions in a requirements file, by package."""
    return dict(PIN.findall(Path(path).read_text("utf-8")))


def write_pins() -> None:
    """Write PIN_FILES, unless the files are right already."""
    for source, path in zip((ENVIRONMENT, LOCK), PIN_FILES, strict=True):
        text = "".join(f"{name}=={pin}\n" for name, pin in read_pins(source).items())
        if not Path(path).is_file() or Path(path).read_text("utf-8") != text:
            remove_incomplete_files(path)
            write_text_file(path, text)


def refuse_other_versions() -> None:
    """Refuse packages that are missing, or installed in another version than the pinned one."""
    locked = normalize_names(read_pins(LOCK))
    required = normalize_names(read_pins(ENVIRONMENT))
    installed = {name: installed_version(name) for name in locked}
    faults = [
        f"{name} {pin}, found {installed[name] or 'none'}"
        for name, pin in locked.items()
        # A package that only some systems need may be missing.
        if installed[name] != pin and (installed[name] or name in required)
    ]
    if faults:
        install = f"pip install --require-hashes -r {LOCK}"
        raise ValueError(f"packages: expected {'; '.join(faults)} (mend it: {install})")


def normalize_names(pins: dict[str, str]) -> dict[str, str]:
    """Return pins by the names that pip compares."""
    return {re.sub(r"[-_.]+", "-", name).lower(): pin for name, pin in pins.items()}


@cache
def installed_version(name: str) -> str | None:
    """Return the installed version of a package, None if there is none."""
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def page_templates() -> list[str]:
    """Return the templates of pages, with their style and script."""
    return sorted(map(os.path.relpath, (LIBRARY.parent / "report/templates").iterdir()))


@cache
def code_inputs(script: str, *modules: str) -> Sequence[str]:
    """Return the files on which a script depends, relative to the working directory.

    They are the script, all modules of the library that it imports, and PIN_FILES. `modules` are
    further ones, imported by a name in a variable.
    """
    paths = {SCRIPTS / script, *(path for name in modules for path in _module_files(name))}
    pending = [*paths]
    while pending:
        new_paths = _imported_files(pending.pop()) - paths
        paths |= new_paths
        pending.extend(new_paths)
    return (*sorted(os.path.relpath(path) for path in paths), *PIN_FILES)


@cache
def _imported_files(path: Path) -> frozenset[Path]:
    """Return the files of the library that Python runs to import a file."""
    names = _imported_names(ast.parse(path.read_text("utf-8")))
    return frozenset(file for name in names for file in _module_files(name))


def _imported_names(tree: ast.AST) -> Iterator[str]:
    """Yield the full names that Python imports: modules, and names in modules."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
            yield from _imported_names(ast.Module(node.orelse, []))
        elif isinstance(node, ast.Import):
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
