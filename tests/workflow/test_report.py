"""The texts of the documentation: their links, the files and modules that they name, numbers."""

import re
from importlib.util import find_spec

import pytest
from html_page import Page
from repository import ROOT

README = ROOT / "README.md"
HOW_IT_IS_BUILT = ROOT / "workflow/README.md"
PAGE_TO_LOOK_AT = ROOT / "resources/readme/answer.html"
NUMBER = r"(\d+(?:\.\d+)?)"
INTERVAL = re.compile(rf"{NUMBER} \[{NUMBER}, {NUMBER}\]")
TEXTS = [
    README,
    *sorted((ROOT / "workflow/report").glob("*.md")),
    ROOT / "config/README.md",
    HOW_IT_IS_BUILT,
    ROOT / "tests/README.md",
    *sorted((ROOT / "resources").rglob("README.md")),
]


@pytest.mark.parametrize("path", TEXTS, ids=lambda path: str(path.relative_to(ROOT)))
def test_links_lead_to_files(path):
    links = re.findall(r"\]\((?!https?:)([^)#]+)\)", path.read_text())
    assert [link for link in links if not (path.parent / link).exists()] == []


@pytest.mark.parametrize("path", TEXTS, ids=lambda path: str(path.relative_to(ROOT)))
def test_files_named_in_the_documentation_exist(path):
    folders = "tests|profiles|workflow|config|resources"
    paths_named = set(re.findall(rf"`(?:python )?((?:{folders})/[\w./-]+)[` ]", path.read_text()))
    made_by_the_user = {
        "config/mine.tsv", "config/my-coating.yaml", "config/several.tsv",
        "resources/scans/my-scan.spm",
    }  # fmt: skip
    assert [name for name in paths_named - made_by_the_user if not (ROOT / name).exists()] == []


def test_modules_named_in_the_table_of_rules_exist():
    """There `.b` after `a.c` stands for `a.b`."""
    text = HOW_IT_IS_BUILT.read_text("utf-8")
    cells = re.findall(r"^(?:\|[^|\n]*){3}\|([^|\n]*)\|[^|\n]*\|$", text, re.M)
    assert len(cells) > 10
    package = ""
    for layer, name in re.findall(r"`(\w*)\.(\w+)`", " ".join(cells)):
        package = layer or package
        assert find_spec(f"hardcontact.{package}.{name}"), (package, name)


def is_rounded(printed, number):
    """Whether a text is a number with fewer decimals."""
    decimals = len(printed.partition(".")[2])
    return abs(float(printed) - float(number)) <= 0.501 * 10**-decimals


def test_the_page_to_look_at_has_the_numbers_of_the_readme():
    """After a change of results, run tests/helpers/full_study.py, and correct README.md."""
    page = Page(PAGE_TO_LOOK_AT.read_text("utf-8"))
    text = " ".join(
        [*page.texts["p"], *page.texts["li"], *(cell for row in page.rows for cell in row)]
    )
    page_intervals = INTERVAL.findall(text.replace("\N{NO-BREAK SPACE}", " "))
    readme_intervals = INTERVAL.findall(README.read_text("utf-8"))
    assert len(readme_intervals) >= 9
    for numbers in readme_intervals:
        assert any(all(map(is_rounded, numbers, row)) for row in page_intervals), numbers
    assert PAGE_TO_LOOK_AT.stat().st_size <= 1_000_000
