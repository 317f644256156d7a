"""Regimes of surfaces whose spectra are known: limits in which one length decides."""

import numpy as np
import pytest
import xarray as xr
from known_spectra import rough

from hardcontact.insight.closed_form import (
    MANY_POINTS,
    SINGLE_PEAKS,
    SMOOTH,
    Contact,
    closed_form,
)
from hardcontact.insight.edge_scaling import (
    CONTACT,
    RANGE,
    REACH,
    ROLL_OFF,
    cause_exponents,
    edge_regimes,
)

SPHERE = Contact(radius=250e3, rho=5.6, work=1.0, area=400.0)


#: Small, so that edges are found soon.
TOLERANCE = 0.02


def regime(spectrum, contact=SPHERE):
    return edge_regimes({"a": spectrum}, contact, TOLERANCE).isel(surface=0)


def test_heights_below_the_range_average_and_heights_far_above_freeze():
    for rms, expected in ((3.0, MANY_POINTS), (100.0, SINGLE_PEAKS)):
        found = regime(rough(rms))
        assert found.regime.item() == expected
        ratio = (found.rough_height / SPHERE.rho) / (found.approach / found.rough_height)
        assert found.freezing.item() == pytest.approx(ratio.item())
        assert (found.freezing.item() > 1) == (expected == SINGLE_PEAKS)
        assert found.approach.item() == closed_form(rough(rms), SPHERE).closest_approach


def test_lengths_of_contact_and_attraction_are_those_of_their_circles():
    found = regime(rough())
    assert np.pi * found.contact_diameter.item() ** 2 / 4 == pytest.approx(SPHERE.area)
    assert found.attraction_reach.item() ** 2 == pytest.approx(2 * 250e3 * 5.6)


#: Without fine waves the closed form has few generations of summits, and is soon computed.
COARSE = {"shortest": 150.0}


def test_a_contact_wider_than_the_edge_sets_it():
    small = Contact(250e3, 5.6, 1.0, 1.0)
    large = Contact(250e3, 5.6, 1.0, 1e6)
    assert regime(rough(30.0, **COARSE), small).short_edge_from.item() == RANGE
    assert regime(rough(30.0, **COARSE), large).short_edge_from.item() == CONTACT


def test_the_shorter_of_reach_and_roll_off_stops_the_long_edge():
    for wavelength, expected in ((500.0, ROLL_OFF), (5000.0, REACH)):
        assert regime(rough(20.0, wavelength, **COARSE)).long_edge_from.item() == expected


def test_a_surface_without_roughness_has_no_edges():
    found = regime(rough(1e-6))
    assert found.regime.item() == SMOOTH and found.short_edge_from.item() == ""
    assert np.isnan(found.predicted_edge).all()


def test_exponents_are_those_of_edges_that_contact_and_range_set_by_turns():
    """Edges on three surfaces, c sqrt(area) or c rho, with c of the surface."""
    spectra = {name: rough(30.0, **COARSE) for name in "abc"}
    axes = {
        "surface": list("abc"),
        "radius": [1e5, 2e5],
        "area": [1.0, 4.0, 9.0, 1e6, 4e6, 9e6],
        "rho": [5.6, 8.0],
    }
    coordinates = xr.Dataset(coords=axes)
    of_contact = np.sqrt(coordinates["area"]) + 0 * coordinates["rho"] + 0 * coordinates["radius"]
    edge = of_contact.where(coordinates["area"] > 1e3, coordinates["rho"])
    edge = edge * xr.DataArray([1.0, 2.0, 5.0], {"surface": list("abc")})
    scaling = xr.Dataset(
        {"edge": edge, "contact_area": coordinates["area"]}, attrs={"confidence": 0.95}
    ).expand_dims(side=["small"])
    found = cause_exponents(scaling, spectra, SPHERE, TOLERANCE)
    assert found["cause_edges"].values.tolist() == [36, 36]
    for cause, expected in ((CONTACT, [0, 0, 1]), (RANGE, [0, 2, 0])):
        exponents = found["cause_exponent"].sel(cause=cause)
        np.testing.assert_allclose(exponents, expected, atol=1e-9)
        interval = found["cause_exponent_interval"].sel(cause=cause)
        np.testing.assert_allclose(interval, np.transpose([expected] * 2), atol=1e-6)
