"""Pages of the report: nothing left out, nothing that a browser would read as markup."""

import re
from html.parser import HTMLParser
from importlib.metadata import version

import numpy as np
import pandas as pd
import pytest
import yaml
from conftest import PAPER, ROOT, assert_says, refusal

from hardcontact import claims, pages

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
    """Three claims as `claims.evaluate` returns them, the first with other values."""
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
    found = Reader(pages.claims_page(table))
    assert "3 statements" in found.texts["h1"]
    counted = "0 reproduced, 1 consistent, 1 not reproduced, 1 not testable on substitutes"
    assert counted in found.texts["p"]
    header, *rows = (" ".join(row) for row in found.rows)
    assert "verdict" in header and len(rows) == len(table)
    for row, claim in zip(rows, table.fillna({"note": ""}).itertuples(), strict=True):
        assert_says(row, claim.section, claim.statement, claim.verdict, claim.basis, claim.note)
    assert_says(rows[0], "3.25", "[2.75, 3.75]", "nm")
    assert "nan" not in " ".join(rows).lower() and "[" not in rows[1]


@pytest.mark.parametrize("column", ["section", "statement", "unit", "basis", "note"])
def test_claims_are_text_not_markup(column):
    page = pages.claims_page(evaluated(**{column: HOSTILE}))
    found = Reader(page)
    assert "script" not in found.tags
    assert HOSTILE in " ".join(found.rows[1])
    assert len(found.rows) == 4 and "<script" not in page


def test_all_claims_of_the_paper_have_a_row():
    statements = claims.read_claims(ROOT / "resources/paper/claims.csv")
    table = statements.assign(
        computed=1.0, low=np.nan, high=np.nan, unit="1", verdict="consistent", basis="no scan"
    )
    found = Reader(pages.claims_page(table))
    shown = [" ".join(row) for row in found.rows[1:]]
    assert len(shown) == len(statements)
    for row, statement in zip(shown, statements.statement, strict=True):
        assert statement in row


README = """# Title

## Where the study departs from the paper

1. **First.** See [the rules](resources/paper/README.md) and [the paper](https://doi.org/10.1/x).
2. **Second.** 1 < 2.

### Substitute scans

| surface | made from |
|---|---|
| UNCD | scans |

## How it works

- Not a departure.
"""


def test_departures_are_that_section_of_the_readme_alone():
    page = pages.departures_page(README)
    found = Reader(page)
    assert found.tags.count("li") == 2 and "1 &lt; 2" in page
    assert found.links == ["https://doi.org/10.1/x"]
    assert "See the rules and" in page
    assert [[cell.strip() for cell in row] for row in found.rows] == [
        ["surface", "made from"],
        ["UNCD", "scans"],
    ]
    assert "Not a departure" not in page and "Where the study departs" in found.texts["h1"]


def test_departures_of_the_readme_are_all_there():
    readme = (ROOT / "README.md").read_text()
    section = readme.partition("## Where the study departs from the paper\n")[2]
    section = section.partition("\n## ")[0]
    titles = re.findall(r"^\d+\. \*\*(.+?)\*\*", section, re.M)
    page = pages.departures_page(readme)
    assert len(titles) >= 17 and Reader(page).tags.count("li") == len(titles)
    assert [title for title in titles if f"<strong>{title}</strong>" not in page] == []
    assert [link for link in Reader(page).links if not link.startswith("https:")] == []


@pytest.mark.parametrize("readme", ["", README.replace("departs", "strays")])
def test_a_readme_without_departures_is_refused(readme):
    assert_says(refusal(pages.departures_page, readme), "README.md", "expected", "found none")


def test_parameters_are_the_whole_configuration_and_every_version():
    config = PAPER | {"store": "a<b>&c"}
    versions = {name: version(name) for name in ("numpy", "snakemake")} | {"a<b": "1<2"}
    found = Reader(pages.parameters_page(config, versions))
    assert yaml.safe_load(found.texts["pre"]) == config
    cells = [[cell.strip() for cell in row] for row in found.rows]
    assert cells[1:] == [[name, number] for name, number in versions.items()]
