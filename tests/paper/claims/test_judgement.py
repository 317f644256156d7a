"""Claims: the table of the paper's statements, and their judgement on a small study."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from intervals import between_multiples
from paper_numbers import CLAIMS, TABLES

from hardcontact.paper.claims.judgement import claim_values, judge_claims
from hardcontact.paper.claims.selection import claim_surfaces
from hardcontact.paper.claims.verdicts import JUDGED_COLUMNS

ROWS = CLAIMS.set_index("id")
TABLE1 = pd.read_csv(TABLES / "table1.csv")
PRINTED = pd.read_csv(TABLES / "pull_off.csv").pivot(
    index="surface", columns="quantity", values="value"
)


def test_each_claim_follows_in_the_end_from_an_independent_claim():
    for claim in ROWS.index:
        chain = [claim]
        while origin := ROWS.loc[chain[-1], "follows_from"]:
            assert origin not in chain
            chain.append(origin)


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


SURFACES = ["smooth", "middle", "rough"]
CONSTANTS = pd.DataFrame({"value": {"scan_size": 5e3, "scan_pixels": 512.0}})
CLAIM = {
    "id": "claim", "section": "Results", "statement": "It is two.", "published": 2.0,
    "published_low": 1.5, "published_high": 2.5, "unit": "1", "rule": "interval",
    "evidence": "published", "dataset": "forces", "quantity": "force", "select": "surface=middle",
    "needs": "", "follows_from": "", "samples_from": "", "note": "",
}  # fmt: skip


def make_datasets(substitutes=(), surfaces=SURFACES):
    """Return heights and forces of 1, 2 and 4, forces within 10 %; some scans are substitutes."""
    names = [*SURFACES, "sphere"]
    sources = ["substitute" if name in substitutes else "measured" for name in names]
    topography = xr.Dataset(
        {
            "rms_height_mean": ("surface", [1.0, 2.0, 4.0, 0.5]),
            "rms_gradient_mean": ("surface", [0.1, 0.2, 0.4, 0.05]),
            "source": ("surface", sources),
            "table1_rows_met": ("surface", ["afm_rms_height"] * 3 + [""]),
        },
        {"surface": names},
        {"sphere_surface": "sphere"},
    )
    forces = xr.Dataset(
        between_multiples("force", "surface", [1.0, 2.0, 4.0], (0.9, 1.1))
        | {"change": (("surface", "scan"), np.full((3, 3), 1e-3))},
        {"surface": SURFACES},
    )
    return {
        "topography": topography.sel(surface=[*surfaces, "sphere"]),
        "forces": forces.sel(surface=surfaces),
        "indent": xr.Dataset(
            {"depth": ("preload", [2.0])},
            {"preload": [np.nextafter(2e-5, 1)]},  # rounding does not hide a label
            {"surface": surfaces[-1]},
        ),
    }


def judge_all(datasets, samples=(), **changes):
    """Return the claims.csv of the claim after changes; its numbers in the sets are samples."""
    sets = xr.Dataset(
        {"value": (("set", "claim"), np.reshape(samples, (-1, 1)))}, {"claim": ["claim"]}
    ).merge(datasets.get("edges", {}))
    claims = pd.DataFrame([CLAIM | changes])
    return judge_claims(claims, datasets, CONSTANTS, 0.95, sets)


def judge(datasets=None, samples=(), **changes):
    """Return the row of the claim after changes of some of its columns."""
    return judge_all(datasets or make_datasets(), samples, **changes).iloc[0]


def test_a_number_is_judged_with_its_interval():
    table = judge_all(make_datasets())
    assert tuple(table.columns) == JUDGED_COLUMNS
    row = table.iloc[0]
    assert (row.computed, row.low, row.high) == pytest.approx((2.0, 1.8, 2.2))
    assert (row.verdict, row.basis) == ("reproduced", "measured")
    assert np.isnan(row.agreeing_share)
    assert judge(published_high=2.1).verdict == "undecided"


@pytest.mark.parametrize(("last_cutoff", "open_end"), [(250.0, "high"), (500.0, "")])
def test_the_interval_of_an_edge_is_open_at_the_last_cutoff(last_cutoff, open_end):
    edges = xr.Dataset(
        {"filtered_force_change": (("side", "cutoff_wavelength"), [[0.05, 0.1]])}
        | between_multiples("edge", ("side", "surface"), [[200.0]], (0.9, 1.25)),
        {"side": ["short"], "surface": ["middle"], "cutoff_wavelength": [43.0, last_cutoff]},
    )
    edge = {"dataset": "edges", "quantity": "edge", "select": "side=short", "unit": "nm"}
    row = judge(make_datasets() | {"edges": edges}, **edge)
    assert (row.computed, row.high, row.open_end) == (200, 250, open_end)


HEIGHT = {"dataset": "topography", "quantity": "afm_rms_height"}
ORDER = {"rule": "order", "published_low": 1.0, "select": "surface=rough>middle>smooth"}


@pytest.mark.parametrize(
    ("changes", "substitutes", "basis", "verdict"),
    [
        ({}, ["middle"], "substitute scans", "reproduced"),
        ({}, ["rough"], "measured", "reproduced"),
        ({}, ["sphere"], "substitute scans", "reproduced"),
        (HEIGHT, ["sphere"], "measured", "agrees"),
        (HEIGHT, ["middle"], "substitute scans", "by construction"),
        (HEIGHT | ORDER, ["middle", "rough"], "substitute scans", "agrees"),
        (HEIGHT | ORDER, SURFACES, "substitute scans", "by construction"),
        (ORDER, ["smooth"], "substitute scans", "reproduced"),
        ({"needs": "construction"}, [], "measured", "by construction"),
        ({"needs": "measured"}, ["middle"], "substitute scans", "not testable"),
        ({"needs": "measured"}, [], "measured", "reproduced"),
        ({"needs": "experiment"}, [], "measured", "model beside experiment"),
        (HEIGHT | {"needs": "no scan"}, ["middle"], "no scan", "reproduced"),
        ({"rule": "below", "published_high": 5.0, "select": ""}, ["rough"], "substitute scans",
         "reproduced"),
    ],
)  # fmt: skip
def test_a_claim_rests_on_the_scans_of_its_surfaces(changes, substitutes, basis, verdict):
    row = judge(make_datasets(substitutes), **changes)
    assert (row.basis, row.verdict) == (basis, verdict)


def test_a_surface_left_out_does_not_select_the_surfaces_of_a_claim():
    datasets = make_datasets()
    forces, topography = {"forces": datasets["forces"]}, datasets["topography"]
    claim, left_out = SimpleNamespace(**CLAIM), [["middle"]]
    surfaces = claim_surfaces(claim, forces, {"left_out": left_out}, topography)
    assert surfaces == [*SURFACES, "sphere"]
    selected = {"left_out": left_out, "surface": [["rough"]]}
    assert claim_surfaces(claim, forces, selected, topography) == ["rough", "sphere"]


# The pixels of CONSTANTS are 5000/512 = 9.77 nm wide.
@pytest.mark.parametrize(("pixel_size", "verdict"), [(9.8, "agrees"), (19.6, "not testable")])
def test_slopes_on_pixels_larger_than_the_papers_are_not_judged(pixel_size, verdict):
    datasets = make_datasets()
    pixel_sizes = ("surface", [pixel_size] * 4)
    datasets["topography"] = datasets["topography"].assign(pixel_size=pixel_sizes)
    slope = {"dataset": "topography", "quantity": "afm_rms_slope"}
    assert judge(datasets, published_low=0.15, published_high=0.25, **slope).verdict == verdict


@pytest.mark.parametrize(
    ("samples", "ends", "agreeing_share", "verdict"),
    [
        (np.linspace(1.7, 2.3, 101), (1.715, 2.285), 1, "reproduced"),
        (np.linspace(1.3, 2.3, 101), (1.325, 2.275), 81 / 101, "undecided"),
        (np.linspace(2.6, 3.0, 101), (2.0, 2.99), 0, "not reproduced"),  # stretched to the number
        ([2.1] * 9, (1.8, 2.2), 1, "reproduced"),  # equal sets: the number keeps its own interval
        ([*np.linspace(1.7, 2.3, 400), *[np.nan] * 4], (1.715, 2.285), 400 / 404, "reproduced"),
        ([*np.linspace(1.7, 2.3, 19), np.nan], (1.7135, 2.2865), 0.95, "undecided"),
        ([*np.linspace(1.7, 2.3, 18), np.nan, np.nan], (np.nan, np.nan), 0.9, "undecided"),
    ],
)
def test_sets_give_interval_and_agreeing_share(samples, ends, agreeing_share, verdict):
    """Ends are the percentiles 2.5 and 97.5 of evenly spaced samples; 1.5 to 2.5 agree."""
    row = judge(make_datasets(), samples, samples_from="sets")
    np.testing.assert_allclose([row.low, row.high], ends, atol=3e-3)
    assert (row.agreeing_share, row.verdict) == (pytest.approx(agreeing_share), verdict)


@pytest.mark.parametrize(
    ("middle_force", "interval", "verdict"),
    [
        (2.0, [1.8, 2.2], "reproduced"),
        (2.0, [1.0, 2.2], "undecided"),
        (0.5, [0.4, 0.6], "not reproduced"),
    ],
)
def test_an_order_needs_every_link(middle_force, interval, verdict):
    datasets = make_datasets()
    datasets["forces"]["force"].loc["middle"] = middle_force
    datasets["forces"]["force_interval"].loc["middle"] = np.array(interval)
    assert judge(datasets, **ORDER).verdict == verdict


def test_unselected_dimensions_take_the_worst_case():
    datasets = make_datasets()
    datasets["forces"]["change"][:] = [[1e-3, 1e-3, np.nan], [1e-3, 1e-3, 0.02], [1e-3] * 3]
    for rule, worst in (("below", 0.02), ("above", 1e-3)):
        assert judge(datasets, quantity="change", select="", rule=rule).computed == worst


def test_numbers_of_one_surface_are_selected_by_label():
    depth = {"dataset": "indent", "quantity": "depth", "select": "preload=20e-6;surface=rough"}
    assert judge(**depth).computed == 2
    assert judge_all(make_datasets(surfaces=["smooth", "middle"]), **depth).empty
    assert judge_all(make_datasets(), **depth | {"select": "preload=10e-6"}).empty


def test_a_claim_about_a_missing_surface_has_no_number():
    rows = pd.DataFrame([CLAIM, CLAIM | {"id": "other", "select": "surface=rough"}])
    datasets = make_datasets(surfaces=["smooth", "middle"])
    datasets["forces"] = datasets["forces"].expand_dims(set=3)
    numbers = claim_values(rows, datasets, CONSTANTS)
    assert numbers.dims == ("set", "claim")
    assert numbers["claim"].values.tolist() == ["claim", "other"]
    np.testing.assert_array_equal(numbers, [[2.0, np.nan]] * 3)


def test_a_claim_without_a_number_is_undecided():
    datasets = make_datasets()
    datasets["forces"]["force"][:] = np.nan
    row = judge(datasets)
    assert row.verdict == "undecided" and row.note == "No value exists."


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"rule": "close"}, "rule: expected interval, .* found 'close'"),
        ({"quantity": "colour"}, ".*colour"),
        ({"quantity": "range_exponent_of_force"}, ".*pull_off_force"),
        ({"quantity": "interaction_radius_at_fit"}, "expected sphere_radius, found none"),
        ({"dataset": "colours"}, "expected colours, found none"),
        ({"select": "phase=solid"}, ".*phase"),
        ({"select": ""}, "expected one number for the rule 'interval'"),
        ({"id": "two", "samples_from": "sets"}, "expected its values in sets.nc"),
    ],
)
def test_errors_name_the_claim(change, message):
    with pytest.raises(ValueError, match=f"claim {change.get('id', 'claim')}: {message}") as error:
        judge(**change)
    assert "\n" not in str(error.value)
