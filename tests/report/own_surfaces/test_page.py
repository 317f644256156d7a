"""The page of own surfaces: self-contained, honest, readable; its figures show the datasets."""

import json
import re
from functools import cache
from html import unescape

import numpy as np
import pytest
from answer_inputs import (
    CONFIDENCE,
    CUTOFFS,
    LABELS,
    OCTAVES,
    RHOS,
    SENSITIVITIES,
    SURFACES,
    datasets,
    drop_interval,
    edges,
    fit,
    force,
    move_edge,
    open_edges,
    scale_extrapolated_force,
    sensitivity,
    setting,
    spectra,
    topography,
)  # fmt: skip
from html_page import Page
from intervals import between_multiples
from matplotlib.text import Text
from paper_study import CITATION, svg
from refusals import assert_says

from hardcontact.report.figures import style
from hardcontact.report.figures.listing import OWN_FIGURES
from hardcontact.report.own_surfaces import figures
from hardcontact.report.own_surfaces.answer import own_answer
from hardcontact.report.own_surfaces.page import own_page
from hardcontact.report.quantities import answer_text
from hardcontact.report.templates import Frame

FORCES = "two substitutes, forces"
LONG = "/scans/" + "a-very-long-name-of-a-scan-" * 5 + "1.spm"
CASES = {
    "one": (datasets(), setting()),
    "open, one force": (
        datasets(
            edges=open_edges(),
            fit=fit(),
            spectra=spectra().assign(path=spectra()["path"].astype(object) + LONG),
        ),
        setting(),
    ),
    FORCES: (datasets(2, topography=topography(2, "substitute"), fit=fit(2)), setting()),
}
FIRST = {"surface": SURFACES[0]}
PHONE = 358  # pixels that a figure is wide on a screen of 390
MIN_TEXT = 9.0  # pixels: as small as footnotes on phones are


PICTURES = {name: svg(f"#{index:03}") for index, name in enumerate(OWN_FIGURES)}


def page_of(own_datasets, own_setting=None):
    """The page of an answer as answer.json has it."""
    answer = json.loads(answer_text(own_answer(own_datasets, own_setting or setting())))
    return own_page(answer, PICTURES, CITATION, Frame("1.2.3"))


@cache
def html(case):
    return page_of(*CASES[case])


@cache
def page(case):
    return Page(html(case))


def words(text):
    """Return the words outside folds."""
    for tag in ("script", "style", "title"):
        text = re.sub(rf"<{tag}.*?</{tag}>", " ", text, flags=re.DOTALL)
    text = re.sub(r"</summary>.*?</details>", " ", text, flags=re.DOTALL)
    return unescape(re.sub(r"<.*?>", " ", text)).split()


@pytest.mark.parametrize("case", CASES)
def test_the_page_is_self_contained_and_describes_every_picture(case):
    texts = " ".join([*page(case).texts["main"], *page(case).values("alt")])
    assert not re.search(r"\bnan\b|\binf\b|None", texts)
    assert not {"link", "iframe", "object"} & set(page(case).attributes)
    assert all(source.startswith("data:image/svg+xml") for source in page(case).values("src"))
    alternatives = page(case).values("alt")
    assert all(len(text) > 30 for text in alternatives)
    assert len(set(alternatives)) == len(alternatives)


@pytest.mark.parametrize("case", CASES)
def test_sections_and_figures_have_anchors(case):
    ids = page(case).values("id")
    assert len(set(ids)) == len(ids)
    forces = ["forces"] if "force" in case else []
    sections = [section["id"] for section in page(case).attributes["section"]]
    assert sections == [
        "answer",
        "inputs",
        "next",
        "cutoffs",
        "surfaces",
        *forces,
        "details",
        "cite",
    ]
    links = {link[1:] for link in page(case).values("href") if link.startswith("#")}
    assert links <= set(ids)


def test_the_unfolded_page_is_short():
    assert len(words(html("one"))) < 480
    (verdict,) = re.findall(r'<div class="answer">\s*<p>(.*?)</p>', html("one"), re.DOTALL)
    assert len(verdict.replace("\u00a0", " ").split()) <= 25


def test_the_page_begins_with_the_headline():
    headline = own_answer(*CASES["one"])["headline"]
    assert headline and not any("<" in line or "&" in line for line in headline)
    first_words = " ".join(page("one").texts["div"][0].replace("\u00a0", " ").split())
    assert first_words.startswith(" ".join(headline))


def headline_of(**changed):
    return " ".join(own_answer(datasets(**changed), setting())["headline"])


def test_the_headline_says_which_force_is_which():
    """Forces with roughness extrapolated at either side stand beside the force on the scans."""
    line = headline_of(force=scale_extrapolated_force(force(), short=0.25, long=0.5))
    assert (
        "640 [510, 800] nN on the scans, 160 [130, 200] nN with roughness extrapolated below"
        in line
    )
    assert "20 nm, 320 [260, 400] nN with roughness extrapolated above 1 µm" in line
    assert "on the scans" not in headline_of()


