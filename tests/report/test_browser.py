"""Pages in a browser: no fault of accessibility, every screen, tables, folds and figures in use."""

from functools import cache
from itertools import groupby

import pytest
from browser import HEIGHT, WIDTHS, audit_page, measure_pages, needs_browser, run_on_pages
from html_page import Page
from own_answers import CASES, FORCES
from own_answers import make_page as make_own_page
from paper_study import FRAME, claims, make_page, svg
from repository import PAPER, ROOT

from hardcontact.paper.claims.verdicts import VERDICTS
from hardcontact.report.figures.listing import OWN_FIGURES, PAPER_FIGURES
from hardcontact.report.paper_study.pages import report_pages

pytestmark = [needs_browser, pytest.mark.study]
#: Texts of cells in the order of their numbers, without which a text comes last.
LENGTHS = ["<5 nm", "43 [40, 50] nm", "250 nm to 1 mm", "1.8 µm", "0.5 mm", ""]


@cache
def page_of(name):
    """A page by its name; claims have each verdict twice."""
    if name == "answer":
        return make_page()
    if name == "own":
        return make_own_page(CASES[FORCES])
    if name == "own, with a long name":
        return make_own_page(CASES["open, one force"])
    texts = {"theory": (ROOT / "workflow/report/theory.md").read_text("utf-8")}
    # The page of parameters has a table of versions, in which any texts may stand.
    versions = {f"scan {number}": text for number, text in enumerate(LENGTHS[::-1])}
    return report_pages(claims()[: 2 * len(VERDICTS)], [], texts, PAPER, versions, FRAME)[name]


@pytest.mark.parametrize(
    ("name", "scheme"),
    [
        ("answer", "dark"),
        ("own", "dark"),
        *((name, "light") for name in ("own", "claims", "theory")),
    ],
)
def test_axe_finds_no_fault(name, scheme, tmp_path):
    audit = audit_page(page_of(name), tmp_path, scheme)
    # A page that axe cannot read meets no rule.
    assert audit["faults"] == [] and audit["passes"] > 20
    assert audit["dark"] == (scheme == "dark")


def test_pages_fit_every_screen(tmp_path):
    names = ["own", "own, with a long name", "claims", "parameters"]
    frames = measure_pages(map(page_of, names), tmp_path)
    assert [frame["screen"] for frame in frames] == len(names) * list(WIDTHS)
    for frame in frames:
        assert frame["overflow"] == 0 and frame["requests"] == 0, frame
        assert frame["smallestFont"] >= 12, frame  # pixels, our limit for legible text


#: Clicks twice on the heading of a column of the first table; returns a column after each click.
SORT = """
  const table = document.querySelector(".table table");
  return [1, 2].map(() => {
    table.tHead.querySelectorAll("button")[%d].click();
    return [...table.tBodies[0].rows].map(row => row.cells[%d].textContent);
  });
"""
#: Copies the first table of claims, follows a link to a row in the last fold, and prints.
USE = """
  let copied;
  Object.defineProperty(window.navigator, "clipboard", {value: {writeText: text => copied = text}});
  document.querySelector("#statements ~ details .tools button").click();
  const folds = [...document.querySelectorAll("details")], folded = folds.at(-1);
  const target = folded.querySelector("td[id]");
  window.location.hash = target.id;
  await new Promise(resolve => setTimeout(resolve, 100));
  const menu = document.querySelector(".menu").getBoundingClientRect();
  const result = {copied, opened: folds.map(fold => fold.open),
    below: target.getBoundingClientRect().top - menu.bottom, menu: menu.top};
  window.dispatchEvent(new window.Event("beforeprint"));
  result.printed = folds.map(fold => fold.open);
  window.dispatchEvent(new window.Event("afterprint"));
  return result;
"""
#: Returns the links to other files after pictures had time to load.
LINKS = """
  await new Promise(resolve => setTimeout(resolve, 500));
  const links = [...document.querySelectorAll("a[href]")].map(link => link.getAttribute("href"));
  return links.filter(link => !/^#|^https:/.test(link));
"""
#: Opens the first figure, then presses Escape.
OPEN = """
  const figure = document.querySelector(".zoom");
  figure.querySelector("summary").click();
  await new Promise(resolve => setTimeout(resolve, 100));
  const width = figure.querySelector("img").clientWidth;
  window.dispatchEvent(new window.KeyboardEvent("keydown", {key: "Escape"}));
  return {width, open: figure.open};
"""
#: By the names of the results: a page and the script that acts on it.
ACTIONS = {
    "sorted numbers": ("parameters", SORT % (1, 1)),
    "sorted surfaces": ("own", SORT % (2, 0)),
    "used claims": ("claims", USE),
    "opened figure": ("own", OPEN),
    "answer": ("answer", LINKS),
    "own": ("own", LINKS),
}


def act(names, folder):
    """Return the results of actions by their names, all in one browser."""
    actions = [(page_of(page), script) for page, script in map(ACTIONS.get, names)]
    return dict(zip(names, run_on_pages(actions, folder), strict=True))


@pytest.fixture(scope="module")
def outcomes(tmp_path_factory):
    """Act on pages without any file beside them."""
    return act([*ACTIONS], tmp_path_factory.mktemp("pages"))


def test_tables_sort_numbers_by_their_size(outcomes):
    ascending, descending = outcomes["sorted numbers"]
    assert [text.replace("\N{NO-BREAK SPACE}", " ") for text in ascending] == LENGTHS
    assert descending[-1] == "" and descending[:-1] == ascending[-2::-1]


def test_sorted_rows_of_a_surface_stay_together(outcomes):
    for surfaces in outcomes["sorted surfaces"]:
        groups = [surface for surface, _ in groupby(surfaces)]
        assert len(groups) == len(set(surfaces)) == 2


def test_claims_copy_with_their_cells_apart_and_open_for_a_link_and_for_the_printer(outcomes):
    result = outcomes["used claims"]
    head, row = result["copied"].split("\n")[:2]
    statement, location = row.split("\t")[0].split("; ")[:2]
    claim = claims().iloc[int(location.split(" · ")[0].removeprefix("Statement ")) - 1]
    assert (statement, claim["verdict"]) == (claim["statement"], VERDICTS[0])
    assert len(row.split("\t")) == len(head.split("\t")) == 6
    # Four verdicts test something, so their folds are open. The link opened the last.
    assert result["opened"] == [True] * 4 + [False] * 2 + [True]
    # The target of the link is on the screen, below the menu at the top.
    assert result["menu"] == 0 <= result["below"] < HEIGHT
    assert all(result["printed"])


def test_a_page_links_to_other_files_only_beside_its_figures(outcomes, tmp_path):
    (tmp_path / "figures").mkdir()
    for figure in (*PAPER_FIGURES, *OWN_FIGURES):
        (tmp_path / f"figures/{figure}.svg").write_bytes(svg("#bbb"))
    for name, links_beside_files in act(["answer", "own"], tmp_path).items():
        links = [tag["href"] for tag in Page(page_of(name)).attributes["a"]]
        assert outcomes[name] == [] and "answer.json" in links_beside_files
        assert links_beside_files == [
            link for link in links if not link.startswith(("#", "https:"))
        ]


def test_figures_open_at_full_size_and_close_on_escape(outcomes):
    result = outcomes["opened figure"]
    # An open figure is 70rem, 1120 pixels, wide or more.
    assert result["width"] >= 1120 and not result["open"]
