"""The table of figures agrees with the modules, and rules can read it without heavy imports."""

import inspect
import subprocess
import sys
from pathlib import Path

import pytest
from figure_inputs.registry import module_of

from hardcontact import figures
from hardcontact.config.patterns import PUBLISHED
from hardcontact.figures.catalogue import FIGURES
from hardcontact.figures.drawing import READERS

ROOT = Path(__file__).parents[2]
PARTS = {"fig4_error"}
SHARED = {"__init__", "catalogue", "drawing", "style", "tables"}


def test_each_module_is_a_figure_or_shared():
    modules = {path.stem for path in Path(figures.__file__).parent.glob("*.py")}
    assert modules == set(FIGURES) | PARTS | SHARED


@pytest.mark.parametrize("name", FIGURES)
def test_a_module_takes_what_the_table_says(name):
    module = module_of(name)
    for function in (module.draw, module.table):
        assert tuple(inspect.signature(function).parameters) == FIGURES[name].inputs


def test_published_tables_exist_and_are_read():
    named = {name for figure in FIGURES.values() for name in figure.published}
    assert named == set(READERS) and named <= set(PUBLISHED)
    for path in PUBLISHED.values():
        assert (ROOT / path).is_file()


def test_the_table_is_read_without_heavy_packages():
    code = (
        "import sys, hardcontact.figures.catalogue;"
        "print({'matplotlib', 'xarray', 'pandas', 'numpy'} & set(sys.modules))"
    )
    run = subprocess.run([sys.executable, "-c", code], cwd=ROOT / "workflow", capture_output=True)
    assert run.stdout.split() == [b"set()"], run.stderr
