"""Pages of the report: nothing left out, nothing that a browser would read as markup."""

import re
from html import escape
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
from hardcontact.claims.verdicts import VERDICTS

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
            "frequency": [0.87, np.nan, np.nan],
            "stability": [0.68, np.nan, np.nan],
            "verdict": ["undecided", "not reproduced", "not testable on substitutes"],
            "follows_from": ["", "first", ""],
            "basis": ["substitute scans", "no scan", "substitute scans"],
            "note": ["", "", "Assumed."],
            "open_end": "",
        }
    )
    for column, value in values.items():
        table.loc[0, column] = value
    return table


def rows_of_claims(page):
    """The rows of the page that are claims: those after the counts of verdicts, without headers."""
    rows = [row for row in Reader(page).rows if len(row) == 5]
    return [row for row in rows if row[0].strip() != "statement"]


def test_claims_show_every_statement_with_its_numbers_and_verdict():
    table = evaluated()
    rows = [" ".join(row) for row in rows_of_claims(claims_page(table, 0.95))]
    for row, claim in zip(rows, table.itertuples(), strict=True):
        assert_says(row, claim.id, claim.statement, claim.verdict, claim.basis, claim.note)
    assert_says(rows[0], "3.25", "[2.75, 3.75]", "nm", "87 %")
    assert_says(rows[1], "Follows from first.")
    assert "nan" not in " ".join(rows).lower() and "[" not in rows[1] and "%" not in rows[1]


@pytest.mark.parametrize(
    ("end", "shown"), [("high", "[2.75, 3.75 or more] nm"), ("low", "[2.75 or less, 3.75] nm")]
)
def test_claims_say_which_end_of_an_interval_is_open(end, shown):
    rows = rows_of_claims(claims_page(evaluated(open_end=end), 0.95))
    assert shown in rows[0][2] and "or " not in rows[1][2]


@pytest.mark.parametrize(("stability", "count"), [(0.68, 1), (0.96, 0), (np.nan, 0)])
def test_claims_say_which_verdicts_may_change_with_the_seed(stability, count):
    page = claims_page(evaluated(stability=stability), 0.95)
    assert f"{count} verdicts may change with the seed" in Reader(page).texts["p"]
    assert ("kept in 68 % of redraws" in rows_of_claims(page)[0][4]) == (count == 1)


def test_claims_begin_with_the_counts_of_independent_findings():
    page = claims_page(evaluated(), 0.95)
    shown = Reader(page)
    assert_says(shown.texts["h1"], "2 findings", "3 statements")
    assert "95 % interval" in shown.texts["p"]
    counts = [row for row in shown.rows if len(row) == 4]
    assert [cell.strip() for cell in counts[0][:3]] == [
        "verdict", "independent findings", "all statements",
    ]  # fmt: skip
    numbers = {row[0].strip(): [int(cell) for cell in row[1:3]] for row in counts[1:]}
    assert list(numbers) == list(VERDICTS) and all(row[3].strip() for row in counts)
    assert numbers["undecided"] == [1, 1] and numbers["not reproduced"] == [0, 1]
    assert page.index("independent findings") < page.index("The rms height")


def test_claims_read_on_a_narrow_screen():
    """Every cell says what it is, for a page too narrow for a header."""
    page = claims_page(evaluated(), 0.95)
    assert 'name="viewport"' in page and "@media (max-width" in page
    assert page.count("<td") == page.count("data-label=")


def test_claims_stand_section_by_section():
    page = claims_page(evaluated(), 0.95)
    assert re.findall("<h2>(.*?)</h2>", page) == ["Table 1", "Results"]


@pytest.mark.parametrize("column", ["section", "statement", "unit", "basis", "note"])
def test_claims_are_text_not_markup(column):
    page = claims_page(evaluated(**{column: HOSTILE}), 0.95)
    assert "script" not in Reader(page).tags and "<script" not in page
    assert escape(HOSTILE) in page and len(rows_of_claims(page)) == 3


@pytest.mark.parametrize(("confidence", "printed"), [(0.5, "50 %"), (0.683, "68.3 %")])
def test_claims_name_the_confidence_of_their_intervals(confidence, printed):
    said = Reader(claims_page(evaluated(), confidence)).texts["p"]
    assert f"Square brackets: {printed} interval" in said and "95" not in said


def test_all_claims_of_the_paper_have_a_row():
    table = STATEMENTS.assign(
        computed=1.0, low=np.nan, high=np.nan, frequency=0.5, verdict="consistent", basis="no scan",
        stability=1.0, open_end="",
    )  # fmt: skip
    page = claims_page(table, 0.95)
    rows = [" ".join(row) for row in rows_of_claims(page)]
    assert len(rows) == len(STATEMENTS)
    assert [text for text in STATEMENTS.statement if escape(text) not in page] == []


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


def test_a_table_of_a_chapter_reads_on_a_narrow_screen():
    labels = re.findall('<td data-label="(.*?)"', text_page(CHAPTER + "\n" + CHAPTER[2:]))
    assert labels == ["surface", "made from"] * 2


@pytest.mark.parametrize("text", ["", "No title.\n", "## Second\n"])
def test_a_chapter_without_a_title_is_refused(text):
    assert_says(refusal(text_page, text), "expected", "'# '", "found")


def test_every_departure_of_the_study_has_its_place():
    text = (ROOT / "workflow/report/departures.md").read_text()
    titles = re.findall(r"^\d+\. \*\*(.+?)\*\*", text, re.M)
    page = text_page(text)
    shown = Reader(page)
    assert shown.texts["h1"] == "Where the study departs from the paper"
    departures = re.sub("<ul>.*?</ul>", "", page, flags=re.DOTALL)
    assert len(titles) >= 17 and departures.count("<li>") == len(titles)
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
