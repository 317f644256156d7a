"""The page of own surfaces: self-contained, honest; its numbers are those of the datasets."""

import json
import re
from functools import cache

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
)  # fmt: skip
from html_page import Page
from refusals import assert_says

from hardcontact.answer import own_surfaces
from hardcontact.answer.own_surfaces import answer

LEFT_OUT = [("elastic contacts", "no modulus"), ("a < b", "x & <b>y</b>")]

CASES = {
    "one": lambda: answer(datasets(), setting()),
    "one, open, one force": lambda: answer(
        datasets(edges=open_edges(), fit=fit()), setting(LEFT_OUT)
    ),
    "two substitutes, forces": lambda: answer(
        datasets(2, topography=topography(2, "substitute"), fit=fit(2)), setting()
    ),
}


@pytest.fixture(autouse=True)
def _unseen(monkeypatch):
    """Figures are drawn, but no pictures made of them: those are looked at in `test_figures`."""
    monkeypatch.setattr(own_surfaces, "png", lambda figure: b"picture")


@cache
def made(case):
    return CASES[case]()


@cache
def shown(case):
    return Page(made(case).page)


def text_of(case, tag="body"):
    """Text of all elements of a tag, with plain spaces."""
    return " ".join(shown(case).texts[tag]).replace("\u00a0", " ")


@pytest.mark.parametrize("case", CASES)
def test_nothing_is_loaded_and_every_picture_is_told(case):
    read = shown(case)
    assert not {"script", "link", "iframe", "object"} & set(read.attributes)
    assert all(source.startswith("data:image/") for source in read.values("src"))
    assert all(link.startswith("#") for link in read.values("href"))
    assert "url(" not in made(case).page and "@import" not in made(case).page
    alts = [image["alt"] for image in read.attributes["img"]]
    assert all(len(alt) > 30 for alt in alts) and len(set(alts)) == len(alts)


@pytest.mark.parametrize("case", CASES)
def test_links_lead_somewhere(case):
    anchors = {section["id"] for section in shown(case).attributes["section"]}
    assert {link[1:] for link in shown(case).values("href")} <= anchors


@pytest.mark.parametrize("case", CASES)
def test_no_number_is_missing_or_printed_as_nan(case):
    texts = [text_of(case), *(image["alt"] for image in shown(case).attributes["img"])]
    assert not re.search(r"\bnan\b|\binf\b|None", " ".join(texts))


@pytest.mark.parametrize("case", CASES)
def test_sections_stand_in_the_order_of_the_questions(case):
    fitted = "force" in case
    expected = [
        "The scans", "Roughness", "The spectrum, and where it is reliable",
        "The force without parts of the roughness", "The band", "The force",
        *(["Fit to your own forces (measured)"] if fitted else []),
        "What limits this answer", "What would narrow it", "What was left out",
    ]  # fmt: skip
    assert shown(case).texts["h2"] == expected


def test_the_first_screen_holds_the_answer():
    page = made("one").page
    start = page.index('<div class="answer">')
    assert page.index("<h1>") < start < page.index("<h2>")
    sentence = made("one").numbers["surfaces"]["my_coating"]["answer"]
    assert sentence in text_of("one", "p")
    assert len(sentence) < 300


def test_a_quick_answer_is_called_a_first_one():
    quick = answer(datasets(), setting(effort="quick"))
    assert own_surfaces.FIRST_ANSWER in quick.page
    assert quick.numbers["effort"] == "quick"
    assert own_surfaces.FIRST_ANSWER not in made("one").page


def test_every_surface_has_its_pictures():
    captions = shown("two substitutes, forces").texts["figcaption"]
    for label in LABELS:
        assert sum(text.startswith(f"{label} (substitute):") for text in captions) == 3
    assert len(captions) == 3 * 2 + 2


def test_ratios_say_to_which_wavelengths_the_unfiltered_surfaces_go():
    assert "with all down to 5 nm (upper) or up to 2.56 µm (lower)" in text_of("one", "figcaption")


def test_open_edges_are_answered_in_words():
    text = text_of("one, open, one force")
    assert_says(text, "The long edge of the band is open: at least 2.56 µm (the scans end here)")
    assert "not found" not in text_of("one")


