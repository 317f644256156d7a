"""The page of the paper's study: whole, self-contained, and nothing left out."""

import base64
import re

import numpy as np
import pytest
from browser import needs_browser
from browser import shown as shown_by_browser
from html_page import Page
from paper_study import (
    CITATION,
    DEPARTURES,
    answer,
    captions,
    claims,
    datasets,
    figures,
    made_page,
    png,
)  # fmt: skip
from refusals import assert_says, refusal
from repository import ROOT

from hardcontact.answer.paper_answer import MAIN_FINDINGS, paper_page
from hardcontact.figures.catalogue import OF_PAPER
from hardcontact.numbers.printing import print_as_paper

HOSTILE = 'a < b & "c" <script>alert(1)</script>'


@pytest.fixture(scope="module")
def html():
    return made_page()


@pytest.fixture(scope="module")
def shown(html):
    return Page(html)


def links(shown):
    return [of["href"] for of in shown.attributes["a"]]


def test_the_page_needs_nothing_else(shown):
    assert not {"link", "iframe", "object", "embed", "base"} & shown.attributes.keys()
    assert all(source.startswith("data:image/png;base64,") for source in shown.values("src"))


def test_links_lead_into_the_page_beside_it_or_to_the_paper(shown):
    anchors = shown.values("id")
    assert len(anchors) == len(set(anchors))
    within = {link[1:] for link in links(shown) if link.startswith("#")}
    assert within <= set(anchors) and {*MAIN_FINDINGS} <= within
    others = [link for link in links(shown) if not link.startswith("#")]
    beside = {f"figures/{name}.{kind}" for name in OF_PAPER for kind in ("csv", "pdf")}
    beside |= {"answer.json", "claims.csv"}
    assert beside <= set(others)
    away = {link for link in others if ":" in link}
    assert away == {f"https://doi.org/{CITATION['references'][0]['doi']}"}


def test_everything_has_an_anchor(shown):
    for tag in ("h2", "h3", "h4", "figure"):
        assert all("id" in of for of in shown.attributes[tag]), tag
    assert {*claims()["id"], *OF_PAPER, "answer", "basis", "cite"} <= set(shown.values("id"))


def test_there_is_one_title_and_headings_are_in_order(html, shown):
    assert len(shown.texts["h1"]) == 1
    levels = [int(level) for level in re.findall(r"<h(\d)", html)]
    assert all(below - above <= 1 for above, below in zip(levels, levels[1:], strict=False))


@needs_browser
def test_a_browser_shows_the_page_on_a_phone_and_on_a_desk(tmp_path):
    departures = (ROOT / "workflow/report/departures.md").read_text()
    wide = {name: png((90, 90, 90), (1400, 900)) for name in OF_PAPER}
    page = paper_page(answer(), wide, captions(), departures, CITATION)
    for measured in shown_by_browser(page.replace("<details>", "<details open>"), tmp_path):
        assert measured["overflow"] == 0 and measured["requests"] == 0
        assert measured["loaded"] == len(OF_PAPER)


def test_the_band_stands_before_its_figure_which_comes_first(shown):
    numbers = answer().numbers
    said = shown.texts["strong"][0].replace("\N{NO-BREAK SPACE}", " ")
    for name in ("shortest_wavelength", "longest_wavelength"):
        row = numbers[name]
        computed = print_as_paper(row.computed, row.unit, (row.low, row.high), 2)
        assert_says(said, computed, print_as_paper(row.published, row.unit))
    assert [of["id"] for of in shown.attributes["figure"]][0] == "fig6"
    pictures = [base64.b64decode(of["src"].partition(",")[2]) for of in shown.attributes["img"]]
    order = ["fig6", *(name for name in OF_PAPER if name != "fig6")]
    assert pictures == [figures()[name] for name in order]


def test_figures_have_alternatives_and_captions_with_the_rest_folded(shown):
    alternatives = [of["alt"] for of in shown.attributes["img"]]
    for name, figure in OF_PAPER.items():
        assert f"{figure.label}: {figure.title}" in alternatives
        assert any(captions()[name].short in text for text in shown.texts["figcaption"])
    folded = [text for text in shown.texts["details"] if captions()["fig1"].more in text]
    assert len(folded) == len(OF_PAPER)


