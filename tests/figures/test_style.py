"""Colours and markers, labels, legends."""

import numpy as np
from matplotlib import rc_context, rcParams
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.figures import drawing, style


def test_colours_and_markers_follow_the_order_of_any_surfaces():
    assert style.colours(["x", "ball", "y"], "ball") == {
        **style.colours(["x", "y"]),
        "ball": style.SPHERE,
    }
    looks = style.looks([str(k) for k in range(8)])
    markers = {name: look["marker"] for name, look in looks.items()}
    assert markers["0"] == markers["6"] != markers["1"]
    assert {name: look["color"] for name, look in looks.items()} == style.colours(looks)


def test_style_holds_inside_alone():
    with rc_context({"font.size": 11}):
        before = dict(rcParams)
        with style.print_style():
            assert rcParams["font.size"] == 8
        assert dict(rcParams) == before


def test_logarithmic_axes_have_plain_numbers():
    axes = Figure().subplots()
    axes.set(xscale="log", xlim=(0.5, 20))
    style.label_logarithmic(axes.xaxis, at=(1, 5))
    ticks = axes.get_xticks()
    inside = ticks[(ticks >= 0.5) & (ticks <= 20)]
    assert np.allclose(inside, [0.5, 1, 5, 10])
    assert axes.xaxis.get_major_formatter()(0.5, None) == "0.5"


def test_many_decades_are_labelled_at_decades_alone():
    axes = Figure().subplots()
    axes.set(xscale="log", xlim=(1e-5, 1e5))
    style.label_logarithmic(axes.xaxis)
    assert np.allclose(np.log10(axes.get_xticks()) % 1, 0)


def test_legend_entries_hold_each_label_once():
    panels = Figure().subplots(1, 2)
    for axes in panels:
        axes.plot([0, 1], label="both")
    panels[1].plot([1, 0], label="second")
    entries = style.legend_entries(panels)
    assert list(entries) == ["both", "second"]
    assert entries["both"] is panels[0].lines[0]


def test_shades_end_with_the_axes():
    axes = Figure().subplots()
    axes.set(xscale="log", xlim=(10, 1000))
    style.shade_artificial(axes, [(0.0, 20.0), (500.0, np.inf), (2000.0, 3000.0)])
    spans = [(patch.get_x(), patch.get_x() + patch.get_width()) for patch in axes.patches]
    assert np.allclose(spans, [(10, 20), (500, 1000)])
    assert axes.get_xlim() == (10, 1000)


def logarithmic(*bars):
    """Return axes with values from 2 to 8, each with an error bar from `low` to `high`."""
    axes = Figure().subplots()
    axes.axvline(1.0)
    for x, (value, low, high) in enumerate(bars):
        axes.errorbar([x], [value], [[value - low], [high - value]])
    axes.set_yscale("log")
    return axes


def test_an_endless_bar_leaves_the_frame_a_decade_beyond_the_values():
    axes = logarithmic((2, 1.9, 2.1), (8, 1e-9, 1e19))
    style.end_near_values([axes])
    assert np.allclose(axes.get_ylim(), (0.2, 80))


def test_bars_of_reasonable_length_leave_the_axes_as_they_are():
    axes = logarithmic((2, 1, 4), (8, 5, 20))
    before = axes.get_ylim()
    style.end_near_values([axes])
    assert axes.get_ylim() == before


def test_a_legend_has_no_more_columns_than_fit():
    def columns(letters):
        figure = Figure(figsize=(drawing.WIDTH, 4), layout="constrained")
        style.legend_above(figure, [Line2D([], [], label="x" * letters) for _ in range(5)])
        (legend,) = figure.legends
        assert letters > 100 or legend.get_window_extent().width <= figure.bbox.width
        return legend._ncols

    assert [columns(letters) for letters in (5, 60, 200)] == [4, 1, 1]
