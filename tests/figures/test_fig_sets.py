"""Many sets: places of the fits, rank correlations with facts, shares of the sets."""

import numpy as np
import pytest
import xarray as xr
from figure_inputs.adhesion import inference
from figure_inputs.published_tables import published_constants
from figure_inputs.sets import SETS, sets
from figure_rows import select
from scipy import stats

from hardcontact.figures import fig_sets

PLASTIC = {"contact_model": "plastic"}


def table(data=None):
    return fig_sets.table(sets() if data is None else data, inference(), published_constants())


def draw(data):
    figure = fig_sets.draw(data, inference(), published_constants())
    figure.draw_without_rendering()
    return figure


def following(values, ranges):
    """A dataset of one surface whose slope takes the values, and ranges of adhesion."""
    same = np.ones((len(values), 1))
    facts = {name: (("set", "surface"), same) for name in fig_sets.FACTS}
    facts["rms_gradient"] = ("set", "surface"), np.reshape(values, (-1, 1))
    return xr.Dataset(facts, {"surface": ["uncd"]}).assign(range_of_adhesion=("set", ranges))


def test_every_best_range_is_in_the_histogram():
    rows = table()
    for model in ("plastic", "rigid"):
        shares = select(rows, quantity="share_of_sets", contact_model=model)
        assert shares["value"].sum() == pytest.approx(1)
        best = sets()["range_of_adhesion"].sel(contact_model=model)
        within = (shares["range_low"] >= 5) & (shares["range_high"] <= 20)
        low, high = shares[within]["range_low"].min(), shares[within]["range_high"].max()
        expected = ((best >= low) & (best < high)).mean().item()
        assert shares[within]["value"].sum() == pytest.approx(expected)


def test_table_holds_the_fits_of_every_set():
    data, rows = sets(), table()
    assert len(select(rows, quantity="range_of_adhesion", origin="computed")) == SETS
    minima = select(rows, quantity="minimum_work")
    assert len(minima) == data["minimum_work"].sel(PLASTIC).notnull().sum()
    assert len(select(rows, quantity="best_error")) == 2 * SETS
    published = select(rows, quantity="work_of_adhesion", origin="published")
    assert published["value"].item() == 0.0463


@pytest.mark.parametrize(("power", "expected"), [(3, 1), (-2, -1)])
def test_a_fact_that_orders_the_ranges_has_correlation_one(power, expected):
    values = np.linspace(1, 2, 30)
    (row,) = fig_sets._correlations(following(values, values**power)).to_dict("records")
    assert row["quantity"] == "rms_gradient" and row["value"] == pytest.approx(expected)


@pytest.mark.study
def test_interval_holds_the_correlation_of_normal_pairs_as_often_as_it_says():
    rng, correlation, inside = np.random.default_rng(3), 0.5, 0
    expected = 6 / np.pi * np.arcsin(correlation / 2)  # Spearman's of a normal distribution
    for _ in range(400):
        first, second = rng.multivariate_normal([0, 0], [[1, 0.5], [0.5, 1]], 50).T
        row = fig_sets._correlations(following(first + 9, np.exp(second))).iloc[0]
        assert row["value"] == pytest.approx(stats.spearmanr(first, second).statistic)
        inside += row["low"] < expected < row["high"]
    assert 0.92 <= inside / 400 <= 0.98


def test_facts_without_spread_are_left_out():
    rows = select(table(), panel="c")
    assert set(rows["quantity"]) == {
        "rms_gradient", "rms_gradient_std", "rms_half_laplacian", "rms_half_laplacian_std",
    }  # fmt: skip
    strongest = fig_sets._strongest(rows)
    assert abs(strongest["value"]) == rows["value"].abs().max()


def test_figure_of_sets_that_differ_in_no_fact():
    data = sets()
    for name in fig_sets.FACTS:
        data[name] = data[name].isel(set=0).broadcast_like(data[name])
    assert select(table(data), panel="c").empty
    assert not [axes for axes in draw(data).axes if axes.get_label() == "<colorbar>"]


def test_figure_of_a_single_set():
    draw(sets().isel(set=[0]))


def test_figure_says_the_share_in_which_plastic_contact_fits_better():
    data = sets()
    data["best_error"].loc[{"contact_model": "rigid"}] = 0.5
    data["best_error"].loc[{"contact_model": "plastic"}] = np.where(np.arange(SETS) < 70, 0.2, 0.7)
    titles = [axes.get_title(loc="left") for axes in draw(data).axes]
    assert any("plastic better in 70 % of sets" in title for title in titles)
