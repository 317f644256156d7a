"""Verdicts that follow the numbers, on the surfaces that a claim depends on."""

import numpy as np
import pytest
from paper_claims import STATEMENTS, judge, judge_one
from paper_datasets import make_datasets, make_indent
from scipy import stats

from hardcontact.claims.evaluation import COLUMNS


def pick(name):
    return STATEMENTS[STATEMENTS["id"] == name]


def one_verdict(claim, datasets):
    return judge(claim, datasets)["verdict"].item()


def test_numbers_of_the_paper_reproduce_it():
    result = judge(STATEMENTS, make_datasets("measured"))
    assert tuple(result.columns) == COLUMNS
    assert list(result["id"]) == list(STATEMENTS["id"])
    failed = set(result["id"][result["verdict"] != "reproduced"])
    # Forces that are log-normal, as these are, follow neither of the other distributions.
    assert failed == {"half_gaussian_misfit", "inverse_gaussian_misfit"}
    free = STATEMENTS["needs"] == "no scan"
    assert list(result["basis"]) == list(np.where(free, "no scan", "measured"))


def test_calibrated_and_assumed_are_not_testable_on_substitutes():
    substitutes = make_datasets()
    result = judge(STATEMENTS, substitutes).set_index("id")
    assert set(result["basis"]) == {"substitute scans", "no scan"}
    untestable = result.index[result["verdict"] == "not testable on substitutes"]
    table1 = [name for name in result.index if name.startswith(("afm_", "all_"))]
    calibrated = [name for name in table1 if not name.startswith("all_rms_curvature")]
    assumed = ["ruby_rms_height", "ruby_peak_to_valley", "slope_by_scales_polished_uncd"]
    assumed += ["small_scales_are_steep", "small_scales_are_curved"]
    assert set(untestable) == {*calibrated, "roughness_order", *assumed}
    assert "calibrated" in result.loc["afm_rms_height_uncd", "note"]
    assert "assume" in result.loc["ruby_rms_height", "note"]


def test_basis_is_that_of_the_surfaces_of_the_claim():
    datasets = make_datasets("measured")
    datasets["topography"]["basis"].loc[{"surface": "mcd"}] = "substitute"
    basis = judge(STATEMENTS, datasets).set_index("id")["basis"]
    assert basis["mean_force_uncd"] == "measured"
    assert basis["mean_force_mcd"] == "substitute scans"
    assert basis["range_of_adhesion"] == "substitute scans"


def test_substitute_sphere_counts_for_forces_only():
    datasets = make_datasets("measured")
    datasets["topography"]["basis"].loc[{"surface": "ruby"}] = "substitute"
    basis = judge(STATEMENTS, datasets).set_index("id")["basis"]
    assert basis["mean_force_uncd"] == "substitute scans"
    assert basis["afm_rms_height_uncd"] == "measured"


def test_missing_surface_is_left_out():
    result = judge(STATEMENTS, make_datasets(surfaces=["polished_uncd", "uncd"]))
    ids = set(result["id"])
    assert "mean_force_uncd" in ids and "range_of_adhesion" in ids
    missing = {"mean_force_mcd", "critical_wavelength_small_ncd", "uncd_above_ncd_and_mcd"}
    assert not ids & missing


def test_missing_value_is_not_reproduced():
    substitutes = make_datasets()
    claim = pick("critical_wavelength_small_pooled")
    substitutes["band"]["critical_wavelength"][:] = np.nan
    result = judge(claim, substitutes)
    assert result["verdict"].item() == "not reproduced"
    assert "No value exists." in result["note"].item()


