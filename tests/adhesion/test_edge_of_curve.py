"""Edges of curves that leave their tolerance at a known cutoff, or nowhere."""

import numpy as np
import pytest

from hardcontact.adhesion.edge_of_curve import Curve, described_edge

CUTOFFS = np.array([10.0, 100.0, 1000.0])
UNKNOWN = [np.nan] * 3


def edge(side, value, least=UNKNOWN, greatest=UNKNOWN, cell=5000.0):
    """The edge of changes that are given in the order of growing effect."""
    cutoffs = CUTOFFS if side == "small" else CUTOFFS[::-1]
    return described_edge(Curve(side, cell, cutoffs, np.array([value, least, greatest])), 0.1)


def test_an_edge_and_its_interval_are_found_between_cutoffs():
    small = edge("small", [0.05, 0.15, 0.4], [0.0, 0.0, 0.2], [0.08, 0.28, 0.9])
    assert small["edge"] == pytest.approx(10**1.5)
    np.testing.assert_allclose(small["edge_interval"], [10**1.1, 10**2.5])
    assert small["edge_status"] == "found" and np.isnan(small["edge_bound"])
    assert small["interval_status"].tolist() == ["found", "found"]
    assert small["edge_text"] == "32 nm [13, 320]"
    large = edge("large", [0.05, 0.15, 0.4], [0.0, 0.0, 0.2], [0.08, 0.28, 0.9])
    assert large["edge"] == pytest.approx(10**2.5)
    np.testing.assert_allclose(large["edge_interval"], [10**1.5, 10**2.9])


@pytest.mark.parametrize(
    "side, changes, cell, bound, status, text",
    [
        ("small", [0.2, 0.3, 0.4], 5e3, 10, "cutoffs", "at most 10 nm: no shorter cutoff"),
        ("small", [0.0, 0.05, 0.1], 5e3, 1000, "cutoffs", "at least 1 µm: no longer cutoff"),
        ("small", [0.0, 0.05, 0.1], 1e3, 1000, "cell", "at least 1 µm: the scans end here"),
        ("large", [0.2, 0.3, 0.4], 5e3, 1000, "cutoffs", "at least 1 µm: no longer cutoff"),
        ("large", [0.2, 0.3, 0.4], 1200, 1000, "cell", "at least 1 µm: the scans end here"),
        ("large", [0.0, 0.05, 0.1], 5e3, 10, "cutoffs", "at most 10 nm: no shorter cutoff"),
    ],
)
def test_an_edge_beyond_what_was_computed_is_open(side, changes, cell, bound, status, text):
    found = edge(side, changes, cell=cell)
    assert np.isnan(found["edge"]) and found["edge_bound"] == bound
    assert found["edge_status"] == f"beyond the {status}"
    assert found["edge_text"].startswith(text) and found["edge_text"].endswith(", no interval")
    assert found["interval_status"].tolist() == ["open", "open"]


def test_an_open_end_of_an_interval_is_no_number():
    found = edge("large", [0.0, 0.2, 0.3], [0.0, 0.0, 0.2], [0.2, 0.3, 0.4])
    assert found["interval_status"].tolist() == ["found", "open"]
    np.testing.assert_allclose(found["edge_interval"], [10**1.5, np.nan])
    assert found["edge_text"] == "320 nm [32, open]"


def test_an_interval_that_is_open_on_both_sides_is_said_to_be():
    found = edge("small", [0.0, 0.2, 0.3], [0.0, 0.0, 0.0], [0.2, 0.3, 0.4])
    assert found["edge_text"] == "32 nm [open, open]"


def test_an_open_edge_may_have_a_known_end():
    found = edge("large", [0.2, 0.3, 0.4], [0.0, 0.2, 0.2], [0.3, 0.4, 0.5], cell=1e3)
    assert found["edge_text"] == "at least 1 µm: the scans end here [0.32, open]"
    assert np.isnan(found["edge"]) and np.isnan(found["edge_interval"][1])


def test_an_interval_without_width_is_none():
    changes = [0.05, 0.15, 0.4]
    found = edge("small", changes, changes, changes)
    assert np.isnan(found["edge_interval"]).all()
    assert found["edge_text"] == "32 nm, no interval"


def test_numbers_have_the_digits_that_tell_them_apart():
    narrow = edge("small", [0.05, 0.15, 0.4], [0.05, 0.1495, 0.4], [0.05, 0.1505, 0.4])
    assert narrow["edge_text"] == "31.6 nm [31.4, 31.8]"
