"""The page on what decides the band: every part with question, table and figure."""

import re

import numpy as np
import pytest
from figure_inputs.closed_form import closed_form
from figure_inputs.elastic_limit import elastic_limit
from figure_inputs.laws import laws
from figure_inputs.published_tables import published_constants
from figure_inputs.scales import band
from figure_inputs.scaling import scaling
from figure_inputs.scan_size import scan_size
from figure_inputs.statistics import statistics
from html_page import Page
from paper_study import svg

from hardcontact.answer.captions import Caption
from hardcontact.answer.insight_page import PARTS, insight_page
from hardcontact.figures.listing import OF_INSIGHT
from hardcontact.insight.prediction import VALIDATION, validated_errors

MADE = (scaling, scan_size, closed_form, laws, statistics, elastic_limit)
HOSTILE = 'a < b & "c" <script>alert(1)</script>'


def made_page(text="Said.", labels=None, basis="substitute"):
    datasets = {name: make() for name, make in zip(PARTS, MADE, strict=True)}
    datasets["band"] = band()
    for one in (one for one in datasets.values() if "surface" in one.dims):
        one["basis"] = one["label"].copy(data=[basis] * 4)
        if labels:
            one["label"] = one["label"].copy(data=np.array([*labels]))
    figures = {name: (svg("grey"), Caption("", text, text)) for name in PARTS}
    errors = validated_errors(VALIDATION)
    return insight_page(datasets, datasets.pop("band"), figures, published_constants(), 128, errors)


@pytest.fixture(scope="module")
def page():
    return Page(made_page())


def test_every_figure_of_the_chapter_has_a_part_in_its_order():
    assert list(PARTS) == list(OF_INSIGHT)


def test_every_part_has_a_question_an_anchor_a_table_and_a_figure_with_its_files(page):
    questions = page.texts["h2"]
    assert len(set(questions)) == len(questions) == len(PARTS) and len(page.texts["h1"]) == 1
    assert [one["id"] for one in page.attributes["h2"]] == list(PARTS)
    ids, links = page.values("id"), page.values("href")
    assert len(set(ids)) == len(ids)
    assert [link[1:] for link in links if link.startswith("#")] == list(PARTS)
    files = [f"figures/{name}.{kind}" for name in PARTS for kind in ("csv", "pdf")]
    assert [link for link in links if not link.startswith("#")] == files
    assert {"band", *(name.removeprefix("fig_") for name in PARTS)} <= set(ids)
    sources = page.values("src")
    assert len(sources) == len(PARTS) and len(page.values("alt")) == len(PARTS)
    assert all(source.startswith("data:image/svg+xml;base64,") for source in sources)


def test_no_cell_lacks_its_column_or_shows_what_is_no_number(page):
    for row in page.rows:
        assert len(row) >= 3
    assert not re.search(r"\b(nan|inf|None|undefined)\b", "".join(page.texts["main"]))


def test_only_what_is_no_scan_is_called_a_substitute(page):
    first = [row[0].strip() for row in page.rows]
    assert first.count("UNCD (substitute)") >= len(PARTS) - 2  # Two parts have no row of it.
    assert "substitute" not in "".join(Page(made_page(basis="measured")).texts["main"]).lower()


def test_labels_and_captions_are_text_not_markup(page):
    made = Page(made_page(HOSTILE, [HOSTILE, "b", "c", "d"]))
    assert len(made.attributes["script"]) == len(page.attributes["script"])
    assert HOSTILE in "".join(made.texts["td"])
