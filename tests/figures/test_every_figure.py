"""What holds for every figure: substitutes named, a tidy table, print size, inputs left alone."""

from functools import cache

import matplotlib as mpl
import pytest
import xarray as xr
from figure_inputs.registry import inputs_of, module_of
from matplotlib.colors import same_color
from matplotlib.figure import Figure
from matplotlib.text import Text
from paper_numbers import LABELS, SUBSTRATES

from hardcontact.figures import drawing, style
from hardcontact.figures.catalogue import FIGURES


@pytest.fixture(scope="module", params=FIGURES)
def name(request):
    """Each figure in turn: what is drawn once is looked at by all tests."""
    return request.param


@cache
def drawn(name: str) -> Figure:
    return module_of(name).draw(**inputs_of(name))


def notes(figure):
    return [text.get_text() for text in figure.texts]


def measured(data):
    """The same dataset of measured scans, wherever it says what they are."""
    if "basis" in getattr(data, "attrs", {}):
        return data.assign_attrs(basis="measured")
    if "basis" in data:
        return data.assign(basis=xr.full_like(data["basis"], "measured"))
    return data


def test_substitutes_are_named_on_the_figure(name):
    labels = {"fig5": ["NCD"], "fig1": [*LABELS, "ruby"]}
    (note,) = notes(drawn(name))
    assert note.startswith(f"substitute surfaces: {', '.join(labels.get(name, LABELS))} (")


def test_table_is_tidy_and_says_where_values_come_from(name):
    rows = module_of(name).table(**inputs_of(name))
    assert set(rows["origin"]) <= {"computed", "published", "given"}
    assert rows["unit"].notna().all()
    assert not rows.duplicated().any()
    if {"surface", "basis"} <= set(rows):
        assert rows.loc[rows["surface"].notna(), "basis"].eq("substitute").all()


def test_drawing_leaves_inputs_and_global_style_alone(name):
    inputs, style_before = inputs_of(name), dict(mpl.rcParams)
    before = {key: data.copy(deep=True) for key, data in inputs.items()}
    module_of(name).draw(**inputs)
    module_of(name).table(**inputs)
    assert dict(mpl.rcParams) == style_before
    for key, data in inputs.items():
        assert getattr(data, "identical", data.equals)(before[key]), key


def test_no_text_is_smaller_than_seven_points(name):
    assert min(text.get_fontsize() for text in drawn(name).findobj(Text)) >= 7 * 0.99


def test_figure_has_print_width_and_fits_a_page(name):
    width, height = drawn(name).get_size_inches()
    assert width == drawing.WIDTH and 2 < height < 9


def test_every_panel_has_its_letter(name):
    titles = [axes.get_title(loc="left") for axes in drawn(name).axes]
    start = r"$\mathbf{"
    lettered = {title.removeprefix(start)[0] for title in titles if title.startswith(start)}
    rows = module_of(name).table(**inputs_of(name))
    if "panel" in rows and name != "fig3":
        assert lettered == set(rows["panel"]) - {""} | {"a"}
    assert "a" in lettered


def test_a_surface_has_the_same_colour_in_every_figure():
    expected = style.colours(SUBSTRATES)["ncd"]
    assert same_color(drawn("fig1").axes[2].spines["left"].get_edgecolor(), expected)
    assert same_color(drawn("fig3").axes[2].patches[0].get_facecolor()[:3], expected)
    for name, panel in (
        ("fig4", "mean pull-off force (µN)"),
        ("fig6", "pull-off force / unfiltered, at ρ = 5.6 nm"),
    ):
        axes = next(axes for axes in drawn(name).axes if axes.get_ylabel() == panel)
        assert any(same_color(line.get_color(), expected) for line in axes.lines)


def renamed(data):
    """The same dataset of two substrates of other names, and the sphere."""
    if "surface" not in getattr(data, "dims", ()):
        return data.assign_attrs(surface="glass") if hasattr(data, "assign_attrs") else data
    kept = [name for name in ("uncd", "ncd", "ruby") if name in data["surface"]]
    data = data.sel(surface=kept)
    if "group" in data.dims:
        data = data.sel(group=["uncd", "ncd", "pooled"])
        data["group"] = ["glass", "steel", "pooled"]
    data["surface"] = ["glass", "steel", "ruby"][: len(kept)]
    return data


def test_figures_take_measured_surfaces_that_the_paper_does_not_know(name):
    inputs = {key: renamed(measured(data)) for key, data in inputs_of(name).items()}
    figure = module_of(name).draw(**inputs)
    figure.draw_without_rendering()
    assert notes(figure) == ["all surfaces measured"]
    assert len(module_of(name).table(**inputs))
