"""Sentences on the size of scans: numbers are those of the dataset."""

import numpy as np
from figure_inputs.scan_size import scan_size
from refusals import assert_says

from hardcontact.answer.scan_size_sentences import scan_size_sentences


def test_factors_sizes_rule_and_error_are_those_of_the_dataset():
    data = scan_size()
    data["excess"].loc[{"surface": "ncd", "scan_size": 2500.0, "rho": 5.6}] = 2.1
    data["size_needed"].loc[{"surface": "mcd", "rho": 5.6}] = 11.2e3
    excess, needed, rule, error = scan_size_sentences(data)
    assert_says(excess, "scans of 2.5 µm", "surfaces of 20 µm", "NCD 2.1 [", "range of 5.6 nm")
    assert_says(needed, "by 10 %", "MCD 11 µm")
    assert_says(rule, "0.25 times the product of", "(draw size / scan size)^1.3", "^-0.4")
    assert_says(error, "from 1.5 to 1.1 on random surfaces", "2 to 1.2 on the surfaces")


def test_a_rule_that_does_not_help_is_shown():
    data = scan_size()
    data["error"].loc[{"tested": "surfaces", "kind": "corrected"}] = np.log(3)
    assert "2 to 3 on the surfaces" in scan_size_sentences(data)[-1]