@pytest.mark.parametrize(
    ("paper_values", "words_on_force"),
    [
        ([], "Pull-off force 640"),
        (
            ["work of adhesion", "hardness"],
            "force at the assumed work of adhesion (46.3 mJ/m²): 640",
        ),
        (
            ["range of adhesion", "work of adhesion"],
            "(46.3 mJ/m²) and range of adhesion (5.6 nm): 640",
        ),
    ],
)
def test_the_headline_says_whether_range_and_work_are_the_paper_s(paper_values, words_on_force):
    headline = own_answer(datasets(), setting()._replace(assumed=paper_values))["headline"]
    assert words_on_force in headline[2]


def test_the_headline_has_the_forces_at_other_ranges_and_works():
    assert_says(headline_of(), "Other ranges and works give ", "240 nN (10 nm, 23.1 mJ/m²)")
    assert "Other ranges" not in headline_of(fit=fit())


def test_own_forces_stand_in_the_headline_with_the_work_that_they_need():
    """The fit has W(RANGE) = WORK for 0.64 µN; the region agrees with both surfaces."""
    assert_says(
        headline_of(fit=fit()),
        "Your force of 640 [580, 700] nN is 1 times",
        "46 [37, 58] mJ/m² at this range",
    )
    *_, ratio, fit_line = own_answer(datasets(2, fit=fit(2)), setting())["headline"]
    assert "twin has 2" in ratio and "fit best at range 5.6 nm, work 46 mJ/m²" in fit_line


def test_an_edge_without_interval_is_as_wide_as_the_cutoffs_around_it():
    line = headline_of(edges=move_edge(37.0, 20.0, 90.0))
    assert "of 37 nm to 1.7 µm decide the force. Short edge: about 37 nm (20 nm to 40 nm)" in line


@pytest.mark.parametrize(("ratio", "lead"), [(0.3, "Its roughness is not that"), (np.nan, "Short")])
def test_a_hindcast_that_fails_or_lacks_an_octave_leaves_no_edge(ratio, lead):
    ratios = between_multiples("hindcast_ratio", "side", [ratio, 1.0], (0.9, 1.1), CONFIDENCE)
    data = force().assign(ratios | {"hindcast_fails": ("side", [1, 0])})
    line = headline_of(force=data)
    assert_says(line, f"partly answered. {lead}", "Short edge not known. Long edge 1.7")
    (note,) = [
        note["text"]
        for note in own_answer(datasets(force=data), setting())["notes"]
        if note["code"] == "hindcast_short"
    ]
    assert_says(note, "0.30 [0.27, 0.33]" if ratio == 0.3 else "show no octave", "below 20 nm")


def test_ripples_of_the_filter_are_no_short_edge():
    data = edges()
    for name in ("edge", "edge_interval"):
        data[name].loc[{"side": "short"}] = np.nan
    data = data.assign(edge_status=data["edge_status"].where(data["side"] != "short", "ripples"))
    line = headline_of(edges=data)
    assert_says(line, "partly answered. Short edge none: the filter's ripples", ". Long edge 1.7")
    notes = [note["text"] for note in own_answer(datasets(edges=data), setting())["notes"]]
    assert any("Without short wavelengths the force falls" in note for note in notes)


@pytest.mark.parametrize(
    ("edge", "interval", "words_on_edges"),
    [
        (120.0, (90.0, 150.0), ""),
        (70.0, (40.0, 90.0), "Short edge: 70 nm (at most 90 nm), partly extrapolated;"),
        (37.0, (20.0, 90.0), "(20 nm to 40 nm), extrapolated;"),
    ],
)
def test_the_headline_says_which_edge_is_extrapolated(edge, interval, words_on_edges):
    line = headline_of(edges=move_edge(edge, *interval))
    assert words_on_edges in line and ("extrapolated" in line) == bool(words_on_edges)


@pytest.mark.parametrize(
    ("factor", "begin", "end", "effect"),
    [
        (1, "Wavelengths", "matter most", "amplitude lowers the force by 0.90 [0.40, 1.4] %."),
        (-1, "Wavelengths", "matter most", "amplitude raises the force by 0.90 [0.40, 1.4] %."),
        (
            0.4,
            "Whether wavelengths",
            "matter most is not certain",
            "amplitude lowers the force by 0.4 [-0.1, 0.9] %.",
        ),
    ],
)
def test_the_page_says_which_octave_matters_most(factor, begin, end, effect):
    text = page_of(datasets(sensitivity=sensitivity(factor=factor))).replace("\u00a0", " ")
    sentence = f"{begin} of 80 nm to 160 nm {end}: 1 % more {effect}"
    positions = [text.index(part) for part in (sentence, 'id="octaves-figure"', 'id="numbers"')]
    assert positions == sorted(positions)


def test_the_figure_of_octaves_has_a_bar_an_octave_and_hatches_those_that_no_scan_shows():
    figure = figures.draw_octaves(datasets(2))
    (axes,) = figure.axes
    bars = [[bar.get_height() for bar in container] for container in axes.containers[::2]]
    np.testing.assert_array_equal(bars, [SENSITIVITIES] * 2)
    hatched = [patch for patch in axes.patches if patch.get_hatch()]
    ends = np.array([(patch.get_x(), patch.get_x() + patch.get_width()) for patch in hatched])
    assert len(hatched) == 2 and (OCTAVES[0] < ends).all() and (ends < OCTAVES[1]).all()


