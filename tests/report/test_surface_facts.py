"""The facts of an answer: edges and forces with intervals, statuses and sources."""

import numpy as np
import pytest
from answer_inputs import (
    PAIRS,
    SURFACES,
    WORK,
    datasets,
    drop_interval,
    edges,
    fit,
    force,
    move_edge,
    open_edges,
    scale_extrapolated_force,
    spectra,
    unresolved_edges,
)  # fmt: skip

from hardcontact.base.number import Number, plain
from hardcontact.inference.edges import computed_cutoffs
from hardcontact.report import force_facts
from hardcontact.report import surface_facts as facts
from hardcontact.report.artificial import classify_edge, parts_of_change


def rows(own_fit=None, **others):
    """Rows of the first surface, by name."""
    surface = datasets(**others).select_surface(SURFACES[0])
    return {row.fact.name: row for row in facts.answer_rows(surface._replace(fit=own_fit))}


@pytest.mark.parametrize(
    ("data", "source"),
    [
        (move_edge(120.0, 90.0, 150.0), ("measured", 90.0, 150.0)),
        (move_edge(70.0, 40.0, 90.0), ("partly_artificial", None, 90.0)),
        (move_edge(37.0, 20.0, 90.0), ("artificial", None, None)),
        (move_edge(120.0, np.nan, np.nan), ("measured", None, None)),
        (move_edge(120.0, 40.0, 150.0), ("interval_artificial", None, 150.0)),
    ],
)
def test_artificial_ends_of_intervals_are_left_out(data, source):
    fact = plain(rows(edges=data)["short_edge"].fact)
    assert (fact["source"], fact["low"], fact["high"]) == source


def test_the_change_at_an_edge_is_split_at_the_shortest_reliable_wavelength():
    # ln F is linear in ln c between 40 and 80 nm, and the scans begin at 55 nm.
    data = move_edge(80.0, 70.0, 90.0)
    low, high = np.log(data["filtered_force_ratio"].sel(side="small", cutoff_wavelength=[40, 80]))[
        0
    ].values
    unseen = low + (high - low) * np.log(55 / 40) / np.log(2)
    surface = datasets(edges=data).select_surface(SURFACES[0])
    np.testing.assert_allclose(
        parts_of_change(surface, "small", 0, 80), [high - unseen, unseen], 1e-4
    )
    assert rows(edges=data)["short_edge"].about["measured_share"].value == pytest.approx(
        1 - unseen / high, rel=1e-4
    )
    assert sum(parts_of_change(surface, "small")) == pytest.approx(np.log1p(0.1 * 4**4), rel=1e-4)


def test_open_edges_are_bounds():
    row = rows(edges=open_edges())["long_edge"]
    bound = Number("long_edge", 2560.0, "nm", status="open_above", source="measured")
    assert plain(row.fact) == plain(bound)
    lower_bound = open_edges()
    lower_bound["edge_status"].loc[{"side": "large"}] = "open_below"
    assert rows(edges=lower_bound)["long_edge"].fact.status == "open_below"
    lower_bound["edge_bound"].loc[{"side": "large"}] = 30_000.0
    assert (
        classify_edge(datasets(edges=lower_bound).select_surface(SURFACES[0]), "large") == "inside"
    )


@pytest.mark.parametrize(
    ("data", "advice"),
    [
        (move_edge(120.0, 90.0, 150.0), []),
        (move_edge(37.0, 20.0, 90.0), [("short_edge", "finer", 37.0)]),
        (move_edge(70.0, 40.0, 90.0), [("short_edge", "finer", 55.0)]),
        (unresolved_edges(), [("short_edge", "finer", 55.0), ("long_edge", "larger", 25_000.0)]),
    ],
)
def test_open_and_extrapolated_edges_recommend_a_measurement(data, advice):
    # The scans are reliable from 55 nm to 25 µm.
    measurements = facts.next_measurements(datasets(edges=data).select_surface(SURFACES[0]))
    assert [
        (measurement["edge"], measurement["code"], measurement["limit"].value)
        for measurement in measurements
    ] == advice


