"""Quartiles beside a median: the span over surfaces, and which surfaces have quartiles."""

import numpy as np
import xarray as xr
from answer_inputs import datasets, topography

from hardcontact.answer.surface_facts import quartile_spans, surfaces_with_quartiles

WHOLE = ["crn", "crn_lower", "crn_upper"]


def described(names=WHOLE, basis="substitute"):
    """Return the datasets of surfaces that are copies of one, by these names."""
    one = datasets(1, topography=topography(1, basis))
    parts = (
        xr.concat([part] * len(names), "surface", data_vars="all").assign_coords(surface=names)
        for part in one[:4]
    )
    return type(one)(*parts)


def with_edges(side, edges, bounds, intervals):
    """Return datasets of a median and its quartiles with these edges (nm) at one side."""
    given = described()
    changed = given.edges.copy(deep=True)
    status = np.where(np.isnan(edges), "beyond the cutoffs", "found")
    changed["edge_status"] = changed["edge_status"].astype(object)
    for name, values in {
        "edge": edges, "edge_bound": bounds, "edge_interval": intervals, "edge_status": status,
        "edge_at_least": np.isnan(edges).astype(int),
    }.items():  # fmt: skip
        changed[name].loc[{"side": side}] = values
    return given._replace(edges=changed)


def test_a_median_needs_both_quartiles_and_no_measurement():
    assert surfaces_with_quartiles(described()) == {"crn": WHOLE}
    assert surfaces_with_quartiles(described(WHOLE[:2])) == {}
    assert surfaces_with_quartiles(described(WHOLE, "measured")) == {}
    assert quartile_spans(described(WHOLE[:2])) == []


def test_spans_are_of_the_median_its_quartiles_and_their_intervals():
    intervals = [[35.0, 50.0], [10.0, np.nan], [60.0, 90.0]]
    given = with_edges("small", [40.0, 20.0, 70.0], [np.nan] * 3, intervals)
    short, long, force = quartile_spans(given)
    assert short.surface == "my coating (substitute)"
    assert [one.value for one in short[1:4]] == [40.0, 20.0, 70.0]
    assert (short.intervals.low, short.intervals.status) == (10.0, "more_than")
    assert long.least == long.most and long.intervals.status == "between"
    assert force.fact.name == "force_mean" and np.isnan(force.fact.low)


def test_forces_without_bounds_have_none():
    given = described()
    ends = given.force["force_interval"] * 0 + xr.DataArray([0.0, np.inf], dims="bound")
    *_, force = quartile_spans(given._replace(force=given.force.assign(force_interval=ends)))
    assert force.intervals.status == "not_bounded" and force.least.status == ""
