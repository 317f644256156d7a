"""Edges of curves that leave their tolerance at a known cutoff, or nowhere."""

import numpy as np
import pytest

from hardcontact.band.critical_band import RatioCurve, describe_edge

CUTOFFS = np.array([10.0, 100.0, 1000.0])
UNKNOWN = [np.nan] * 3


def edge(side, value, lowest=UNKNOWN, highest=UNKNOWN, cell=5000.0):
    """The edge of a curve of changes, in the order of growing effect."""
    cutoffs = CUTOFFS if side == "small" else CUTOFFS[::-1]
    values = np.array([value, lowest, highest])
    return describe_edge(RatioCurve(side, cell, cutoffs, values, (-np.inf, 0.1)))


def edge_of_ratios(side, cutoffs, ratio, low, high):
    """The edge of one surface, whose ratios have a sign."""
    limits = (np.log(0.9), np.log(1.1))
    return describe_edge(RatioCurve(side, 1e6, cutoffs, np.log([ratio, low, high]), limits))


def test_the_edge_of_a_ratio_that_crosses_one_is_where_it_leaves_the_tolerance():
    # The known curve is (3 µm / cutoff)^0.16: 1 at 3 µm, 0.91 and 1.12 at the cutoffs around it.
    cutoffs = np.array([20e3, 5380.0, 1450.0, 389.0])
    ratio = (3e3 / cutoffs) ** 0.16
    ratio[0] = 0.95  # flat again where no roughness remains to be removed
    result = edge_of_ratios("large", cutoffs, ratio, 0.99 * ratio, 1.01 * ratio)
    log_ratio = np.log(ratio[1:3])
    share = (np.log(1.1) - log_ratio[0]) / (log_ratio[1] - log_ratio[0])
    assert result["edge"] == pytest.approx(5380 * (1450 / 5380) ** share)
    # The ratio reaches 1.1 at 1.65 µm; a line between both |ratio - 1| would reach 0.1 at 3.6 µm.
    assert result["edge"] == pytest.approx(3e3 / 1.1 ** (1 / 0.16), rel=1e-9)
    np.testing.assert_allclose(result["edge_interval"], [1450, 5380])


@pytest.mark.parametrize("spread", [0.02, 0.3])
def test_the_bracket_holds_the_edge_of_a_curve_that_is_not_straight(spread):
    rng = np.random.default_rng(5)
    for _ in range(50):
        true_edge = 10 ** rng.uniform(1.3, 3.4)
        power = rng.uniform(0.5, 6)
        cutoffs = 10.0 ** np.arange(1, 4.5, 0.6)
        ratio = 1 + 0.1 * (cutoffs / true_edge) ** power
        result = edge_of_ratios(
            "small", cutoffs, ratio, ratio * np.exp(-spread), ratio * np.exp(spread)
        )
        low, high = result["edge_interval"]
        assert not low > true_edge and not high < true_edge


def test_an_edge_and_its_interval_are_found_between_cutoffs():
    small = edge("small", [0.05, 0.15, 0.4], [0.0, 0.0, 0.2], [0.08, 0.28, 0.9])
    assert small["edge"] == pytest.approx(10**1.5)
    np.testing.assert_allclose(small["edge_interval"], [10, 1000])
    assert small["edge_status"] == "found" and np.isnan(small["edge_bound"])
    assert small["edge_interval_status"].tolist() == ["found", "found"]
    large = edge("large", [0.05, 0.15, 0.4], [0.0, 0.0, 0.2], [0.08, 0.28, 0.9])
    assert large["edge"] == pytest.approx(10**2.5)
    np.testing.assert_allclose(large["edge_interval"], [10, 1000])


@pytest.mark.parametrize(
    "side, changes, cell, bound, status, is_lower_bound",
    [
        ("small", [0.2, 0.3, 0.4], 5e3, 10, "cutoffs", 0),
        ("small", [0.0, 0.05, 0.1], 5e3, 1000, "cutoffs", 1),
        ("small", [0.0, 0.05, 0.1], 1e3, 1000, "cell", 1),
        ("large", [0.2, 0.3, 0.4], 5e3, 1000, "cutoffs", 1),
        ("large", [0.2, 0.3, 0.4], 1200, 1000, "cell", 1),
        ("large", [0.0, 0.05, 0.1], 5e3, 10, "cutoffs", 0),
    ],
)
def test_an_edge_beyond_the_cutoffs_is_open(side, changes, cell, bound, status, is_lower_bound):
    result = edge(side, changes, cell=cell)
    assert np.isnan(result["edge"]) and result["edge_bound"] == bound
    assert result["edge_status"] == f"beyond the {status}"
    assert result["edge_bound_is_lower"] == is_lower_bound
    assert result["edge_interval_status"].tolist() == ["open", "open"]


def test_an_open_edge_may_have_one_end_of_its_interval():
    result = edge("large", [0.2, 0.3, 0.4], [0.0, 0.2, 0.2], [0.3, 0.4, 0.5], cell=1e3)
    assert result["edge_bound"] == 1000 and np.isnan(result["edge"])
    np.testing.assert_allclose(result["edge_interval"], [100, np.nan])


def test_an_interval_open_on_both_sides_is_left_out():
    result = edge("small", [0.2, 0.3, 0.4], [0.15, 0.2, 0.3], [0.3, 0.4, 0.5])
    assert result["edge_bound"] == 10 and np.isnan(result["edge_interval"]).all()


def test_an_exact_curve_has_its_edge_between_two_cutoffs():
    changes = [0.05, 0.15, 0.4]
    assert edge("small", changes, changes, changes)["edge_interval"].tolist() == [10, 100]
