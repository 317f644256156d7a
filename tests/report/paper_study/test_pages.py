"""The page of the paper's study: whole, self-contained, and its answer first."""

import base64
import re

import numpy as np
import pytest
from html_page import Page
from paper_study import (
    CITATION,
    answer,
    captions,
    claims,
    datasets,
    figures,
    make_figures_page,
    make_page,
)
from refusals import assert_says
from repository import PAPER, merged

from hardcontact.base.formatting import format_as_paper
from hardcontact.paper.claim_selection import LARGER_PIXELS
from hardcontact.paper.verdicts import UNTESTABLE, VERDICTS, summary
from hardcontact.report.figures.listing import PAPER_FIGURES
from hardcontact.report.quantities import numbers_by_name


@pytest.fixture(scope="module")
def html():
    return make_page()


@pytest.fixture(scope="module")
def page(html):
    return Page(html)


def plain(text):
    return " ".join(text.replace("\N{NO-BREAK SPACE}", " ").split())


def answer_words(page):
    """The words of the page's answer."""
    return plain(page.texts["div"][0])


def test_the_page_needs_nothing_else(page):
    assert not {"link", "iframe", "object", "embed", "base"} & page.attributes.keys()
    assert all(source.startswith("data:image/svg+xml;base64,") for source in page.values("src"))


def test_links_lead_within_the_study_or_to_the_paper(page):
    anchors, links = page.values("id"), page.values("href")
    assert len(anchors) == len(set(anchors))
    assert {link[1:] for link in links if link.startswith("#")} <= set(anchors)
    neighbours = {"answer.json", "claims.csv", "report/claims.html", "report/figures.html"}
    assert neighbours <= set(links)
    external = {link for link in links if ":" in link}
    assert external == {f"https://doi.org/{CITATION['references'][0]['doi']}"}


def test_the_page_says_first_what_came_out(page):
    first_words = answer_words(page)
    assert "Wavelengths of 640 to 1280 nm matter most: 1 % more " in first_words
    assert "at 320 to 640 nm by " in first_words
    numbers = numbers_by_name(answer())
    for name in ("first_short_edge", "first_long_edge"):
        edge, published = numbers[name], numbers[f"{name}_published"]
        interval = (edge.low, edge.high)
        assert_says(first_words, format_as_paper(edge.value, edge.unit, interval, 2))
        assert_says(first_words, format_as_paper(published.value, published.unit))


def test_the_page_warns_of_coarse_grids_first():
    coarse_page = Page(make_page(**datasets(pixels=128)))
    assert answer_words(coarse_page).startswith("Coarse grids: ")


def test_findings_that_only_larger_pixels_leave_untested_are_told_apart():
    """Studies on smaller grids have more independent findings; the page says which."""
    table = claims()
    slopes = table["id"].str.fullmatch("afm_rms_(slope|curvature)_.*")
    table.loc[slopes, ["verdict", "note"]] = [UNTESTABLE, f"A note. {LARGER_PIXELS}"]
    count = summary(table)["independent"].sum()
    expected = f"independent findings ({count - 8} without slopes and curvatures"
    assert slopes.sum() == 8
    assert expected in " ".join(answer(table)["verdicts"])
    assert "without slopes" not in " ".join(answer()["verdicts"])


def test_a_verdict_on_an_edge_from_artificial_roughness_says_so():
    """The short transition, 20 nm or 80 nm, is shorter or longer than the edge."""
    table = claims()
    table.loc[table["id"] == "short_edge_first", ["computed", "low", "high"]] = [50.0, 45.0, 55.0]
    for transition, is_artificial in ((20.0, False), (80.0, True)):
        scales = datasets()["scales"].assign(transition=("side", [transition, 1e6]))
        page = Page(make_page(table, scales=scales))
        (line,) = re.findall(
            "shortest wavelength that matters on any.*, the longest", answer_words(page)
        )
        assert ("from artificial roughness" in line) == is_artificial, line
        (row,) = [
            row
            for row in page.rows
            if "on the coating whose force changes first" in row[0] and "short-wave" in row[0]
        ]
        assert ("from artificial roughness" in plain(" ".join(row))) == is_artificial, row


