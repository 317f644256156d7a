"""The tiny study's claims, answer and report."""

import json

import pandas as pd
from browser import measure_pages, needs_browser
from html_page import Page, dead_links
from jsonschema import Draft202012Validator
from paper_numbers import CLAIMS, SUBSTRATES
from repository import ROOT

from hardcontact.base.dataset import read_dataset
from hardcontact.paper.claims.selection import WITHOUT_SCAN
from hardcontact.report.figures.listing import PAPER_FIGURES
from hardcontact.report.paper_study.answer import ANSWER_CLAIMS


def test_every_claim_has_a_basis_and_those_of_sets_have_their_share(results):
    claims = pd.read_csv(results / "claims.csv")
    assert claims.id.tolist() == CLAIMS.id.tolist()
    assert set(claims.basis) == {"substitute scans", *WITHOUT_SCAN}
    assert claims.agreeing_share.notna().tolist() == (CLAIMS.samples_from != "").tolist()
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
    assert {row["surface"] for row in answer["quantities"]} == {"", *SUBSTRATES}


def test_no_figure_is_missing_and_no_link_is_dead(results):
    files = {path.relative_to(results).as_posix(): path for path in results.rglob("*.*")}
    html = {name: path.read_text("utf-8") for name, path in files.items() if path.suffix == ".html"}
    assert len(Page(html["report/figures.html"]).values("src")) == len(PAPER_FIGURES)
    assert dead_links(html, files.keys() - html.keys()) == []


@needs_browser
def test_a_browser_shows_pages_on_phone_and_desk(results, tmp_path):
    pages = [(results / f"{name}.html").read_text() for name in ("answer", "report/figures")]
    opened = [page.replace("<details>", "<details open>") for page in pages]
    for frame in measure_pages(opened, tmp_path):
        assert frame["overflow"] == 0 and frame["requests"] == 0
        assert frame["loaded"] == frame["pictures"] > 0
