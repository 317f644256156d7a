"""Classical models: the table repeats the dataset; models without a force are drawn as such."""

import numpy as np
from figure_inputs.classical import CLASSICAL_MODELS, classical
from figure_inputs.published_tables import published_constants
from figure_rows import select

from hardcontact.figures import fig_classical


def test_table_holds_the_numbers_of_the_dataset():
    data = classical()
    rows = fig_classical.table(data, published_constants())
    assert set(rows["origin"]) == {"computed", "published"}
    assert set(rows["quantity"]) == set(fig_classical.QUANTITIES)
    chosen = select(rows, quantity="pull_off_force", metrics="afm", surface="mcd")
    expected = data["pull_off_force"].sel(metrics="afm", surface="mcd")
    assert list(chosen["model"]) == CLASSICAL_MODELS
    assert list(chosen["value"]) == expected.values.tolist()
    assert np.allclose(chosen["high"], 1.1 * expected)
    assert set(chosen["label"]) == {"MCD"} and set(chosen["unit"]) == {"N"}
    assert set(chosen["model_verified"]) == {"unverified"}
    curve = select(rows, quantity="transition_coefficient", transition="fit")
    assert list(curve["x"]) == data["tabor_axis"].values.tolist()
    assert curve["low"].isna().all()
    assert select(rows, quantity="printed_tabor_parameter")["value"].item() == 0.81


def test_vanishing_forces_are_drawn_in_the_strip_below():
    data = classical()
    forces = fig_classical.draw(data, published_constants()).axes[0]
    bottom = forces.get_ylim()[0]
    place = 2 + CLASSICAL_MODELS.index("fuller")
    points = [
        line.get_ydata()[0]
        for line in forces.lines
        if len(line.get_xdata()) == 1 and abs(line.get_xdata()[0] - place) < 0.45
    ]
    assert len(points) == 2 * data.sizes["surface"]
    assert all(bottom < point < 3 * bottom for point in points)


def test_figure_with_a_surface_that_the_paper_does_not_know():
    data = classical().isel(surface=[1, 2]).assign_coords(surface=["glass", "steel"])
    numbers = [name for name in data if "surface" in data[name].dims and data[name].dtype == float]
    data = data.assign(data[numbers].where(data["surface"] == "glass"))
    fig_classical.draw(data, published_constants()).draw_without_rendering()
