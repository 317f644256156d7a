"""Rules, verdicts, and the table that holds them."""

import numpy as np
import pandas as pd
import pytest
from refusals import assert_says, refusal

from hardcontact.claims.verdicts import VERDICTS, accepts, read_verdicts, summary, verdict

NONE = (np.nan, np.nan)
#: Interval, the number and its interval, verdict: limits 4 and 6, accepted 4 to 6.
TWO_SIDED = [
    (5.0, (4.5, 5.5), "reproduced"),
    (5.0, (4.0, 6.0), "reproduced"),
    (5.0, (5.0, 5.0), "reproduced"),
    (5.0, NONE, "consistent"),
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
@pytest.mark.parametrize(("computed", "ends", "expected"), TWO_SIDED)
def test_two_limits(rule, computed, ends, expected):
    assert verdict(rule, computed, *ends, 4.0, 6.0) == expected


@pytest.mark.parametrize(("computed", "ends", "expected"), TWO_SIDED)
def test_one_limit_is_judged_as_two_of_which_one_is_far(computed, ends, expected):
    below, above = (
        verdict(rule, computed, *ends, *limits)
        for rule, limits in (("below", (np.nan, 6.0)), ("above", (4.0, np.nan)))
    )
    assert below == verdict("interval", computed, *ends, -99.0, np.nextafter(6.0, 0))
    assert above == verdict("interval", computed, *ends, np.nextafter(4.0, 9), 99.0)
    assert verdict("order", computed, *ends, 4.0, np.nan) == above


def test_a_limit_belongs_to_a_rule_of_two():
    for rule, accepted in (("interval", True), ("below", False), ("above", False)):
        assert accepts(rule, [5.0, np.nan], 5.0, 5.0).tolist() == [accepted, False]


def test_a_factor_widens_both_limits():
    assert accepts("factor 2", [1.9, 2.0, 12.0, 12.1], 4.0, 6.0).tolist() == [0, 1, 1, 0]


@pytest.mark.parametrize("rule", ["close", "factor", "factor x", "interval 2", ""])
def test_unknown_rule(rule):
    with pytest.raises(ValueError):
        verdict(rule, 1.0, 1.0, 1.0, 1.0, 1.0)


def test_rule_needs_its_limit():
    with pytest.raises(ValueError, match="lacks a published limit"):
        verdict("below", 1.0, 1.0, 1.0, 1.0, np.nan)


def test_summary_lists_every_verdict_and_counts_independent_findings():
    evaluated = pd.DataFrame(
        {
            "verdict": [*["consistent", "reproduced"] * 2, "by construction"],
            "follows_from": ["", "", "first", "first", ""],
        }
    )
    result = summary(evaluated).set_index("verdict")
    assert list(result.index) == list(VERDICTS)
    assert result.loc["reproduced"].to_dict() == {"independent": 1, "claims": 2}
    assert result.loc["consistent"].to_dict() == {"independent": 1, "claims": 2}
    assert result.loc["by construction"].to_dict() == {"independent": 0, "claims": 1}
    assert result.sum().to_dict() == {"independent": 2, "claims": 5}


def test_a_table_that_is_cut_short_is_refused(tmp_path):
    path = tmp_path / "claims.csv"
    path.write_text("id,verdict,follows_from,note\nfirst,reproduced,,\n")
    read = read_verdicts(path)
    assert read["verdict"].tolist() == ["reproduced"]
    assert read[["follows_from", "note"]].values.tolist() == [["", ""]]
    path.write_text("id,verdict,follows_from,note\nfirst,reprod")
    assert_says(refusal(read_verdicts, path), str(path), "whole table", "cut short")
