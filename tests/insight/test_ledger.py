"""The law over what is not stated: where all is known, it is the closed form."""

import numpy as np
import pytest
from known_experiments import KNOWN, experiment
from known_spectra import rough

from hardcontact.insight.closed_form import Contact, closed_form, smooth_force
from hardcontact.insight.experiments import Cell
from hardcontact.insight.ledger import cases, drawn, number_of_law, numbers_of_law
from hardcontact.numbers.random import generator

CONTACT = Contact(1e5, 5.6, 1.0, 400.0)


def of_law(one, errors=(1.0, 1.0)):
    """The number of the closed form for the first draw of an experiment."""
    draws = drawn(one, 3, generator(1))
    first = {name: values[0] for name, values in draws.items()}
    return number_of_law(one.statement, cases(one, first), errors)


def test_where_all_is_known_every_draw_is_the_same_contact():
    draws = drawn(experiment("fall", rough=10.0), 3, generator(1))
    for name, value in KNOWN.items():
        assert draws[name] == pytest.approx(value, rel=1e-12)
    assert draws["rougher_rms_height_nm"] == pytest.approx(10)


@pytest.mark.parametrize("statement", ["ratio_to_smooth", "fall", "exponent_in_radius"])
def test_where_all_is_known_the_number_is_that_of_the_closed_form(statement):
    found = closed_form(rough(), CONTACT).force
    given, expected = {}, found / smooth_force(CONTACT)
    if statement == "fall":
        given, expected = {"rough": 10.0}, found / closed_form(rough(10.0), CONTACT).force
    if statement == "exponent_in_radius":
        larger = closed_form(rough(), Contact(2e5, 5.6, 1.0, 400.0)).force
        given, expected = {"radius_nm": (1e5, 2e5)}, np.log2(larger / found)
    # Both spectra end at 20 nm, on another grid each.
    assert of_law(experiment(statement, **given)) == pytest.approx(expected, rel=0.03)


def test_a_distance_is_the_closest_approach():
    expected = closed_form(rough(), CONTACT).closest_approach
    assert of_law(experiment("contact_distance")) == pytest.approx(expected, rel=0.01)


def test_a_smooth_surface_has_the_ratio_one_and_the_exponent_one():
    smooth = {"rms_height_nm": 1e-4, "preload_nN": 1e-3}
    assert of_law(experiment("ratio_to_smooth", **smooth)) == pytest.approx(1, rel=1e-3)
    ends = experiment("exponent_in_radius", radius_nm=(1e4, 1e6), **smooth)
    assert of_law(ends) == pytest.approx(1, rel=1e-3)


def test_errors_multiply_forces_but_none_exceeds_that_of_a_smooth_sphere():
    ratio = experiment("ratio_to_smooth")
    assert of_law(ratio, (0.5,)) == pytest.approx(of_law(ratio) / 2)
    assert of_law(ratio, (1e6,)) == 1
    fall = experiment("fall", rough=10.0)
    assert of_law(fall, (0.5, 0.25)) == pytest.approx(2 * of_law(fall))


def test_a_contact_that_sticks_like_a_smooth_sphere_has_no_number():
    assert np.isnan(of_law(experiment("ratio_to_smooth", radius_nm=10.0)))


def test_an_unknown_roll_off_is_a_multiple_of_each_height():
    one = experiment("fall", rough=10.0)
    one.cells["rolloff_nm"] = Cell("unknown", 50.0, 50.0)
    draws = drawn(one, 2, generator(1))
    assert draws["rolloff_nm"] == pytest.approx(200) and draws["hurst"] == pytest.approx(0.8)
    assert draws["rougher_rolloff_nm"] == pytest.approx(500)


def test_the_error_of_the_law_is_known_where_it_was_tried():
    inside = experiment("ratio_to_smooth")
    numbers, tried = numbers_of_law(inside, drawn(inside, 4, generator(1)))
    assert tried.all() and 1 < numbers.max() / numbers.min() < 10
    tip = experiment("ratio_to_smooth", radius_nm=1e3)
    assert not numbers_of_law(tip, drawn(tip, 2, generator(1)))[1].any()


def test_what_is_missing_is_named():
    nan = float("nan")
    assert experiment("fall", measured=nan).missing == ["measured", "rougher_rms_height_nm"]
    assert experiment("exponent_in_radius").missing == ["two_radii"]
    assert experiment("ratio_to_smooth").missing == []
