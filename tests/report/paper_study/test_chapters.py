"""Pages of claims and of chapters are complete, and their texts are escaped."""

import re

import numpy as np
import pytest
from html_page import Page, dead_links
from paper_study import FRAME, PAGES, make_figures_page, make_page
from paper_study import claims as all_claims
from refusals import assert_says
from repository import PAPER, ROOT

from hardcontact.paper.claims.verdicts import VERDICTS
from hardcontact.report.figures.listing import PAPER_FIGURES
from hardcontact.report.paper_study.pages import convert_chapter, report_pages
from hardcontact.report.paper_study.tables import claim_facts

HOSTILE = 'a < b & "c" <script>alert(1)</script>'


def three_claims(**values):
    """Return three claims from Table 1, the first with other values."""
    table = all_claims().iloc[:3].copy()
    for column, value in values.items():
        table.loc[0, column] = value
    return table


def make_pages(table=None, changed=(), **texts):
    """The pages of claims, by default three, of chapters by name, and of parameters."""
    configuration = PAPER | {"intervals": {"confidence": 0.8}}
    table = three_claims() if table is None else table
    return report_pages(table, changed, texts, configuration, {"numpy": "1", "a<b": "1<2"}, FRAME)


SETS_AND_CONFIDENCE = 100, 0.95


@pytest.mark.parametrize(
    ("values", "printed"),
    [
        ({"computed": 3.25, "low": 2.75, "high": 3.75}, {"computed_text": "3.2 [2.8, 3.8] nm"}),
        ({"computed": np.nan}, {"computed_text": "", "computed": None}),
        ({"published": 3.0}, {"published_text": "3 nm"}),
        ({"rule": "above"}, {"published_text": "as stated"}),
        ({"accepted_low": 2.0, "accepted_high": 4.0}, {"accepted_text": "2 to 4 nm"}),
        ({"accepted_low": 1.0, "accepted_high": np.inf}, {"accepted_text": "above 1 nm"}),
        ({"accepted_low": -np.inf, "accepted_high": 0.2}, {"accepted_text": "below 0.2 nm"}),
        ({"verdict": "undecided"}, {"kind": "independent"}),
        ({"verdict": "undecided", "follows_from": "second"}, {"kind": "follows"}),
        ({"verdict": "by construction"}, {"kind": "by construction"}),
    ],
)
def test_a_claim_is_printed_with_its_number_its_limits_and_its_kind(values, printed):
    row = claim_facts(three_claims(**values), *SETS_AND_CONFIDENCE)["claims"][
        "afm_rms_height_polished_uncd"
    ]
    assert {name: row[name] for name in printed} == printed


@pytest.mark.parametrize(
    ("values", "count"),
    [
        ({"basis": "no scan", "verdict": "reproduced"}, 1),
        ({"basis": "no scan", "verdict": "reproduced", "follows_from": "second"}, 0),
        ({"basis": "no scan; assumed asperities", "verdict": "reproduced"}, 1),
        ({"basis": "no scan", "verdict": "undecided"}, 0),
        ({"verdict": "reproduced"}, 0),
    ],
)
def test_facts_count_independent_statements_reproduced_without_scans(values, count):
    assert claim_facts(three_claims(**values), *SETS_AND_CONFIDENCE)["without_scan"] == count


KINDS = ["independent", "follows", "by construction"]


def test_the_page_of_claims_has_a_row_for_each_and_counts_verdicts():
    table = all_claims()
    page = Page(make_pages(table)["claims"])
    rows = [row for row in page.rows if len(row) == 6 and row[0].strip() != "statement"]
    independent_first = sorted(
        claim_facts(table, *SETS_AND_CONFIDENCE)["claims"].values(),
        key=lambda row: (VERDICTS.index(row["verdict"]), KINDS.index(row["kind"])),
    )
    for cells, claim in zip(rows, independent_first, strict=True):
        row_text = " ".join(cells).replace("\N{NO-BREAK SPACE}", " ")
        words = [claim[name] for name in ("statement", "number", "section")]
        assert_says(row_text, f"Statement {claim['position']} · ", *words)
    counts = [row for row in page.rows if len(row) == 4][1:]
    assert [row[0].strip() for row in counts] == list(VERDICTS)
    assert all(row[3].strip() for row in counts)
    assert set(table["id"]) <= set(page.values("id"))


