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


def test_span_holds_values_and_intervals_and_leaves_out_what_is_not_known():
    values = xr.DataArray([40.0, np.nan, 70.0], dims="surface")
    intervals = xr.DataArray(
        [[35.0, 50.0], [np.nan, np.nan], [60.0, 90.0]], dims=["surface", "bound"]
    )
    assert over_quartiles(values, intervals) == (35.0, 90.0)
    assert over_quartiles(values, intervals * np.nan) == (40.0, 70.0)


def test_sentence_gives_the_span_and_names_open_edges():
    given = described(["crn", "crn_lower", "crn_upper"])
    edges = given.edges.copy(deep=True)
    edges["edge"].loc[{"side": "small"}] = [40.0, 20.0, 60.0]
    edges["edge_interval"].loc[{"side": "small"}] = np.nan
    edges["edge_status"] = edges["edge_status"].astype(object)
    edges["edge_status"].loc[{"side": "large"}] = ["found", "open", "open"]
    (sentence,) = quartile_sentences(given._replace(edges=edges))
    assert "my coating (substitute), over the quartiles" in sentence
    assert "the short edge of the band from 20 nm to 60 nm, the long edge" in sentence
    assert "(2 of 3 edges are open: beyond what was computed), the mean force from" in sentence
