"""Every figure of the tiny study: drawn without warnings, legible, with the datasets' numbers."""

import importlib
from functools import cache
from itertools import combinations

import numpy as np
import pytest
from matplotlib.colors import same_color
from matplotlib.lines import Line2D
from matplotlib.patches import StepPatch
from matplotlib.text import Text
from paper_numbers import LABELS, SUBSTRATES, WORK
from repository import ROOT

from hardcontact.base.dataset import read_dataset
from hardcontact.base.published import PUBLISHED_TABLES
from hardcontact.report.figures import drawing, style
from hardcontact.report.figures.listing import PAPER_FIGURES, describe_figure


@pytest.fixture(scope="module")
def read_inputs(results):
    """Return a function that reads the inputs of a figure of the finished study."""

    @cache
    def read(name):
        return {
            source: drawing.READERS[source](ROOT / PUBLISHED_TABLES[source])
            if source in PUBLISHED_TABLES
            else read_dataset(results / f"{source}.nc")
            for source in describe_figure(name).inputs
        }

    return read


@pytest.fixture(scope="module")
def draw_checked(read_inputs):
    """Return a function that draws a figure of the finished study and expects unchanged inputs."""

    @cache
    def draw(name):
        module = importlib.import_module(f"hardcontact.report.figures.{name}")
        inputs = read_inputs(name)
        inputs_before = {key: data.copy(deep=True) for key, data in inputs.items()}
        with style.print_style():
            figure = module.draw(**inputs)
            style.freeze_layout(figure)
            figure.draw_without_rendering()
        for key, data in inputs.items():
            assert data.equals(inputs_before[key]), key
        return figure

    return draw


def texts(figure):
    """Return the visible texts and their boxes (pixels), shrunk by a pixel."""
    visible_texts = [
        text for text in figure.findobj(Text) if text.get_visible() and text.get_text()
    ]
    unseen = {text for axes in figure.axes for text in unseen_tick_labels(axes)}
    return [
        (text, text.get_window_extent().padded(-1)) for text in visible_texts if text not in unseen
    ]


def unseen_tick_labels(axes):
    """Yield the tick labels that are not drawn: beyond the limits, or of hidden axes."""
    for axis in (axes.xaxis, axes.yaxis):
        low, high = sorted(axis.get_view_interval())
        ticks = [*axis.get_major_ticks(), *axis.get_minor_ticks()]
        seen_labels = {
            tick.label1 for tick in ticks if low <= tick.get_loc() * (1 + 1e-9) <= high * (1 + 2e-9)
        }
        tick_labels = set(axis.findobj(Text)) - {axis.label}
        yield from tick_labels - seen_labels if axes.axison else axis.findobj(Text)


@pytest.mark.parametrize("name", PAPER_FIGURES)
def test_texts_are_large_enough_inside_the_figure_and_do_not_overlap(draw_checked, name):
    figure = draw_checked(name)
    width, height = figure.get_size_inches()
    assert width == drawing.WIDTH and 2 < height < 9  # inches: less than a page
    boxes = texts(figure)
    assert min(text.get_fontsize() for text, _ in boxes) >= 7  # points
    sheet = figure.bbox
    texts_beyond = [
        text.get_text()
        for text, box in boxes
        if box.x0 < sheet.x0 or box.x1 > sheet.x1 or box.y0 < sheet.y0 or box.y1 > sheet.y1
    ]
    assert texts_beyond == []
    overlapping_texts = [
        (text.get_text(), second_text.get_text())
        for (text, box), (second_text, second_box) in combinations(boxes, 2)
        # The boxes of tilted names of an axis overlap, where the names do not.
        if box.overlaps(second_box)
        and not (text.get_rotation() % 90 and second_text.get_rotation() % 90)
    ]
    assert overlapping_texts == []


@pytest.mark.parametrize("name", PAPER_FIGURES)
def test_a_surface_has_one_colour(draw_checked, name):
    figure = draw_checked(name)
    colours = dict(zip(LABELS, style.surface_colours(SUBSTRATES).values(), strict=True))
    lines = [line for line in figure.findobj(Line2D) if line.get_label() in colours]
    assert all(same_color(line.get_color(), colours[line.get_label()]) for line in lines)
    if not lines:  # no line in these figures is labelled with a surface
        assert name in {"fig1", "fig3", "fig5", "fig_elastic", "fig_fit", "fig_features"}


