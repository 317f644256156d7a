"""The rules that turn a number and its interval into a verdict."""

from math import nan

import numpy as np
import pytest

from hardcontact.paper.claims.verdicts import accepted_range

NONE = (np.nan, np.nan)
#: The number, its interval and the verdict, for limits of 4 and 6.
TWO_SIDED = [
    (5.0, (4.5, 5.5), "reproduced"),
    (5.0, (4.0, 6.0), "reproduced"),
    (5.0, (5.0, 5.0), "reproduced"),
    (5.0, NONE, "agrees"),
    (5.0, (1.0, 9.0), "undecided"),
    (5.0, (4.5, 6.1), "undecided"),
    (7.0, (5.9, 8.0), "undecided"),
    (7.0, (1.0, 8.0), "undecided"),
    (7.0, (6.5, 8.0), "not reproduced"),
    (3.0, (2.0, 3.5), "not reproduced"),
    (7.0, (7.0, 7.0), "not reproduced"),
    (7.0, NONE, "not reproduced"),
    (np.nan, (4.5, 5.5), "undecided"),
    (np.nan, NONE, "undecided"),
]


@pytest.mark.parametrize("rule", ["interval", "factor 1"])
@pytest.mark.parametrize(("number", "ends", "judgement"), TWO_SIDED)
def test_a_number_is_judged_by_two_limits(rule, number, ends, judgement):
    assert accepted_range(rule, 4.0, 6.0).verdict(number, *ends) == judgement


@pytest.mark.parametrize(("number", "ends", "judgement"), TWO_SIDED)
def test_one_limit_is_judged_like_two_with_one_far_away(number, ends, judgement):
    def verdict(rule, low, high):
        return accepted_range(rule, low, high).verdict(number, *ends)

    assert verdict("below", nan, 6.0) == verdict("interval", -99.0, np.nextafter(6.0, 0))
    lower_verdict = verdict("above", 4.0, nan)
    assert lower_verdict == verdict("interval", np.nextafter(4.0, 9), 99.0)
    assert verdict("order", 4.0, nan) == lower_verdict


def test_limits_are_accepted_by_intervals_only():
    for rule, accepted in (("interval", True), ("below", False), ("above", False)):
        assert accepted_range(rule, 5.0, 5.0).accepts([5.0, nan]).tolist() == [accepted, False]


def test_a_factor_widens_both_limits():
    accepted = accepted_range("factor 2", 4.0, 6.0).accepts([1.9, 2.0, 12.0, 12.1])
    assert accepted.tolist() == [False, True, True, False]


@pytest.mark.parametrize("rule", ["close", "factor", "factor x", "interval 2", "", "below"])
def test_an_unknown_rule_or_one_without_its_limit_is_refused(rule):
    with pytest.raises(ValueError):
        accepted_range(rule, 1.0, np.nan)


@pytest.mark.parametrize(
    ("samples", "verdict"),
    [
        (np.linspace(4.2, 5.8, 101), "reproduced"),
        (np.linspace(1.0, 9.0, 101), "undecided"),  # few samples agree, and the interval has all
        (np.linspace(6.1, 9.0, 101), "not reproduced"),
        (np.linspace(3.9, 5.8, 101), "undecided"),
    ],
)
def test_samples_of_one_number_are_judged_with_its_interval(samples, verdict):
    low, high = np.percentile(samples, [2.5, 97.5])
    assert accepted_range("interval", 4.0, 6.0).verdict_of_posterior(samples, low, high) == verdict
