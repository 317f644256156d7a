"""Intervals by sets, and verdicts that other sets would change."""

from math import nan

import numpy as np
import pytest
from scipy.stats import binom

from hardcontact.claims.verdicts import REDRAWS, sets_interval, stability, stretched
from hardcontact.numbers.random import generator

CONFIDENCE = 0.95


def above_five(value, low, high):
    """Judge the statement that a number is above five."""
    return "reproduced" if low > 5 else "undecided" if high > 5 else "not reproduced"


def holds(numbers, given, judge=above_five):
    return stability(judge, given, np.array(numbers, float), CONFIDENCE, generator(1, "test"))


def test_the_interval_leaves_the_tails_out():
    replicas = np.arange(201.0)
    np.testing.assert_allclose(sets_interval(replicas, CONFIDENCE), [5, 195])
    np.testing.assert_allclose(
        sets_interval(np.stack([replicas, replicas + 1], 1), 0.95)[1], [6, 196]
    )


def test_too_few_numbers_make_no_interval():
    numbers = np.append(np.arange(18.0), [nan, nan])
    assert np.isnan(sets_interval(numbers, CONFIDENCE)).all()
    assert np.isfinite(sets_interval(numbers, 0.9)).all()


@pytest.mark.parametrize(
    ("ends", "value", "expected"),
    [((1, 2), 1.5, (1, 2)), ((1, 2), 3, (1, 3)), ((1, 2), 0, (0, 2)), ((1, 2), nan, (1, 2))],
)
def test_an_interval_holds_its_number(ends, value, expected):
    assert stretched(ends, value) == expected


def test_no_interval_stays_none():
    assert np.isnan(stretched((nan, nan), 1.0)).all()


def test_a_verdict_far_from_its_limit_always_stays():
    assert holds(np.linspace(6, 7, 100), "reproduced") == 1
    assert holds(np.linspace(3, 4, 100), "not reproduced") == 1


def test_a_verdict_at_its_limit_stays_as_often_as_binomial_statistics_say():
    """Two of a hundred sets disagree: at three, the interval of 95 % would reach them.

    The low end lies between the third and the fourth number, so the verdict stays while the third
    number agrees, and while the set that is taken as the study's own does.
    """
    numbers = [4.0, 4.0] + [6.0] * 98
    expected = binom.cdf(2, 100, 0.02) * 0.98
    error = np.sqrt(expected * (1 - expected) / REDRAWS)
    assert holds(numbers, "reproduced") == pytest.approx(expected, abs=4 * error)


def test_sets_without_a_number_enter_the_redraws():
    numbers = [6.0] * 95 + [nan] * 5
    judge = lambda value, low, high: "interval" if np.isfinite(low) else "none"  # noqa: E731
    expected = binom.cdf(5, 100, 0.05)
    assert holds(numbers, "interval", judge) == pytest.approx(expected, abs=0.1)


def test_the_same_numbers_whenever_they_are_drawn():
    numbers = [4.0] * 3 + [6.0] * 97
    assert holds(numbers, "undecided") == holds(numbers, "undecided")