def rows_of(shown, columns):
    """The rows of the tables with so many columns, without their headings."""
    rows = [[cell.replace("\N{NO-BREAK SPACE}", " ") for cell in row] for row in shown.rows]
    return [row for row in rows if len(row) == columns and "verdict" not in row[-1].split()]


def test_every_statement_has_its_numbers_and_verdict(shown):
    rows = rows_of(shown, 7)
    assert len(rows) == len(claims())
    for cells, claim in zip(rows, claims().itertuples(), strict=True):
        assert_says(cells[0], claim.statement, claim.id)
        assert cells[1].strip() == claim.section
        assert cells[4].startswith(print_as_paper(claim.computed, claim.unit).split()[0])
        assert ("[" in cells[4]) == np.isfinite(claim.low)
        assert cells[6].startswith(claim.verdict)
    assert not re.search(r"\bnan\b", " ".join(sum(rows, [])), re.I)


def test_main_findings_are_rows_of_the_same_numbers(shown):
    table = claims().set_index("id")
    rows = [row for row in rows_of(shown, 5) if "%" in row[3] or row[3].strip() == ""]
    for cells, name in zip(rows, MAIN_FINDINGS, strict=True):
        assert cells[0].strip() == table["statement"][name]
        assert cells[-1].strip() == table["verdict"][name]


def test_verdicts_are_counted(shown):
    rows = (row for row in shown.rows if len(row) == 4 and row[1].strip().isdigit())
    counted = {row[0].strip(): int(row[2]) for row in rows}
    assert counted == claims()["verdict"].value_counts().to_dict()


def test_substitutes_are_said_to_be_and_only_they(shown):
    assert any("UNCD (substitute)" in row[0] for row in shown.rows)
    measured = datasets()["topography"].assign(basis=("surface", ["measured"] * 5))
    bands = {"band": datasets()["band"].assign(basis=("surface", ["measured"] * 4))}
    made = Page(made_page(answer(topography=measured, **bands)))
    assert not any("(substitute)" in text for text in made.texts["main"])


def test_every_departure_has_its_place():
    text = (ROOT / "workflow/report/departures.md").read_text()
    shown = Page(made_page(departures=text))
    titles = re.findall(r"^\d+\. \*\*(.+?)\*\*", text, re.M)
    assert len(titles) >= 17 and set(titles) <= set(shown.texts["strong"])
    assert set(re.findall("^## (.+)", text, re.M)) <= set(shown.texts["h3"])
    assert text.partition("\n")[0][2:] in shown.texts["h2"]


def test_departures_without_a_title_are_refused():
    assert_says(refusal(made_page, None, DEPARTURES[2:]), "expected", "'# '", "found")


@pytest.mark.parametrize("column", ["section", "statement", "unit", "basis", "note"])
def test_what_tables_say_is_text_not_markup(html, column):
    table = claims()
    table[column] = table[column].astype(object)
    table.loc[table["id"] == "range_of_adhesion", column] = HOSTILE
    assert made_page(answer(table)).count("<script") == html.count("<script")


def test_labels_are_text_not_markup(html):
    surfaces = answer().surfaces.assign(label=HOSTILE)
    band = datasets()["band"]
    band = band.assign(label=("surface", [HOSTILE] * band.sizes["surface"]))
    made = made_page(answer(band=band)._replace(surfaces=surfaces))
    assert made.count("<script") == html.count("<script") and "alert" in made


def test_a_page_without_the_numbers_of_the_answer_has_all_the_rest():
    table = claims().assign(computed=np.nan, low=np.nan, high=np.nan, frequency=np.nan)
    shown = Page(made_page(answer(table)))
    assert "answer" not in shown.values("id")
    assert len(shown.attributes["img"]) == len(OF_PAPER)
    assert not re.search(r"\bnan\b", shown.texts["main"][0], re.I)
