"""Numbers of the further claims: closed forms, known answers, and verdicts that follow them."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from paper_numbers import (
    RADIUS,
    SUBSTRATES,
    make_adhesion,
    make_classical,
    make_datasets,
    make_elastic,
    make_indent,
    make_inference,
    make_topography,
)
from scipy import stats
from scipy.integrate import quad

from hardcontact import claims, contact_estimates, estimates, intervals

PAPER = Path(__file__).parents[1] / "resources" / "paper"
CLAIMS = claims.read_claims(PAPER / "claims.csv")
PARAMETERS = pd.read_csv(PAPER / "parameters.csv").set_index("quantity")["value"]


def judged(name, datasets):
    return claims.evaluate(CLAIMS[CLAIMS["id"] == name], datasets).iloc[0]


def near(found, expected, **tolerance):
    np.testing.assert_allclose(np.asarray(found["value"]), expected, **tolerance)


# --- intervals --------------------------------------------------------------------------------


def test_scans_have_the_interval_of_student():
    rng = np.random.default_rng(3)
    values = rng.normal(size=7)
    found = intervals.mean_over_scans(xr.DataArray(values, dims="scan"))
    low, high = stats.t.interval(0.95, 6, values.mean(), stats.sem(values))
    assert (float(found["low"]), float(found["high"])) == pytest.approx((low, high))


def test_one_scan_has_no_interval():
    found = intervals.mean_over_scans(xr.DataArray([2.0], dims="scan"))
    assert float(found["value"]) == 2 and np.isnan([found["low"], found["high"]]).all()


def test_contacts_of_a_scan_count_once():
    """Many contacts do not narrow the interval, and a missing scan is none."""
    values = np.broadcast_to(np.array([1.0, 2, 3, np.nan])[:, None, None], (4, 5, 30))
    dataset = xr.Dataset({"depth": (("scan", "sphere_scan", "contact"), values)})
    found = intervals.variable(dataset, "depth")
    expected = intervals.mean_over_scans(xr.DataArray([1.0, 2, 3], dims="scan"))
    for name in ("value", "low", "high"):
        assert float(found[name]) == pytest.approx(float(expected[name]))


def test_own_interval_comes_first():
    ends = {"depth_low": 0.5, "depth_high": 4.0}
    dataset = xr.Dataset({"depth": (("scan", "contact"), [[1.0]])} | ends)
    found = intervals.variable(dataset, "depth")
    assert [found[name].item() for name in ("value", "low", "high")] == [1.0, 0.5, 4.0]


@pytest.mark.parametrize(
    ("low", "high", "expected"),
    [(-0.1, 0.3, (0.0, 0.3)), (-0.4, -0.2, (0.2, 0.4)), (0.1, 0.2, (0.1, 0.2))],
)
def test_magnitude(low, high, expected):
    signed = intervals.interval(xr.DataArray((low + high) / 2), low, high)
    found = intervals.magnitude(signed)
    assert (float(found["low"]), float(found["high"])) == pytest.approx(expected)


def test_decades_bound_both_extremes():
    value = xr.DataArray([1.0, 10.0, 100.0], dims="surface")
    found = intervals.decades(intervals.interval(value, value / 2, value * 2), "surface")
    ends = [float(found[name]) for name in ("value", "low", "high")]
    assert ends == pytest.approx([2, np.log10(25), np.log10(400)])


# --- closed forms -----------------------------------------------------------------------------


def test_constants_are_the_published_ones():
    assert estimates.ATOMIC_RANGE_UPPER_BOUND == PARAMETERS["atomic_range_upper_bound"]
    assert estimates.SINUSOID_AMPLITUDE == PARAMETERS["sinusoid_amplitude"]
    ranges = tuple(PARAMETERS[f"sinusoid_range_{end}"] for end in ("short", "long"))
    assert estimates.SINUSOID_RANGES == ranges
    transition = PARAMETERS["small_scale_transition_wavelength"]
    assert estimates.SMALL_SCALE_TRANSITION_WAVELENGTH == transition
    assert estimates.STYLUS_RADIUS == PARAMETERS["stylus_radius"]


@pytest.mark.parametrize("rho", estimates.SINUSOID_RANGES)
def test_sinusoid_share(rho):
    def attraction(x):
        return np.exp(-estimates.SINUSOID_AMPLITUDE * (1 - np.cos(x)) / rho)

    expected = quad(attraction, 0, np.pi / 2)[0] / quad(attraction, 0, np.pi)[0]
    near(estimates.sinusoid_share(make_inference()).sel(rho=rho), expected)


def test_interaction_share():
    radius, rho = np.sqrt(2 * RADIUS * 5.6), 5.6

    def ring(r):
        return r * np.exp(-(r**2) / (2 * RADIUS * rho))

    expected = quad(ring, 0, radius)[0] / quad(ring, 0, 20 * radius)[0]
    found = estimates.interaction_share(make_inference()).sel(contact_model="plastic")
    near(found, expected)
    assert float(found["value"]) == pytest.approx(1 - np.exp(-1))


def test_smooth_sphere_has_the_same_force_at_all_ranges():
    assert float(estimates.smooth_sphere_change(make_adhesion())["value"]) < 1e-9


def test_coarse_pixels_show_at_small_ranges():
    """Pixels as wide as the disk of interaction: the sum over them is no integral any more."""
    adhesion = make_adhesion().assign_attrs(pixel_size=np.sqrt(RADIUS * 0.05) * 4)
    assert float(estimates.smooth_sphere_change(adhesion)["value"]) > 0.1


def test_deformation_energy_of_one_wave():
    """E* q h²/8 of a wave of amplitude h; of many waves of the same length the same a height²."""
    q, height, modulus, work = 0.02, 3.0, 289.7e9, 0.0463
    wavevector = np.linspace(0.0199, 0.0201, 201)
    width = wavevector[1] - wavevector[0]
    spectrum = np.zeros((1, 1, 201))
    spectrum[0, 0, 100] = 2 * np.pi * height**2 / (q * width)  # h_rms² = 1/2π ∫ q C dq
    topography = xr.Dataset(
        {"psd_isotropic": (("surface", "scan", "wavevector"), spectrum)},
        {"surface": ["mcd"], "wavevector": wavevector},
    )
    elastic = make_elastic(["mcd"]).assign_attrs(effective_modulus=modulus, work_of_adhesion=work)
    amplitude = np.sqrt(2) * height
    expected = modulus * q * 1e9 * (amplitude * 1e-9) ** 2 / 8 / work
    near(contact_estimates.deformation_over_adhesion(topography, elastic), [expected])


def test_deformation_needs_a_spectrum():
    topography = make_topography()
    topography["psd_isotropic"][1, 2:] = np.nan
    found = contact_estimates.deformation_over_adhesion(topography, make_elastic())
    full = contact_estimates.deformation_over_adhesion(make_topography(), make_elastic())
    near(found.sel(surface="uncd"), full["value"].sel(surface="uncd") * 0.985)


# --- forces -----------------------------------------------------------------------------------


def with_forces(forces):
    """An adhesion dataset with these (n,) forces at the reference range, whatever the surface."""
    adhesion = make_adhesion()
    shape = adhesion["pull_off_force"].isel(surface=0, contact_model=0, rho=0).shape
    adhesion["pull_off_force"] = xr.zeros_like(adhesion["pull_off_force"]) + xr.DataArray(
        forces.reshape(shape), dims=("scan", "sphere_scan", "contact_y", "contact_x")
    )
    return adhesion


DISTRIBUTIONS = {
    "lognormal_misfit": stats.lognorm(0.9, scale=2e-7),
    "half_gaussian_misfit": stats.halfnorm(scale=2e-7),
    "inverse_gaussian_misfit": stats.invgauss(3.0, scale=2e-7),
}


@pytest.mark.parametrize("name", DISTRIBUTIONS)
def test_misfit_is_small_for_the_right_distribution(name):
    forces = DISTRIBUTIONS[name].rvs(1000, random_state=4)
    found = estimates.estimate(name, with_forces(forces))["value"]
    assert (found < 0.05).all()


@pytest.mark.parametrize("name", ["half_gaussian_misfit", "inverse_gaussian_misfit"])
def test_misfit_is_large_for_the_wrong_distribution(name):
    forces = np.tile([1e-8, 1e-5], 500)
    assert (estimates.estimate(name, with_forces(forces))["value"] > 0.2).all()


def test_rise_at_short_ranges():
    adhesion = make_adhesion()
    rise = estimates.short_range_rise(adhesion).sel(contact_model="plastic", surface="mcd")
    mean = adhesion["pull_off_force"].mean(["sphere_scan", "contact_y", "contact_x"])
    mean = mean.sel(contact_model="plastic", surface="mcd")
    near(rise, (mean.sel(rho=0.05) / mean.sel(rho=2.0)).mean())
    adhesion["pull_off_force"].loc[{"rho": 0.05}] = 0.0
    assert judged("short_range_rise", make_datasets() | {"adhesion": adhesion}).verdict == (
        "not reproduced"
    )


def test_touching_pixels():
    adhesion = make_adhesion()
    near(contact_estimates.plastic_contact_area(adhesion), [100, 400])
    touching = 0.0463 * 400e-18 / 0.05e-9
    adhesion["pull_off_force"].loc[{"rho": 0.05}] = 4 * touching
    adhesion = adhesion.assign_attrs(work_of_adhesion=0.0463)
    near(contact_estimates.touching_share(adhesion).sel(contact_model="plastic"), [0.25] * 4)


def test_forces_at_the_published_pair_and_at_short_range():
    inference = make_inference().sel(contact_model="plastic")
    near(estimates.force_at_published_pair(inference), [8.8e-6, 0.4e-6, 0.16e-6, 0.11e-6])
    short = estimates.short_range_force(inference).sel(surface="polished_uncd")
    near(short, 8.8e-6 * 0.6 / 5.6)
    without = inference.isel(rho=slice(1, None))
    assert np.isnan(estimates.short_range_force(without)["value"]).all()


def test_errors_of_parts_of_the_map():
    inference = make_inference()
    near(estimates.short_range_error(inference), [0.8, 0.8])
    near(estimates.least_ratio_error(inference), [0.4, 0.05])
    plastic = inference.sel(contact_model="plastic")
    near(estimates.half_width_of_range(plastic), 0.5)
    near(estimates.half_width_of_work(plastic), 0.0035)


def test_no_region_of_small_error_is_not_reproduced():
    datasets = make_datasets()
    datasets["inference"]["region_range_low"][:] = np.nan
    row = judged("half_width_of_range", datasets)
    assert row.verdict == "not reproduced" and "No value exists." in row.note


def test_changes_of_cutoffs():
    inference = make_inference()
    inside = estimates.change_inside_band(inference).sel(side="large", group="pooled")
    near(inside, 0.6)
    near(estimates.small_scale_change(inference), [0.0] * 5)
    inference["scale_ratio"].loc[{"side": "small", "cutoff_wavelength": 10.0}] = 0.8
    near(estimates.small_scale_change(inference), [0.2] * 5)
    near(estimates.stylus_ratio(inference), [4.0] * 5)


def test_area_that_attracts_grows_by_one_power_more_than_the_force():
    adhesion = make_adhesion()
    near(estimates.area_slope(adhesion).sel(contact_model="plastic"), [1.9, 1.6, 1.3, 1.2])


# --- contact ----------------------------------------------------------------------------------


def test_roughness_by_scales():
    topography = make_topography().sel(surface=SUBSTRATES)
    slope = np.array([0.31 / 0.04, 1.17 / 0.39, 0.92 / 0.51, 0.85 / 0.49])
    height = np.array([4.2 / 3.2, 1.0, 97.2 / 97.1, 101.2 / 107.1])
    near(contact_estimates.slope_by_scales(topography), slope)
    near(contact_estimates.slope_over_height(topography), slope / height)
    curvature = np.array([1.99 / 2e-3, 6.32 / 4.8e-2, 5.91 / 3.9e-2, 5.04 / 2.8e-2])
    near(contact_estimates.curvature_over_height(topography), curvature / height)


def test_contact_height_is_taken_scan_by_scan():
    found = contact_estimates.contact_height(make_adhesion(), make_topography())
    assert set(found["surface"].values) == set(SUBSTRATES)
    near(found.sel(contact_model="plastic", surface="uncd"), 60 / 17.4)
    np.testing.assert_allclose(found["high"], found["low"])  # apex and roughness scatter alike


def test_elastic_contact():
    elastic = make_elastic()
    found = contact_estimates.elastic_change(elastic)
    near(found, [0.01] * 4)
    np.testing.assert_allclose(found["high"], 0.01)
    near(contact_estimates.peak_over_hardness(elastic), [2.4, 2.8, 3.2, 3.2])
    area = np.mean(1 / np.array([0.98, 0.99, 1.0, 1.01, 1.02]))
    expected = np.array([400 / 300, 1.6, 2.0, 2.0]) * area
    near(contact_estimates.plastic_over_elastic_area(elastic), expected)


def test_classical():
    classical = make_classical()
    found = contact_estimates.effective_work_decades(classical).sel(against="computed")
    near(found, [np.log10(7.15 / 0.08)] * 3)
    ratio = contact_estimates.classical_over_numerical(classical, make_inference())
    near(ratio.sel(contact_model="plastic", model="maugis", against="published"), [12, 12])


# --- verdicts ---------------------------------------------------------------------------------


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
    ("large_scales_in_band_matter", "inference", "scale_ratio", {"side": "large"}, 1.0),
    ("small_scales_added", "inference", "scale_ratio", {"side": "small"}, 0.5),
    ("stylus_insufficient", "inference", "scale_ratio", {"side": "small"}, 1.0),
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
    assert judged(name, datasets).verdict == "reproduced"
    for end in ("", "_low", "_high"):
        if variable + end in datasets[dataset]:
            datasets[dataset][variable + end].loc[where] = value
    assert judged(name, datasets).verdict == "not reproduced"


def test_numbers_of_indents_are_those_of_the_published_preload_and_surface():
    datasets = make_datasets()
    assert judged("indent_depth", datasets).computed == pytest.approx(2.0)
    others = claims.evaluate(CLAIMS, datasets | {"indent": make_indent("mcd")})
    assert not others["id"].str.contains("indent").any()
    lighter = make_indent().isel(preload=[0])
    assert claims.evaluate(
        CLAIMS[CLAIMS["id"] == "indent_depth"], datasets | {"indent": lighter}
    ).empty


def test_claims_of_no_scan_keep_their_verdict_on_substitutes():
    for basis in ("substitute", "measured"):
        row = judged("hertz_stress", make_datasets(basis))
        assert (row.basis, row.verdict) == ("no scan", "reproduced")


def test_claims_of_two_datasets_touch_the_surfaces_of_both():
    datasets = make_datasets("measured")
    assert judged("contact_height", datasets).basis == "measured"
    datasets["topography"]["basis"].loc[{"surface": "mcd"}] = "substitute"
    for name in ("contact_height", "stiff_interfaces", "numerical_beats_classical"):
        assert judged(name, datasets).basis == "substitute scans"


def test_every_claim_names_what_exists():
    """Every derived quantity is used, and every other one is a variable of its dataset."""
    derived = CLAIMS["quantity"].isin(list(estimates.DERIVED))
    assert set(estimates.DERIVED) == set(CLAIMS["quantity"][derived])
    datasets = make_datasets()
    table1 = CLAIMS["section"] == "Table 1"
    for claim in CLAIMS[~derived & (CLAIMS["quantity"].str[:4] != "afm_") & ~table1].itertuples():
        assert claim.quantity in datasets[claim.dataset], claim.id


def test_claims_repeat_the_printed_numbers():
    published = CLAIMS.set_index("id")
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
    work = pd.read_csv(PAPER / "pull_off.csv").set_index(["quantity", "surface"])["value"]
    for surface, value in work["effective_work_of_adhesion"].items():
        row = published.loc[f"effective_work_{surface}"]
        assert row.published == value and row.published_low < value < row.published_high
    spread = work["effective_work_of_adhesion"]
    assert published.loc["effective_work_spread", "published"] == pytest.approx(
        np.log10(spread.max() / spread.min()), abs=0.005
    )
    table = pd.read_csv(PAPER / "table1.csv").set_index(["surface", "quantity"])["value"]
    slopes = [table["polished_uncd", f"{scales}_rms_slope"] for scales in ("all", "afm")]
    found = published.loc["slope_by_scales_polished_uncd", "published"]
    assert found == pytest.approx(slopes[0] / slopes[1])
    half_widths = pd.read_csv(PAPER / "parameters.csv").set_index("quantity")["uncertainty"]
    for name in ("range", "work"):
        found = published.loc[f"half_width_of_{name}", "published"]
        assert found == half_widths[f"{name}_of_adhesion"]
    force = work["mean_force", "polished_uncd"]
    for name in ("rigid_too_weak", "plastic_reproduces_scale", "short_range_too_weak"):
        assert published.loc[name, "published"] == force
