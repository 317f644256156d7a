"""The texts of the report: one a figure, each whole once its values are filled in."""

import pytest
from conftest import PAPER, ROOT
from docutils.core import publish_doctree
from jinja2 import Environment, StrictUndefined

TEXTS = sorted((ROOT / "workflow/report").glob("*.rst"))
MODULES = {path.stem for path in (ROOT / "workflow/hardcontact/figures").glob("*.py")}


@pytest.mark.parametrize("path", TEXTS, ids=lambda path: path.stem)
def test_report_text_is_restructured_text(path):
    class Snakemake:
        config = PAPER

    environment = Environment(trim_blocks=True, lstrip_blocks=True, undefined=StrictUndefined)
    text = environment.from_string(path.read_text()).render(snakemake=Snakemake)
    document = publish_doctree(text, settings_overrides={"halt_level": 2})
    assert document.astext().strip() and "{{" not in document.astext()


def test_every_figure_has_a_caption():
    assert MODULES - {"__init__", "style"} <= {path.stem for path in TEXTS}
