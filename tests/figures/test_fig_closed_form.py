"""The closed form: forces, errors and freezing as they are in the dataset."""

import numpy as np
import pytest
import xarray as xr
from figure_rows import select
from matplotlib.text import Text

from hardcontact.figures import fig_closed_form, style
from hardcontact.statistics import with_interval

SHAPE = (2, 2, 3)


def closed_form():
    rng = np.random.default_rng(1)
    force = rng.uniform(1e-7, 1e-5, SHAPE)
    dims = ("surface", "map_size", "rho")
    interval = np.stack([0.8 * force, 1.2 * force], axis=-1)
    predicted = rng.uniform(0.5, 2, (*SHAPE, 2)) * force[..., None]
    newton = {"units": "N"}
    return xr.Dataset(
        with_interval("computed_force", dims, force, interval, newton, 0.95)
        | {
            "predicted_force": ((*dims, "source"), predicted, newton),
            "first_term_force": ((*dims, "source"), predicted / 2, newton),
            "error": ((*dims, "source"), predicted / force[..., None], {"units": "1"}),
            "whole_freezing": (("surface", "rho"), rng.uniform(0.1, 9, (2, 3)), {"units": "1"}),
            "edge": (("surface", "side"), [[40.0, 1500.0], [np.nan, 1800.0]], {"units": "nm"}),
            "label": ("surface", ["UNCD", "MCD"]),
            "basis": ("surface", ["substitute", "substitute"]),
        },
        {
            "surface": ["uncd", "mcd"], "map_size": [5000.0, 20000.0], "rho": [0.5, 5.6, 20.0],
            "source": ["spectrum", "contacts"], "side": ["small", "large"],
        },
    )  # fmt: skip


def test_table_holds_the_dataset():
    data, rows = closed_form(), fig_closed_form.table(closed_form())
    at = {"surface": "mcd", "rho": 5.6, "map_size": 20000.0}
    drawn = select(rows, quantity="computed_force", **at)[["value", "low", "high"]].values[0]
    force = data.computed_force.sel(at).item()
    assert drawn == pytest.approx([force, 0.8 * force, 1.2 * force])
    for name in ("predicted_force", "error"):
        value = select(rows, quantity=name, source="contacts", **at)["value"].item()
        assert value == data[name].sel({**at, "source": "contacts"}).item()
    assert select(rows, quantity="edge_large", surface="mcd")["value"].item() == 1800
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
    (note,) = (text.get_text() for text in figure.texts)
    assert note.startswith("substitute surfaces: UNCD, MCD (")
    figure.draw_without_rendering()
    assert min(text.get_fontsize() for text in figure.findobj(Text)) >= 7 * 0.99
    assert figure.get_size_inches()[0] == style.WIDTH


def test_drawing_leaves_its_input_alone():
    data = closed_form()
    fig_closed_form.draw(data)
    fig_closed_form.table(data)
    assert data.identical(closed_form())
