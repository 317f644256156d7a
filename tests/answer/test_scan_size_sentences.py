"""Sentences on the size of scans: numbers are those of the dataset."""

import numpy as np
from figure_inputs.scan_size import scan_size
from refusals import assert_says

from hardcontact.answer.scan_size_sentences import scan_size_sentences


def test_factors_sizes_rule_and_error_are_those_of_the_dataset():
    data = scan_size()
    data["excess"].loc[{"surface": "ncd", "scan_size": 2500.0, "rho": 5.6}] = 2.1
    data["size_needed"].loc[{"surface": "mcd", "rho": 5.6}] = 11.2e3
    excess, *_, needed, rule, error = scan_size_sentences(data)
    assert_says(excess, "scans of 2.5 µm", "surfaces of 20 µm", "NCD 2.1 [", "range of 5.6 nm")
    assert_says(needed, "by 10 %", "MCD 11 µm")
    assert_says(rule, "0.25 times the product of", "(draw size / scan size)^1.3", "^-0.4")
    assert_says(error, "from 1.5 to 1.1 on random surfaces", "2 to 1.2 on the surfaces")


def test_a_rule_that_does_not_help_is_shown():
    data = scan_size()
    data["error"].loc[{"tested": "surfaces", "kind": "corrected"}] = np.log(3)
    assert "2 to 3 on the surfaces" in scan_size_sentences(data)[-1]


def test_long_edges_from_scans_stand_beside_those_of_whole_surfaces():
    _, edges, first, *others = scan_size_sentences(scan_size())[:-3]
    assert_says(
        edges, "scans of 2.5 µm alone", "surfaces of 40 µm", "UNCD 1060 nm instead of 1090 nm"
    )
    assert_says(first, "mirrored scans of 1.25 µm", "MCD at least 2.4 µm: the scans end here")
    assert_says(others[1], "whole surfaces of 20 µm: polished UNCD 1030 nm")


def test_whole_surfaces_are_said_to_be_too_small_where_an_interval_says_so():
    data = scan_size()
    interval = data["force_over_largest_interval"]
    interval.loc[{"edge_size": 20e3, "bound": "low"}] = 0.9
    interval.loc[{"edge_size": 20e3, "bound": "high"}] = 1.1
    said = scan_size_sentences(data)[-4]
    assert_says(said, "scans of 2.5 µm polished UNCD 1.9 [", "all intervals hold 1", "up to 10 %")
    interval.loc[{"surface": "ncd", "edge_size": 20e3, "bound": "high"}] = 0.95
    assert_says(
        scan_size_sentences(data)[-4],
        "surfaces of 40 µm",
        "surfaces of 20 µm polished",
        "small for NCD.",
    )
