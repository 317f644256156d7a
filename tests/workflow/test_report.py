"""The texts of the report and the README: captions, chapters, their links and their length."""

import re

import pytest
from jinja2 import Environment, StrictUndefined
from repository import PAPER, ROOT

from hardcontact.config.configuration import CHAPTERS, PAGES
from hardcontact.figures.listing import FIGURES, describe

CAPTIONS = sorted((ROOT / "workflow/report").glob("*.rst"))
README = ROOT / "README.md"
TEXTS = [
    README,
    *sorted((ROOT / "workflow/report").glob("*.md")),
    ROOT / "config/README.md",
    *sorted((ROOT / "resources").rglob("README.md")),
]


def shown(path, **others):
    """Return the text of a caption in the report of the paper's study, or with other keys."""

    class Snakemake:
        config = PAPER | others

    environment = Environment(trim_blocks=True, lstrip_blocks=True, undefined=StrictUndefined)
    return environment.from_string(path.read_text()).render(snakemake=Snakemake)


def test_the_report_of_own_surfaces_does_not_tell_the_story_of_the_paper():
    own = shown(ROOT / "workflow/report/own_surfaces.rst", study="mine", published="none")
    assert "mine" in own and "answer.html" in own and "{%" not in own
    assert "claims.csv" not in own and "ruby" not in own
    assert "claims.csv" in shown(ROOT / "workflow/report/workflow.rst")


def test_every_figure_and_page_has_a_caption():
    assert {path.stem for path in CAPTIONS} == {
        "workflow", "own_surfaces", "answer", "insight", "figure", *PAGES,
    }  # fmt: skip


@pytest.mark.parametrize("name", ["answer_paper", "answer_surfaces"])
def test_the_answer_stands_first_in_the_report(name):
    """Snakemake sorts the chapters of a report by their names."""
    rule = (ROOT / f"workflow/rules/{name}.smk").read_text()
    (chapter,) = re.findall(r'category="(.+)"', rule)
    others = {describe(name).chapter for name in FIGURES}
    assert chapter < min(others | {category for category, _ in PAGES.values()})


@pytest.mark.parametrize("name", CHAPTERS)
def test_a_chapter_begins_with_its_one_title(name):
    lines = (ROOT / f"workflow/report/{name}.md").read_text().splitlines()
    assert [line for line in lines if line.startswith("# ")] == lines[:1]


@pytest.mark.parametrize("path", TEXTS, ids=lambda path: str(path.relative_to(ROOT)))
def test_links_lead_to_files(path):
    links = re.findall(r"\]\((?!https?:)([^)#]+)\)", path.read_text())
    assert [link for link in links if not (path.parent / link).exists()] == []


@pytest.mark.parametrize("path", TEXTS, ids=lambda path: str(path.relative_to(ROOT)))
def test_files_that_a_text_names_exist(path):
    folders = "tests|profiles|workflow|config|resources"
    named = set(re.findall(rf"`(?:python )?((?:{folders})/[\w./-]+)[` ]", path.read_text()))
    made_by_the_user = {
        "config/mine.tsv", "config/my-coating.yaml", "config/several.tsv",
        "resources/scans/my-scan.spm",
    }  # fmt: skip
    assert [name for name in named - made_by_the_user if not (ROOT / name).exists()] == []


def test_the_readme_is_short():
    assert len(README.read_text().splitlines()) <= 130