@pytest.mark.parametrize(
    ("status", "advice"), [("open_above", ("larger", 25_000.0)), ("open_below", ("finer", 55.0))]
)
def test_an_open_edge_recommends_finer_or_larger_scans(status, advice):
    data = open_edges()
    data["edge_status"].loc[{"side": "large"}] = status
    measurements = facts.next_measurements(datasets(edges=data).select_surface(SURFACES[0]))
    long = [
        (measurement["code"], measurement["limit"].value)
        for measurement in measurements
        if measurement["edge"] == "long_edge"
    ]
    assert long == [advice]


def test_an_edge_whose_interval_is_artificial_names_its_cutoffs():
    # The scans are reliable from 55 nm.
    row = rows(edges=move_edge(31.6, 20.0, 50.0))["short_edge"]
    cutoffs = computed_cutoffs(
        move_edge(31.6, 20.0, 50.0)["filtered_force_ratio"].sel(side="small")
    )
    low, high = row.about["cutoffs"].low, row.about["cutoffs"].high
    assert row.fact.status == "no_interval" and low < 31.6 <= high
    assert not ((low < cutoffs) & (cutoffs < high)).any()
    assert "cutoffs" not in rows(edges=move_edge(120.0, 90.0, 150.0))["short_edge"].about


def test_a_missing_interval_has_a_reason():
    data = move_edge(120.0, np.nan, np.nan)
    assert rows(edges=data)["short_edge"].fact.status == "few_parts"
    for source, status in {"none": "whole_scan", "few_places": "few_places"}.items():
        edges_without_interval = data.assign(interval_source=("surface", [source]))
        assert rows(edges=edges_without_interval)["short_edge"].fact.status == status
    half = rows(edges=move_edge(120.0, 90.0, np.nan))["short_edge"].fact
    assert (half.low, plain(half.high), half.status) == (90.0, None, "")
    assert rows(force=drop_interval(force()))["force_mean"].fact.status == "whole_scan"
    endless = force()
    endless["force_interval"].loc[{"bound": "low"}] = 0
    endless["force_interval"].loc[{"bound": "high"}] = np.inf
    fact = rows(force=endless)["force_mean"].fact
    assert np.isnan([fact.low, fact.high]).all() and fact.status == "few_parts"


def test_contacts_that_touch_too_few_places_give_no_answer():
    few_places = drop_interval(force()).assign(interval_source=("surface", ["few_places"]))
    verdict = facts.surface_verdict(list(rows(force=few_places).values()))
    assert (verdict["answer"], verdict["band"]) == ("no", "few_places")


def test_a_force_at_the_smooth_bound_is_marked():
    assert rows()["force_mean"].about["bounded"] is False
    smooth = force()
    smooth["smooth_bound"] = smooth["force"].isel(surface=0)
    assert rows(force=smooth)["force_mean"].about["bounded"] is True


def test_the_force_at_other_pairs_follows_a_power_law_within_the_ranges():
    surface = datasets().select_surface(SURFACES[0])
    assert rows()["range_sensitivity"].fact.value == pytest.approx(-0.5)  # F ~ rho^-0.5
    bounds_only, unknown = force_facts.pair_rows(
        surface.force, PAIRS
    )  # the one asked for has no row
    assert bounds_only.fact.value == pytest.approx(0.32e-6 * (10 / 5.6) ** -0.5)
    assert bounds_only.about["share"].value == 0.58 and bounds_only.about["range"].value == 10.0
    assert unknown.fact.status == "not_computed" and np.isnan(unknown.fact.value)
    one_range = force().sel(rho=[5.6])
    assert np.isnan(rows(force=one_range)["range_sensitivity"].fact.value)


def answer_of(data, wavelengths, force_data=None):
    """The verdict on edges with scans of these reliable wavelengths (nm)."""
    scan = ("map", 2 * wavelengths[1], 1, *wavelengths, "pixels", np.nan)
    answer_rows = rows(
        edges=data, spectra=spectra(scans={"scan.spm": scan}), force=force_data or force()
    )
    surface_verdict = facts.surface_verdict(list(answer_rows.values()))
    return surface_verdict["answer"], surface_verdict["band"]


@pytest.mark.parametrize(
    ("data", "wavelengths", "answer_and_band"),
    [
        (edges(), (6, 25e3), ("yes", "found")),
        (edges(), (55, 25e3), ("partly", "found")),
        (edges(), (400, 1000), ("no", "found")),
        (open_edges(), (6, 25e3), ("partly", "found")),
        (move_edge(3000.0, 2000.0, 4000.0), (6, 25e3), ("yes", "overlapping")),
        (unresolved_edges(), (6, 25e3), ("no", "none")),
    ],
)
def test_the_verdict_follows_from_the_edges_and_the_scans(data, wavelengths, answer_and_band):
    assert answer_of(data, wavelengths) == answer_and_band


