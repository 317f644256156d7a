"""The page of the paper's study: whole, self-contained, and nothing left out."""

import base64
import re

import numpy as np
import pandas as pd
import pytest
from browser import needs_browser
from browser import shown as shown_by_browser
from html_page import Page
from paper_claims import STATEMENTS
from paper_study import DEPARTURES, answer, captions, claims, figures, made_page, png
from refusals import assert_says, refusal
from repository import ROOT

from hardcontact.answer.paper_page import STORY, paper_page
from hardcontact.answer.paper_sentences import answer_sentences, basis_sentences
from hardcontact.figures.catalogue import OF_PAPER
from hardcontact.numbers.printing import print_as_paper

HOSTILE = 'a < b & "c" <script>alert(1)</script>'


@pytest.fixture(scope="module")
def html():
    return made_page()


@pytest.fixture(scope="module")
def shown(html):
    return Page(html)


def test_the_page_needs_nothing_else(html, shown):
    assert not {"script", "link", "iframe", "object", "embed", "base"} & shown.attributes.keys()
    assert all(source.startswith("data:image/png;base64,") for source in shown.values("src"))
    assert not re.search(r"url\(|@import|srcset", html)
    within = [link[1:] for link in shown.values("href") if link.startswith("#")]
    assert set(within) <= set(shown.values("id")) and len(within) == 3
    others = [link for link in shown.values("href") if not link.startswith("#")]
    assert others and all(link.startswith("https://doi.org/") for link in others)


def test_the_page_reads_on_a_phone(html, shown):
    assert {"name": "viewport", "content": "width=device-width, initial-scale=1"} in (
        shown.attributes["meta"]
    )
    assert "@media (max-width" in html
    assert all("data-label" in cell for cell in shown.attributes["td"])


@needs_browser
def test_a_browser_shows_the_page_on_a_phone_and_on_a_desk(tmp_path):
    departures = (ROOT / "workflow/report/departures.md").read_text()
    wide = {name: png((90, 90, 90), (1400, 900)) for name in OF_PAPER}
    page = paper_page(answer(), wide, captions(), departures)
    for measured in shown_by_browser(page.replace("<details>", "<details open>"), tmp_path):
        assert measured["overflow"] == 0 and measured["requests"] == 0
        assert measured["loaded"] == len(OF_PAPER)


def test_question_and_answer_come_first(html, shown):
    assert shown.texts["h1"] == ["Which scales of roughness matter?"]
    question, said, basis = shown.texts["p"][:3]
    assert question.count("?") == 1
    assert_says(question, "ruby", "polished UNCD, UNCD, NCD, MCD")
    assert said == " ".join(answer_sentences(answer()))
    assert basis == " ".join(basis_sentences(answer()))
    assert html.index(said[:40]) < html.index("<figure")


def test_figures_stand_in_the_order_of_the_story_with_their_captions(shown):
    pictures = [of["src"].partition(",")[2] for of in shown.attributes["img"]]
    assert [base64.b64decode(data) for data in pictures] == list(figures().values())
    expected = list(captions().values())
    assert list(zip(shown.texts["h4"], shown.texts["figcaption"], strict=True)) == expected
    alternatives = [of["alt"] for of in shown.attributes["img"]]
    expected = [(figure.label, figure.title) for figure in OF_PAPER.values()]
    for said, parts in zip(alternatives, expected, strict=True):
        assert_says(said, *parts)


def test_every_chapter_of_figures_is_introduced_once(shown):
    chapters = list(dict.fromkeys(figure.chapter for figure in OF_PAPER.values()))
    assert list(STORY) == chapters == shown.texts["h3"][: len(chapters)]
    assert [text for text in STORY.values() if shown.texts["p"].count(text) != 1] == []


def test_every_statement_has_its_numbers_and_verdict(shown):
    rows = [row for row in shown.rows if len(row) == 5 and row[0].strip() != "statement"]
    by_section = pd.concat(of for _, of in claims().groupby("section", sort=False))
    assert len(rows) == len(STATEMENTS)
    for cells, claim in zip(rows, by_section.itertuples(), strict=True):
        assert_says(cells[0], claim.statement, claim.id)
        assert cells[2].startswith(print_as_paper(claim.computed, claim.unit).split()[0])
        assert ("[" in cells[2]) == np.isfinite(claim.low)
        assert cells[4].startswith(claim.verdict)
    assert not re.search(r"\bnan\b", " ".join(sum(rows, [])), re.I)


def test_verdicts_are_counted_and_folded_by_section(shown):
    table = claims()
    sections = list(dict.fromkeys(table["section"]))
    assert len(shown.attributes["details"]) == len(sections)
    for name, said in zip(sections, shown.texts["summary"], strict=True):
        counts = {verdict: int(n) for n, verdict in re.findall(r"(\d+) ([a-z ]+)", said)}
        assert said.startswith(name)
        assert counts == table["verdict"][table["section"] == name].value_counts().to_dict()
    rows = (row for row in shown.rows if len(row) == 4 and row[1].strip().isdigit())
    counted = {row[0].strip(): int(row[2]) for row in rows}
    assert counted == table["verdict"].value_counts().to_dict()


def test_every_departure_has_its_place():
    text = (ROOT / "workflow/report/departures.md").read_text()
    shown = Page(made_page(departures=text))
    titles = re.findall(r"^\d+\. \*\*(.+?)\*\*", text, re.M)
    assert len(titles) >= 17 and set(titles) <= set(shown.texts["strong"])
    headings = re.findall("^## (.+)", text, re.M)
    assert shown.texts["h3"][len(STORY) :] == headings
    assert shown.texts["h2"][-1] == text.partition("\n")[0][2:]


def test_departures_without_a_title_are_refused():
    assert_says(refusal(made_page, None, DEPARTURES[2:]), "expected", "'# '", "found")


@pytest.mark.parametrize("column", ["section", "statement", "unit", "basis", "note"])
def test_what_tables_say_is_text_not_markup(column):
    table = claims()
    table[column] = table[column].astype(object)
    table.loc[table["id"] == "range_of_adhesion", column] = HOSTILE
    assert "script" not in Page(made_page(answer(table))).attributes


def test_labels_are_text_not_markup():
    surfaces = answer().surfaces.assign(label=HOSTILE)
    assert "script" not in Page(made_page(answer()._replace(surfaces=surfaces))).attributes


def test_a_page_without_the_numbers_of_the_answer_has_all_the_rest():
    table = claims().assign(computed=np.nan, low=np.nan, high=np.nan, frequency=np.nan)
    shown = Page(made_page(answer(table)))
    assert shown.texts["strong"][0] == answer_sentences(answer(table))[-1]
    assert len(shown.attributes["img"]) == len(OF_PAPER)
