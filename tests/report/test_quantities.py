"""Numbers of datasets as pages print them and as answer.json lists them."""

import numpy as np
import pytest
import xarray as xr

from hardcontact.base.number import Number
from hardcontact.report.quantities import (
    answer_json,
    bounds_only,
    in_words,
    number_of,
    quantity_mapping,
)

NAN = np.nan


def force(value, low, high):
    return xr.Dataset(
        {"force": ((), value, {"units": "N"}), "force_interval": ("bound", [low, high])},
        {"bound": ["low", "high"]},
    )


@pytest.mark.parametrize(
    ("low", "high", "status"),
    [(4e-7, 6e-7, ""), (NAN, NAN, "no_interval"), (1e-12, 6e-7, "not_bounded"),
     (0, np.inf, "not_bounded")],
)  # fmt: skip
def test_an_endless_interval_is_left_out(low, high, status):
    number = number_of(force(5e-7, low, high), "force")
    assert (number.value, number.unit, number.status) == (5e-7, "N", status)
    assert np.isfinite(number.low) == (status == "")


@pytest.mark.parametrize(
    ("number", "words"),
    [
        (Number("edge", 67.0, "nm", 47.0, 74.0), "67 [47, 74] nm"),
        (Number("edge", 67.0, "nm", 47.0, 74.0, "interval_open_high"), "67 [47, 74 or more] nm"),
        (Number("edge", 67.0, "nm", 47.0), "67 nm [above 47 nm]"),
        (Number("edge", 67.0, "nm", high=74.0), "67 nm [below 74 nm]"),
        (Number("edge", 67.0, "nm", status="few_parts"),
         "67 nm (not bounded: too few parts, which differ too much)"),
        (Number("edge", 2560.0, "nm", status="open_above"), "at least 2.56 µm"),
        (Number("edge", 20.0, "nm", status="open_below"), "at most 20 nm"),
        (Number("edge", NAN, "nm", status="no_band"), "no band"),
        (Number("edge", NAN, "nm"), "not known"),
        (bounds_only("size", 1.0, 2.0), "1 to 2"),
        (bounds_only("size", 1.0, NAN), "more than 1"),
        (bounds_only("size", NAN, 2.0), "at most 2"),
    ],
)  # fmt: skip
def test_a_number_is_printed_with_its_interval_and_status(number, words):
    assert in_words(number) == words


def test_two_quantities_of_one_name_are_refused():
    twice = [quantity_mapping(Number("force", 1.0)), quantity_mapping(Number("force", 2.0))]
    with pytest.raises(ValueError, match="expected quantities with different names"):
        answer_json({}, twice)