def test_the_page_concludes_from_a_reason_only_if_its_interval_excludes_none():
    """Without an effect the shortest wavelength that matters would be 1 times as long."""
    table = claims()
    names = ["plasticity_moves_short_edge", "range_moves_short_edge"]
    for low, is_resolved in ((1.9, True), (0.91, False)):
        table.loc[table["id"].isin(names), ["computed", "low", "high"]] = [3.0, low, 7.7]
        line = answer_words(Page(make_page(table)))
        assert ("matter little for two reasons" in line) == is_resolved
        assert ("Not resolved is whether yielding" in line) == (not is_resolved)


def pictures(page):
    """The pictures of a page in their order."""
    return [base64.b64decode(image["src"].partition(",")[2]) for image in page.attributes["img"]]


def test_the_figures_of_the_answer_have_their_captions(page):
    shown = [name for name, picture in figures().items() if picture in pictures(page)]
    assert {"fig_scales", "fig_octaves", "fig6"} <= set(shown)
    for name in shown:
        assert captions()[name].title in page.values("alt")
        assert any(captions()[name].short in text for text in page.texts["figcaption"])


def test_the_page_of_figures_has_each_with_its_caption_and_its_file():
    page = Page(make_figures_page())
    assert pictures(page) == list(figures().values())
    for name in PAPER_FIGURES:
        assert f"../figures/{name}.pdf" in page.values("href")
        assert any(captions()[name].short in text for text in page.texts["figcaption"])
    assert any("AFM scans: rms height (nm), published" in row[0] for row in page.rows)


def test_main_findings_repeat_the_claims(page):
    table = claims().set_index("id")
    anchors = [link.partition("#")[2] for link in page.values("href")]
    ids = [anchor for anchor in anchors if anchor in table.index]
    ids = ids[ids.index("band_is_sufficient") :]  # the table, after those not reproduced
    rows = [[plain(cell) for cell in row] for row in page.rows if len(row) == 6][1:]
    for cells, claim_id in zip(rows[: len(ids)], ids, strict=True):
        claim = table.loc[claim_id]
        assert cells[0].startswith(claim["statement"]) and cells[-1].startswith(claim["verdict"])
        assert cells[3].endswith(claim["number"])
    assert len(ids) >= 10


def test_a_study_of_other_contacts_shows_both_values_and_judges_nothing():
    harder = merged(PAPER, {"study": "harder", "contact": {"hardness": "30 GPa"}})
    page = Page(make_page(configuration=harder))
    words = plain(page.texts["main"][0])
    assert words.startswith("What changes?")
    assert ["hardness", "25 GPa", "30 GPa"] in [[plain(cell) for cell in row] for row in page.rows]
    assert ["finding", "verdict"] not in [[row[0], row[-1]] for row in page.rows]
    for verdict in VERDICTS:
        assert f"verdict-{verdict.replace(' ', '-')}" not in page.values("class")
        assert verdict not in words


def test_only_substitutes_are_labelled_as_such(page):
    assert any("UNCD (substitute)" in row[0] for row in page.rows)
    measured_topography = datasets()["topography"].assign(basis=("surface", ["measured"] * 5))
    measured_page = Page(make_page(topography=measured_topography))
    assert not any("(substitute)" in text for text in measured_page.texts["main"])


def test_a_page_without_numbers_still_has_its_figures(page):
    table = claims().assign(computed=np.nan, low=np.nan, high=np.nan, agreeing_share=np.nan)
    empty_page = Page(make_page(table))
    assert pictures(empty_page) == pictures(page)
    assert not re.search(r"\bnan\b", empty_page.texts["main"][0], re.I)
