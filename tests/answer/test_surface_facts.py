"""The facts of an answer: edges and forces with intervals, statuses and sources."""

import numpy as np
import pytest
from answer_inputs import (
    MEASUREMENTS,
    SURFACES,
    WORK,
    continued,
    datasets,
    edges,
    fit,
    force,
    open_edges,
    setting,
    spectra,
)  # fmt: skip

from hardcontact.answer import surface_facts as facts
from hardcontact.answer.artificial import place_of_edge
from hardcontact.numbers.number import Number, plain


def rows(own=None, **others):
    """Rows of the first surface, by name."""
    of = datasets(**others).of_surface(SURFACES[0])
    return {row.fact.name: row for row in facts.answer_rows(of._replace(fit=own))}


def with_edge(edge, low, high, side="small"):
    data = edges()
    data["edge"].loc[{"side": side}] = edge
    data["edge_interval"].loc[{"side": side}] = [low, high]
    return data


def test_rows_hold_edges_and_forces_in_their_order():
    found = rows()
    assert list(found) == [
        "short_edge", "long_edge", "force_mean", "force_median", "force_middle", "smooth_sphere",
    ]  # fmt: skip
    short = found["short_edge"].fact
    assert short[1:] == (37.0, "nm", 29.6, 46.25, "", "artificial")
    assert found["long_edge"].fact.source == "measured"
    mean = found["force_mean"].fact
    assert (mean.value, mean.low, mean.high) == pytest.approx((0.64e-6, 0.512e-6, 0.8e-6))
    assert found["force_median"].fact.value == pytest.approx(0.95 * 0.64e-6)
    middle = found["force_middle"]
    assert (middle.fact.low, middle.fact.high) == pytest.approx((0.4 * 0.64e-6, 1.8 * 0.64e-6))
    assert middle.about["share"].value == pytest.approx(0.9)
    assert found["smooth_sphere"].fact.value == pytest.approx(2 * np.pi * 250e-6 * WORK)


@pytest.mark.parametrize(
    ("data", "source"),
    [
        (with_edge(100.0, 80.0, 130.0), "measured"),
        (with_edge(70.0, 40.0, 90.0), "partly_artificial"),
        (with_edge(100.0, np.nan, np.nan), "measured"),
    ],
)
def test_edges_have_their_place_among_artificial_wavelengths(data, source):
    assert rows(edges=data)["short_edge"].fact.source == source


def test_open_edges_are_bounds():
    found = rows(edges=open_edges())["long_edge"]
    bound = Number("long_edge", 2560.0, "nm", status="open_above", source="measured")
    assert plain(found.fact) == plain(bound)
    assert found.about["reason"] == "beyond the cell"
    below = open_edges()
    below["edge_at_least"].loc[{"side": "large"}] = 0
    assert rows(edges=below)["long_edge"].fact.status == "open_below"
    below["edge_bound"].loc[{"side": "large"}] = 30_000.0
    assert place_of_edge(below.isel(surface=0).sel(side="large"), [(25e3, np.inf)]) == "inside"


def test_an_edge_without_ends_is_not_bounded_only_where_ratios_have_intervals():
    data = with_edge(100.0, np.nan, np.nan)
    assert rows(edges=data)["short_edge"].fact.status == "not_bounded"
    bare = data.assign(scale_ratio_interval=data["scale_ratio_interval"] * np.nan)
    assert rows(edges=bare)["short_edge"].fact.status == ""
    half = rows(edges=with_edge(100.0, 80.0, np.nan))["short_edge"].fact
    assert (half.low, plain(half.high), half.status) == (80.0, None, "")


def test_forces_without_bounds_are_not_bounded():
    endless = force()
    endless["force_interval"].loc[{"bound": "low"}] = 0
    endless["force_interval"].loc[{"bound": "high"}] = np.inf
    fact = rows(force=endless)["force_mean"].fact
    assert np.isnan([fact.low, fact.high]).all() and fact.status == "not_bounded"


