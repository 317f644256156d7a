"""The texts of the documentation: their links, the files that they name, the README's length."""

import re

import pytest
from repository import ROOT

README = ROOT / "README.md"
TEXTS = [
    README,
    *sorted((ROOT / "workflow/report").glob("*.md")),
    ROOT / "config/README.md",
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


def test_the_readme_is_short():
    assert len(README.read_text().splitlines()) <= 110