def test_substitutes_are_called_so():
    assert "substitute" not in text_of("one")
    text = text_of("two substitutes, forces")
    assert_says(text, "Not measured: my coating, twin.", "How twin (substitute) sticks")
    cells = [row[0].strip() for row in shown("two substitutes, forces").rows]
    assert cells.count("twin (substitute), 1") == 1


def test_artificial_edges_stand_on_the_first_screen():
    page = made("one").page
    notice = page.index('<div class="notice">')
    assert notice < page.index("<h2>") and "no scan is reliable" in page[notice:]
    data = edges()
    data["edge"].loc[{"side": "small"}] = 100.0
    data["edge_interval"].loc[{"side": "small"}] = [80.0, 130.0]
    assert '<div class="notice">' not in answer(datasets(edges=data), setting()).page


def test_what_is_the_papers_and_not_the_users_is_said():
    text, numbers = text_of("one"), made("one").numbers
    assert_says(text, "hardness: 25 GPa (as in the paper); preload: 10 µN.")
    assert numbers["of_paper"] == ["hardness"] and numbers["contact"]["hardness"] == "25 GPa"


def test_what_was_left_out_is_listed_with_its_reason():
    rows = [[cell.strip() for cell in row] for row in shown("one, open, one force").rows]
    assert all(list(part) in rows for part in LEFT_OUT)
    assert "Nothing." in shown("one").texts["p"]


def test_rms_numbers_have_scan_and_pixel_size():
    rows = [[cell.strip() for cell in row] for row in shown("one").rows]
    data = topography().sel(surface=SURFACES[0])
    for scan in data["scan"].values:
        (row,) = [row for row in rows if row[0] == f"my coating, {scan}"]
        assert row[1].replace("\u00a0", " ") == "640 nm, 10 nm"
        assert row[2] == f"{data['rms_height'].sel(scan=scan).item():.3g}"
    (joined,) = [row for row in rows if row[0] == "my coating, joined spectrum"]
    assert "artificial" in joined[1] and joined[2:5] == ["6.2", "0.74", "0.55"]


def test_missing_scans_have_no_row():
    data = topography()
    data["rms_height"].loc[{"scan": SCANS}] = np.nan
    rows = Page(answer(datasets(topography=data), setting()).page).rows
    assert not [row for row in rows if row[0].strip() == f"my coating, {SCANS}"]


def test_fits_are_labelled_measured_and_never_published():
    for case in ("one, open, one force", "two substitutes, forces"):
        assert "Measured: 640 [576, 704] nN on my coating" in text_of(case)
        assert "published fo" not in text_of(case).lower()


@pytest.mark.parametrize("case", CASES)
def test_numbers_are_json_without_nan(case):
    text = json.dumps(made(case).numbers, allow_nan=False)
    assert json.loads(text) == made(case).numbers


def test_numbers_are_those_of_the_datasets():
    numbers = made("one").numbers
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


def test_open_edges_are_no_numbers():
    edge = made("one, open, one force").numbers["surfaces"]["my_coating"]["band"]["large"]
    assert edge["edge"]["value"] is None and edge["bound"]["value"] == 2560.0
    assert edge["edge"]["interval"] == [None, None] and edge["status"] == "beyond the cell"
    assert edge["conditional"] is True and edge["text"].startswith("at least")
    assert edge["edge_at_least"] is True


def test_fits_and_pooled_bands_are_among_the_numbers():
    numbers = made("two substitutes, forces").numbers
    assert numbers["fit"]["origin"] == "measured"
    assert numbers["fit"]["best_work"]["values"] == [0.5 * WORK, WORK]
    assert numbers["fit"]["work_of_adhesion"]["dimensions"] == ["contact_model", "surface", "rho"]
    assert numbers["fit"]["texts"]["label"] == LABELS
    assert numbers["fit"]["coordinates"]["contact_model"] == ["rigid", "plastic"]
    assert numbers["pooled_band"]["large"]["value"] == 1500.0
    assert numbers["surfaces"]["twin"]["basis"] == "substitute"
    assert "45 [36, 56.2] nm to 1.5 [" in text_of("two substitutes, forces")
