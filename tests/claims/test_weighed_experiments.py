"""Verdicts on experiments: by the rules of the claims, from draws that depend on the row alone."""

import numpy as np
from figure_inputs.ledger import ledger
from known_experiments import experiment

from hardcontact.claims.weighed_experiments import NOT_TESTABLE, weighed


def test_an_experiment_that_states_too_little_names_what_it_lacks():
    lacking = ledger().sel(experiment="lacking")
    assert lacking["verdict"] == NOT_TESTABLE and lacking["missing"] == "measured"
    assert np.isnan(lacking["predicted"]) and np.isnan(lacking["predicted_interval"]).all()


def test_a_contact_that_is_never_rough_is_not_tested():
    (found,) = weighed([experiment("ratio_to_smooth", radius_nm=10.0)], 2, 1, 0.95)["missing"]
    assert found == "rough_contact"


def test_no_force_exceeds_that_of_a_smooth_sphere_so_that_the_control_fails():
    assert ledger()["verdict"].sel(experiment="soft") == "not reproduced"


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
