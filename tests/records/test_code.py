"""Packages are installed as pinned; jobs depend on the pins, not on what is written around them."""

import ast
from pathlib import Path

import pytest
from refusals import assert_says, refusal
from repository import ROOT

from hardcontact.records import code

#: Requirements of the same meaning: plain, and with reasons and hashes.
PLAIN = "numpy==2.0\nattrs==25.1\n"
COMMENTED = (
    "# arrays (BSD)\n\nnumpy==2.0  # and more\n"
    "attrs==25.1 ; python_version < '3.12' \\\n    --hash=sha256:12 \\\n    --hash=sha256:34\n"
)


@pytest.fixture
def write(tmp_path, monkeypatch):
    """Return a function that writes the requirements and the list of all packages."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "workflow").mkdir()

    def write_requirements(environment, lock):
        Path(code.ENVIRONMENT).write_text(environment)
        Path(code.LOCK).write_text(lock)

    return write_requirements


def test_pins_are_read_and_other_requirements_are_not(tmp_path):
    path = tmp_path / "environment.txt"
    path.write_text(
        "# numpy==0 is a comment\nnumpy==2.0\nxarray>=1\n--no-index\npytest[extra]==1\n"
    )
    assert code.read_pins(path) == {"numpy": "2.0", "pytest": "1"}


def test_comments_and_hashes_change_no_input(write):
    write(PLAIN, PLAIN)
    code.write_pins()
    times = [Path(path).stat().st_mtime_ns for path in code.PIN_FILES]
    write(COMMENTED, COMMENTED)
    code.write_pins()
    assert [Path(path).stat().st_mtime_ns for path in code.PIN_FILES] == times
    write(PLAIN, PLAIN.replace("25.1", "25.2"))
    code.write_pins()
    assert [Path(path).read_text()[-5:] for path in code.PIN_FILES] == ["25.1\n", "25.2\n"]


INSTALLED = {"numpy": "2.0", "attrs": "25.1"}


@pytest.mark.parametrize(
    ("environment", "lock", "found"),
    [
        ("numpy==2.0\n", "numpy==2.0\nattrs==25.2\n", "attrs 25.2, found 25.1"),
        ("numpy==1.9\n", "numpy==1.9\n", "numpy 1.9, found 2.0"),
        ("scipy==1.17\n", "scipy==1.17\n", "scipy 1.17, found none"),
    ],
)
def test_packages_other_than_pinned_are_refused(write, monkeypatch, environment, lock, found):
    monkeypatch.setattr(code, "installed_version", INSTALLED.get)
    write(environment, lock)
    message = refusal(code.refuse_other_versions)
    assert_says(message, found, "pip install --require-hashes -r workflow/lock.txt")


def test_a_package_that_another_system_needs_may_be_missing(write, monkeypatch):
    monkeypatch.setattr(code, "installed_version", INSTALLED.get)
    write("NumPy==2.0\n", "numpy==2.0\ncolorama==0.4 ; sys_platform == 'win32'\n")
    code.refuse_other_versions()


def test_all_requirements_are_in_the_list_of_all_packages_with_the_same_version():
    """Otherwise `.ci/lock` makes the list anew."""
    required, locked = (
        code.normalize_names(code.read_pins(ROOT / path)) for path in (code.ENVIRONMENT, code.LOCK)
    )
    assert required.items() <= locked.items()


def test_imports_that_python_runs_are_inputs_and_those_for_type_checkers_are_not():
    text = "if TYPE_CHECKING:\n import a\nelse:\n import b\nif not TYPE_CHECKING:\n import c"
    assert [*code._imported_names(ast.parse(text))] == ["b", "c"]
