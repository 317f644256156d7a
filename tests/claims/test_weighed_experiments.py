"""Verdicts on experiments: by the rules of the claims, from draws that depend on the row alone."""

import numpy as np
from figure_inputs.ledger import ledger
from known_experiments import experiment

from hardcontact.claims.weighed_experiments import NOT_TESTABLE, NOT_TRIED, weighed


def test_an_experiment_that_states_too_little_names_what_it_lacks():
    lacking = ledger().sel(experiment="lacking")
    assert lacking["verdict"] == NOT_TESTABLE and lacking["missing"] == "measured"
    assert np.isnan(lacking["predicted"]) and np.isnan(lacking["predicted_interval"]).all()


def test_a_contact_that_is_never_rough_is_not_tested():
    (found,) = weighed([experiment("ratio_to_smooth", radius_nm=10.0)], 2, 1, 0.95)["missing"]
    assert found == "rough_contact"


def test_a_control_that_would_fail_whatever_the_law_says_is_not_tested():
    capped, fails = (ledger().sel(experiment=name) for name in ("capped", "soft"))
    assert capped["verdict"] == NOT_TESTABLE and capped["missing"] == "below_smooth"
    assert fails["verdict"] == "not reproduced" and fails["agreement"] == 0
    hard = weighed([experiment("ratio_to_smooth", rule="above", low=1.0)], 2, 1, 0.95)
    assert hard["verdict"] == "not reproduced"


def test_there_is_no_verdict_where_the_law_was_not_tried():
    tip = ledger().sel(experiment="tip")
    assert tip["tried"] == 0 and tip["verdict"] == NOT_TRIED and np.isfinite(tip["predicted"])


def test_draws_belong_to_the_row_and_not_to_its_place():
    again = weighed([experiment("ratio_to_smooth", id="ratio", range_nm=(1.0, 5.0))], 4, 1, 0.95)
    assert (
        again.sel(experiment="ratio")
        .drop_attrs()
        .identical(ledger().sel(experiment="ratio").drop_attrs())
    )


def test_the_verdict_is_that_of_the_interval_and_the_unknown_that_moves_it_is_named():
    open_range = {"id": "ratio", "range_nm": (0.5, 20.0)}
    wide, narrow = (
        weighed([experiment("ratio_to_smooth", **open_range, low=low, high=1.0)], 12, 1, 0.95)
        .isel(experiment=0)
        for low in (1e-9, 0.3)
    )  # fmt: skip
    assert wide["verdict"] == "reproduced" and wide["agreement"] == 1
    assert narrow["verdict"] == "undecided" and 0 < narrow["agreement"] < 1
    assert wide["decided_by"] == "range_nm"
