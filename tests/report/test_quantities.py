"""Numbers of datasets as pages print them and as answer.json lists them."""

import json

import numpy as np
import pytest
import xarray as xr

from hardcontact.base.number import Number
from hardcontact.report.quantities import (
    all_quantities,
    answer_text,
    describe_number,
    describe_without_interval,
    number_of,
    number_without_value,
    numbers_of_answer,
)
from hardcontact.report.templates import render_note

NAN = np.nan


def force(value, low, high):
    """A dataset with a force (N) and its interval."""
    return xr.Dataset(
        {"force": ((), value, {"units": "N"}), "force_interval": ("end", [low, high])},
        {"end": ["low", "high"]},
    )


def test_an_endless_interval_is_left_out():
    number = number_of(force(5e-7, 0, np.inf), "force")
    assert (number.value, number.unit, number.status) == (5e-7, "N", "no_interval")
    assert np.isnan([number.low, number.high]).all()
    bounded = number_of(force(5e-7, 4e-7, 6e-7), "force")
    assert (bounded.low, bounded.high, bounded.status) == (4e-7, 6e-7, "")


@pytest.mark.parametrize(
    ("number", "words"),
    [
        (Number("edge", 67.0, "nm", 47.0, 74.0), "67 [47, 74] nm"),
        (Number("edge", 67.0, "nm", 47.0, 74.0, "interval_open_high"), "67 nm (at least 47 nm)"),
        (Number("edge", 67.0, "nm", 47.0), "67 nm (at least 47 nm)"),
        (Number("edge", 67.0, "nm", high=74.0), "67 nm (at most 74 nm)"),
        (Number("edge", 67.0, "nm", status="no_interval"), "67 nm (not bounded by these scans)"),
        (Number("edge", 2560.0, "nm", status="open_above"), "at least 2.56 µm"),
        (Number("edge", 20.0, "nm", status="open_below"), "at most 20 nm"),
        (Number("edge", NAN, "nm", status="no_band"), "not found: no cutoff changes the force"),
        (Number("edge", NAN, "nm"), "not known"),
        (number_without_value("size", 1.0, 2.0), "1 to 2"),
        (number_without_value("size", 1.0, NAN), "at least 1"),
        (number_without_value("size", NAN, 2.0), "at most 2"),
    ],
)  # fmt: skip
def test_a_number_is_printed_with_its_interval_and_status(number, words):
    assert describe_number(number) == words


@pytest.mark.parametrize(
    ("number", "words"),
    [
        (Number("edge", 269.4, "nm", 227.0, 270.0, "interval_open_high"), "269 nm"),
        (Number("edge", 269.4, "nm"), "270 nm"),
        (Number("edge", 269.4, "nm", 227.0), "270 nm"),
        (Number("edge", 2004.0, "nm", 1000.0, 2900.0), "2.0 µm"),
        (Number("edge", 2560.0, "nm", status="open_above"), "at least 2.6 µm"),
    ],
)
def test_a_number_without_its_interval_keeps_the_digits(number, words):
    assert describe_without_interval(number) == words


def test_two_quantities_of_one_name_are_refused():
    twice = all_quantities([Number("force", 1.0), Number("force", 2.0)], {})
    with pytest.raises(ValueError, match="expected quantities with different names"):
        answer_text({"quantities": twice})


def test_numbers_come_back_from_answer_json_as_they_were():
    numbers = [
        Number("edge", 67.0, "nm", 47.0, 74.0, "interval_open_high", "artificial"),
        Number("force", 5e-7, "N", source="measured"),
    ]
    text = answer_text({"quantities": all_quantities([], {"film": numbers})})
    read_again = numbers_of_answer(json.loads(text), "film")
    assert repr(list(read_again.values())) == repr(numbers)
    assert numbers_of_answer(json.loads(text)) == {}


def test_the_gravity_of_a_note_may_come_from_a_comparison_of_numpy():
    facts = {"grave": np.float64(0.5) < 0.9, "substitutes": ["UNCD"]}
    note = render_note("substitutes.txt", "caution", **facts)
    assert json.loads(json.dumps(note))["grave"] is True
