"""The page of your surfaces: self-contained, honest, readable; figures show the datasets."""

import re

import numpy as np
import own_datasets as own
import pytest
import xarray as xr
from html_page import Page
from intervals import between_multiples
from matplotlib.text import Text
from own_answers import CASES, FORCES, make_answer, make_page, setting
from refusals import assert_says

from hardcontact.report.figures import style
from hardcontact.report.figures.listing import OWN_FIGURES
from hardcontact.report.own_surfaces import figures
from hardcontact.report.own_surfaces.answer import own_answer

FIRST = {"surface": own.SURFACES[0]}
#: Width of a figure in pixels, on a phone with a screen of 390.
PHONE_WIDTH = 358
#: Height of the smallest text in pixels, as of footnotes on phones.
MIN_TEXT = 9.0


@pytest.mark.parametrize("case", CASES)
def test_the_page_is_self_contained_and_describes_every_picture(case):
    page = Page(make_page(CASES[case]))
    texts = " ".join([*page.texts["main"], *page.values("alt")])
    assert not re.search(r"\bnan\b|\binf\b|None", texts)
    assert not {"link", "iframe", "object"} & set(page.attributes)
    assert all(source.startswith("data:image/svg+xml") for source in page.values("src"))
    alternatives = page.values("alt")
    assert all(len(text) > 30 for text in alternatives)
    assert len(set(alternatives)) == len(alternatives)


def headline_of(**changed):
    """The lines of the headline in one; `changed` replaces datasets."""
    return " ".join(make_answer(own.datasets(**changed))["headline"])


@pytest.mark.parametrize(("ratio", "lead"), [(0.3, "Its roughness is not that"), (np.nan, "Short")])
def test_a_hindcast_that_fails_or_lacks_an_octave_leaves_no_edge(ratio, lead):
    ratios = between_multiples("hindcast_ratio", "side", [ratio, 1.0], (0.9, 1.1), own.CONFIDENCE)
    data = own.force().assign(ratios | {"hindcast_fails": ("side", [1, 0])})
    line = headline_of(force=data)
    assert_says(line, f"partly answered. {lead}", "Short edge not known. Long edge 1.7")
    (note,) = [
        note["text"]
        for note in make_answer(own.datasets(force=data))["notes"]
        if note["code"] == "hindcast_short"
    ]
    assert_says(note, "0.30 [0.27, 0.33]" if ratio == 0.3 else "show no octave", "below 20 nm")


@pytest.mark.parametrize(("needed", "remark"), [
    (80.0, "80 positions, each with other summits, give the mean within"),
    (np.nan, "on the scans alone; how much forces differ elsewhere is not known"),
])  # fmt: skip
def test_the_scatter_is_that_of_the_scans_alone_if_the_needed_contacts_are_not_known(
    needed, remark
):
    data = own.force()
    data["contacts_needed"] = xr.full_like(data["contacts_needed"], needed)
    (row,) = [row for row in Page(make_page(own.datasets(force=data))).rows if "Scatter" in row[0]]
    assert_says(row[-1], remark)


def test_one_sentence_names_all_that_is_assumed():
    (sentence,) = [
        text for text in Page(make_page(own.datasets())).texts["p"] if text.startswith("Assumed")
    ]
    assert sentence.replace("\N{NO-BREAK SPACE}", " ") == (
        "Assumed, because you gave none: the paper's hardness (25 GPa), "
        "work of adhesion (46.3 mJ/m²), and a smooth sphere."
    )


def test_hindcasts_that_tested_no_octave_at_either_side_make_one_caution():
    ratios = {"hindcast_ratio": ("side", [np.nan] * 2), "hindcast_fails": ("side", [1, 1])}
    answer = make_answer(own.datasets(force=own.force().assign(ratios)))
    (note,) = [note for note in answer["notes"] if note["code"].startswith("hindcast")]
    assert_says(note["text"], "no force or edge includes any below 20 nm or above 1 µm")
    names = {quantity["name"] for quantity in answer["quantities"]}
    assert names >= {"hindcast_short_start", "hindcast_long_start"}


