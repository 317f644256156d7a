"""Numbers with units as they are printed."""

import numpy as np
import pytest

from hardcontact.numbers.printing import (
    print_formatted,
    print_length,
    print_number,
    print_quantity,
    print_share,
)


@pytest.mark.parametrize(
    ("value", "unit", "printed"),
    [
        (37.04, "nm", "37 nm"),
        (0.3, "nm", "0.3 nm"),
        (999.4, "nm", "999 nm"),
        (999.9, "nm", "1 µm"),
        (1736.0, "nm", "1.74 µm"),
        (2.5e6, "nm", "2.5 mm"),
        (6.4e-7, "N", "640 nN"),
        (1.28e-6, "N", "1.28 µN"),
        (3e-13, "N", "0.3 pN"),
        (0.0463, "J m-2", "46.3 mJ/m²"),
        (1.2, "J m-2", "1.2 J/m²"),
    ],
)
def test_quantities_have_three_digits_and_the_fitting_unit(value, unit, printed):
    assert print_quantity(value, unit) == printed


def test_an_interval_has_the_unit_of_its_value():
    assert print_quantity(900.0, "nm", 450.0, 1800.0) == "900 [450, 1800] nm"


@pytest.mark.parametrize("ends", [(np.nan, 3.0), (3.0, np.nan), (np.nan, np.nan), (3.0, np.inf)])
def test_an_interval_without_an_end_is_none(ends):
    assert print_quantity(3.0, "nm", *ends) == "3 nm"


def test_zero_has_the_smallest_unit():
    assert print_length(0.0) == "0 nm"


def test_an_interval_that_bounds_nothing_says_so():
    assert print_quantity(3.0, "nm", 0.0, np.inf) == "3 nm [not bounded]"
    assert print_quantity(1.5e-4, "N", 1.2e-7, 7.8e17) == "150 µN [not bounded]"
    assert print_quantity(3.0, "nm", 0.0, 5.0) == "3 [0, 5] nm"


def test_confidence_is_printed_in_percent():
    assert print_share(0.95) == "95 %"
    assert print_share(0.999) == "99.9 %"


def test_intervals_are_printed_where_there_are_any():
    error = {"value": 0.0561, "low": 0.045, "high": 0.0684}
    assert print_formatted(error, ".2g") == "0.056 [0.045, 0.068]"
    assert print_formatted({"value": 1.8, "low": np.nan, "high": np.nan}, ".2f") == "1.80"


def test_numbers_are_printed_without_exponent():
    printed = [print_number(length) for length in (5000.0, 99594.5, 12.6056, 0.1953)]
    assert printed == ["5000", "99600", "12.6", "0.195"]