def test_continued_roughness_has_its_own_force_and_the_verdict_both():
    found = rows(force=continued(force(), small=0.25))
    row = found["force_continued"]
    assert row.fact.value == pytest.approx(0.16e-6) and row.fact.source == "extrapolated"
    assert row.about["side"] == "small" and row.about["start"].value == 20.0
    assert row.about["end"].value == 5.0
    least, most = facts.verdict(list(found.values()))["forces"]
    assert (least.value, most.value) == pytest.approx((0.16e-6, 0.64e-6)) and np.isnan(least.low)
    alike = facts.verdict(list(rows().values()))
    assert alike["forces"][0] == alike["forces"][1] and alike["edges"][0].value == 37.0


def test_own_forces_have_rows_of_their_surface_alone():
    found = rows(fit())
    assert found["measured_force"].fact.source == "measured"
    assert found["measured_force"].about == {"tests": 40, "lopsided": False}
    assert found["measured_work"].fact.value == pytest.approx(WORK)
    changed = fit()
    changed["continued_differs"].loc[{"side": "small"}] = 1
    assert rows(changed)["continued_work"].fact.value == pytest.approx(WORK / 2)
    assert "measured_force" not in rows(fit().assign_coords(surface=["other"]))


@pytest.mark.parametrize(("high", "told"), [(700.0, False), (900.0, True)])
def test_an_upper_end_that_few_tests_leave_open_is_told(high, told):
    data = fit()
    data["measured_force_interval"].loc[{"bound": "high"}] = 1e-9 * high
    assert rows(data)["measured_force"].about["lopsided"] is told


@pytest.mark.parametrize(("work", "told"), [(10.0, False), (50.8, True)])
def test_a_work_beyond_that_of_any_solids_is_told(work, told):
    data = fit()
    data["work_of_adhesion"] = data["work_of_adhesion"] * 0 + work
    assert rows(data)["measured_work"].about["beyond_solids"] is told


def test_pooled_edges_are_of_several_surfaces():
    assert facts.pooled_rows(edges()) == []
    short, long = facts.pooled_rows(edges(2))
    assert short.fact.name == "pooled_short_edge"
    assert (long.fact.value, long.fact.low, long.fact.high) == (1500.0, 1200.0, 1875.0)


def test_inputs_tell_where_they_come_from():
    sources = {one["name"]: one["source"] for one in facts.contact_inputs(setting())}
    assert sources == {
        "sphere": "assumed", "radius of the sphere": "given", "hardness": "assumed",
        "preload": "given",
    }  # fmt: skip
    rough = setting()._replace(contact={"sphere": "ball"})
    assert facts.contact_inputs(rough)[0]["source"] == "file"


def test_scans_that_are_alike_are_counted_together():
    many = {f"{n}.spm": MEASUREMENTS["coarse.spm"] for n in range(3)}
    data = spectra(measured=many | {"fine.spm": MEASUREMENTS["fine.spm"]}).sel(surface=SURFACES[0])
    several, one = facts.scan_inputs(data)
    assert (several["count"], several["kind"], one["count"]) == (3, "map", 1)
    assert plain(several["tip_radius"])["status"] == "not_known"
    assert one["tip_radius"].value == 10.0


def fit_status(data):
    return facts.fit_facts(facts.of_answer(data))


def test_fits_of_several_surfaces_have_a_region_or_a_reason_for_none():
    assert fit_status(fit())["status"] == "one_surface"
    both = fit_status(fit(2))
    assert both["status"] == "region" and both["gaps"] == []
    assert (both["best_range"].value, both["best_work"].value) == (5.6, WORK)
    assert (both["region_range"].low, plain(both["region_range"].high)) == (3.2, None)
    nothing = fit(2)
    nothing["region"] *= np.nan
    assert fit_status(nothing)["status"] == "none"
    nothing["work_of_adhesion_interval"] *= np.nan
    assert fit_status(nothing)["status"] == "no_interval"


def test_gaps_of_a_region_are_found():
    data = fit(2)
    data["region"][:] = 1.0
    data["region"].loc[{"rho": slice(2.0, 5.0)}] = np.nan
    ((low, high),) = fit_status(data)["gaps"]
    assert low < 2.0 and high > 5.0
