"""Edges of curves that leave their tolerance at a known cutoff, or nowhere."""

import numpy as np
import pytest

from hardcontact.band.critical_band import Curve, described_edge

CUTOFFS = np.array([10.0, 100.0, 1000.0])
UNKNOWN = [np.nan] * 3


def edge(side, value, least=UNKNOWN, greatest=UNKNOWN, cell=5000.0):
    """The edge of changes that are given in the order of growing effect."""
    cutoffs = CUTOFFS if side == "small" else CUTOFFS[::-1]
    values = np.array([value, least, greatest])
    return described_edge(Curve(side, cell, cutoffs, values, (-np.inf, 0.1)))


def edge_of_ratios(side, cutoffs, ratio, low, high):
    """The edge of one surface, whose ratios have a sign."""
    limits = (np.log(0.9), np.log(1.1))
    return described_edge(Curve(side, 1e6, cutoffs, np.log([ratio, low, high]), limits))


def test_a_ratio_that_passes_through_one_between_cutoffs_leaves_where_it_is_known_to():
    # The known curve is (3 µm / cutoff)^0.16: one at 3 µm, 0.91 and 1.12 at the cutoffs around it.
    cutoffs = np.array([20e3, 5380.0, 1450.0, 389.0])
    ratio = (3e3 / cutoffs) ** 0.16
    ratio[0] = 0.95  # flat again where nothing is left to be removed
    found = edge_of_ratios("large", cutoffs, ratio, 0.99 * ratio, 1.01 * ratio)
    line = np.log(ratio[1:3])
    share = (np.log(1.1) - line[0]) / (line[1] - line[0])
    assert found["edge"] == pytest.approx(5380 * (1450 / 5380) ** share)
    # It reaches 1.1 at 1.65 µm; |ratio - 1| on the line between both would do so at 3.6 µm.
    assert found["edge"] == pytest.approx(3e3 / 1.1 ** (1 / 0.16), rel=1e-9)
    np.testing.assert_allclose(found["edge_interval"], [1450, 5380])


@pytest.mark.parametrize("spread", [0.02, 0.3])
def test_the_bracket_holds_the_edge_of_a_curve_that_is_not_straight(spread):
    rng = np.random.default_rng(5)
    for _ in range(50):
        true, power = 10 ** rng.uniform(1.3, 3.4), rng.uniform(0.5, 6)
        cutoffs = 10.0 ** np.arange(1, 4.5, 0.6)
        ratio = 1 + 0.1 * (cutoffs / true) ** power
        found = edge_of_ratios(
            "small", cutoffs, ratio, ratio * np.exp(-spread), ratio * np.exp(spread)
        )
        low, high = found["edge_interval"]
        assert not low > true and not high < true


def test_an_edge_and_its_interval_are_found_between_cutoffs():
    small = edge("small", [0.05, 0.15, 0.4], [0.0, 0.0, 0.2], [0.08, 0.28, 0.9])
    assert small["edge"] == pytest.approx(10**1.5)
    np.testing.assert_allclose(small["edge_interval"], [10, 1000])
    assert small["edge_status"] == "found" and np.isnan(small["edge_bound"])
    assert small["interval_status"].tolist() == ["found", "found"]
    large = edge("large", [0.05, 0.15, 0.4], [0.0, 0.0, 0.2], [0.08, 0.28, 0.9])
    assert large["edge"] == pytest.approx(10**2.5)
    np.testing.assert_allclose(large["edge_interval"], [10, 1000])


@pytest.mark.parametrize(
    "side, changes, cell, bound, status, at_least",
    [
        ("small", [0.2, 0.3, 0.4], 5e3, 10, "cutoffs", 0),
        ("small", [0.0, 0.05, 0.1], 5e3, 1000, "cutoffs", 1),
        ("small", [0.0, 0.05, 0.1], 1e3, 1000, "cell", 1),
        ("large", [0.2, 0.3, 0.4], 5e3, 1000, "cutoffs", 1),
        ("large", [0.2, 0.3, 0.4], 1200, 1000, "cell", 1),
        ("large", [0.0, 0.05, 0.1], 5e3, 10, "cutoffs", 0),
    ],
)
def test_an_edge_beyond_what_was_computed_is_open(side, changes, cell, bound, status, at_least):
    found = edge(side, changes, cell=cell)
    assert np.isnan(found["edge"]) and found["edge_bound"] == bound
    assert found["edge_status"] == f"beyond the {status}"
    assert found["edge_at_least"] == at_least
    assert found["interval_status"].tolist() == ["open", "open"]


def test_an_open_edge_may_have_a_known_end():
    found = edge("large", [0.2, 0.3, 0.4], [0.0, 0.2, 0.2], [0.3, 0.4, 0.5], cell=1e3)
    assert found["edge_bound"] == 1000 and np.isnan(found["edge"])
    np.testing.assert_allclose(found["edge_interval"], [100, np.nan])


def test_an_open_edge_has_no_interval_that_is_open_on_both_sides():
    found = edge("small", [0.2, 0.3, 0.4], [0.15, 0.2, 0.3], [0.3, 0.4, 0.5])
    assert found["edge_bound"] == 10 and np.isnan(found["edge_interval"]).all()


def test_a_curve_that_is_known_exactly_has_its_edge_between_two_cutoffs():
    changes = [0.05, 0.15, 0.4]
    assert edge("small", changes, changes, changes)["edge_interval"].tolist() == [10, 100]
