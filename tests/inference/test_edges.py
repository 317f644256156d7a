"""Edges of curves that leave their tolerance at a known cutoff, or nowhere."""

import numpy as np
import pytest
import xarray as xr
from measurements import UNCD

import hardcontact as hc
from hardcontact.base.arrays import generator
from hardcontact.inference.edges import CUTOFF, edge_intervals, find_edges, find_ripples
from hardcontact.surfaces.synthesis import random_surface

CUTOFFS = np.array([10.0, 100.0, 1000.0])
LIMITS = (np.log(0.9), np.log(1.1))


def make_curve(side, cutoffs, values):
    """Return the curve of values (cutoff,) of a side."""
    return xr.DataArray(values, {CUTOFF: cutoffs, "side": side}, [CUTOFF])


def edge_of_ratios(side, cutoffs, *ratio_and_ends):
    """Return the edge of force ratios, and its interval from the ends of their intervals."""
    curve, low, high = (make_curve(side, cutoffs, np.log(ratio)) for ratio in ratio_and_ends)
    return find_edges(curve, LIMITS)["edge"].item(), edge_intervals(curve, low, high, LIMITS)


def test_an_edge_is_interpolated_in_log_wavelength():
    def edge(*values, spectrum_end=np.nan):
        curve = make_curve("short", [1.0, 10.0, 100.0], np.array(values))
        return find_edges(curve, (-0.1, 0.1), spectrum_end)["edge"].item()

    assert edge(0, 0.05, 0.15) == pytest.approx(10**1.5)
    assert edge(0, -0.05, -0.15) == pytest.approx(10**1.5)
    assert edge(0, 0.1, 0.3) == pytest.approx(10.0)
    # never outside the limits, or always
    assert np.isnan([edge(0, 0.05, 0.1), edge(0.2, 0.3, 0.4)]).all()
    assert edge(0.2, 0.3, 0.4, spectrum_end=0.1) == pytest.approx(10**-0.5)
    # A cutoff that the curve does not have changes nothing.
    assert edge(0, np.nan, 0.2) == pytest.approx(10.0)
    # From -0.1 to 0.2 through zero: two thirds of the decade, not none of it.
    assert edge(0, -0.1, 0.2) == pytest.approx(10 ** (1 + 2 / 3))


@pytest.mark.parametrize(
    ("side", "changes", "edge", "status", "bound"),
    [
        ("short", [0.00, 0.05, 0.15], np.sqrt(20 * 40), "found", np.nan),
        ("long", [0.15, 0.05, 0.00], np.sqrt(20 * 10), "found", np.nan),
        ("short", [0.15, 0.05, 0.00], np.nan, "open_below", 10),
        ("short", [0.00, 0.05, 0.05], np.nan, "open_above", 40),
        ("long", [0.00, 0.05, 0.15], np.nan, "open_above", 40),
        ("long", [0.05, 0.05, 0.00], np.nan, "open_below", 10),
    ],
)
def test_an_edge_is_found_or_open_as_find_edges_says(side, changes, edge, status, bound):
    edges = find_edges(make_curve(side, np.array([10.0, 20, 40]), changes), (-0.1, 0.1))
    np.testing.assert_allclose([edges["edge"], edges["edge_bound"]], [edge, bound])
    assert edges["edge_status"] == status


def test_the_edge_of_a_ratio_that_crosses_one_is_where_it_leaves_the_tolerance():
    # The known curve is (3 µm / cutoff)^0.16: 1 at 3 µm, 0.91 and 1.12 at the cutoffs around it.
    cutoffs = np.array([20e3, 5380.0, 1450.0, 389.0])
    ratio = (3e3 / cutoffs) ** 0.16
    ratio[0] = 0.95  # flat again where no roughness remains to be removed
    edge, interval = edge_of_ratios("long", cutoffs, ratio, 0.99 * ratio, 1.01 * ratio)
    log_ratio = np.log(ratio[1:3])
    share = (np.log(1.1) - log_ratio[0]) / (log_ratio[1] - log_ratio[0])
    assert edge == pytest.approx(5380 * (1450 / 5380) ** share)
    # The ratio reaches 1.1 at 1.65 µm; a line between both |ratio - 1| would reach 0.1 at 3.6 µm.
    assert edge == pytest.approx(3e3 / 1.1 ** (1 / 0.16), rel=1e-9)
    np.testing.assert_allclose(interval, [1450, 5380])


def test_a_curve_that_begins_outside_its_limits_has_neither_edge_nor_interval():
    ratio = np.array([1.3, 1.5, 2.0])
    edge, interval = edge_of_ratios("long", CUTOFFS[::-1], ratio, 0.9 * ratio, 1.1 * ratio)
    assert np.isnan([edge, *interval]).all()


@pytest.mark.parametrize("spread", [0.02, 0.3])
def test_the_interval_contains_the_edge_of_a_curve_that_is_not_straight(spread):
    rng = np.random.default_rng(5)
    for _ in range(50):
        true_edge = 10 ** rng.uniform(1.3, 3.4)
        exponent = rng.uniform(0.5, 6)
        cutoffs = 10.0 ** np.arange(1, 4.5, 0.6)
        ratio = 1 + 0.1 * (cutoffs / true_edge) ** exponent
        _, (low, high) = edge_of_ratios(
            "short", cutoffs, ratio, ratio * np.exp(-spread), ratio * np.exp(spread)
        )
        assert not low > true_edge and not high < true_edge  # An end may be NaN.


@pytest.mark.parametrize(
    ("side", "ratio", "ripples"),
    [
        ("short", [1.05, 0.8, 2.0], True),
        ("short", [0.95, 1.2, 0.5], False),
        ("short", [0.95, 1.05, 0.97], False),
        ("long", [1.05, 0.8, 2.0], False),
    ],
)
def test_a_force_that_falls_without_short_waves_shows_ripples(side, ratio, ripples):
    cutoffs = CUTOFFS if side == "short" else CUTOFFS[::-1]
    assert find_ripples(make_curve(side, cutoffs, np.log(ratio)), LIMITS) == ripples


def test_pillars_have_no_short_edge_and_a_gaussian_surface_has_one():
    random = random_surface(generator(4), 64, 5.0, UNCD)
    pillars = np.kron(generator(5).random((8, 8)) > 0.5, np.full((8, 8), 20.0))
    statuses = [
        hc.force_ratios(
            hc.HeightMap(heights, 5.0), {"short": [20, 40, 80]}, radius=5e3, preload=1e-6,
            hardness=25e9, rho=5.6, window=640, contacts_per_row=4,
        ).edge_status.item()
        for heights in (random.heights, pillars)
    ]  # fmt: skip
    assert statuses == ["found", "ripples"]
