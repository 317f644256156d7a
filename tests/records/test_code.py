"""The tracer of code against small libraries; test_reruns.py has all that scripts load."""

import pytest

from hardcontact.records import code


@pytest.fixture
def library(tmp_path, monkeypatch):
    """Give a function that writes a script, and modules of a library with two packages."""
    top = tmp_path / "workflow"
    for folder in ("hardcontact", "hardcontact/surfaces", "hardcontact/contact", "scripts"):
        (top / folder).mkdir(parents=True)
    for package in ("", "surfaces", "contact"):
        (top / "hardcontact" / package / "__init__.py").touch()
    monkeypatch.setattr(code, "LIBRARY", top / "hardcontact")
    monkeypatch.setattr(code, "SCRIPTS", top / "scripts")
    monkeypatch.chdir(tmp_path)
    code.code_inputs.cache_clear()

    def write(script, modules):
        (top / "scripts/script.py").write_text(script)
        for name, text in modules.items():
            (top / "hardcontact" / f"{name}.py").write_text(text)

    yield write
    code.code_inputs.cache_clear()


def traced(*modules):
    """Return the modules that a script uses, without itself and the pins."""
    *files, direct, transitive = code.code_inputs("script.py", *modules)
    assert (direct, transitive) == ("results/environment.txt", "results/lock.txt")
    assert files == sorted(files)
    files.remove("workflow/scripts/script.py")
    return [file.removeprefix("workflow/hardcontact/").removesuffix(".py") for file in files]


@pytest.mark.parametrize(
    "text",
    [
        "from hardcontact.surfaces import scans",
        "from hardcontact.surfaces.scans import read as door",
        "import os, hardcontact.surfaces.scans as door",
        "def read():\n    from hardcontact.surfaces import scans",
        "try:\n    import hardcontact.surfaces.scans\nexcept ImportError:\n    pass",
    ],
)
def test_every_way_to_import_a_module_is_followed(library, text):
    library(text, {"surfaces/scans": "read = None"})
    assert traced() == ["__init__", "surfaces/__init__", "surfaces/scans"]


def test_modules_that_modules_import_are_followed(library):
    """Also a module that a rule names, and modules that import each other."""
    library(
        "from hardcontact.surfaces.scans import read",
        {
            "random": "",
            "surfaces/scans": "from hardcontact.surfaces import spectrum",
            "surfaces/spectrum": "from hardcontact.contact.hertz import radius",
            "contact/__init__": "from hardcontact import random",
            "contact/hertz": "import hardcontact.surfaces.scans",
            "contact/named": "",
            "contact/unused": "",
        },
    )
    assert traced("hardcontact.contact.named") == [
        "__init__", "contact/__init__", "contact/hertz", "contact/named", "random",
        "surfaces/__init__", "surfaces/scans", "surfaces/spectrum",
    ]  # fmt: skip


@pytest.mark.parametrize(
    "text",
    [
        "import numpy",
        "import hardcontactless.surfaces.scans",
        "import typing\nif typing.TYPE_CHECKING:\n    from hardcontact.surfaces import scans",
    ],
)
def test_imports_from_elsewhere_are_left_out(library, text):
    library(text, {"surfaces/scans": ""})
    assert traced() == []
