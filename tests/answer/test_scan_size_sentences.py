"""Sentences on the size of scans: numbers are those of the dataset."""

import numpy as np
from figure_inputs.scan_size import scan_size
from refusals import assert_says

from hardcontact.answer.scan_size_sentences import scan_size_sentences


def test_factors_sizes_rule_and_error_are_those_of_the_dataset():
    data = scan_size()
    data["excess"].loc[{"surface": "ncd", "scan_size": 2500.0, "rho": 5.6}] = 2.1
    data["size_needed"].loc[{"surface": "mcd", "rho": 5.6}] = 11.2e3
    _, excess, *_, needed, _, rule, error = scan_size_sentences(data)
    assert_says(excess, "scans of 2.5 µm", "surfaces of 20 µm", "NCD 2.1 [", "range of 5.6 nm")
    assert_says(needed, "by 10 %", "MCD 11 µm", "off by a factor of 1.2, more than this")
    assert_says(rule, "0.25 times the product of", "(draw size / scan size)^1.3", "^-0.4")
    assert_says(error, "from 1.5 to 1.1 on random surfaces", "2 to 1.2 on the surfaces")


def test_a_rule_that_does_not_help_is_shown():
    data = scan_size()
    data["error"].loc[{"tested": "surfaces", "kind": "corrected"}] = np.log(3)
    assert "2 to 3 on the surfaces" in scan_size_sentences(data)[-1]


def test_long_edges_from_scans_stand_beside_those_of_whole_surfaces():
    edges, first, *others = scan_size_sentences(scan_size())[2:-3]
    assert_says(
        edges, "scans of 2.5 µm alone", "surfaces of 40 µm", "UNCD 1060 nm instead of 1090 nm"
    )
    assert_says(first, "mirrored scans of 1.25 µm", "MCD at least 2.4 µm [above 1.2 µm]: the")
    assert_says(others[1], "whole surfaces of 20 µm: polished UNCD 1030 nm")


def test_whole_surfaces_are_said_to_be_too_small_where_an_interval_says_so():
    data = scan_size()
    interval = data["force_over_largest_interval"]
    interval.loc[{"edge_size": 20e3, "bound": "low"}] = 0.9
    interval.loc[{"edge_size": 20e3, "bound": "high"}] = 1.1
    said = scan_size_sentences(data)[0]
    assert_says(said, "scans of 2.5 µm polished UNCD 1.95 [", "up to 10 %")
    assert_says(said, "all intervals of whole surfaces of 20 µm hold 1")
    interval.loc[{"surface": "mcd", "edge_size": 20e3}] = np.nan
    assert_says(scan_size_sentences(data)[0], "surfaces of 20 µm are enough is not known of all")
    interval.loc[{"surface": "ncd", "edge_size": 20e3, "bound": "high"}] = 0.95
    assert_says(
        scan_size_sentences(data)[0],
        "surfaces of 40 µm",
        "surfaces of 20 µm polished",
        "whole surfaces of 20 µm are too small for NCD.",
    )


def test_a_force_is_larger_only_where_its_interval_lies_above_one():
    data = scan_size()
    at_scan = {"edge_size": 2500.0, "bound": "low"}
    data["force_over_largest_interval"].loc[at_scan] = [0.9, 1.1, 1.1, 1.1]
    assert "larger on UNCD, NCD and MCD, not decided on polished" in scan_size_sentences(data)[0]
    data["excess_interval"].loc[{"scan_size": 2500.0, "bound": "high"}] = 0.9
    data["excess_interval"].loc[{"scan_size": 2500.0, "bound": "low"}] = 0.8
    assert "; smaller on polished UNCD, UNCD, NCD and MCD." in scan_size_sentences(data)[1]


def test_intervals_on_windows_refute_sizes_of_the_rule():
    data = scan_size()
    interval = data["force_over_largest_interval"]
    interval.loc[{"bound": "low"}], interval.loc[{"bound": "high"}] = 0.9, 2.0
    assert not any("windows alone ask" in one for one in scan_size_sentences(data))
    interval.loc[{"surface": "ncd", "edge_size": 1250.0, "bound": "low"}] = 1.2
    interval.loc[{"surface": "ncd", "edge_size": 5000.0, "bound": "high"}] = 1.05
    for needed, follows in ((4e3, "."), (6e3, ", against the rule on NCD.")):
        data["size_needed"].loc[{"surface": "ncd", "rho": 5.6}] = needed
        (said,) = (one for one in scan_size_sentences(data) if "windows alone ask" in one)
        assert said.endswith(f"for: NCD more than 1.25 µm and at most 5 µm{follows}")


def test_a_trend_with_the_range_against_the_rule_is_said():
    data = scan_size()
    assert not any("the other way" in one for one in scan_size_sentences(data))
    data["predicted_excess"].loc[{"surface": "mcd", "scan_size": 1250.0}] = [3.0, 2.0]
    (said,) = (one for one in scan_size_sentences(data) if "the other way" in one)
    assert_says(said, "scans of 1.25 µm", "from 1.4 nm to 5.6 nm", "way: MCD 2.8 [")
    assert said.endswith("by the rule 3 to 2.")
