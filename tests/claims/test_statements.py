"""The statements of the paper: known rules and names, and the numbers that are printed."""

import numpy as np
import pandas as pd
import pytest
from paper_claims import (
    CONSTANTS,
    INSIGHT_STATEMENTS,
    PAPER_STATEMENTS,
    PARAMETERS,
    STATEMENTS,
    TABLES,
)
from paper_datasets import make_datasets

from hardcontact.claims.evaluation import DATASETS, DERIVED, INSIGHT_DATASETS
from hardcontact.claims.verdicts import accepted_range
from hardcontact.insight.interaction_laws import EXPONENTIAL, LAWS
from hardcontact.insight.law_comparison import CASES


def pick(name):
    return STATEMENTS[STATEMENTS["id"] == name]


def test_ids_are_unique():
    assert STATEMENTS["id"].is_unique


def test_rules_are_known_and_have_their_limits():
    for claim in STATEMENTS.itertuples():
        accepted_range(claim.rule, claim.published_low, claim.published_high)


def test_vocabulary():
    assert set(STATEMENTS["basis"]) <= {"published", "inferred", "assumed"}
    assert set(STATEMENTS["needs"]) <= {"", "measured", "no scan", "construction"}
    assert set(STATEMENTS["replicated"]) == {"", "yes"}


@pytest.mark.parametrize(
    "statements, datasets", [(PAPER_STATEMENTS, DATASETS), (INSIGHT_STATEMENTS, INSIGHT_DATASETS)]
)
def test_each_table_needs_only_its_datasets(statements, datasets):
    named = statements["dataset"].str.split("+").explode()
    assert set(named) <= {*datasets, "paper"}


def test_a_claim_follows_from_another_that_follows_from_none():
    followed = STATEMENTS.set_index("id")["follows_from"]
    named = followed[followed != ""]
    assert (followed[named] == "").all() and (named.index != named).all()


def test_sets_hold_what_replicated_claims_need():
    replicated = STATEMENTS[STATEMENTS["replicated"] == "yes"]
    named = set(replicated["dataset"].str.split("+").explode())
    assert named == {"topography", "adhesion", "inference", "band", "paper"}
    assert (replicated["needs"].isin(["", "construction"])).all()
    assert not replicated["quantity"].str.startswith("all_").any()


def test_claims_about_forces_say_at_which_range_they_stand():
    of_pairs = STATEMENTS["quantity"].isin(
        ["force_mean", "force_median", "lognormal_shape", "mean_over_median", "ratio_at_pair"]
    )
    fitted = STATEMENTS["id"].str.endswith("_at_fit")
    pair = STATEMENTS["select"].str.extract(r"pair=(\w+)")[0]
    assert (pair[of_pairs] == np.where(fitted, "fitted", "published")[of_pairs]).all()
    assert pair[~of_pairs].isna().all()


def test_edges_of_the_band_are_numbers_and_bounds():
    edges = STATEMENTS[STATEMENTS["quantity"] == "band_edge"].set_index("id")
    for side, rule, column in (("small", "above", "low"), ("large", "below", "high")):
        of_side = edges[edges.index.str.contains(f"_{side}_")]
        bounds = of_side.index.str.startswith("critical_wavelength")
        for rows, expected in ((of_side[bounds], rule), (of_side[~bounds], "factor 1.25")):
            assert len(rows) == 5 and set(rows["rule"]) == {expected}
            assert (rows[f"published_{column}"] == rows["published"]).all()
        restated = STATEMENTS.set_index("id").loc[f"no_effect_{side}"]
        assert restated["follows_from"] == f"edge_{side}_pooled"


def test_rigid_and_plastic_contact_have_the_same_scale():
    """What is too weak for the micronewtons does not reproduce them, and the other way round."""
    rows = STATEMENTS.set_index("id")
    plastic = rows.loc["plastic_reproduces_scale"]
    least, _ = accepted_range(*plastic[["rule", "published_low", "published_high"]])
    for name in ("rigid_too_weak", "short_range_too_weak"):
        assert rows.loc[name, "published_high"] == pytest.approx(least)


def test_every_claim_names_what_exists():
    """Every derived quantity is used, and every other one is a variable of its dataset."""
    derived = STATEMENTS["quantity"].isin(list(DERIVED))
    assert set(DERIVED) == set(STATEMENTS["quantity"][derived])
    datasets = make_datasets()
    table1 = STATEMENTS["section"] == "Table 1"
    for claim in STATEMENTS[
        ~derived & (STATEMENTS["quantity"].str[:4] != "afm_") & ~table1
    ].itertuples():
        assert claim.quantity in datasets[claim.dataset], claim.id


def test_every_law_but_that_of_the_paper_is_judged_where_it_replaces_it():
    selected = STATEMENTS[STATEMENTS["id"].str.startswith("similar_with_")]["select"]
    others = [law.name for law in LAWS if law != EXPONENTIAL]
    assert list(selected) == [f"law={name};case=equivalent" for name in others]
    assert CASES[0] == "equivalent"


