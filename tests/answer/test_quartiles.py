"""Quartiles beside a median: the span over surfaces, and which surfaces have quartiles."""

import numpy as np
import xarray as xr
from answer_inputs import datasets, topography

from hardcontact.answer.quartiles import (
    over_quartiles,
    quartile_sentences,
    surfaces_with_quartiles,
)


def described(names, basis="substitute"):
    """Return the datasets of surfaces that are copies of one, by these names."""
    one = datasets(1, topography=topography(1, basis))
    parts = (
        xr.concat([part] * len(names), "surface", data_vars="all").assign_coords(surface=names)
        for part in one[:4]
    )
    return type(one)(*parts)


def test_a_median_needs_both_quartiles_and_no_measurement():
    whole = ["crn", "crn_lower", "crn_upper"]
    assert surfaces_with_quartiles(described(whole)) == {"crn": whole}
    assert surfaces_with_quartiles(described(whole[:2])) == {}
    assert surfaces_with_quartiles(described(whole, "measured")) == {}
    assert quartile_sentences(described(whole[:2])) == []


def test_span_leaves_out_what_is_not_known():
    assert over_quartiles(xr.DataArray([[40.0, np.nan], [np.inf, 70.0]])) == (40.0, 70.0)
    assert np.isnan(over_quartiles(xr.DataArray([np.nan]))).all()


def with_edges(side, edges, bounds, texts, intervals):
    """Return datasets of a median and its quartiles with these edges (nm) at one side."""
    given = described(["crn", "crn_lower", "crn_upper"])
    changed = given.edges.copy(deep=True)
    for name, values in {
        "edge": edges, "edge_bound": bounds, "edge_text": texts, "edge_interval": intervals,
        "edge_status": np.where(np.isnan(edges), "beyond the cutoffs", "found"),
    }.items():  # fmt: skip
        numbers = name not in ("edge_text", "edge_status")
        changed[name] = changed[name].astype(float if numbers else object)
        changed[name].loc[{"side": side}] = values
    return given._replace(edges=changed)


NONE = [np.nan] * 3


def test_sentence_gives_the_median_its_quartiles_and_their_intervals():
    intervals = [[35.0, 50.0], [10.0, np.nan], [60.0, 90.0]]
    given = with_edges("small", [40.0, 20.0, 70.0], NONE, [""] * 3, intervals)
    (sentence,) = quartile_sentences(given)
    assert sentence.startswith("my coating (substitute), with the span over the quartiles")
    assert "short edge of the band 40 nm (20 nm to 70 nm; above 10 nm);" in sentence
    assert "; mean force " in sentence


def test_forces_without_bounds_have_none():
    given = described(["crn", "crn_lower", "crn_upper"])
    ends = given.force["force_interval"] * 0 + xr.DataArray([0.0, np.inf], dims="bound")
    (sentence,) = quartile_sentences(given._replace(force=given.force.assign(force_interval=ends)))
    assert "; intervals not bounded)." in sentence and "inf" not in sentence


def test_open_edges_are_bounds():
    unknown = [[np.nan] * 2] * 3
    bounds, texts = [np.nan, 8e3, 8e3], ["", "at least 8 µm", "at least 8 µm"]
    given = with_edges("large", [5e3, np.nan, np.nan], bounds, texts, unknown)
    (sentence,) = quartile_sentences(given)
    assert "long edge 5 µm (5 µm to at least 8 µm; intervals not bounded);" in sentence
    given = with_edges("large", NONE, [8e3] * 3, ["at least 8 µm"] * 3, unknown)
    (sentence,) = quartile_sentences(given)
    assert "long edge at least 8 µm (all three alike; intervals not bounded);" in sentence