@pytest.mark.parametrize("column", ["section", "statement", "number", "unit", "basis", "note"])
def test_claims_are_text_not_markup(column):
    page = make_pages(three_claims(**{column: HOSTILE}))["claims"]
    assert page.count("<script") == make_pages()["claims"].count("<script") and "alert(1)" in page


CHAPTER = """# Where the study departs <from> the paper

1. **First.** See [the rules](resources/paper/README.md) and [the paper](https://doi.org/10.1/x).
2. **Second.** 1 < 2. See [ends](methods.md#ends); 250 µm, but `--radius 250 µm`.

## Substitute scans

| surface | made from |
|---|---|
| UNCD | scans |
"""


def test_a_chapter_is_a_page_whose_links_lead_to_pages_not_into_the_repository():
    page = make_pages(departures=CHAPTER)["departures"]
    parsed_page = Page(page)
    assert parsed_page.texts["h1"] == ["Where the study departs <from> the paper"]
    assert len(parsed_page.texts["li"]) == 2 and "1 &lt; 2" in page and "See the rules and" in page
    text = convert_chapter(CHAPTER, ["methods", "claims"]).html
    assert Page(text).values("href") == ["https://doi.org/10.1/x", "methods.html#ends"]
    assert "250\N{NO-BREAK SPACE}µm, but <code>--radius 250 µm" in text
    rows = [[cell.strip() for cell in row] for row in parsed_page.rows]
    assert rows == [["surface", "made from"], ["UNCD", "scans"]]
    assert [cell["data-label"] for cell in parsed_page.attributes["td"]] == ["surface", "made from"]


def all_pages():
    """Every page of a study, by its path."""
    texts = {path.stem: path.read_text("utf-8") for path in (ROOT / "workflow/report").glob("*.md")}
    report = make_pages(all_claims(), **texts) | {"figures": make_figures_page()}
    pages = {f"report/{name}.html": page for name, page in report.items()}
    return pages | {"answer.html": make_page()}


def test_every_page_links_to_all_others_and_no_link_is_dead():
    study_pages = all_pages()
    files = {"answer.json", "claims.csv", *(f"figures/{name}.pdf" for name in PAPER_FIGURES)}
    assert dead_links(study_pages, files) == []
    assert set(study_pages) == {"answer.html", *(f"report/{name}.html" for name in PAGES)}
    for path, html in study_pages.items():
        menu = re.search('<nav class="menu pages".*?</nav>', html, re.DOTALL)[0]
        assert menu.count("<a ") == len(PAGES) and menu.count('aria-current="page"') == 1, path


@pytest.mark.parametrize("path", sorted((ROOT / "workflow/report").glob("*.md")))
def test_every_formula_of_a_chapter_is_mathml(path):
    """An unknown command would keep its backslash."""
    text = path.read_text("utf-8")
    formulas = re.findall("<math.*?</math>", convert_chapter(text).html)
    assert 2 * len(formulas) == text.count("$$")
    assert not [formula for formula in formulas if "\\" in formula or "<merror" in formula]


def test_statements_beside_other_contacts_have_numbers_and_no_verdicts():
    changed = [{"input": "hardness", "paper": "25 GPa", "study": "30 GPa"}]
    table = three_claims(computed=3.25, low=2.75, high=3.75)
    page = Page(make_pages(table, changed)["claims"])
    assert_says(page.texts["p"][0], "hardness 30 GPa", "paper 25 GPa", "meaningless")
    (row,) = [row for row in page.rows if "of polished UNCD" in row[0]]
    assert_says(row[-1].replace("\N{NO-BREAK SPACE}", " "), "3.2 [2.8, 3.8] nm")
    assert not [text for text in page.values("class") if text.startswith("verdict-")]
