"""Force maps: the maps drawn, distributions, errors of means, what a mean needs."""

import numpy as np
import pytest
from figure_inputs.maps import maps
from figure_rows import select

from hardcontact.figures import fig_maps
from hardcontact.numbers.statistics import bounds


def titled(figure, letter):
    start = rf"$\mathbf{{{letter}}}$"
    return next(axes for axes in figure.axes if axes.get_title(loc="left").startswith(start))


def test_table_holds_what_is_needed_with_intervals():
    data, rows = maps(), fig_maps.table(maps())
    at = {"surface": "ncd", "rho": 2.0}
    low, high = bounds(data, "contacts_needed")
    for sampling in ("random", "array"):
        row = select(rows, quantity="contacts_needed", sample=sampling, **at)
        expected = [float(one.sel({**at, "sampling": sampling})) for one in (low, high)]
        assert list(row[["low", "high"]].values[0]) == pytest.approx(expected, nan_ok=True)
    scans = select(rows, quantity="scans_needed", **at)["value"].item()
    assert scans == pytest.approx(float(data["scans_needed"].sel(at)))


def test_errors_are_those_that_means_keep_with_confidence():
    data, rows = maps(), select(fig_maps.table(maps()), quantity="relative_error", surface="mcd")
    assert data.attrs["normal_quantile"] == pytest.approx(1.645, abs=1e-3)
    spread = float(data["variation"].sel(surface="mcd", rho=5.6))
    random = select(rows, sample="random", contacts=16)["value"].item()
    assert random == pytest.approx(1.645 * spread / 4, rel=1e-3)
    array = select(rows, sample="array", contacts=16)["value"].item()
    computed = float(data["array_error"].sel(surface="mcd", rho=5.6, contacts=16))
    assert array == pytest.approx(1.645 * computed, rel=1e-3)


def test_mean_of_the_map_is_relative_to_a_smooth_sphere():
    row = select(fig_maps.table(maps()), quantity="mean_over_smooth_sphere", surface="uncd")
    force = maps()["pull_off_force"].sel(surface="uncd").values.mean(dtype=float)
    assert row["value"].item() == pytest.approx(force / (2 * np.pi * 250e-6))


def test_drawn_maps_are_heights_and_forces_over_their_mean():
    figure, data = fig_maps.draw(maps()), maps()
    heights = titled(figure, "a_2").images[0].get_array()
    np.testing.assert_allclose(
        heights - heights.mean(),
        data["heights"][1] - data["heights"][1].mean(),
        atol=1e-4,
    )
    forces = titled(figure, "b_2").images[0].get_array()
    np.testing.assert_allclose(forces, data["pull_off_force"][1] / forces_mean(data), rtol=1e-5)
    assert forces.mean() == pytest.approx(1, rel=1e-5)


def forces_mean(data):
    return data["pull_off_force"][1].values.mean(dtype=float)


def test_figure_without_intervals():
    data = maps()
    for name in ("scans_needed", "between_scans"):
        data[name][:] = np.nan
        data[f"{name}_interval"][:] = np.nan
    data["contacts_needed"].loc[{"sampling": "array"}] = np.nan
    fig_maps.draw(data).draw_without_rendering()