def test_scans_that_lack_roughness_answer_in_part_at_most():
    assert (
        answer_of(edges(), (6, 25e3), scale_extrapolated_force(force(), small=0.25))[0] == "partly"
    )
    assert answer_of(edges(), (400, 1000), scale_extrapolated_force(force(), small=0.25))[0] == "no"


def test_the_verdict_has_the_force_with_and_without_extrapolated_roughness():
    row_by_name = rows(force=scale_extrapolated_force(force(), small=0.25))
    row = row_by_name["force_extrapolated"]
    assert row.fact.value == pytest.approx(0.16e-6) and row.fact.source == "extrapolated"
    assert row.about["side"] == "small" and row.about["start"].value == 20.0
    assert row.about["end"].value == 5.0
    forces = facts.surface_verdict(list(row_by_name.values()))["forces"]
    scan_force, extrapolated = (row.fact for row in forces)
    assert (scan_force.value, extrapolated.value) == pytest.approx((0.64e-6, 0.16e-6))
    assert scan_force.low == pytest.approx(0.512e-6)
    unknown = spectra().assign(tail_known=("surface", [0]))
    partial = facts.surface_verdict(
        list(rows(force=scale_extrapolated_force(force(), small=0.25), spectra=unknown).values())
    )
    assert [row.fact.name for row in partial["forces"]] == ["force_mean"]
    assert partial["answer"] == "partly"
    alike = facts.surface_verdict(list(rows().values()))
    assert len(alike["forces"]) == 1 and alike["edges"][0].value == 37.0


def test_own_forces_have_rows_only_for_their_surface():
    row_by_name = rows(fit())
    assert row_by_name["measured_force"].fact.source == "measured"
    assert row_by_name["measured_force"].about == {"tests": 40, "lopsided": False}
    assert row_by_name["measured_work"].fact.value == pytest.approx(WORK)
    different = fit()
    different["extrapolation_matters"].loc[{"side": "small"}] = 1
    assert rows(different)["extrapolated_work"].fact.value == pytest.approx(WORK / 2)
    assert "measured_force" not in rows(fit().assign_coords(surface=["other"]))


@pytest.mark.parametrize(("high", "is_lopsided"), [(700.0, False), (900.0, True)])
def test_a_lopsided_interval_of_few_tests_is_marked(high, is_lopsided):
    data = fit()
    data["measured_force_interval"].loc[{"bound": "high"}] = 1e-9 * high
    assert rows(data)["measured_force"].about["lopsided"] is is_lopsided


@pytest.mark.parametrize(("work", "is_beyond_solids"), [(10.0, False), (50.8, True)])
def test_a_work_beyond_that_of_solids_is_marked(work, is_beyond_solids):
    data = fit()
    data["work_by_range"] = data["work_by_range"] * 0 + work
    assert rows(data)["measured_work"].about["beyond_solids"] is is_beyond_solids


def fit_status(data):
    return force_facts.fit_facts(force_facts.preferred_fit(data))


def test_fits_of_several_surfaces_have_a_region_or_a_reason_for_none():
    assert fit_status(fit())["status"] == "one_surface"
    status = fit_status(fit(2))
    assert status["status"] == "region" and status["gaps"] == []
    assert (status["best_range"].value, status["best_work"].value) == (5.6, WORK)
    assert (status["region_range"].low, plain(status["region_range"].high)) == (3.2, None)
    assert status["allows_range"] and status["range"].value == 5.6
    short_range = fit(2).assign_attrs(assumed_range=1.0)  # the region begins at 3.2 nm
    assert not fit_status(short_range)["allows_range"]
    parted = fit(2)
    parted["region"].loc[{"rho_fine": slice(6, 9)}] = np.nan
    rho = parted["rho_fine"].values
    assert fit_status(parted)["gaps"] == [[rho[rho < 6].max(), rho[rho > 9].min()]]
    nothing = fit(2)
    nothing["region"] *= np.nan
    assert fit_status(nothing)["status"] == "none"
    nothing["work_by_range_interval"] *= np.nan
    assert fit_status(nothing)["status"] == "no_interval"