def test_no_region_of_small_error_is_not_reproduced():
    datasets = make_datasets()
    datasets["inference"]["region_range"][:] = np.nan
    row = judge_one("half_width_of_range", datasets)
    assert row.verdict == "not reproduced" and "No value exists." in row.note


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"rule": "close"}, "claim range_of_adhesion: unknown rule 'close'"),
        ({"quantity": "colour"}, "claim range_of_adhesion: .*colour"),
        ({"dataset": "colours"}, "claim range_of_adhesion: no dataset named 'colours'"),
        ({"select": "phase=solid"}, "claim range_of_adhesion: .*phase"),
        ({"select": ""}, "claim range_of_adhesion: rule 'interval' needs one number"),
    ],
)
def test_errors_name_the_claim(change, message):
    substitutes = make_datasets()
    claim = pick("range_of_adhesion").assign(**change)
    with pytest.raises(ValueError, match=message) as error:
        judge(claim, substitutes)
    assert "\n" not in str(error.value)


def test_missing_attribute_is_named():
    substitutes = make_datasets()
    del substitutes["inference"].attrs["sphere_radius"]
    with pytest.raises(ValueError, match="claim interaction_radius: expected sphere_radius"):
        judge(pick("interaction_radius"), substitutes)


def test_order_needs_every_link():
    substitutes = make_datasets()
    claim = pick("uncd_above_ncd_and_mcd")
    inference = substitutes["inference"]
    assert one_verdict(claim, substitutes) == "reproduced"
    inference["force_mean_interval"].loc[{"surface": "mcd", "bound": "high"}] = 1e-6
    assert one_verdict(claim, substitutes) == "consistent"
    inference["force_mean"].loc[{"surface": "mcd"}] = 0.5e-6
    assert one_verdict(claim, substitutes) == "not reproduced"


def test_open_dimensions_take_the_worst_case():
    substitutes = make_datasets()
    claim = pick("stitching_change")
    substitutes["adhesion"]["window_change"][1, 3] = 0.02
    substitutes["adhesion"]["window_change"][0, 4] = np.nan
    result = judge(claim, substitutes)
    assert result["computed"].item() == 0.02
    assert result["verdict"].item() == "not reproduced"


FLIPS = [
    ("hertz_stress", "classical", "hertz_peak_pressure", {}, 150e6),
    ("tabor_parameter", "classical", "tabor_parameter", {}, 0.618),
    ("tabor_transition", "classical", "tabor_parameter", {}, 0.01),
    ("effective_work_mcd", "classical", "effective_work_of_adhesion", {"surface": "mcd"}, 1e-4),
    ("effective_work_spread", "classical", "effective_work_of_adhesion", {}, 7e-3),
    ("no_simple_relation", "classical", "power_law_error", {"rms_parameter": "slope"}, 0.05),
    ("rms_height_insufficient", "classical", "power_law_error", {"metrics": "afm"}, 0.05),
    ("slope_and_curvature_less_important", "classical", "power_law_error",
     {"rms_parameter": "slope"}, 0.2),
    ("maugis_fails", "classical", "mean_relative_error", {"model": "maugis"}, 0.05),
    ("fuller_tabor_fails", "classical", "mean_relative_error", {"model": "fuller_tabor"}, 0.05),
    ("rumpf_fails", "classical", "mean_relative_error", {"model": "rumpf_height"}, 0.05),
    ("numerical_beats_classical", "inference", "best_error", {"contact_model": "plastic"}, 0.7),
    ("ratios_meet", "inference", "ratio_error", {"contact_model": "plastic"}, 0.2),
    ("rigid_too_weak", "inference", "mean_force", {"contact_model": "rigid"}, 1e-3),
    ("plastic_reproduces_scale", "inference", "mean_force", {"contact_model": "plastic"}, 1e-5),
    ("short_range_too_weak", "inference", "mean_force", {"contact_model": "plastic"}, 1e-3),
    ("short_range_cannot_fit", "inference", "mean_relative_error", {"rho_fine": 0.5}, 0.05),
    ("large_scales_in_band_matter", "band", "scale_ratio", {"side": "large"}, 1.0),
    ("small_scales_added", "band", "scale_ratio", {"side": "small"}, 0.5),
    ("stylus_insufficient", "band", "scale_ratio", {"side": "small"}, 1.0),
    ("range_exceeds_5_nm", "inference", "range_of_adhesion", {"contact_model": "plastic"}, 3.0),
    ("elastic_equals_rigid", "elastic", "elastic_pull_off_force", {"surface": "ncd"}, 1e-6),
    ("elastic_pressure_exceeds_hardness", "elastic", "hard_share", {"surface": "uncd"}, 0.4),
    ("plasticity_enlarges_contact", "elastic", "contact_area", {"surface": "uncd"}, 500.0),
    ("pressure_exceeds_hardness", "elastic", "peak_pressure", {"surface": "uncd"}, 20e9),
    ("indent_depth", "indent", "depth", {}, 4.0),
    ("indent_edge_length", "indent", "edge_length", {}, 20.0),
    ("indent_depth_measured", "indent", "depth", {}, 0.2),
    ("indent_size_measured", "indent", "lateral_size", {}, 20.0),
    ("few_asperities_ncd", "asperities", "two_largest_share", {"surface": "ncd"}, 0.3),
    ("fewer_asperities", "asperities", "patches", {"surface": "mcd"}, 12.0),
    ("area_growth_order", "adhesion", "pull_off_force", {"rho": 8.0, "surface": "mcd"}, 1.0),
    ("contact_height", "adhesion", "closest_approach", {"surface": "uncd"}, -17.4),
    ("plastic_contact_area", "adhesion", "contact_pixels", {"contact_model": "plastic"}, 9),
    ("touching_pixels_rise", "adhesion", "pull_off_force", {"rho": 0.05}, 1e-3),
    ("stiff_interfaces", "topography", "psd_isotropic", {"surface": "ncd"}, 1e-3),
]  # fmt: skip