def test_claims_repeat_table1():
    table = pd.read_csv(TABLES / "table1.csv")
    for row in table.itertuples():
        claim = pick(f"{row.quantity}_{row.surface}").iloc[0]
        assert claim["published"] == row.value
        assert claim["published_low"] == pytest.approx(row.value - row.uncertainty)
        assert claim["published_high"] == pytest.approx(row.value + row.uncertainty)
        assert claim["unit"] == row.unit
        assert claim["quantity"] == row.quantity
    assert len(table) == (STATEMENTS["section"] == "Table 1").sum() == 24


def test_claims_repeat_pull_off():
    table = pd.read_csv(TABLES / "pull_off.csv").set_index(["quantity", "surface"])["value"]
    for quantity in ("mean_force", "median_force"):
        for surface, value in table[quantity].items():
            assert pick(f"{quantity}_{surface}")["published"].item() == value
    mean = table["mean_force"]
    for surface in ("polished_uncd", "ncd", "mcd"):
        published = pick(f"force_ratio_{surface}")["published"].item()
        assert published == pytest.approx(mean[surface] / mean["uncd"])


def test_claims_repeat_parameters():
    published = STATEMENTS.set_index("id")["published"]
    assert published["range_of_adhesion"] == PARAMETERS["range_of_adhesion"]
    assert published["work_of_adhesion"] == PARAMETERS["work_of_adhesion"]
    assert published["range_from_ratios"] == PARAMETERS["range_of_adhesion_from_ratios"]
    assert published["interaction_radius"] == PARAMETERS["interaction_radius"]
    assert published["stitching_change"] == PARAMETERS["stitching_change_upper_bound"]
    assert published["ruby_rms_height"] == PARAMETERS["sphere_rms_height_upper_bound"]
    assert published["plastic_fits"] == PARAMETERS["error_threshold"]
    assert (
        published[published.index.str.startswith("similar_with_")] == published["plastic_fits"]
    ).all()
    assert published["no_effect_small"] == PARAMETERS["scale_tolerance"]
    band = tuple(PARAMETERS[f"critical_wavelength_{side}"] for side in ("small", "large"))
    pooled = tuple(published[f"edge_{side}_pooled"] for side in ("small", "large"))
    assert band == pooled


def test_claims_repeat_the_printed_numbers():
    published = STATEMENTS.set_index("id")
    for name, quantity in {
        "hertz_stress": "hertz_stress",
        "tabor_parameter": "tabor_parameter",
        "plastic_contact_area": "plastic_contact_area",
        "indent_depth": "indent_depth",
        "indent_edge_length": "indent_edge_length",
    }.items():
        assert published.loc[name, "published"] == PARAMETERS[quantity]
    for name, quantity in {
        "indent_depth_measured": "measured_indent_depth",
        "indent_size_measured": "measured_indent_size",
        "single_indent_depth": "single_indent_depth",
        "single_indent_size": "single_indent_size",
        "range_agrees_with_others": "nanoscale_range",
    }.items():
        limits = [PARAMETERS[f"{quantity}_{end}_bound"] for end in ("lower", "upper")]
        assert published.loc[name, ["published_low", "published_high"]].tolist() == limits
    work = pd.read_csv(TABLES / "pull_off.csv").set_index(["quantity", "surface"])["value"]
    for surface, value in work["effective_work_of_adhesion"].items():
        row = published.loc[f"effective_work_{surface}"]
        assert row.published == value and row.published_low < value < row.published_high
    spread = work["effective_work_of_adhesion"]
    assert published.loc["effective_work_spread", "published"] == pytest.approx(
        np.log10(spread.max() / spread.min()), abs=0.005
    )
    table = pd.read_csv(TABLES / "table1.csv").set_index(["surface", "quantity"])["value"]
    slopes = [table["polished_uncd", f"{scales}_rms_slope"] for scales in ("all", "afm")]
    ratio = published.loc["slope_by_scales_polished_uncd", "published"]
    assert ratio == pytest.approx(slopes[0] / slopes[1])
    for name in ("range", "work"):
        half_width = published.loc[f"half_width_of_{name}", "published"]
        assert half_width == CONSTANTS["uncertainty"][f"{name}_of_adhesion"]
    force = work["mean_force", "polished_uncd"]
    for name in ("rigid_too_weak", "plastic_reproduces_scale", "short_range_too_weak"):
        assert published.loc[name, "published"] == force


def test_lognormal_shapes_follow_from_pull_off():
    table = pd.read_csv(TABLES / "pull_off.csv").pivot(
        index="surface", columns="quantity", values="value"
    )
    shapes = np.sqrt(2 * np.log(table["mean_force"] / table["median_force"]))
    expected = {"polished_uncd": 1.80, "uncd": 0.71, "ncd": 0.76, "mcd": 1.10}
    for surface, shape in expected.items():
        assert round(shapes[surface], 2) == shape
        assert pick(f"lognormal_shape_{surface}")["published"].item() == shape
