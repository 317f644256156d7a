"""Fig. 5: lines through the deepest point, distributions of all contacts."""

import numpy as np
import pytest
from figure_inputs.contact import PIXEL, PRELOADS, indent
from figure_inputs.published_tables import published_constants
from figure_rows import select

from hardcontact.figures import fig5


def table(data):
    return fig5.table(data, published_constants())


def test_lines_go_through_the_deepest_point_of_the_published_preload():
    data = indent()
    rows = table(data)
    for along, panel, length in (("x", "b", 4 * PIXEL), ("y", "c", 0)):
        before, after = (
            select(rows, panel=panel, quantity=f"height_{when}").set_index("position")["value"]
            for when in ("before", "after")
        )
        depth = before - after
        assert list(depth.index) == list(data[along].values)
        assert depth.idxmax() == pytest.approx(length)
        assert depth.max() == pytest.approx(data["indentation"].max().item())
    assert before.max() <= 0  # heights fall away from the apex
    assert set(select(rows, panel="b")["preload"]) == {2e-5}


def test_distributions_hold_the_contacts_of_each_preload():
    data = indent()
    rows = table(data)
    for panel, name in (("d", "depth"), ("e", "edge_length"), ("f", "lateral_size")):
        for preload in PRELOADS:
            of_contacts = data[name].sel(preload=preload).values.ravel()
            drawn = select(
                rows, panel=panel, quantity=name, origin="computed", preload=preload
            ).set_index("share")["value"]
            assert drawn[0.0] == of_contacts.min() and drawn[1.0] == of_contacts.max()
            assert np.mean(of_contacts <= drawn[0.5]) >= 0.5 > np.mean(of_contacts < drawn[0.5])
    published = select(rows, origin="published").set_index("quantity")["value"].to_dict()
    assert published == {"depth": 2.0, "edge_length": 50.0, "lateral_size": 50.0}


def test_every_indent_of_the_map_is_in_view():
    shown = indent().sel(preload=2e-5)
    pressed = shown["indentation"].where(shown["indentation"] > 0, drop=True)
    for along in "xy":
        low, high = fig5._view(shown, along)
        assert low <= pressed[along].min() and pressed[along].max() <= high


def test_nearest_preload_and_missing_scans():
    data = indent()
    data["depth"][:, 1] = np.nan
    one = data.sel(preload=[1e-5])
    for drawn in (data, one):
        fig5.draw(drawn, published_constants()).draw_without_rendering()
    assert set(select(table(one), panel="b")["preload"]) == {1e-5}
    assert select(table(data), quantity="depth", origin="computed")["value"].notna().all()