@pytest.mark.parametrize(("name", "dataset", "variable", "where", "value"), FLIPS)
def test_verdict_follows_the_number(name, dataset, variable, where, value):
    datasets = make_datasets()
    assert judge_one(name, datasets).verdict == "reproduced"
    for end in ("", "_interval"):
        if variable + end in datasets[dataset]:
            datasets[dataset][variable + end].loc[where] = value
    assert judge_one(name, datasets).verdict == "not reproduced"


def test_numbers_of_indents_are_those_of_the_published_preload_and_surface():
    datasets = make_datasets()
    assert judge_one("indent_depth", datasets).computed == pytest.approx(2.0)
    others = judge(STATEMENTS, datasets | {"indent": make_indent("mcd")})
    assert not others["id"].str.contains("indent").any()
    lighter = make_indent().isel(preload=[0])
    assert judge(
        STATEMENTS[STATEMENTS["id"] == "indent_depth"], datasets | {"indent": lighter}
    ).empty


def test_claims_of_no_scan_keep_their_verdict_on_substitutes():
    for basis in ("substitute", "measured"):
        row = judge_one("hertz_stress", make_datasets(basis))
        assert (row.basis, row.verdict) == ("no scan", "reproduced")


def test_claims_of_two_datasets_depend_on_the_surfaces_of_both():
    datasets = make_datasets("measured")
    assert judge_one("contact_height", datasets).basis == "measured"
    datasets["topography"]["basis"].loc[{"surface": "mcd"}] = "substitute"
    for name in ("contact_height", "stiff_interfaces", "numerical_beats_classical"):
        assert judge_one(name, datasets).basis == "substitute scans"


def test_intervals_over_scans_have_the_confidence_that_is_given():
    claim, datasets = pick("plastic_above_rigid"), make_datasets()
    datasets["adhesion"]["pull_off_force"].loc[{"contact_model": "plastic", "scan": 0}] *= 1.1
    wide, narrow = (judge(claim, datasets, confidence).iloc[0] for confidence in (0.95, 0.5))
    assert wide.computed == narrow.computed
    quantiles = [stats.t.ppf((1 + confidence) / 2, 4) for confidence in (0.95, 0.5)]
    assert (wide.high - wide.low) / (narrow.high - narrow.low) == pytest.approx(
        quantiles[0] / quantiles[1]
    )
