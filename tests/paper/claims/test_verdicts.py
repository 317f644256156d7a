"""The rules that turn a number and its interval into a verdict."""

from math import nan

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from refusals import assert_says, refusal
from scipy.stats import binomtest

from hardcontact.paper.claims.verdicts import (
    VERDICTS,
    accepted_numbers,
    count_verdicts,
    find_open_end,
    read_judged_claims,
)

NO_INTERVAL = (nan, nan)
#: The number, its interval and the verdict, for limits of 4 and 6.
TWO_SIDED = [
    (5.0, (4.5, 5.5), "reproduced"),
    (5.0, (4.0, 6.0), "reproduced"),
    (5.0, (5.0, 5.0), "reproduced"),
    (5.0, NO_INTERVAL, "agrees"),
    (5.0, (1.0, 9.0), "undecided"),
    (5.0, (4.5, 6.1), "undecided"),
    (7.0, (5.9, 8.0), "undecided"),
    (7.0, (1.0, 8.0), "undecided"),
    (7.0, (6.5, 8.0), "not reproduced"),
    (3.0, (2.0, 3.5), "not reproduced"),
    (7.0, (7.0, 7.0), "not reproduced"),
    (7.0, NO_INTERVAL, "not reproduced"),
    (nan, (4.5, 5.5), "undecided"),
    (nan, NO_INTERVAL, "undecided"),
]


@pytest.mark.parametrize("rule", ["interval", "factor 1"])
@pytest.mark.parametrize(("number", "ends", "judgement"), TWO_SIDED)
def test_a_number_is_judged_by_two_limits(rule, number, ends, judgement):
    assert accepted_numbers(rule, 4.0, 6.0).verdict(number, *ends) == judgement


@pytest.mark.parametrize(("number", "ends", "judgement"), TWO_SIDED)
def test_one_limit_is_judged_like_two_with_one_far_away(number, ends, judgement):
    def verdict(rule, low, high):
        return accepted_numbers(rule, low, high).verdict(number, *ends)

    assert verdict("below", nan, 6.0) == verdict("interval", -99.0, np.nextafter(6.0, 0))
    lower_verdict = verdict("above", 4.0, nan)
    assert lower_verdict == verdict("interval", np.nextafter(4.0, 9), 99.0)
    assert verdict("order", 4.0, nan) == lower_verdict


# If all agree, 72 sets decide, but 71 do not: 0.95^71 > 0.025 > 0.95^72.
@pytest.mark.parametrize("set_count", [71, 72, 100])
def test_sets_decide_if_the_exact_interval_of_their_share_does(set_count):
    accepted = accepted_numbers("above", 0.0, nan)
    for agreeing_count in range(set_count + 1):
        values = np.where(np.arange(set_count) < agreeing_count, 1.0, -1.0)
        share = binomtest(agreeing_count, set_count).proportion_ci(0.95)
        decided = {"reproduced": share.low >= 0.95, "not reproduced": share.high <= 0.05}
        expected = [verdict for verdict, holds in decided.items() if holds] or ["undecided"]
        assert [accepted.verdict_of_sets(values, 0.95)] == expected


def test_a_factor_widens_both_limits():
    is_accepted = accepted_numbers("factor 2", 4.0, 6.0).accepts([1.9, 2.0, 12.0, 12.1])
    assert is_accepted.tolist() == [False, True, True, False]


@pytest.mark.parametrize("rule", ["close", "factor", "factor x", "interval 2", "", "below"])
def test_an_unknown_rule_or_one_without_its_limit_is_refused(rule):
    with pytest.raises(ValueError):
        accepted_numbers(rule, 1.0, nan)


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
    assert (
        accepted_numbers("interval", 4.0, 6.0).verdict_of_posterior(samples, low, high) == verdict
    )


def test_summary_lists_every_verdict_and_counts_independent_statements():
    evaluated = pd.DataFrame(
        {
            "verdict": [*["agrees", "reproduced"] * 2, "by construction"],
            "follows_from": ["", "", "first", "first", ""],
        }
    )
    result = count_verdicts(evaluated).set_index("verdict")
    assert list(result.index) == list(VERDICTS)
    assert result.loc["reproduced"].to_dict() == {"independent": 1, "claims": 2}
    assert result.loc["agrees"].to_dict() == {"independent": 1, "claims": 2}
    assert result.loc["by construction"].to_dict() == {"independent": 0, "claims": 1}
    assert result.sum().to_dict() == {"independent": 2, "claims": 5}


def test_a_truncated_table_is_refused(tmp_path):
    path = tmp_path / "claims.csv"
    path.write_text("id,verdict,follows_from,note\nfirst,reproduced,,\n")
    claims = read_judged_claims(path)
    assert claims["verdict"].tolist() == ["reproduced"]
    assert claims[["follows_from", "note"]].values.tolist() == [["", ""]]
    path.write_text("id,verdict,follows_from,note\nfirst,reprod")
    assert_says(refusal(read_judged_claims, path), str(path), "complete table", "a part")


def test_claims_without_verdicts_are_counted_as_none(tmp_path):
    path = tmp_path / "claims.csv"
    path.write_text("id,agreeing_share,verdict,follows_from,note\nfirst,,,,\n")
    assert count_verdicts(read_judged_claims(path))["claims"].sum() == 0


def band(cutoffs):
    """Return the changes at cutoffs (nm) of both sides; cutoffs below 300 nm are short."""
    change = np.where([np.array(cutoffs) < 300, np.array(cutoffs) > 300], 0.5, nan)
    dims = ("side", "group", "cutoff_wavelength")
    return xr.Dataset(
        {"filtered_force_change": (dims, change[:, None])},
        {"side": ["short", "long"], "group": ["mcd"], "cutoff_wavelength": cutoffs},
    )


#: Bands of a study and its sets: short cutoffs end at 250 and 120 nm, long cutoffs at 500 nm.
BANDS = [band([20, 43, 120, 250, 500, 1800, 3500]), band([43, 120, 500, 1800])]


@pytest.mark.parametrize(
    ("side", "edge", "low", "high", "end"),
    [
        ("short", 60, 40, 119, ""),
        ("short", 60, 40, 120, "high"),  # the last cutoff of the sets
        ("short", 60, 40, 250, "high"),  # of the study
        ("short", 60, 40, 200, ""),
        ("short", 130, 100, 130, "high"),  # stretched to a number beyond the cutoffs of the sets
        ("short", 110, 100, 110, ""),
        ("short", 130, 120, 140, ""),
        ("long", 900, 500, 2000, "low"),
        ("long", 900, 501, 3500, ""),
        ("long", 480, 480, 2000, "low"),
        ("long", 900, nan, nan, ""),
    ],
)
def test_an_end_at_or_beyond_the_last_cutoff_is_open(side, edge, low, high, end):
    assert find_open_end(side, edge, low, high, BANDS) == end
