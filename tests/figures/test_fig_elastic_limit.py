"""Limit of the bearing area: the table holds what is drawn, contacts yield from one on."""

from functools import cache

import numpy as np
from figure_inputs.elastic_limit import elastic_limit
from figure_rows import select
from paper_numbers import LABELS

from hardcontact.figures import fig_elastic_limit


@cache
def drawn():
    return fig_elastic_limit.draw(elastic_limit())


def test_table_holds_indices_shares_areas_and_forces():
    data, rows = elastic_limit(), fig_elastic_limit.table(elastic_limit())
    of_ncd = data.plasticity_index.sel(surface="ncd")
    index = select(rows, quantity="plasticity_index", surface="ncd")
    assert index["value"].max() == of_ncd.max() and index["value"].min() == of_ncd.min()
    share = select(rows, quantity="plastic_share", surface="ncd")
    assert (share["value"].item(), share["high"].item()) == (0.9, 0.9 * 1.2)
    for name in fig_elastic_limit.AREAS:
        np.testing.assert_array_equal(
            select(rows, quantity=name)["value"], data[name].values.ravel()
        )
    ratio = select(rows, quantity="force_ratio", surface="uncd", variant="larger_area")
    assert ratio["value"].item() == 2
    assert select(rows, origin="given")["value"].item() == 405


def test_contacts_yield_from_one_on():
    axes = drawn().axes[0]
    assert [list(line.get_xdata()) for line in axes.lines[-1:]] == [[1, 1]]
    for line, of_surface in zip(axes.lines[:4], elastic_limit().plasticity_index, strict=True):
        yields = float((of_surface >= 1).mean())
        below = np.asarray(line.get_ydata())[np.asarray(line.get_xdata()) < 1]
        assert abs(1 - yields - (below.max() if below.size else 0)) < 0.03


def test_no_mark_lies_behind_a_legend_or_on_the_frame():
    data = elastic_limit()
    for name in fig_elastic_limit.SHARES:
        data[f"{name}_interval"] = data[f"{name}_interval"].clip(0, 1)
    figure = fig_elastic_limit.draw(data)
    figure.canvas.draw()
    _, shares, _, forces, _ = figure.axes
    for axes in (shares, forces):
        within = axes.transData.inverted()
        legend = axes.get_legend().get_window_extent().transformed(within)
        bars = [one.lines[2][0].get_segments()[0] for one in axes.containers]
        assert max(bar[:, 1].max() for bar in bars) < legend.y0
        assert min(bar[:, 1].min() for bar in bars) > axes.get_ylim()[0]


def test_substitutes_are_named():
    (note,) = [text.get_text() for text in drawn().texts]
    assert note.startswith(f"substitute surfaces: {', '.join(LABELS)}")
