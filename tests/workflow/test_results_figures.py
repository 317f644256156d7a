"""Every figure of the quick study: drawn without warnings, legible, with the datasets' numbers."""

import importlib
from functools import cache
from itertools import combinations, pairwise

import numpy as np
import pytest
from matplotlib.colors import same_color
from matplotlib.lines import Line2D
from matplotlib.text import Text
from paper_numbers import LABELS, SUBSTRATES
from repository import PAPER, ROOT

from hardcontact.base import dataset
from hardcontact.config.patterns import PUBLISHED_TABLES
from hardcontact.report.captions import caption
from hardcontact.report.figures import drawing, style
from hardcontact.report.figures.listing import PAPER_FIGURES, describe_figure

#: Figures with values of the paper, and words of their captions about these.
PUBLISHED_IN = {
    "fig3": "published mean and median", "fig4": "published range", "fig5": "2 nm and 50 nm",
    "fig_fit": "published range", "fig6": "43 nm and 1.8 µm",
    "fig_asperities": "published, 1.8 µm", "fig_classical": "published forces",
    "fig_elastic": "most of the contact area",
    "fig_protruded": "Black: published",
}  # fmt: skip


@pytest.fixture(scope="module", params=PAPER_FIGURES)
def name(request):
    return request.param


@pytest.fixture(scope="module")
def draw_checked(results):
    """Return a function that draws a figure of the finished study: its table and its drawing."""

    @cache
    def draw(name):
        module = importlib.import_module(f"hardcontact.report.figures.{name}")
        inputs = {
            source: drawing.READERS[source](ROOT / PUBLISHED_TABLES[source])
            if source in PUBLISHED_TABLES
            else dataset.read(results / f"{source}.nc")
            for source in describe_figure(name).inputs
        }
        inputs_before = {key: data.copy(deep=True) for key, data in inputs.items()}
        with style.print_style():
            table, figure = module.draw(**inputs)
            style.freeze_layout(figure)
            figure.draw_without_rendering()
        for key, data in inputs.items():
            assert getattr(data, "identical", data.equals)(inputs_before[key]), key
        return table, figure

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
    """Return the labels of ticks that lie beyond the limits of the axes, or of axes without any."""
    for axis in (axes.xaxis, axes.yaxis):
        low, high = sorted(axis.get_view_interval())
        ticks = [*axis.get_major_ticks(), *axis.get_minor_ticks()]
        artists = {
            tick.label1 for tick in ticks if low <= tick.get_loc() * (1 + 1e-9) <= high * (1 + 2e-9)
        }
        labels = set(axis.findobj(Text)) - {axis.label}
        yield from labels - artists if axes.axison else axis.findobj(Text)


def test_texts_are_large_enough_inside_the_figure_and_do_not_overlap(draw_checked, name):
    _, figure = draw_checked(name)
    width, height = figure.get_size_inches()
    assert width == drawing.WIDTH and 2 < height < 9
    boxes = texts(figure)
    assert min(text.get_fontsize() for text, _ in boxes) >= 0.99 * 7
    sheet = figure.bbox
    texts_beyond = [
        text.get_text()
        for text, box in boxes
        if box.x0 < sheet.x0 or box.x1 > sheet.x1 or box.y0 < sheet.y0 or box.y1 > sheet.y1
    ]
    assert texts_beyond == []
    covered = [
        (text.get_text(), second_text.get_text())
        for (text, box), (second_text, second_box) in combinations(boxes, 2)
        # The boxes of tilted names of an axis overlap, where the names do not.
        if box.overlaps(second_box)
        and not (text.get_rotation() % 90 and second_text.get_rotation() % 90)
    ]
    assert covered == []


def test_table_has_finite_values_with_units(draw_checked, name):
    table, _ = draw_checked(name)
    assert set(table["origin"]) <= {"computed", "published", "given"}
    assert table["unit"].notna().all() and not table.duplicated().any()
    ends = [column for column in ("value", "low", "high") if column in table]
    assert not np.isinf(table[ends].astype(float)).any(axis=None)
    has_ends = table[ends].notna().any(axis=1)
    is_beyond = table["beyond"].fillna("") != "" if "beyond" in table else False
    assert (has_ends | is_beyond).all()
    if {"surface", "basis"} <= set(table):
        assert table.loc[table["surface"].notna(), "basis"].eq("substitute").all()


def test_substitutes_are_named_and_panels_lettered_in_order(draw_checked, name):
    _, figure = draw_checked(name)
    assert any(text.get_text().startswith("substitute surfaces: ") for text in figure.texts)
    start = r"$\mathbf{"
    titles = [axes.get_title(loc="left") for axes in figure.axes]
    letters = sorted({title[len(start)] for title in titles if title.startswith(start)})
    assert all(ord(following) == ord(previous) + 1 for previous, following in pairwise(letters))
    assert letters[:1] == ["a"] or len(figure.axes) == 1


