"""Laws of attraction: the table holds what is drawn, the pressure drawn is that of each law."""

from functools import cache

import numpy as np
import pytest
from figure_inputs.laws import laws
from figure_inputs.scales import CRITICAL
from figure_rows import select
from paper_numbers import SUBSTRATES

from hardcontact.figures import fig_laws
from hardcontact.insight.interaction_laws import LAWS, pressure
from hardcontact.insight.law_comparison import CASES


@cache
def drawn():
    return fig_laws.draw(laws())


def test_table_holds_fits_ratios_and_edges_of_every_law():
    data, rows = laws(), fig_laws.table(laws())
    for law in data.law.values:
        for case in CASES:
            one = data.sel(law=law, case=case)
            for name in ("range_of_law", "work_of_adhesion", "fit_error"):
                (row,) = select(rows, law=law, case=case, quantity=name).to_dict("records")
                assert row["value"] == one[name].item()
                assert (row["low"], row["high"]) == tuple(one[f"{name}_interval"].values)
            of_case = select(rows, law=law, case=case, panel="c", group="mcd")
            assert of_case["value"].item() == one.ratio.sel(surface="mcd").item()
            edge = select(rows, law=law, case=case, side="small", group="pooled")
            assert edge["value"].item() == one.critical_wavelength.values[0, -1]
    assert not rows.duplicated().any() and rows["unit"].notna().all()
    assert len(select(rows, origin="published")) == 4


def test_an_edge_that_is_open_has_no_row():
    edges = select(fig_laws.table(laws()), side="large", quantity="critical_wavelength")
    assert np.isnan(CRITICAL[1, 0]) and "polished_uncd" not in edges["group"].values
    assert set(edges["group"]) == {*SUBSTRATES[1:], "pooled"}


def test_pressure_drawn_is_that_of_each_law():
    lines = drawn().axes[0].lines
    data = laws().sel(case="equivalent")
    for law, line in zip(LAWS, lines, strict=True):
        rho = data.range_of_law.sel(law=law.name).item()
        work = data.work_of_adhesion.sel(law=law.name).item()
        # 0.05 J/m² over 5 nm are 10 MPa.
        expected = 1e3 * work / rho * pressure(law, line.get_xdata(), rho)
        assert line.get_ydata() == pytest.approx(expected)
        assert line.get_label() == law.label


def test_the_legend_shows_line_and_mark_of_each_law():
    handles = drawn().axes[0].get_legend().legend_handles
    assert [handle.get_marker() for handle in handles] == list(fig_laws.MARKERS)
    assert [handle.get_linestyle() for handle in handles] == list(fig_laws.DASHES)


def test_laws_are_told_apart_without_colour():
    marks = {line.get_marker() for line in drawn().axes[2].lines} - {"None", "_", "|", ""}
    assert marks == set(fig_laws.MARKERS)
    assert len({line.get_linestyle() for line in drawn().axes[0].lines}) == len(LAWS)
