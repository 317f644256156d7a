"""Colours and markers, labels, legends."""

import matplotlib as mpl
import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hardcontact.report.figures import drawing, style


def test_colours_and_markers_follow_the_order_of_any_surfaces():
    assert style.colours(["x", "ball", "y"], "ball") == {
        **style.colours(["x", "y"]),
        "ball": style.SPHERE_COLOUR,
    }
    looks = style.looks([str(k) for k in range(8)])
    markers = {name: look["marker"] for name, look in looks.items()}
    assert markers["0"] == markers["6"] != markers["1"]
    assert {name: look["color"] for name, look in looks.items()} == style.colours(looks)


def test_surfaces_at_one_position_stand_side_by_side_around_it():
    data = xr.Dataset(coords={"surface": list("abcd")})
    factors = [factor for factor, _, _ in style.iterate_dodged(data)]
    assert np.prod(factors) == pytest.approx(1)
    assert np.allclose(np.divide(factors[1:], factors[:-1]), style.DODGE)


def test_a_user_s_settings_change_no_figure(monkeypatch):
    monkeypatch.setitem(mpl.rcParams, "axes.facecolor", "black")
    with style.print_style():
        assert mpl.rcParams["axes.facecolor"] == mpl.rcParamsDefault["axes.facecolor"]
        assert mpl.rcParams["font.size"] == style.RC["font.size"]


@pytest.mark.parametrize(
    ("limits", "labels"),
    [((0.5, 20), [0.5, 1, 5, 10]), ((1e-2, 1e3), [1e-2, 0.1, 1, 10, 100, 1e3])],
)
def test_logarithmic_axes_have_plain_numbers(limits, labels):
    axes = Figure().subplots()
    axes.set(xscale="log", xlim=limits)
    style.label_logarithmic(axes.xaxis, digits=(1, 5))
    ticks = axes.get_xticks()
    low, high = limits
    assert np.allclose(ticks[(ticks >= 0.999 * low) & (ticks <= 1.001 * high)], labels)
    assert axes.xaxis.get_major_formatter()(0.5, None) == "0.5"


@pytest.mark.parametrize(
    ("bars", "limits"),  # value, low, high of each
    [([(2, 1.9, 2.1), (8, 1e-9, 1e19)], (0.2, 80)), ([(2, 1, 4), (8, 5, 20)], None)],
)
def test_endless_error_bars_leave_the_frame(bars, limits):
    axes = Figure().subplots()
    axes.axvline(1.0)
    for x, (value, low, high) in enumerate(bars):
        axes.errorbar([x], [value], [[value - low], [high - value]])
    axes.set_yscale("log")
    old_limits = axes.get_ylim()
    style.end_near_values([axes])
    assert np.allclose(axes.get_ylim(), limits or old_limits)


@pytest.mark.parametrize(("letters", "columns"), [(5, 4), (60, 1), (200, 1)])
def test_a_legend_has_no_more_columns_than_fit(letters, columns):
    figure = Figure(figsize=(drawing.WIDTH, 4), layout="constrained")
    style.legend_above(figure, [Line2D([], [], label="x" * letters) for _ in range(5)])
    (legend,) = figure.legends
    assert legend._ncols == columns
    assert letters > 100 or legend.get_window_extent().width <= figure.bbox.width
