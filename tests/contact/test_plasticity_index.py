"""Elastic area and plasticity index: Hertz, the plastic limit, and the solver on rough surfaces."""

from dataclasses import replace

import numpy as np
import pytest
from periodic_maps import RADIUS, over, periodic_noise
from published_contact import MODULUS

from hardcontact.contact.bearing_area import all_lowest_gaps
from hardcontact.contact.contact import Contact
from hardcontact.contact.elastic import contact_at_load
from hardcontact.contact.geometry import gap_map, gaps_at
from hardcontact.contact.smooth_sphere import hertz_contact
from hardcontact.insight.elastic_limit import SLOPE_OVER_PRESSURE, elastic_estimates, squared_slopes

LOAD = Contact(radius=RADIUS, preload=10e-6, hardness=25e9)


def only(estimates):
    (one,) = estimates.values()
    return one


@pytest.mark.parametrize("preload", [1e-6, 10e-6])
def test_a_smooth_sphere_is_hertz(preload):
    pixel_size = 5.0 * np.sqrt(preload / 10e-6)  # as many contact pixels at both
    load = replace(LOAD, preload=preload)
    pair = over(np.zeros((128, 128)), None, pixel_size, 256, 1)
    one = only(elastic_estimates(pair, load, MODULUS))
    radius = hertz_contact(preload, RADIUS, MODULUS).radius
    area = one.elastic_pixels * pixel_size**2
    assert np.sqrt(area / np.pi) == pytest.approx(radius, rel=0.01)
    assert len(one.contact.gaps) == one.elastic_pixels
    # The mean pressure of Hertz on a disc of radius r is 4 E* r/(3 pi R), the squared slope r²/2R²;
    # differences over a pixel p add p²/2R² to it.
    disc = np.sqrt(load.pixels(pixel_size) * pixel_size**2 / np.pi)
    slope = np.sqrt((disc**2 + pixel_size**2) / 2) / RADIUS
    expected = 4 * np.sqrt(2) / (3 * np.pi) * MODULUS * slope / load.hardness
    assert one.plasticity_index == pytest.approx(expected, rel=0.05) and one.plasticity_index < 1


def test_slope_over_pressure_is_that_of_a_parabola():
    # Mean of (r/R)² over a disc of radius a: a²/2R²; mean pressure of Hertz: 4 E* a/(3 pi R).
    assert 1 / SLOPE_OVER_PRESSURE == pytest.approx(4 / (3 * np.pi) * np.sqrt(2))


def test_squared_slope_of_a_plane_and_of_a_parabola():
    y, x = np.indices((64, 64))
    offsets = np.array([[3, 2], [-5, 7], [0, 0]])
    plane = over((0.3 * x - 0.4 * y) * 5.0, None, 5.0, 32, 1, radius=1e18)
    slopes = squared_slopes(plane, np.array([32, 32]), offsets)
    np.testing.assert_allclose(slopes, 0.25, rtol=1e-9)
    # One-sided slopes of u²p/2R along one axis: ((u + 1/2)² + (u - 1/2)²)/2 = u² + 1/4.
    ball = over(np.zeros((64, 64)), None, 5.0, 32, 1)
    expected = ((offsets**2).sum(axis=1) + 0.5) * (5.0 / RADIUS) ** 2
    np.testing.assert_allclose(squared_slopes(ball, np.array([0, 0]), offsets), expected, rtol=1e-9)


def test_gaps_at_offsets_are_those_of_the_whole_window():
    pair = over(periodic_noise(96, 5.0, 1), periodic_noise(70, 0.5, 2), 20.0, 200, 3)
    y, x = np.indices((200, 200)) - 100
    position = pair.geometry.positions[[2, 1]]
    np.testing.assert_allclose(
        gaps_at(pair, position, np.stack([y, x], -1)), gap_map(pair, (2, 1)), atol=1e-12
    )


def test_a_rough_surface_is_plastic():
    pair = over(periodic_noise(128, 40.0, 1), periodic_noise(128, 0.5, 2), 5.0, 320, 3)
    bearing = all_lowest_gaps(pair, LOAD.pixels(5.0))
    for place, one in elastic_estimates(pair, LOAD, MODULUS).items():
        assert one.plasticity_index > 1 and one.elastic_pixels <= len(bearing[place].gaps)
        np.testing.assert_array_equal(one.contact.gaps, bearing[place].gaps)
        np.testing.assert_array_equal(one.contact.offsets, bearing[place].offsets)


@pytest.mark.parametrize("rms", [0.1, 0.5, 2.0])
def test_the_index_says_which_area_is_larger(rms):
    pair = over(periodic_noise(128, rms, 4), None, 5.0, 320, 3)
    bearing = LOAD.pixels(5.0)
    for one in elastic_estimates(pair, LOAD, MODULUS).values():
        assert (one.plasticity_index >= 1) == (one.elastic_pixels <= bearing)


@pytest.mark.parametrize("rms", [0.5, 2.0])
def test_elastic_area_is_that_of_the_solver_within_a_factor_of_three(rms):
    # Elastic bodies touch beyond the lowest gaps, so the estimate is the smaller area.
    pair = over(periodic_noise(64, rms, 4), None, 5.0, 64, 1)
    one = only(elastic_estimates(pair, LOAD, MODULUS))
    pressure = contact_at_load(gap_map(pair, (0, 0)), 5.0, MODULUS, LOAD.preload).pressure
    assert 1 / 3 < one.elastic_pixels / np.count_nonzero(pressure) < 1
