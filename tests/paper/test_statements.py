"""Claims name existing quantities and labels, and repeat the printed numbers of the paper."""

import numpy as np
import pandas as pd
import pytest
from paper_numbers import CONSTANTS, PARAMETERS, STATEMENTS, TABLES

from hardcontact.paper.evaluation import DERIVED_QUANTITIES
from hardcontact.paper.verdicts import accepted_range

ROWS = STATEMENTS.set_index("id")
TABLE1 = pd.read_csv(TABLES / "table1.csv")
PRINTED = pd.read_csv(TABLES / "pull_off.csv").pivot(
    index="surface", columns="quantity", values="value"
)


def test_a_claim_follows_only_from_an_independent_claim():
    origins = ROWS["follows_from"][ROWS["follows_from"] != ""]
    assert (ROWS["follows_from"][origins] == "").all() and (origins.index != origins).all()


def test_claims_of_the_sets_use_datasets_of_the_sets():
    replicated = STATEMENTS[STATEMENTS["samples_from"] == "sets"]
    names = set(replicated["dataset"].str.split("+").explode())
    assert names == {"topography", "adhesion", "fit", "edges", "paper"}
    assert replicated["needs"].isin(["", "construction", "experiment", "measured"]).all()


def test_every_derived_quantity_is_judged():
    assert set(DERIVED_QUANTITIES) <= set(STATEMENTS["quantity"])


def test_claims_repeat_table1():
    for row in TABLE1.itertuples():
        claim = ROWS.loc[f"{row.quantity}_{row.surface}"]
        limits = claim[["published", "published_low", "published_high"]].tolist()
        assert limits == pytest.approx(
            [row.value, row.value - row.uncertainty, row.value + row.uncertainty]
        )
        assert (claim["unit"], claim["quantity"]) == (row.unit, row.quantity)
    assert len(TABLE1) == (STATEMENTS["section"] == "Table 1").sum() == 24


PUBLISHED = {
    "hertz_stress": "hertz_stress",
    "tabor_parameter": "tabor_parameter",
    "plastic_contact_area": "plastic_contact_area",
    "indent_depth": "indent_depth",
    "indent_edge_length": "indent_edge_length",
    "range_of_adhesion": "range_of_adhesion",
    "work_of_adhesion": "work_of_adhesion",
    "range_from_ratios": "range_of_adhesion_from_ratios",
    "interaction_radius": "interaction_radius",
    "stitching_change": "stitching_change_upper_bound",
    "ruby_rms_height": "sphere_rms_height_upper_bound",
    "plastic_fits": "error_threshold",
    "no_effect_short": "scale_tolerance",
    "short_edge_first": "short_edge",
    "short_edge_pooled": "short_edge",
    "long_edge_first": "long_edge",
    "long_edge_pooled": "long_edge",
}
#: Claims whose limits are printed as a range.
RANGES = {
    "indent_depth_measured": "measured_indent_depth",
    "indent_size_measured": "measured_indent_size",
    "single_indent_depth": "single_indent_depth",
    "single_indent_size": "single_indent_size",
    "range_agrees_with_others": "nanoscale_range",
}


def test_claims_repeat_the_printed_numbers():
    published = ROWS["published"]
    for claim, parameter in PUBLISHED.items():
        assert published[claim] == PARAMETERS[parameter], claim
    for claim, parameter in RANGES.items():
        limits = [PARAMETERS[f"{parameter}_{end}_bound"] for end in ("lower", "upper")]
        assert ROWS.loc[claim, ["published_low", "published_high"]].tolist() == limits
    for name in ("range", "work"):
        half_width = CONSTANTS["uncertainty"][f"{name}_of_adhesion"]
        assert published[f"half_width_of_{name}"] == half_width
    for name in ("rigid_too_weak", "plastic_reproduces_scale", "short_range_too_weak"):
        assert published[name] == PRINTED["mean_force"]["polished_uncd"]


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


def test_edges_of_the_band_are_numbers_and_bounds():
    edges = ROWS[ROWS["quantity"].isin(["band_edge", "first_edge"])]
    # Half a unit of the last digit of 43 nm and 1.8 µm; a bound has none.
    for side, bound, column, half in (
        ("short", "above", "low", 0.5),
        ("long", "below", "high", 50),
    ):
        rows = edges[edges.index.str.contains(f"^{side}_edge_")]
        bounds = rows.index.str.contains("_at_")
        assert list(rows["rule"]) == [bound if is_bound else "factor 1.25" for is_bound in bounds]
        distance = abs(rows[f"published_{column}"] - rows["published"])
        assert distance.tolist() == [0 if is_bound else half for is_bound in bounds]
        assert len(rows) == 3


def test_a_force_too_weak_for_a_claim_does_not_reproduce_it():
    plastic = ROWS.loc["plastic_reproduces_scale"]
    lowest = accepted_range(*plastic[["rule", "published_low", "published_high"]]).low
    for name in ("rigid_too_weak", "short_range_too_weak"):
        assert ROWS.loc[name, "published_high"] == pytest.approx(lowest)
