"""The list of figures agrees with the modules, and rules can read it without heavy imports."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
from jinja2 import UndefinedError
from repository import PAPER, ROOT

from hardcontact.report.figures import listing
from hardcontact.report.figures.listing import PAPER_FIGURES, caption, describe_figure
from hardcontact.report.own_surfaces.figures import OWN_DRAWINGS


def test_each_figure_has_its_drawing():
    modules = {path.stem for path in Path(listing.__file__).parent.glob("fig*.py")}
    assert modules == set(PAPER_FIGURES)
    assert set(OWN_DRAWINGS) == set(listing.OWN_FIGURES)


def test_each_figure_of_the_paper_belongs_to_a_chapter():
    page = (ROOT / "workflow/report/templates/figures.html").read_text("utf-8")
    chapters = set(re.findall(r'^  "(\d\. [^"]+)": "', page, re.M))
    assert {describe_figure(name).chapter for name in PAPER_FIGURES} <= chapters


def test_a_caption_names_the_values_of_the_study():
    configuration = PAPER | {"inference": PAPER["inference"] | {"confidence": 0.8}}
    assert "its 80 % interval" in caption("fig6", configuration).details
    with pytest.raises(UndefinedError, match="confidence"):
        caption("fig6", PAPER | {"inference": {}})


def test_figures_are_described_without_heavy_packages():
    code = (
        "import sys; from hardcontact.report.figures.listing import PAPER_FIGURES, describe_figure;"
        "[describe_figure(name) for name in PAPER_FIGURES];"
        "print({'matplotlib', 'PIL', 'scipy', 'jinja2'} & set(sys.modules))"
    )
    run = subprocess.run([sys.executable, "-c", code], cwd=ROOT / "workflow", capture_output=True)
    assert run.stdout.split() == [b"set()"], run.stderr
