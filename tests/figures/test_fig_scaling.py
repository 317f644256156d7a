"""Scaling of the band: the table holds all edges, the panels draw the sections they name."""

from functools import cache

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from figure_inputs.scaling import scaling
from figure_rows import select
from matplotlib.colors import to_rgb
from paper_numbers import SUBSTRATES

from hardcontact.figures import fig_scaling, style

PUBLISHED = pd.DataFrame({"value": {"critical_wavelength_small": 43.0,
                                    "critical_wavelength_large": 1800.0}})  # fmt: skip


@cache
def drawn():
    return fig_scaling.draw(scaling(), PUBLISHED)


def test_table_holds_every_edge_but_the_open_one_and_all_that_is_drawn():
    data, rows = scaling(), fig_scaling.table(scaling(), PUBLISHED)
    edges = select(rows, quantity="edge", origin="computed")
    assert len(edges) == 2 * 4 * 27 - 1
    chosen = {"side": "large", "surface": "mcd", "radius": 1e6, "area": 50.0, "rho": 5.6}
    (row,) = select(edges, **chosen).to_dict("records")
    assert row["value"] == data["edge"].sel(chosen).item()
    assert row["high"] == data["edge_interval"].sel({**chosen, "bound": "high"}).item()
    assert row["reach"] == pytest.approx(np.sqrt(2 * 1e6 * 5.6))
    assert len(select(rows, quantity="formula_edge")) == 2 * 4 * 27
    assert len(select(rows, quantity="designed_error")) == 2 * 2 * 3
    assert select(rows, origin="published")["value"].tolist() == [43.0, 1800.0]
    place = select(rows, quantity="designed_over_range", designed="crn_rougher")
    assert place["value"].item() == 167.0
    assert rows["unit"].notna().all()


def test_sections_go_through_the_paper_and_leave_out_open_edges():
    data = scaling()
    short, long, *_ = drawn().axes
    counts = {"small": [9] * 4, "large": [8, 9, 9, 9]}
    for axes, side in ((short, "small"), (long, "large")):
        marks = [container.lines[0] for container in axes.containers]
        assert [len(line.get_xdata()) for line in marks] == counts[side]
        of_uncd = data["edge"].sel(side=side, surface="uncd", area=400.0)
        assert sorted(marks[1].get_ydata()) == pytest.approx(sorted(of_uncd.values.ravel()))
    place = {"side": "small", "surface": SUBSTRATES[0], "radius": 250e3, "area": 400.0}
    formula = data["formula_edge"].sel(place).values
    assert any(np.array_equal(line.get_ydata(), formula) for line in short.lines)


def test_marks_have_the_colours_of_the_surfaces_and_bounds_are_open():
    _, _, errors, regimes = drawn().axes
    faces = [line.get_markerfacecolor() for line in errors.lines if line.get_marker() == "v"]
    assert faces == [fig_scaling.SIDES["small"][0], "white"]
    marked = [tuple(to_rgb(one.get_facecolor()[0])) for one in regimes.collections[-4:]]
    assert marked == [to_rgb(colour) for colour in style.colours(SUBSTRATES).values()]
    offsets = [one.get_offsets()[0].tolist() for one in regimes.collections[-4:]]
    assert offsets[1] == [3.2, 3.2]


def test_substitutes_are_named_and_measured_surfaces_are_not():
    (note,) = [text.get_text() for text in drawn().texts]
    assert note.startswith("substitute surfaces: ")
    data = scaling()
    measured = data.assign(basis=xr.full_like(data["basis"], "measured"))
    (note,) = [text.get_text() for text in fig_scaling.draw(measured, PUBLISHED).texts]
    assert note == "all surfaces measured"
