"""Limit of elastic contact: the table holds what is drawn, one curve a surface."""

import numpy as np
from figure_inputs.elastic_limit import elastic_limit
from figure_rows import select

from hardcontact.figures import fig_elastic_limit


def test_table_and_curves_hold_the_indices():
    data = elastic_limit()
    rows, axes = fig_elastic_limit.table(data), fig_elastic_limit.draw(data).axes[0]
    for curve, surface in zip(axes.lines, data.surface.values, strict=False):
        expected = data.slope_index.sel(surface=surface)
        np.testing.assert_allclose(curve.get_ydata()[:3], expected[:3])
        drawn = select(rows, quantity="slope_index", surface=surface)["value"]
        np.testing.assert_allclose(drawn[:3], expected[:3])
    assert list(axes.lines[-1].get_ydata()) == [1, 1]
