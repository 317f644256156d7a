"""Figures of the page: readable on a phone, what is artificial or open is drawn so."""

from functools import cache

import numpy as np
import pytest
from answer_inputs import (
    CUTOFFS,
    EDGES,
    MODELS,
    RANGE,
    SURFACES,
    edges,
    fit,
    force,
    open_edges,
    spectra,
    topography,
    without_interval,
)  # fmt: skip
from matplotlib.colors import to_hex
from matplotlib.text import Text

from hardcontact.answer import canvas, fit_curve, force_curve, maps, psd, ratios
from hardcontact.answer.datasets import at_range, model_of
from hardcontact.figures.style import ARTIFICIAL
from hardcontact.scales.critical_band import computed_cutoffs

PHONE = 358  # pixels that a figure is wide on a screen of 390
LEAST_TEXT = 9.0  # pixels, with letters of some 7: as small as footnotes on phones are


def of_first(data):
    return data.sel(surface=SURFACES[0])


@cache
def figures():
    return {
        "map": maps.draw(of_first(topography())),
        "psd": psd.draw(of_first(spectra())),
        "ratios": ratios.draw(of_first(edges()), of_first(spectra())),
        "open": ratios.draw(of_first(open_edges()), of_first(spectra())),
        "force": force_curve.draw(force(2)),
        "force without interval": force_curve.draw(without_interval(force())),
        "fitted curve": fit_curve.draw(fit_curve.of_answer(fit())),
        "fitted pair": fit_curve.draw(fit_curve.of_answer(fit(2))),
    }


NAMES = [
    "map", "psd", "ratios", "open", "force", "force without interval", "fitted curve",
    "fitted pair",
]  # fmt: skip


@pytest.mark.parametrize("name", NAMES)
def test_text_is_readable_on_a_phone_and_inside_the_figure(name):
    figure = figures()[name]
    with canvas.canvas_style():
        figure.draw_without_rendering()
    texts = [text for text in figure.findobj(Text) if text.get_visible() and text.get_text()]
    points = PHONE / (72 * figure.get_figwidth())
    assert texts and min(text.get_fontsize() for text in texts) * points >= LEAST_TEXT
    drawn = figure.get_tightbbox()  # inch
    assert drawn.x0 >= 0 and drawn.x1 <= figure.get_figwidth()
    assert drawn.y0 >= 0 and drawn.y1 <= figure.get_figheight()


@pytest.mark.parametrize("name", NAMES)
def test_pictures_are_small(name):
    made = canvas.png(figures()[name])
    assert made.startswith(b"\x89PNG") and len(made) < 150_000


def spans(axes, look):
    """Ends along x of the patches of a colour."""
    patches = [p for p in axes.patches if to_hex(p.get_facecolor()) == look["facecolor"].lower()]
    return [(patch.get_x(), patch.get_x() + patch.get_width()) for patch in patches]


@pytest.mark.parametrize("name", ["psd", "ratios"])
def test_artificial_wavelengths_are_shaded_in_every_panel(name):
    for axes in figures()[name].axes:
        left, right = axes.get_xlim()
        expected = [(left, 55.0)] + ([(25_000.0, right)] if right > 25_000 else [])
        assert np.allclose(spans(axes, ARTIFICIAL), expected)


def test_spectrum_is_drawn_in_colour_where_it_is_reliable():
    data = of_first(spectra())
    (axes,) = psd.draw(data).axes
    colours = {look["color"] for look in psd.KINDS.values()}
    drawn = [line for line in axes.lines if line.get_color() in colours]
    bands = zip(data["shortest_reliable"].values, data["longest_reliable"].values, strict=True)
    assert len(drawn) == data.sizes["measurement"]
    for line, (short, long) in zip(drawn, bands, strict=True):
        x, y = line.get_data()
        inside = x[np.isfinite(np.asarray(y))]
        assert short <= inside.min() and inside.max() <= long and inside.size > 5


def test_edges_that_are_found_are_lines_with_their_interval():
    for axes, side in zip(figures()["ratios"].axes, EDGES, strict=True):
        lines = [
            line.get_xdata() for line in axes.lines if line.get_color() == ratios.EDGE["color"]
        ]
        assert np.allclose(lines, EDGES[side])
        look = {"facecolor": ratios.EDGE_INTERVAL["color"]}
        assert np.allclose(spans(axes, look), (0.8 * EDGES[side], 1.25 * EDGES[side]))


def test_open_edges_are_arrows_and_no_lines():
    axes = figures()["open"].axes[1]
    (arrow,) = axes.texts
    bound = CUTOFFS["large"][-1]
    assert arrow.xyann[0] == bound and bound < arrow.xy[0] < axes.get_xlim()[1]
    assert spans(axes, {"facecolor": ratios.EDGE_INTERVAL["color"]}) == []
    assert not figures()["ratios"].axes[1].texts


def test_arrows_point_to_what_was_not_computed():
    data = of_first(open_edges())
    data["edge_at_least"].loc[{"side": "large"}] = 0
    (arrow,) = ratios.draw(data, of_first(spectra())).axes[1].texts
    assert arrow.xy[0] < arrow.xyann[0] == CUTOFFS["large"][-1]


def test_an_open_end_of_an_interval_runs_to_the_last_cutoff():
    data = of_first(edges())
    data["edge_interval"].loc[{"side": "small", "bound": "high"}] = np.nan
    axes = ratios.draw(data, of_first(spectra())).axes[0]
    look = {"facecolor": ratios.EDGE_INTERVAL["color"]}
    assert np.allclose(spans(axes, look), (0.8 * EDGES["small"], CUTOFFS["small"][-1]))


def test_ratios_are_those_of_the_cutoffs_of_their_side():
    data = of_first(edges())
    for side, cutoffs in CUTOFFS.items():
        assert np.array_equal(computed_cutoffs(data["scale_ratio"].sel(side=side)), cutoffs)


def test_forces_of_every_model_are_drawn_in_the_unit_of_the_answer():
    (axes,) = figures()["force"].axes
    data = force(2)
    assert axes.get_ylabel() == "pull-off force (µN)"
    curves = [line.get_ydata() for line in axes.lines if len(line.get_xdata()) == data.sizes["rho"]]
    assert len(curves) == 2 * len(MODELS)
    expected = 1e6 * data["force"].sel(contact_model=["plastic", "rigid"]).values
    assert np.allclose(curves, expected.reshape(4, -1))


def test_force_is_that_at_the_range_asked_for():
    here = at_range(force())
    assert here["rho"] == RANGE and here["force"].item() == pytest.approx(0.64e-6)
    assert here["contact_model"] == "plastic"
    assert model_of(force().sel(contact_model=["rigid"])) == "rigid"
    with pytest.raises(KeyError):
        at_range(force().assign_attrs(range_of_adhesion=4.0))


def test_what_fits_every_surface_is_drawn_where_there_are_several():
    alone, together = (figures()[name].axes[0] for name in ("fitted curve", "fitted pair"))
    region = to_hex(fit_curve.REGION["color"])

    def regions(axes):
        return [c for c in axes.collections if to_hex(c.get_facecolor()[0]) == region]

    assert regions(alone) == [] and len(regions(together)) == 1
    star = next(line for line in together.lines if line.get_marker() == "*")
    assert star.get_xdata() == RANGE and star.get_ydata() == pytest.approx(46.3)
    assert not [line for line in alone.lines if line.get_marker() == "*"]


def test_pictures_are_the_same_each_time():
    first, second = (canvas.png(psd.draw(of_first(spectra()))) for _ in range(2))
    assert first == second
