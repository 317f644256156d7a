"""What would narrow an answer: each measurement is named where the answer lacks it, only there."""

import numpy as np
import pytest
from answer_inputs import (
    SURFACES,
    continued,
    datasets,
    edges,
    fit,
    force,
    open_edges,
    spectra,
    unresolved_edges,
)

from hardcontact.adhesion.finite_scan import LARGE_ENOUGH
from hardcontact.answer.next_measurements import WORTH, next_measurements


def proposed(own=None, **others):
    """All that is proposed, by code, in its order."""
    of = datasets(**others).of_surface(SURFACES[0])._replace(fit=own)
    return {one["code"]: one for one in next_measurements(of)}


def wide(data=None):
    """Forces whose scans show no roughness below 100 nm."""
    return (force() if data is None else data).assign(transition=("side", [100.0, 1000.0]))


def test_what_settles_an_edge_comes_first_and_own_forces_last():
    found = proposed(force=wide(), edges=open_edges())
    ranks = [WORTH.index(one["settles"]) for one in found.values()]
    assert ranks == sorted(ranks) and len(set(ranks)) == len(WORTH)
    assert list(found)[:2] == ["shorter_waves", "longer_waves"] and list(found)[-1] == "forces"


def test_the_wavelengths_between_short_edge_and_contact_scans_are_asked_for():
    # The edge is at 37 [29.6, 46.2] nm; scans are reliable from 55 nm, contacts' from 20 nm.
    found = proposed(force=wide())["shorter_waves"]
    assert [(band.low, band.high) for band in found["bands"]] == [(pytest.approx(29.6), 55.0)]
    assert not found["and_below"] and not found["settles_force"]
    assert "shorter_waves" not in proposed()  # roughness below 20 nm alone is artificial
    assert proposed(force=wide(continued(force(), small=0.25)))["shorter_waves"]["settles_force"]


def test_an_edge_that_may_be_shorter_asks_for_shorter_waves():
    data = edges()
    data["edge_interval"].loc[{"side": "small", "bound": "low"}] = np.nan
    found = proposed(force=wide(), edges=data)["shorter_waves"]
    assert found["and_below"] and found["bands"][0].low == 37.0


def test_a_long_edge_that_is_open_or_artificial_asks_for_longer_waves():
    data = edges()
    data["edge_interval"].loc[{"side": "large", "bound": "high"}] = 60e3  # the scans end at 25 µm
    assert "longer_waves" in proposed(edges=data) and "longer_waves" in proposed(edges=open_edges())
    assert "longer_waves" not in proposed()


def test_where_nothing_matters_a_finer_map_is_asked_for_and_no_larger_one():
    found = proposed(edges=unresolved_edges())
    assert next(iter(found)) == "shorter_waves"
    (band,) = found["shorter_waves"]["bands"]
    assert (band.status, band.high) == ("at_most", 55.0)
    assert not {"longer_waves", "larger_map"} & set(found)


def test_a_map_is_to_be_as_large_as_contacts_need():
    drawn = force().assign(draw_size=("surface", [4000.0]))
    found = proposed(force=drawn)["larger_map"]
    assert found["size"].value == 4000 * LARGE_ENOUGH
    large = datasets().topography.assign(scan_size=("surface", [4001 * LARGE_ENOUGH]))
    assert "larger_map" not in proposed(force=drawn, topography=large)


def test_pixels_are_to_resolve_the_contact():
    found = proposed()["finer_pixels"]  # 400 nm² on pixels of 10 nm
    assert found["size"].value == pytest.approx(np.sqrt(40)) and found["pixels"] == 10
    assert "finer_pixels" not in proposed(force=force().assign_attrs(contact_area=1000.0))


def test_more_places_are_asked_for_where_intervals_come_from_parts_of_a_scan():
    assert "more_places" not in proposed()
    assert "more_places" in proposed(force=force().assign(conditional=("surface", [1])))


def test_unknown_tips_and_missing_forces_are_named():
    assert {"tips", "forces"} <= set(proposed())
    sharp = spectra()
    sharp["tip_radius"] = sharp["tip_radius"].fillna(10.0)
    assert not {"tips", "forces"} & set(proposed(fit(), spectra=sharp))