def test_names_of_the_user_are_escaped():
    hostile = "</script><b>x</b>\"'"
    data = datasets()
    paths = data.spectra["path"].astype(object) + hostile
    labelled = type(data)(*(dataset.assign(label=("surface", [hostile])) for dataset in data[:5]))
    labelled = labelled._replace(spectra=labelled.spectra.assign(path=paths))
    text = page_of(labelled)
    assert "<b>" not in text and Page(text).texts["h1"]


@pytest.mark.parametrize("exact", [0, 1, 2])
def test_a_fit_that_is_exact_by_construction_has_no_error(exact):
    two_fits = fit(2)
    two_fits["exact_pairs"][:] = exact
    page_html = page_of(datasets(2, fit=two_fits))
    text = re.search('<p id="fit">(.*?)</p>', page_html, re.DOTALL)[1]
    assert ("error" in text) == (exact == 0) and ("tests nothing" in text) == (exact > 0)


def lines_of(figure):
    """The curves of a figure by label."""
    return {line.get_label(): line for line in figure.axes[0].lines if line.get_label()[0] != "_"}


def test_the_figure_of_cutoffs_shows_the_ratios_of_both_sides():
    data = edges().sel(FIRST)
    figure = figures.draw_cutoffs(datasets())
    curves = lines_of(figure)
    for side, (label, _) in figures.SIDE_LOOKS.items():
        ratios = data["filtered_force_ratio"].sel(side=side).dropna("cutoff_wavelength")
        x, y = curves[label].get_data()
        assert x.tolist() == CUTOFFS[side].tolist() and y.tolist() == ratios.values.tolist()


@pytest.mark.parametrize(("largest", "scale"), [(1.5, "linear"), (2000.0, "log")])
def test_all_ratios_are_shown_on_a_logarithmic_axis_if_they_differ_tenfold(largest, scale):
    data = edges()
    data["filtered_force_ratio"] = data["filtered_force_ratio"].clip(max=1.2)
    data["filtered_force_ratio_interval"] = data["filtered_force_ratio_interval"].clip(0.9, 1.4)
    data["filtered_force_ratio"].loc[{"side": "short", "cutoff_wavelength": 160}] = largest
    figure = figures.draw_cutoffs(datasets(edges=data))
    (axes,) = figure.axes
    low, high = axes.get_ylim()
    for label, _ in figures.SIDE_LOOKS.values():
        ratios = lines_of(figure)[label].get_ydata()
        assert ((low < ratios) & (ratios < high)).all()
    assert axes.get_yscale() == scale


def test_spectra_are_drawn_apart_where_they_are_not_reliable():
    data = spectra().sel(FIRST)
    figure = figures.draw_spectra(datasets())
    curves = lines_of(figure)
    for index, name in enumerate(("fine.spm", "coarse.spm", "line.txt")):
        x, density = curves[name].get_data()
        reliable_wavelengths = x[np.isfinite(density)]
        assert data["shortest_reliable"][index] <= reliable_wavelengths.min()
        assert reliable_wavelengths.max() <= data["longest_reliable"][index]
        is_unreliable = np.isfinite(curves[f"{name}, not reliable"].get_ydata())
        assert is_unreliable.any() and not (is_unreliable & np.isfinite(density)).any()
        drawn = np.where(is_unreliable, curves[f"{name}, not reliable"].get_ydata(), density)
        np.testing.assert_array_equal(drawn, data["psd"][index])
    assert {"joined", "used"} <= set(curves)


def test_forces_of_both_models_are_drawn_over_the_range():
    figure = figures.draw_forces(datasets())
    curves = lines_of(figure)
    for model in ("plastic", "rigid"):
        x, y = curves[f"my coating, {model}"].get_data()
        forces = 1e6 * force().sel(FIRST).sel(contact_model=model)["force"].values
        assert x.tolist() == RHOS.tolist()
        np.testing.assert_allclose(y, forces)
    unbounded = figures.draw_forces(datasets(force=drop_interval(force())))
    (band,) = unbounded.axes[0].collections
    assert not [path for path in band.get_paths() if len(path.vertices)]


@pytest.mark.parametrize("name", OWN_FIGURES)
def test_figures_are_readable_on_a_phone_and_name_their_surfaces_and_units(name):
    with style.print_style():
        figure = figures.OWN_DRAWINGS[name](CASES[FORCES][0])
        figure.draw_without_rendering()
    texts = [text for text in figure.findobj(Text) if text.get_visible() and text.get_text()]
    points = PHONE / (72 * figure.get_figwidth())
    assert min(text.get_fontsize() for text in texts) * points >= MIN_TEXT
    measure_page = " ".join(text.get_text() for text in texts)
    assert all(f"{label} (substitute)" in measure_page for label in LABELS)
