"""Claims name existing quantities and labels, and repeat the printed numbers of the paper."""

import numpy as np
import pandas as pd
import pytest
from paper_numbers import CLAIMS, TABLES

from hardcontact.paper.open_ends import EDGE_CLAIMS
from hardcontact.paper.verdicts import accepted_range

ROWS = CLAIMS.set_index("id")
TABLE1 = pd.read_csv(TABLES / "table1.csv")
PRINTED = pd.read_csv(TABLES / "pull_off.csv").pivot(
    index="surface", columns="quantity", values="value"
)


def test_a_claim_follows_only_from_an_independent_claim():
    origins = ROWS["follows_from"][ROWS["follows_from"] != ""]
    assert (ROWS["follows_from"][origins] == "").all() and (origins.index != origins).all()


def test_all_claims_about_edges_may_have_open_intervals():
    edge_claims = ROWS[ROWS["dataset"] == "edges"]
    sides = edge_claims["select"].str.extract("^side=(short|long)", expand=False)
    assert sides.to_dict() == EDGE_CLAIMS


def test_claims_repeat_table1():
    for row in TABLE1.itertuples():
        claim = ROWS.loc[f"{row.quantity}_{row.surface}"]
        limits = claim[["published", "published_low", "published_high"]].tolist()
        assert limits == pytest.approx(
            [row.value, row.value - row.uncertainty, row.value + row.uncertainty]
        )
        assert (claim["unit"], claim["quantity"]) == (row.unit, row.quantity)
    assert len(TABLE1) == (CLAIMS["section"] == "Table 1").sum() == 24


def test_claims_repeat_the_printed_forces_and_what_follows_from_them():
    mean, work = PRINTED["mean_force"], PRINTED["effective_work_of_adhesion"]
    table1 = TABLE1.set_index(["surface", "quantity"])["value"]
    slopes = [table1["polished_uncd", f"{scales}_rms_slope"] for scales in ("all", "afm")]
    printed = {
        "effective_work_spread": (np.log10(work.max() / work.min()), 0.005),
        "slope_by_scales_polished_uncd": (slopes[0] / slopes[1], 1e-6),
    }
    for surface in PRINTED.index:
        printed |= {
            f"mean_force_{surface}": (mean[surface], 0),
            f"median_force_{surface}": (PRINTED["median_force"][surface], 0),
            f"effective_work_{surface}": (work[surface], 0),
        }
        if surface != "uncd":
            printed[f"force_ratio_{surface}"] = (mean[surface] / mean["uncd"], 1e-6)
    for claim, (value, error) in printed.items():
        assert ROWS.loc[claim, "published"] == pytest.approx(value, abs=error), claim


def test_a_force_too_weak_for_a_claim_does_not_reproduce_it():
    plastic = ROWS.loc["plastic_reproduces_scale"]
    lowest = accepted_range(*plastic[["rule", "published_low", "published_high"]]).low
    for name in ("rigid_too_weak", "short_range_too_weak"):
        assert ROWS.loc[name, "published_high"] == pytest.approx(lowest)
