"""The page of own surfaces: self-contained, honest; its numbers are those of the datasets."""

import json
import re
from functools import cache
from html import unescape

import numpy as np
import pytest
from answer_inputs import (
    LABELS,
    RANGE,
    SCANS,
    SURFACES,
    WORK,
    datasets,
    edges,
    fit,
    force,
    open_edges,
    setting,
    spectra,
    topography,
    unresolved_edges,
)  # fmt: skip
from html_page import Page
from jsonschema import Draft202012Validator, ValidationError
from repository import ROOT

from hardcontact.answer import own_page as page_of
from hardcontact.answer.own_answer import as_plain, own_answer
from hardcontact.answer.own_page import own_page

FORCES = "two substitutes, forces"
LEFT_OUT = [("elastic contacts", "no modulus"), ("a < b", "x & <b>y</b>")]

CASES = {
    "one": (datasets(), setting()),
    "one, open, one force": (datasets(edges=open_edges(), fit=fit()), setting(LEFT_OUT)),
    "two substitutes, forces": (
        datasets(2, topography=topography(2, "substitute"), fit=fit(2)),
        setting(),
    ),
}


@pytest.fixture(autouse=True)
def _unseen(monkeypatch):
    """Figures are drawn, but no pictures made of them: those are looked at in `test_curves`."""
    monkeypatch.setattr(page_of.pictures, "png", lambda figure: b"picture")


@cache
def answer(case):
    return own_answer(*CASES[case])


@cache
def html(case):
    return own_page(answer(case))


@cache
def shown(case):
    return Page(html(case))


@cache
def numbers_of(case):
    return as_plain(answer(case))


@pytest.mark.parametrize("case", CASES)
def test_no_number_is_missing_or_printed_as_nan(case):
    visible = re.sub(r"<script.*?</script>", "", html(case), flags=re.DOTALL)
    texts = [
        " ".join(Page(visible).texts["main"]),
        *(image["alt"] for image in shown(case).attributes["img"]),
    ]
    assert not re.search(r"\bnan\b|\binf\b|None", " ".join(texts))


def words(html):
    """Words that are seen before a fold is opened."""
    for tag in ("script", "style", "title", "noscript"):
        html = re.sub(rf"<{tag}.*?</{tag}>", " ", html, flags=re.DOTALL)
    unfolded = re.sub(
        r"(<details><summary>.*?</summary>).*?</details>", r"\1", html, flags=re.DOTALL
    )
    while unfolded != html:
        html, unfolded = unfolded, re.sub(r"<details>.*?</details>", " ", unfolded, flags=re.DOTALL)
    return unescape(re.sub(r"<.*?>", " ", html)).split()


@pytest.mark.parametrize("case", CASES)
def test_nothing_is_loaded_and_every_picture_is_told(case):
    read = shown(case)
    assert not {"link", "iframe", "object"} & set(read.attributes)
    assert all(source.startswith("data:image/") for source in read.values("src"))
    assert all(link.startswith("#") or link == "answer.json" for link in read.values("href"))
    alts = [image["alt"] for image in read.attributes["img"]]
    assert all(len(alt) > 30 for alt in alts) and len(set(alts)) == len(alts)


@pytest.mark.parametrize("case", CASES)
def test_sections_tables_and_figures_have_anchors(case):
    read = shown(case)
    ids = read.values("id")
    assert len(set(ids)) == len(ids)
    sections = [section["id"] for section in read.attributes["section"]]
    forces = ["forces"] if "force" in case else []
    expected = ["answer", "inputs", "cutoffs", "surfaces", *forces, "next", "details"]
    assert sections == expected
    assert all("id" in one for one in read.attributes["figure"])
    assert {link[1:] for link in read.values("href") if link.startswith("#")} <= set(ids)
    assert len(read.texts["h1"]) == 1 and len(read.texts["h2"]) == len(sections) - 1


