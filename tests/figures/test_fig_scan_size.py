"""Size of scans: the table holds every factor, the panels draw the ranges they name."""

from functools import cache

import pytest
from figure_inputs.scan_size import scan_size
from figure_rows import select

from hardcontact.figures import fig_scan_size


@cache
def drawn():
    return fig_scan_size.draw(scan_size())


def test_table_holds_every_factor_and_every_size():
    data, rows = scan_size(), fig_scan_size.table(scan_size())
    assert len(select(rows, quantity="excess")) == 4 * 3 * 2 + 5 * 3 * 2
    (row,) = select(rows, quantity="excess", surface="ncd", scan_size=2500.0, rho=5.6).to_dict(
        "records"
    )
    of_ncd = data.sel(surface="ncd", scan_size=2500.0, rho=5.6)
    assert row["value"] == of_ncd["excess"].item()
    assert row["predicted"] == of_ncd["predicted_excess"].item()
    assert row["high"] == of_ncd["excess_interval"].sel(bound="high").item()
    assert len(select(rows, quantity="size_needed", unit="nm")) == 4 * 2


def test_panels_show_computed_factors_the_rule_and_sizes():
    data = scan_size()
    sizes, rule, needed, _ = drawn().axes
    marks = [container.lines[0] for container in sizes.containers]
    expected = data["excess"].sel(surface="polished_uncd", rho=5.6)
    assert marks[0].get_ydata() == pytest.approx(expected.values)
    assert len(rule.lines[0].get_xdata()) == 5 * 3 * 2
    assert rule.lines[1].get_ydata() == pytest.approx(1.1 * rule.lines[1].get_xdata())
    last = data["size_needed"].sel(surface="mcd") / 1e3
    assert needed.lines[3].get_ydata() == pytest.approx(last.values)


def test_surfaces_of_one_size_stand_beside_each_other():
    sizes, edges = (drawn().axes[place] for place in (0, 3))
    for axes, containers in ((sizes, sizes.containers), (edges, edges.containers[::2])):
        places = [float(one.lines[0].get_xdata()[1]) for one in containers]  # at 2.5 µm
        assert len(places) == 4 and places == sorted(set(places)), axes
        assert places[0] * places[3] == pytest.approx(2.5**2) and 2.5 not in places


def test_long_edges_of_windows_and_whole_surfaces_are_drawn_open_ones_at_their_bound():
    data, edges = scan_size(), drawn().axes[3]
    windows, whole = (container.lines[0] for container in edges.containers[:2])
    first = data["long_edge"].sel(surface="polished_uncd") / 1e3
    assert windows.get_ydata() == pytest.approx(first.values[:3])
    assert whole.get_ydata() == pytest.approx(first.values[3:])
    assert whole.get_markerfacecolor() == "white"
    of_mcd = edges.containers[6]
    assert of_mcd.lines[0].get_ydata()[0] == pytest.approx(2.4)
    ends = of_mcd.lines[2][0].get_segments()[0][:, 1]
    assert ends == pytest.approx([0.5, 2.5])  # the shortest cutoff, the longest wave
    longer, shorter = (text for text in edges.texts if text.arrow_patch)
    assert longer.get_position()[1] == pytest.approx(2.4) and longer.xy[1] > 2.4  # at least
    assert shorter.get_position()[1] == pytest.approx(0.5) and shorter.xy[1] < 0.5  # at most


def test_table_holds_long_edges_with_their_status_and_the_forces_beside_them():
    rows = fig_scan_size.table(scan_size())
    edges = select(rows, quantity="long_edge", unit="nm", panel="d")
    assert len(edges) == 4 * 5 == len(select(rows, quantity="force_over_largest", panel="d"))
    (row,) = select(edges, surface="mcd", scan_size=1250.0).to_dict("records")
    assert row["value"] == 2400 and row["status"] == "beyond the cell" and row["mirrored"] == 1
    (row,) = select(edges, surface="mcd", scan_size=40e3).to_dict("records")
    assert row["status"] == "found" and row["mirrored"] == 0


def test_substitutes_are_named():
    assert any(text.get_text().startswith("substitute surfaces") for text in drawn().texts)
