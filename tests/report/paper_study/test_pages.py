"""The page of the paper's study: whole, self-contained, and its answer first."""

import base64
import re

import numpy as np
import pytest
from html_page import Page
from paper_study import captions, claims, figures, make_figures_page, make_page
from repository import PAPER

from hardcontact.config.configuration import merge_overlay
from hardcontact.paper.claims.verdicts import VERDICTS
from hardcontact.report.figures.listing import PAPER_FIGURES


@pytest.fixture(scope="module")
def page():
    return Page(make_page())


def plain(text):
    """A text with single, ordinary spaces."""
    return " ".join(text.replace("\N{NO-BREAK SPACE}", " ").split())


def answer_words(page):
    """The words of the page's answer."""
    return plain(page.texts["div"][0])


def test_the_page_needs_nothing_else(page):
    assert not {"link", "iframe", "object", "embed", "base"} & page.attributes.keys()
    assert all(source.startswith("data:image/svg+xml;base64,") for source in page.values("src"))


def test_the_page_concludes_from_a_reason_only_if_its_interval_excludes_none():
    """Without an effect the short edge would be "1 times shorter"."""
    table = claims()
    names = ["plasticity_moves_short_edge", "range_moves_short_edge"]
    for low, is_resolved in ((1.9, True), (0.91, False)):
        table.loc[table["id"].isin(names), ["computed", "low", "high"]] = [3.0, low, 7.7]
        line = answer_words(Page(make_page(table)))
        assert (
            "without yielding the short edge, averaged over the coatings, would be" in line
        ) == is_resolved
        assert ("Why shorter waves hardly matter: not resolved" in line) == (not is_resolved)


def pictures(page):
    """The pictures of a page in their order."""
    return [base64.b64decode(image["src"].partition(",")[2]) for image in page.attributes["img"]]


def test_the_page_of_figures_has_each_with_its_caption_and_its_file():
    page = Page(make_figures_page())
    assert pictures(page) == list(figures().values())
    for name in PAPER_FIGURES:
        assert f"../figures/{name}.pdf" in page.values("href")
        assert any(captions()[name].caption in text for text in page.texts["figcaption"])
    assert any("AFM scans: rms height (nm), published" in row[0] for row in page.rows)


def test_a_study_of_other_contacts_shows_both_values_and_judges_nothing():
    harder = merge_overlay(PAPER, {"study": "harder", "contact": {"hardness": "30 GPa"}})
    page = Page(make_page(configuration=harder))
    words = plain(page.texts["main"][0])
    assert words.startswith("What changes?")
    assert ["hardness", "25 GPa", "30 GPa"] in [[plain(cell) for cell in row] for row in page.rows]
    assert ["statement", "verdict"] not in [[row[0], row[-1]] for row in page.rows]
    for verdict in VERDICTS:
        assert f"verdict-{verdict.replace(' ', '-')}" not in page.values("class")
        assert verdict not in words


def test_a_page_without_numbers_still_has_its_figures(page):
    table = claims().assign(computed=np.nan, low=np.nan, high=np.nan, agreeing_share=np.nan)
    empty_page = Page(make_page(table))
    assert pictures(empty_page) == pictures(page)
    assert not re.search(r"\bnan\b", empty_page.texts["main"][0], re.I)
