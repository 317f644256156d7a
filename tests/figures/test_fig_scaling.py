"""Scaling of the band: the table holds all edges, the panels draw the sections they name."""

from functools import cache

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from figure_inputs.scaling import AREAS, scaling
from figure_rows import select
from paper_numbers import SUBSTRATES

from hardcontact.figures import fig_scaling, style

PUBLISHED = pd.DataFrame({"value": {"critical_wavelength_small": 43.0,
                                    "critical_wavelength_large": 1800.0}})  # fmt: skip


@cache
def drawn():
    return fig_scaling.draw(scaling(), PUBLISHED)


def test_table_holds_every_edge_but_the_open_one_and_every_exponent():
    data, rows = scaling(), fig_scaling.table(scaling(), PUBLISHED)
    edges = select(rows, quantity="edge", origin="computed")
    assert len(edges) == 2 * 4 * 27 - 1
    chosen = {"side": "large", "surface": "mcd", "radius": 1e6, "area": 50.0, "rho": 5.6}
    (row,) = select(edges, **chosen).to_dict("records")
    assert row["value"] == data["edge"].sel(chosen).item()
    assert row["high"] == data["edge_interval"].sel({**chosen, "bound": "high"}).item()
    assert row["reach"] == pytest.approx(np.sqrt(2 * 1e6 * 5.6))
    assert len(select(rows, quantity="exponent", dependence="independent")) == 2 * 4 * 3 * 3
    assert select(rows, origin="published")["value"].tolist() == [43.0, 1800.0]
    assert select(rows, quantity="roll_off", surface="uncd")["value"].item() == 1000.0
    assert rows["unit"].notna().all()


def test_sections_go_through_the_paper_and_leave_out_open_edges():
    data = scaling()
    short, long, contact, _ = drawn().axes
    counts = {"small": [9] * 4, "large": [8, 9, 9, 9]}
    for axes, side in ((short, "small"), (long, "large")):
        marks = [container.lines[0] for container in axes.containers]
        assert [len(line.get_xdata()) for line in marks] == counts[side]
        of_uncd = data["edge"].sel(side=side, surface="uncd", area=400.0)
        assert sorted(marks[1].get_ydata()) == pytest.approx(sorted(of_uncd.values.ravel()))
    (line, *_) = [container.lines[0] for container in contact.containers]
    assert line.get_xdata() == pytest.approx(np.sqrt(AREAS))
    expected = data["edge"].sel(side="small", surface=SUBSTRATES[0], radius=250e3, rho=5.6)
    assert line.get_ydata() == pytest.approx(expected.values)


def test_every_surface_keeps_its_colour_and_every_exponent_its_line():
    exponents = drawn().axes[3]
    colours = [container.lines[0].get_color() for container in exponents.containers]
    each = list(style.colours(SUBSTRATES).values())
    assert colours == [colour for colour in each for _ in fig_scaling.EXPONENTS]
    labels = [text.get_text() for text in exponents.get_yticklabels()]
    assert labels == [name for *_, name in fig_scaling.EXPONENTS]


def test_no_exponent_lies_outside_of_the_axes():
    data = scaling()
    data["exponent"][:] = 2.5
    exponents = fig_scaling.draw(data, PUBLISHED).axes[3]
    least, most = exponents.get_xlim()
    marks = [container.lines[0].get_xdata().item() for container in exponents.containers]
    assert max(marks) == 2.5 < most and least <= -1


def test_intervals_that_leave_the_panel_end_in_arrows():
    data = scaling()
    place = {"side": "small", "surface": "uncd", "part": "all", "length": "rho"}
    data["exponent_interval"].loc[place] = [-7.0, 9.0]
    exponents = fig_scaling.draw(data, PUBLISHED).axes[3]
    arrows = [line for line in exponents.lines if line.get_marker() in ("<", ">")]
    assert [line.get_xdata()[0] for line in arrows] == list(exponents.get_xlim())
    assert {line.get_color() for line in arrows} == {style.colours(SUBSTRATES)["uncd"]}
    assert not [line for line in drawn().axes[3].lines if line.get_marker() in ("<", ">")]


def test_substitutes_are_named_and_measured_surfaces_are_not():
    (note,) = [text.get_text() for text in drawn().texts]
    assert note.startswith("substitute surfaces: ")
    data = scaling()
    measured = data.assign(basis=xr.full_like(data["basis"], "measured"))
    (note,) = [text.get_text() for text in fig_scaling.draw(measured, PUBLISHED).texts]
    assert note == "all surfaces measured"