def test_a_small_window_and_a_small_scan_are_said_to_change_the_force_in_opposite_directions():
    small = {"finite_scan_ratio": (("surface", "end"), [[2.0, 4.0]])}
    window = {"window_share": ("rho", [1, 1, 0.36, 0.2, 0.1])}
    texts = [
        {note["code"]: note["text"] for note in make_answer(own.datasets(force=data))["notes"]}
        for data in (own.force().assign(window), own.force().assign(window | small))
    ]
    both_errors = "lowers the computed forces, while the small scan raises them"
    assert [both_errors in text["window"] for text in texts] == [False, True]


def test_a_quick_page_says_how_to_run_full_effort():
    answer = own_answer(own.datasets(), setting()._replace(effort="quick"))
    assert_says(
        answer["headline"][-1], "Full effort, the same command without --config effort=quick"
    )


def test_scans_that_hardly_change_the_force_do_not_deny_any_change():
    assert_says(headline_of(edges=own.unresolved_edges()), "hardly changes the force", "at most")


@pytest.mark.parametrize(("high", "overlap"), [(1000.0, False), (2000.0, True)])
def test_the_headline_says_if_the_intervals_of_the_edges_overlap(high, overlap):
    line = headline_of(edges=own.move_edge(300.0, 250.0, high))
    assert ("These intervals overlap, so there may be no band." in line) == overlap


def test_the_figure_of_octaves_has_a_bar_an_octave_and_hatches_those_that_no_scan_shows():
    figure = figures.draw_octaves(own.datasets(2))
    (axes,) = figure.axes
    bars = [[bar.get_height() for bar in container] for container in axes.containers]
    np.testing.assert_array_equal(bars, [own.SENSITIVITIES] * 2)
    hatched = [patch for patch in axes.patches if patch.get_hatch()]
    ends = np.array([(patch.get_x(), patch.get_x() + patch.get_width()) for patch in hatched])
    assert len(hatched) == 2 and (own.OCTAVES[0] < ends).all() and (ends < own.OCTAVES[1]).all()


def test_names_of_the_user_are_escaped():
    hostile = "</script><b>x</b>\"'"
    spectra = own.spectra()
    spectra["path"] = spectra["path"].astype(object) + hostile
    topography = own.topography().assign(label=("surface", [hostile]))
    text = make_page(own.datasets(topography=topography, spectra=spectra))
    assert "<b>" not in text and "&lt;b&gt;" in text and Page(text).texts["h1"]


def lines_of(figure):
    """The curves of a figure by label."""
    return {line.get_label(): line for line in figure.axes[0].lines if line.get_label()[0] != "_"}


def test_the_figure_of_cutoffs_shows_the_ratios_of_both_sides():
    data = own.edges().sel(FIRST)
    figure = figures.draw_cutoffs(own.datasets())
    curves = lines_of(figure)
    for side, (label, _) in figures.SIDE_LOOKS.items():
        ratios = data["filtered_force_ratio"].sel(side=side).dropna("cutoff_wavelength")
        x, y = curves[label].get_data()
        assert x.tolist() == own.CUTOFFS[side].tolist() and y.tolist() == ratios.values.tolist()


def test_spectra_are_drawn_apart_where_they_are_not_reliable():
    data = own.spectra().sel(FIRST)
    figure = figures.draw_spectra(own.datasets())
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
    figure = figures.draw_forces(own.datasets())
    curves = lines_of(figure)
    for model in ("plastic", "rigid"):
        x, y = curves[f"my coating, {model}"].get_data()
        forces = 1e6 * own.force().sel(FIRST).sel(contact_model=model)["force"].values
        assert x.tolist() == own.RHOS.tolist()
        np.testing.assert_allclose(y, forces)
    unbounded = figures.draw_forces(own.datasets(force=own.drop_interval(own.force())))
    (band,) = unbounded.axes[0].collections
    assert not [path for path in band.get_paths() if len(path.vertices)]


@pytest.mark.parametrize("name", OWN_FIGURES)
def test_figures_are_readable_on_a_phone_and_name_their_surfaces_and_units(name):
    with style.print_style():
        figure = figures.OWN_DRAWINGS[name](CASES[FORCES])
        figure.draw_without_rendering()
    texts = [text for text in figure.findobj(Text) if text.get_visible() and text.get_text()]
    pixels_per_point = PHONE_WIDTH / (72 * figure.get_figwidth())
    assert min(text.get_fontsize() for text in texts) * pixels_per_point >= MIN_TEXT
    figure_text = " ".join(text.get_text() for text in texts)
    assert all(f"{label} (substitute)" in figure_text for label in own.LABELS)
