"""The documentation links to files and names files that exist; README has the page's numbers."""

import re
from importlib.util import find_spec

import pytest
from html_page import Page
from repository import ROOT

README = ROOT / "README.md"
PAGE = ROOT / "resources/readme/answer.html"
NUMBER = r"(\d+(?:\.\d+)?)"
INTERVAL = re.compile(rf"{NUMBER} \[{NUMBER}, {NUMBER}\]")
FOLDERS = ("workflow", "config", "tests", "resources")
TEXTS = [README, *(path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.md")))]
MADE_BY_THE_USER = {
    "config/bare-coated.yaml", "config/mine.tsv", "config/my-coating.yaml", "config/several.tsv",
    "resources/scans/my-scan.spm",
}  # fmt: skip


@pytest.mark.parametrize("path", TEXTS, ids=lambda path: str(path.relative_to(ROOT)))
def test_links_and_names_of_files_lead_to_files(path):
    text = path.read_text("utf-8")
    links = re.findall(r"\]\((?!https?:)([^)#]+)\)", text)
    assert [link for link in links if not (path.parent / link).exists()] == []
    names = re.findall(rf"`(?:python )?((?:profiles|{'|'.join(FOLDERS)})/[\w./-]+)[` ]", text)
    assert [name for name in {*names} - MADE_BY_THE_USER if not (ROOT / name).exists()] == []


def is_rounded(printed, number):
    """Return True if a printed number is another text's number, rounded to its decimals."""
    decimals = len(printed.partition(".")[2])
    # Half a unit of the last decimal, and the error of binary numbers.
    return abs(float(printed) - float(number)) <= 0.501 * 10**-decimals


def test_the_page_of_the_full_study_has_the_numbers_of_the_readme():
    """After a change of results, run tests/helpers/full_study.py, and correct README.md."""
    page = Page(PAGE.read_text("utf-8"))
    text = " ".join([*page.texts["p"], *page.texts["li"], *sum(page.rows, [])])
    page_intervals = INTERVAL.findall(text.replace("\N{NO-BREAK SPACE}", " "))
    readme_intervals = INTERVAL.findall(README.read_text("utf-8"))
    assert len(readme_intervals) >= 6
    for numbers in readme_intervals:
        assert any(all(map(is_rounded, numbers, row)) for row in page_intervals), numbers


def test_modules_named_in_the_table_of_rules_exist():
    """There `.b` after `a.c` stands for `a.b`."""
    text = (ROOT / "workflow/README.md").read_text("utf-8")
    cells = re.findall(r"^(?:\|[^|\n]*){3}\|([^|\n]*)\|[^|\n]*\|$", text, re.M)
    assert len(cells) > 10
    package = ""
    for layer, name in re.findall(r"`(\w*)\.(\w+)`", " ".join(cells)):
        package = layer or package
        assert find_spec(f"hardcontact.{package}.{name}"), (package, name)
