"""Elastic contact: every contact and its median, levels, colours that turn at the hardness."""

import numpy as np
import pytest
from figure_inputs.building import SCANS
from figure_inputs.contact import CONTACTS, HARDNESS, elastic
from figure_rows import select
from paper_numbers import SUBSTRATES

from hardcontact.figures import fig_elastic


def test_table_holds_every_contact_and_its_median():
    data = elastic()
    rows = fig_elastic.table(data)
    ratio = data["elastic_pull_off_force"] / data["rigid_pull_off_force"]
    for name, values in (
        ("hard_share", data["hard_share"]),
        ("peak_pressure", data["peak_pressure"]),
        ("elastic_over_rigid", ratio),
    ):
        of_surface = values.sel(surface="ncd").values
        contacts = select(rows, surface="ncd", quantity=name)["value"]
        assert sorted(contacts) == sorted(of_surface.ravel())
        median = select(rows, surface="ncd", quantity=f"{name}_median")["value"].item()
        assert median == pytest.approx(np.median(of_surface))


def test_table_holds_the_levels_drawn():
    rows = fig_elastic.table(elastic())
    levels = select(rows, panel="c").query("origin != 'computed'")
    assert levels.set_index("quantity")["value"].to_dict() == {"hardness": HARDNESS}
    assert select(rows, quantity="hertz_peak_pressure")["value"].item() == 137e6
    most = select(rows, origin="published", quantity="hard_share")
    assert (most["low"].item(), most["high"].item()) == (0.5, 1.0)


def test_colours_turn_at_the_hardness():
    maps = [axes for axes in fig_elastic.draw(elastic()).axes if axes.get_xlabel() == "x (nm)"]
    assert len(maps) == len(SUBSTRATES)
    for axes in maps:
        assert axes.collections[0].norm(HARDNESS / 1e9) == pytest.approx(0.5)


def test_scale_of_forces_holds_every_contact():
    data = elastic()
    axes = fig_elastic.draw(data).axes
    forces = next(one for one in axes if one.get_ylabel().startswith("elastic / rigid"))
    drawn = np.concatenate([line.get_ydata() for line in forces.lines if line.get_marker() == "o"])
    ratio = data["elastic_pull_off_force"] / data["rigid_pull_off_force"]
    assert np.sort(drawn) == pytest.approx(np.sort(100 * (ratio.values.ravel() - 1)))
    low, high = forces.get_ylim()
    assert low < drawn.min() and drawn.max() <= high < 1


def test_figure_with_missing_scans():
    data = elastic()
    for name in [name for name, values in data.items() if "contact" in values.dims]:
        data[name][1, 2] = np.nan
    fig_elastic.draw(data).draw_without_rendering()
    shares = select(fig_elastic.table(data), surface="uncd", quantity="hard_share")
    assert len(shares) == (SCANS - 1) * CONTACTS and set(shares["scan"]) == {1, 2}