def test_a_surface_has_one_colour(draw_checked, name):
    _, figure = draw_checked(name)
    colours = dict(zip(LABELS, style.colours(SUBSTRATES).values(), strict=True))
    lines = [line for line in figure.findobj(Line2D) if line.get_label() in colours]
    assert all(same_color(line.get_color(), colours[line.get_label()]) for line in lines)
    if not lines:
        assert name in {
            "fig1",
            "fig3",
            "fig5",
            "fig_elastic",
            "fig_fit",
            "fig_protruded",
        }


def test_the_caption_is_short_and_names_published_values(draw_checked, name):
    title, short, rest_of_caption = caption(name, PAPER)
    assert 10 < len(title) < 80 and 20 < len(short.split()) <= 65 and rest_of_caption
    assert not any(
        mark in " ".join((title, short, rest_of_caption)) for mark in ("{", "}", "**", "``", "\n")
    )
    has_published = (draw_checked(name)[0]["origin"] == "published").any()
    assert has_published == (name in PUBLISHED_IN)
    if has_published:
        assert PUBLISHED_IN[name] in f"{short} {rest_of_caption}"


def test_the_files_of_a_figure_have_the_same_table(draw_checked, results, name):
    table, _ = draw_checked(name)
    folder = results / "figures"
    written = table.to_csv(index=False, float_format="%.8g", lineterminator="\n")
    assert (folder / f"{name}.csv").read_text() == written
    for kind, start in (("pdf", b"%PDF-"), ("png", b"\x89PNG"), ("svg", b"<?xml")):
        assert (folder / f"{name}.{kind}").read_bytes().startswith(start)


RUMPF = {"model": "rumpf_height", "metrics": "afm", "surface": "uncd"}
PLASTIC = {"contact_model": "plastic"}
#: A figure, the columns that select rows of its table, and the values in a dataset.
NUMBERS = [
    ("fig1", {"surface": "mcd", "quantity": "rms_height_mean"},
     "topography", lambda data: data.rms_height_mean.sel(surface="mcd")),
    ("fig3", {"surface": "uncd", "quantity": "mean_force", "pair": "fitted"},
     "fit",
     lambda data: data.mean_force_at_pair.sel(surface="uncd", pair="fitted", **PLASTIC)),
    ("fig4", {"surface": "ncd", "quantity": "force_ratio", "origin": "computed", "over": "scans"},
     "fit", lambda data: data.force_ratio.sel(surface="ncd", **PLASTIC)),
    ("fig_fit", {"panel": "a", "quantity": "best_error_of_set"},
     "sets", lambda data: data.best_error.sel(PLASTIC)),
    ("fig5", {"quantity": "depth", "origin": "computed", "share": 1.0},
     "indent", lambda data: data.depth.groupby("preload").max(...)),
    ("fig6", {"group": "uncd", "side": "large", "quantity": "filtered_force_ratio"},
     "edges", lambda data: data.filtered_force_ratio.sel(surface="uncd", side="large")),
    ("fig_asperities", {"surface": "mcd", "quantity": "patch_count"},
     "asperities", lambda data: data.patch_count.sel(surface="mcd").median(["scan", "contact"])),
    ("fig_classical", {"quantity": "pull_off_force", **RUMPF},
     "classical", lambda data: data.pull_off_force.sel(RUMPF)),
    ("fig_elastic", {"surface": "ncd", "quantity": "peak_pressure_median"},
     "elastic", lambda data: data.peak_pressure.sel(surface="ncd").median(["scan", "contact"])),
    ("fig_enhancement", {"contact_model": "rigid", "quantity": "edge"},
     "enhancement", lambda data: data.edge.sel(contact_model="rigid")),
    ("fig_protruded", {"quantity": "median_force_at_published", "protruded_body": "coating"},
     "protruded", lambda data: data.median_force_at_published),
]  # fmt: skip


@pytest.mark.parametrize(
    ("name", "selected_rows", "source", "values"),
    NUMBERS,
    ids=lambda value: str(value) if value in PAPER_FIGURES else "",
)
def test_numbers_are_those_of_the_dataset(
    draw_checked, results, name, selected_rows, source, values
):
    table, _ = draw_checked(name)
    is_selected = np.logical_and.reduce(
        [table[column] == value for column, value in selected_rows.items()]
    )
    reference_values = np.asarray(values(dataset.read(results / f"{source}.nc"))).ravel()
    reference_values = np.sort(reference_values[np.isfinite(reference_values)])
    assert reference_values.size
    np.testing.assert_allclose(
        np.sort(table[is_selected]["value"].dropna()), reference_values, rtol=1e-7
    )


def test_every_figure_has_a_number_compared():
    assert {name for name, *_ in NUMBERS} == set(PAPER_FIGURES)