def test_what_is_not_folded_is_short():
    assert len(words(html("one"))) < 450
    verdicts = re.search(r'<div class="answer">(.*?)</div>', html(FORCES), re.DOTALL)[1]
    for verdict in re.findall(r"<p>(.*?)</p>", verdicts, re.DOTALL):
        assert len(verdict.replace("\u00a0", " ").split()) <= 25


def test_every_surface_has_its_rows_and_figures():
    rows = [[cell.strip() for cell in row] for row in shown(FORCES).rows]
    for name, label in zip(SURFACES, LABELS, strict=True):
        assert sum(row[0] == f"{label} (substitute)" for row in rows) >= 8 + SCANS
        ids = shown(FORCES).values("id")
        assert {f"{kind}-{name}" for kind in ("cutoffs", "map", "spectrum")} <= set(ids)


def test_curves_of_the_page_are_values():
    found = re.findall(r'<script type="application/json">(.*?)</script>', html(FORCES), re.DOTALL)
    assert len(found) == 2 * 2 + 2 and all(json.loads(one)["series"] for one in found)


def test_names_of_the_user_are_escaped():
    hostile = "</script><b>x</b>\"'"
    given = datasets()
    parts = (part.assign(label=("surface", [hostile])) for part in given[:4])
    spectra_of = given.spectra.assign(path=given.spectra["path"].astype(object) + hostile)
    given = type(given)(*parts)._replace(spectra=spectra_of.assign(label=("surface", [hostile])))
    page = own_page(own_answer(given, setting([(hostile, "x & <b>y</b>")])))
    assert "<b>" not in page and Page(page).texts["h1"]


def test_missing_scans_have_no_row():
    data = topography()
    data["rms_height"].loc[{"scan": SCANS}] = np.nan
    answers = [own_answer(datasets(topography=one), setting()) for one in (topography(), data)]
    pages = [Page(own_page(one)) for one in answers]
    assert len(pages[0].rows) - len(pages[1].rows) == 1


@pytest.mark.parametrize("case", CASES)
def test_numbers_are_as_their_schema_describes(case):
    schema = json.loads((ROOT / "workflow/schemas/answer_surfaces.schema.json").read_text())
    Draft202012Validator.check_schema(schema)
    Draft202012Validator(schema).validate(numbers_of(case))


@pytest.mark.parametrize(
    "change", [lambda n: n.update(other=1), lambda n: n["surfaces"]["my_coating"].pop("force")]
)
def test_the_schema_knows_every_key(change):
    schema = json.loads((ROOT / "workflow/schemas/answer_surfaces.schema.json").read_text())
    numbers = json.loads(json.dumps(numbers_of("one")))
    change(numbers)
    with pytest.raises(ValidationError):
        Draft202012Validator(schema).validate(numbers)


@pytest.mark.parametrize("case", CASES)
def test_numbers_are_json_without_nan(case):
    text = json.dumps(numbers_of(case), allow_nan=False)
    assert json.loads(text) == numbers_of(case)


def test_numbers_are_those_of_the_datasets():
    numbers = numbers_of("one")
    of_surface = numbers["surfaces"]["my_coating"]
    assert numbers["range_of_adhesion"] == {"value": RANGE, "unit": "nm"}
    assert numbers["work_of_adhesion"] == {"value": WORK, "unit": "J m-2"}
    data = edges().sel(surface="my_coating")
    for side, edge in of_surface["band"].items():
        assert edge["edge"]["value"] == data["edge"].sel(side=side)
        assert edge["edge"]["interval"] == data["edge_interval"].sel(side=side).values.tolist()
        known = data["scale_ratio"].sel(side=side).dropna("cutoff_wavelength")
        assert edge["force_ratio"]["values"] == known.values.tolist()
        assert edge["cutoff_wavelength"]["values"] == known["cutoff_wavelength"].values.tolist()
    of_model = force().sel(surface="my_coating", contact_model="plastic")
    assert of_surface["force"]["value"] == of_model["force"].sel(rho=RANGE)
    assert of_surface["force"]["over_rho"]["plastic"]["values"] == of_model["force"].values.tolist()
    quantiles = [of["value"] for of in of_surface["force"]["quantiles_of_contacts"].values()]
    assert quantiles == of_model["force_quantile"].sel(rho=RANGE).values.tolist()
    joined = spectra().sel(surface="my_coating")["joined"].dropna("bin_wavevector")
    assert of_surface["spectrum"]["joined_psd"]["values"] == joined.values.tolist()
    assert of_surface["spectrum"]["artificial"][-1]["to"]["value"] is None
    scans = topography().sel(surface="my_coating")["rms_height"].values.tolist()
    assert [scan["rms_height"]["value"] for scan in of_surface["scans"]] == scans
    assert numbers["fit"] is None and numbers["pooled_band"] is None


