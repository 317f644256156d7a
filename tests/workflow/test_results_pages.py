"""The tiny study's claims, figures, answers and report."""

import json

import pandas as pd
from browser import measure_pages, needs_browser
from html_page import Page, dead_links
from jsonschema import Draft202012Validator
from paper_numbers import SUBSTRATES
from repository import ROOT

from hardcontact.base.dataset import read_dataset
from hardcontact.config.user_files import read_yaml
from hardcontact.paper.claims.selection import WITHOUT_SCAN
from hardcontact.paper.claims.verdicts import JUDGED_COLUMNS, VERDICTS
from hardcontact.report.figures.listing import PAPER_FIGURES
from hardcontact.report.paper_study.answer import ANSWER_CLAIMS

PAGES = read_yaml("workflow/report/pages.yaml")


def test_every_claim_has_a_verdict_and_a_basis(results):
    claims = pd.read_csv(results / "claims.csv")
    assert tuple(claims.columns) == JUDGED_COLUMNS
    assert set(claims.verdict) <= set(VERDICTS)
    assert set(claims.basis) == {"substitute scans", *WITHOUT_SCAN}
    published = pd.read_csv(ROOT / "resources/paper/claims.csv")
    assert list(claims.id) == list(published.id) and claims.id.is_unique
    replicated = published.set_index("id").loc[claims.id, "samples_from"].notna()
    assert list(claims.agreeing_share.notna()) == list(replicated)
    assert claims.agreeing_share.dropna().between(0, 1).all()


def test_the_answer_follows_its_schema_and_has_the_numbers_of_the_datasets(results):
    answer = json.loads((results / "answer.json").read_text())
    schema = json.loads((ROOT / "workflow/schemas/answer.schema.json").read_text())
    Draft202012Validator(schema).validate(answer)
    numbers = {row["name"]: row for row in answer["quantities"] if row["surface"] == ""}
    assert ANSWER_CLAIMS.keys() <= numbers.keys()
    rho = read_dataset(results / "filtered_forces.nc").attrs["rho"]
    assert numbers["range_of_band"]["value"] == rho == 5.6
    assert numbers["sets"]["value"] == read_dataset(results / "sets.nc").sizes["set"] == 10
    surfaces = {row["surface"] for row in answer["quantities"]} - {""}
    assert surfaces == set(SUBSTRATES)


def test_the_answer_is_short_and_no_figure_or_page_is_missing(results):
    page = Page((results / "answer.html").read_text())
    assert len(" ".join(page.texts["main"]).split()) <= 2000
    figures = Page((results / "report/figures.html").read_text())
    assert len(figures.values("src")) == len(PAPER_FIGURES)
    pages = {path.stem: path.read_text() for path in (results / "report").glob("*.html")}
    assert set(pages) == set(PAGES)
    assert "study: tiny" in pages["parameters"] and "numpy" in pages["parameters"]


def test_no_link_is_dead(results):
    files = {path.relative_to(results).as_posix(): path for path in results.rglob("*.*")}
    html = {name: path.read_text("utf-8") for name, path in files.items() if path.suffix == ".html"}
    assert dead_links(html, files.keys() - html.keys()) == []


@needs_browser
def test_a_browser_shows_pages_on_phone_and_desk(results, tmp_path):
    pages = [(results / f"{name}.html").read_text() for name in ("answer", "report/figures")]
    opened = [page.replace("<details>", "<details open>") for page in pages]
    for frame in measure_pages(opened, tmp_path):
        assert frame["overflow"] == 0 and frame["requests"] == 0
        assert frame["loaded"] == frame["pictures"] > 0
