"""The closed form: forces, errors and freezing as they are in the dataset."""

import numpy as np
import pytest
from figure_inputs.closed_form import closed_form
from figure_rows import select

from hardcontact.figures import fig_closed_form


def test_table_holds_the_dataset():
    data, rows = closed_form(), fig_closed_form.table(closed_form())
    at = {"surface": "mcd", "rho": 5.6, "map_size": 20000.0}
    drawn = select(rows, quantity="computed_force", **at)[["value", "low", "high"]].values[0]
    force = data.computed_force.sel(at).item()
    assert drawn == pytest.approx([force, 0.8 * force, 1.2 * force])
    for name in ("predicted_force", "error"):
        value = select(rows, quantity=name, source="contacts", **at)["value"].item()
        assert value == data[name].sel({**at, "source": "contacts"}).item()
    assert select(rows, quantity="edge_large", surface="mcd")["value"].item() == 3000
    assert rows["unit"].notna().all() and not rows.duplicated().any()
    assert set(rows["origin"]) == {"computed"} and set(rows["basis"]) == {"substitute"}


def test_figure_shows_the_largest_maps():
    figure = fig_closed_form.draw(closed_form())
    assert "on maps of 20 µm" in figure.axes[0].get_title(loc="left")
    expected = closed_form().predicted_force.sel(
        surface="uncd", map_size=20000.0, source="spectrum"
    )
    drawn = [np.asarray(line.get_ydata(), float) for line in figure.axes[0].lines]
    assert any(np.allclose(line, expected * 1e6) for line in drawn if len(line) == 3)
