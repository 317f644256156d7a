"""Rules, verdicts, and the table that holds them."""

import numpy as np
import pandas as pd
import pytest
from refusals import assert_says, refusal

from hardcontact.claims.verdicts import VERDICTS, read_verdicts, summary, verdict


@pytest.mark.parametrize(
    ("rule", "computed", "low", "high", "expected"),
    [
        ("interval", 5.0, 1.0, 9.0, "reproduced"),
        ("interval", 7.0, 5.9, 8.0, "consistent"),
        ("interval", 7.0, 6.5, 8.0, "not reproduced"),
        ("interval", 3.0, 2.0, 3.5, "not reproduced"),
        ("interval", 7.0, np.nan, np.nan, "not reproduced"),
        ("factor 1.5", 8.9, 8.8, 9.2, "reproduced"),
        ("factor 1.5", 2.7, 2.6, 2.8, "reproduced"),
        ("factor 1.5", 9.5, 8.0, 11.0, "consistent"),
        ("factor 1.5", 9.5, 9.1, 11.0, "not reproduced"),
        ("below", 5.0, 4.5, 5.5, "reproduced"),
        ("below", 5.0, 4.5, 6.5, "consistent"),
        ("below", 6.5, 5.5, 7.0, "not reproduced"),
        ("above", 5.0, 4.5, 6.5, "reproduced"),
        ("above", 5.0, 3.5, 6.5, "consistent"),
        ("above", 3.5, 3.0, 6.5, "not reproduced"),
        ("order", 5.0, 4.5, 6.5, "reproduced"),
        ("order", 5.0, 3.5, 6.5, "consistent"),
        ("order", 4.0, 4.0, 4.0, "not reproduced"),
        ("above", np.nan, np.nan, np.nan, "not reproduced"),
        ("interval", np.nan, 1.0, 9.0, "not reproduced"),
    ],
)
def test_verdict(rule, computed, low, high, expected):
    assert verdict(rule, computed, low, high, 4.0, 6.0) == expected


@pytest.mark.parametrize("rule", ["close", "factor", "factor x", "interval 2", ""])
def test_unknown_rule(rule):
    with pytest.raises(ValueError):
        verdict(rule, 1.0, 1.0, 1.0, 1.0, 1.0)


def test_rule_needs_its_limit():
    with pytest.raises(ValueError, match="lacks a published limit"):
        verdict("below", 1.0, 1.0, 1.0, 1.0, np.nan)


def test_summary_lists_every_verdict():
    evaluated = pd.DataFrame({"verdict": ["consistent", "reproduced", "consistent"]})
    result = summary(evaluated)
    assert list(result["verdict"]) == list(VERDICTS)
    assert list(result["claims"]) == [1, 2, 0, 0]


def test_a_table_that_is_cut_short_is_refused(tmp_path):
    path = tmp_path / "claims.csv"
    path.write_text("id,verdict\nfirst,reproduced\n")
    assert read_verdicts(path)["verdict"].tolist() == ["reproduced"]
    path.write_text("id,verdict\nfirst,reprod")
    assert_says(refusal(read_verdicts, path), str(path), "whole table", "cut short")