@pytest.mark.parametrize(("of_paper", "count"), [(["work of adhesion"], 2), (["hardness"], 0)])
def test_who_gives_range_and_work_is_told_of_no_other_pairs(of_paper, count):
    answered = own_answer(datasets(), setting()._replace(of_paper=of_paper))
    rows = as_plain(answered)["surfaces"]["my_coating"]["answer"]
    assert [row["name"] for row in rows].count("force_of_pair") == count


def test_a_verdict_without_a_band_has_no_edges():
    unresolved = own_answer(datasets(edges=unresolved_edges()), setting())
    answer = re.search(r'<div class="answer">(.*?)</div>', own_page(unresolved), re.DOTALL)[1]
    assert "Nothing" in answer and "at least" not in answer and len(words(answer)) <= 25
    schema = json.loads((ROOT / "workflow/schemas/answer_surfaces.schema.json").read_text())
    Draft202012Validator(schema).validate(as_plain(unresolved))


def test_measurements_that_contradict_each_other_are_told():
    data = spectra()
    data["psd"][0, 2] *= 100
    odd = own_answer(datasets(spectra=data), setting())
    assert "contradict" in own_page(odd) and "contradict" not in html("one")
    schema = json.loads((ROOT / "workflow/schemas/answer_surfaces.schema.json").read_text())
    Draft202012Validator(schema).validate(as_plain(odd))


def test_open_edges_are_no_numbers():
    edge = numbers_of("one, open, one force")["surfaces"]["my_coating"]["band"]["large"]
    assert edge["edge"]["value"] is None and edge["bound"]["value"] == 2560.0
    assert edge["edge"]["interval"] == [None, None] and edge["status"] == "beyond the cell"
    assert edge["conditional"] is True and edge["edge_at_least"] is True


@pytest.mark.parametrize("exact", [0, 1, 2])
def test_a_fit_that_is_exact_by_construction_tells_no_error(exact):
    of_two = fit(2)
    of_two["exact_pairs"][:] = exact
    page = own_page(own_answer(datasets(2, fit=of_two), setting()))
    text = re.search('<p id="fit">(.*?)</p>', page, re.DOTALL)[1]
    assert ("error" in text) == (exact == 0) and ("tests nothing" in text) == (exact > 0)
    assert ("2 pairs" in text) == (exact == 2)


def test_fits_and_pooled_bands_are_among_the_numbers():
    numbers = numbers_of("two substitutes, forces")
    assert numbers["fit"]["origin"] == "measured"
    assert numbers["fit"]["best_work"]["values"] == [0.5 * WORK, WORK]
    assert numbers["fit"]["work_of_adhesion"]["dimensions"] == ["contact_model", "surface", "rho"]
    assert numbers["fit"]["texts"]["label"] == LABELS
    assert numbers["fit"]["coordinates"]["contact_model"] == ["rigid", "plastic"]
    assert numbers["pooled_band"]["large"]["value"] == 1500.0
    assert numbers["surfaces"]["twin"]["basis"] == "substitute"
    names = [row["name"] for row in numbers["surfaces"]["twin"]["answer"]]
    assert names[:2] == ["short_edge", "long_edge"] and "measured_force" in names