PLASTIC = {"contact_model": "plastic"}
FITTED = PLASTIC | {"pair": "fitted"}
PUBLISHED = PLASTIC | {"pair": "published"}
RIGID_CASE = {"contact_model": "rigid", "side": "short", "rho": 1}  # nm
CONTACTS = ["scan", "contact"]
MICRO, MILLI, GIGA = 1e-6, 1e-3, 1e9
#: A figure, the number of a panel, a dataset, and numbers of this dataset that the panel shows.
NUMBERS = [
    ("fig4", 3, "fit", lambda data: data.force_over_reference.sel(PLASTIC)),
    ("fig4", 4, "fit", lambda data: WORK * data.mean_force.sel(PLASTIC) / MICRO),
    ("fig4", 4, "fit", lambda data: data.mean_force_at_pair.sel(FITTED) / MICRO),
    ("fig_fit", 0, "sets", lambda data: data.best_error.sel(PLASTIC)),
    ("fig_fit", 0, "fit", lambda data: data.best_error_by_range),
    ("fig_fit", 1, "fit", lambda data: data.work_of_adhesion.sel(PLASTIC) / MILLI),
    ("fig5", 1, "indent", lambda data: -data.sphere_height.sel(y=0)),
    ("fig5", 3, "indent", lambda data: data.depth.groupby("preload").max(...)),
    ("fig6", 0, "edges", lambda data: data.filtered_force_ratio.sel(side="short")),
    ("fig6", 1, "edges", lambda data: data.filtered_force_ratio.sel(side="long")),
    ("fig_asperities", 2, "asperities", lambda data: data.asperity_count.median(CONTACTS)),
    ("fig_asperities", 3, "asperities", lambda data: data.extent.median(CONTACTS) / 1e3),
    ("fig_classical", 0, "classical", lambda data: data.computed_mean_force / MICRO),
    ("fig_classical", 1, "classical", lambda data: data.mean_relative_error),
    ("fig_elastic", 4, "elastic", lambda data: data.share_above_hardness),
    ("fig_elastic", 5, "elastic", lambda data: data.peak_pressure / GIGA),
    ("fig_edge_shifts", 0, "edge_shifts", lambda data: data.filtered_force_ratio.sel(RIGID_CASE)),
    ("fig_scales", 0, "topography", lambda data: data.isotropic_psd.mean("scan")),
    ("fig_octaves", 1, "band_forces", lambda data: data.band_force_ratio.sel(band="published")),
    ("fig_features", 0, "features", lambda data: data.median_force_at_pair / MICRO),
    ("fig_features", 1, "features", lambda data: data.log_force_std),
]


def drawn_numbers(axes):
    """Return the coordinates of all lines and symbols of a panel."""
    lines = [coordinates for line in axes.lines for coordinates in line.get_data(orig=False)]
    offsets = [np.ma.filled(marks.get_offsets(), np.nan) for marks in axes.collections]
    return np.concatenate([np.ravel(values).astype(float) for values in (*lines, *offsets)])


@pytest.mark.parametrize(
    ("figure", "panel", "source", "numbers"),
    NUMBERS,
    ids=lambda value: "" if callable(value) else str(value),
)
def test_numbers_of_datasets_are_drawn(draw_checked, read_inputs, figure, panel, source, numbers):
    drawn = drawn_numbers(draw_checked(figure).axes[panel])
    expected = np.ravel(numbers(read_inputs(figure)[source]))
    expected = expected[np.isfinite(expected)]
    assert expected.size
    missing = [value for value in expected if not np.isclose(drawn, value, rtol=1e-6).any()]
    assert missing == []


def test_maps_are_those_of_the_dataset(draw_checked, read_inputs):
    heights = read_inputs("fig1")["topography"].example_heights.isel(surface=0)
    (image,) = draw_checked("fig1").axes[0].images
    np.testing.assert_allclose(image.get_array(), heights - heights.mean(), atol=1e-4)


def test_histograms_hold_all_forces_and_name_the_fitted_shape(draw_checked, read_inputs):
    axes = draw_checked("fig3").axes[len(SUBSTRATES)]  # below the first surface: logarithmic axes
    fit = read_inputs("fig3")["fit"].sel(PUBLISHED).isel(surface=0)
    assert f"here {fit.log_force_std.item():.2f}" in axes.get_title(loc="left")
    histograms = [patch.get_data() for patch in axes.patches if isinstance(patch, StepPatch)]
    totals = [np.sum(density * np.diff(edges)) for density, edges, _ in histograms]
    assert np.allclose(totals, 1) and len(totals) == 2
