"""Self-contained documents: well formed, nothing to load, nothing that text could break."""

import pytest
from html_page import Page

from hardcontact.answer.html import figure_html, list_html, page, table_html, text_html

HOSTILE = 'a < b & "c" <script>alert(1)</script>'


def test_every_text_is_shown_as_it_is():
    body = (
        figure_html(b"\x89PNG", HOSTILE, HOSTILE)
        + table_html([HOSTILE], [[HOSTILE]])
        + list_html([HOSTILE])
    )
    shown = Page(page(HOSTILE, body))
    for tag in ("title", "h1", "figcaption", "th", "td", "li"):
        assert shown.texts[tag] == [HOSTILE], tag
    assert shown.attributes["img"][0]["alt"] == HOSTILE
    assert "script" not in shown.attributes


def test_pictures_are_inside_the_page():
    (image,) = Page(page("t", figure_html(b"png", "a", "c"))).attributes["img"]
    assert image["src"] == "data:image/png;base64,cG5n"


def test_page_fits_the_width_of_its_screen():
    shown = Page(page("t", ""))
    views = [of["content"] for of in shown.attributes["meta"] if of.get("name") == "viewport"]
    assert views == ["width=device-width, initial-scale=1"]
    assert "@media (max-width" in shown.texts["style"][0]


def test_cells_name_their_column_where_there_is_no_header():
    shown = Page(table_html(["part", "why"], [["a", "b"], ["c", "d"]]))
    assert [cell["data-label"] for cell in shown.attributes["td"]] == ["part", "why"] * 2
    assert [[cell.strip() for cell in row] for row in shown.rows[1:]] == [["a", "b"], ["c", "d"]]


@pytest.mark.parametrize("text", ["37 nm", "[31, 44] µm", "0.6 µN", "46 mJ/m²", "25 GPa", "5 %"])
def test_numbers_stay_with_their_units(text):
    assert text_html(text) == text.replace(" ", "\u00a0").replace("[31,\u00a0", "[31, ")


@pytest.mark.parametrize("text", ["3 maps", "1 Newton", "2 meters"])
def test_other_words_do_not(text):
    assert text_html(text) == text
