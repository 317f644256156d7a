"""The judged claims of a study: reading, counts of verdicts, open ends of intervals."""

from math import nan

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from refusals import assert_says, refusal

from hardcontact.paper.claims.judged_claims import (
    add_open_ends,
    count_verdicts,
    read_judged_claims,
    without_verdicts,
)
from hardcontact.paper.claims.verdicts import VERDICTS


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


def test_claims_without_verdicts_are_read_back_and_counted_as_none(tmp_path):
    path = tmp_path / "claims.csv"
    path.write_text("id,agreeing_share,verdict,follows_from,note\nfirst,0.99,reproduced,,\n")
    without_verdicts(read_judged_claims(path)).to_csv(path, index=False)
    assert path.read_text().splitlines()[1].startswith("first,,,")
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
    numbers = {"computed": edge, "low": low, "high": high}
    names = [f"{side}_edge_first", f"{side}_edge_mean", "range_of_adhesion"]
    claims = add_open_ends(pd.DataFrame([{"id": name, **numbers} for name in names]), BANDS)
    assert claims["open_end"].tolist() == [end, end, ""]
