"""Pages of the report: nothing left out, nothing that a browser would read as markup."""

import re
from html.parser import HTMLParser
from importlib.metadata import version

import numpy as np
import pandas as pd
import pytest
import yaml
from paper_claims import STATEMENTS
from refusals import assert_says, refusal
from repository import PAPER, ROOT

from hardcontact.claims.report_pages import claims_page, pages, parameters_page, text_page

HOSTILE = 'a < b & "c" <script>alert(1)</script>'


class Reader(HTMLParser):
    """What a browser shows of a page: the text of each row's cells, and every tag and link."""

    def __init__(self, page):
        super().__init__()
        self.tags, self.links, self.rows, self.inside = [], [], [], []
        self.texts = {"pre": "", "h1": "", "p": ""}
        self.feed(page)

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.links += [value for name, value in attributes if name in ("href", "src")]
        self.inside.append(tag)
        if tag == "tr":
            self.rows.append([])
        elif tag in ("td", "th"):
            self.rows[-1].append("")

    def handle_endtag(self, tag):
        while self.inside and self.inside.pop() != tag:
            pass

    def handle_data(self, data):
        if {"td", "th"} & set(self.inside):
            self.rows[-1][-1] += data + " "
        for tag in self.texts.keys() & set(self.inside):
            self.texts[tag] += data


def evaluated(**values):
    """Three claims as `evaluate` returns them, the first with other values."""
    table = pd.DataFrame(
        {
            "id": ["first", "second", "third"],
            "section": ["Table 1", "Results", "Results"],
            "statement": ["The rms height is 3 nm.", "A > B & C.", "It is so."],
            "published": [3.0, np.nan, 0.1],
            "computed": [3.25, 1.5, np.nan],
            "low": [2.75, np.nan, np.nan],
            "high": [3.75, np.nan, np.nan],
            "unit": ["nm", "1", "1"],
            "rule": ["interval", "above", "below"],
            "verdict": ["consistent", "not reproduced", "not testable on substitutes"],
            "basis": ["substitute scans", "no scan", "substitute scans"],
            "note": ["", np.nan, "Assumed."],
        }
    )
    for column, value in values.items():
        table.loc[0, column] = value
    return table


def test_claims_show_every_statement_with_its_numbers_and_verdict():
    table = evaluated()
    shown = Reader(claims_page(table, 0.95))
    assert "3 statements" in shown.texts["h1"]
    counted = "0 reproduced, 1 consistent, 1 not reproduced, 1 not testable on substitutes"
    assert counted in shown.texts["p"] and "95 % interval" in shown.texts["p"]
    header, *rows = (" ".join(row) for row in shown.rows)
    assert "verdict" in header and len(rows) == len(table)
    for row, claim in zip(rows, table.fillna({"note": ""}).itertuples(), strict=True):
        assert_says(row, claim.section, claim.statement, claim.verdict, claim.basis, claim.note)
    assert_says(rows[0], "3.25", "[2.75, 3.75]", "nm")
    assert "nan" not in " ".join(rows).lower() and "[" not in rows[1]


@pytest.mark.parametrize("column", ["section", "statement", "unit", "basis", "note"])
def test_claims_are_text_not_markup(column):
    page = claims_page(evaluated(**{column: HOSTILE}), 0.95)
    shown = Reader(page)
    assert "script" not in shown.tags
    assert HOSTILE in " ".join(shown.rows[1])
    assert len(shown.rows) == 4 and "<script" not in page


@pytest.mark.parametrize(("confidence", "printed"), [(0.5, "50 %"), (0.683, "68.3 %")])
def test_claims_name_the_confidence_of_their_intervals(confidence, printed):
    said = Reader(claims_page(evaluated(), confidence)).texts["p"]
    assert f"Square brackets: {printed} interval" in said and "95" not in said


def test_all_claims_of_the_paper_have_a_row():
    table = STATEMENTS.assign(
        computed=1.0, low=np.nan, high=np.nan, unit="1", verdict="consistent", basis="no scan"
    )
    rows = [" ".join(row) for row in Reader(claims_page(table, 0.95)).rows[1:]]
    assert len(rows) == len(STATEMENTS)
    for row, statement in zip(rows, STATEMENTS.statement, strict=True):
        assert statement in row


CHAPTER = """# Where the study departs <from> the paper

1. **First.** See [the rules](resources/paper/README.md) and [the paper](https://doi.org/10.1/x).
2. **Second.** 1 < 2.

## Substitute scans

| surface | made from |
|---|---|
| UNCD | scans |
"""


def test_a_chapter_is_a_page_without_links_into_the_repository():
    page = text_page(CHAPTER)
    shown = Reader(page)
    assert shown.tags.count("h1") == 1 and shown.tags.count("li") == 2 and "1 &lt; 2" in page
    assert shown.texts["h1"] == "Where the study departs <from> the paper"
    assert shown.links == ["https://doi.org/10.1/x"]
    assert "See the rules and" in page
    assert [[cell.strip() for cell in row] for row in shown.rows] == [
        ["surface", "made from"],
        ["UNCD", "scans"],
    ]


@pytest.mark.parametrize("text", ["", "No title.\n", "## Second\n"])
def test_a_chapter_without_a_title_is_refused(text):
    assert_says(refusal(text_page, text), "expected", "'# '", "found")


def test_every_departure_of_the_study_has_its_place():
    text = (ROOT / "workflow/report/departures.md").read_text()
    titles = re.findall(r"^\d+\. \*\*(.+?)\*\*", text, re.M)
    page = text_page(text)
    shown = Reader(page)
    assert shown.texts["h1"] == "Where the study departs from the paper"
    assert len(titles) >= 17 and shown.tags.count("li") == len(titles)
    assert [title for title in titles if f"<strong>{title}</strong>" not in page] == []
    assert [link for link in shown.links if not link.startswith("https:")] == []


@pytest.mark.parametrize("path", sorted((ROOT / "workflow/report").glob("*.md")))
def test_every_chapter_of_the_study_has_a_title(path):
    assert Reader(text_page(path.read_text())).texts["h1"]


def test_parameters_are_the_whole_configuration_and_every_version():
    configuration = PAPER | {"store": "a<b>&c"}
    versions = {name: version(name) for name in ("numpy", "snakemake")} | {"a<b": "1<2"}
    shown = Reader(parameters_page(configuration, versions))
    assert yaml.safe_load(shown.texts["pre"]) == configuration
    cells = [[cell.strip() for cell in row] for row in shown.rows]
    assert cells[1:] == [[name, number] for name, number in versions.items()]


def test_pages_are_those_of_the_claims_the_chapters_and_the_parameters():
    configuration = PAPER | {"inference": {"confidence": 0.8}}
    made = pages(evaluated(), {"departures": CHAPTER}, configuration, {"numpy": "1"})
    assert list(made) == ["claims", "departures", "parameters"]
    assert "80 % interval" in Reader(made["claims"]).texts["p"]
    assert made["departures"] == text_page(CHAPTER)
