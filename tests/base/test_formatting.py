"""Numbers with units as they are printed: the fitting prefix, few digits, no exponents."""

from math import inf, nan

import pytest

from hardcontact.base.formatting import (
    format_as_paper,
    format_estimate,
    format_quantity,
    format_value_and_ends,
    is_unbounded,
)


@pytest.mark.parametrize(
    ("value", "unit", "ends", "printed"),
    [
        (0.0, "nm", (nan, nan), "0 nm"),
        (999.9, "nm", (nan, nan), "1 µm"),
        (3e-13, "N", (nan, nan), "0.3 pN"),
        (0.0463, "J m-2", (nan, nan), "46.3 mJ/m²"),
        (900.0, "nm", (450.0, 1800.0), "900 [450, 1800] nm"),
        (3.0, "nm", (nan, 3.0), "3 nm"),
        (3.0, "nm", (3.0, inf), "3 nm"),
        (3.0, "nm", (0.0, 5.0), "3 [0, 5] nm"),
        (3.0, "nm", (0.0, inf), "3 nm [not bounded]"),
        (1.5e-4, "N", (1.2e-7, 7.8e17), "150 µN [not bounded]"),
        (3e-5, "N", (0.5e-6, 72.7e-6), "30 µN [not bounded]"),
        (3e-5, "N", (1e-6, 99e-6), "30 [1.0, 99] µN"),
    ],
)
def test_a_quantity_has_three_digits_or_those_of_its_interval(value, unit, ends, printed):
    assert format_quantity(value, unit, ends) == printed


@pytest.mark.parametrize(
    ("value", "unit", "ends", "printed"),
    [
        (-2500.0, "nm", (nan, nan), "-2.5 µm"),
        (0.06e-6, "N", (nan, nan), "0.06 µN"),
        (0.0479, "nm-1", (nan, nan), "0.0479 nm⁻¹"),
        (1234.5, "1", (nan, nan), "1230"),
        (3.0, "furlong", (nan, nan), "3 furlong"),
        (nan, "nm", (nan, nan), ""),
        (1664.0, "nm", (876.0, 2841.0), "1.7 [0.88, 2.8] µm"),
        (0.18, "1", (0.15, 0.29), "0.18 [0.15, 0.29]"),
        (1.1, "1", (0.9996, 1.4), "1.10 [0.9996, 1.40]"),
        (1.5, "nm", (1.0, nan), "1.5 nm"),
    ],
)
def test_a_quantity_of_the_paper_has_its_units(value, unit, ends, printed):
    assert format_as_paper(value, unit, ends) == printed


@pytest.mark.parametrize(
    ("numbers", "printed"),
    [
        ((1.00323, 0.9517, 1.05755), "1.00 0.95 1.06"),
        ((1.02286, 1.01793, 1.04247), "1.023 1.018 1.042"),
        ((59.4975, 47.1, 83.1), "59 47 83"),
        ((0.9, 0.5, 1.4), "0.9 0.5 1.4"),
        # The ends differ by more than three times: each number has two digits.
        ((157.0, 22.0, 1045.0), "160 22 1000"),
        ((88.6, 37.4, 202.0), "89 37 200"),
        ((0.00056, 0.000128, 0.00144), "0.00056 0.00013 0.0014"),
        # The interval contains zero.
        ((0.0877, -0.0912, 0.276), "0.09 -0.09 0.28"),
        ((0.2, -0.001, 0.3), "0.20 0.00 0.30"),
        # Ends stay on their side of the limits that follow; others are as above.
        ((3.4, 1.005, 7.7, 0, 1), "3.4 1.005 7.7"),
        ((0.2, -0.001, 0.3, 0, 1), "0.20 -0.001 0.30"),
        ((1.00323, 1 + 1e-9, 1.05755, 0, 1), "1.00 1.00 1.06"),
        ((5.9, 5.6, 6.12, 5.1, 6.1), "5.9 5.6 6.12"),
        ((17.4, 17.4, 17.4), "17.40 17.40 17.40"),
        ((0.0, 0.0, 0.0), "0 0 0"),
        ((1.234, 0.1, float("inf")), "1.2 0.1 inf"),
    ],
)
def test_the_width_of_an_interval_decides_the_digits(numbers, printed):
    assert " ".join(format_value_and_ends(*numbers)) == printed


def test_digits_are_as_asked_and_without_exponent():
    assert format_as_paper(67.23, "nm", digits=2) == "67 nm"
    assert format_estimate({"value": 0.0561, "low": 0.045, "high": 0.0684}, ".2g") == (
        "0.056 [0.045, 0.068]"
    )
    assert format_estimate({"value": 1.8, "low": nan, "high": nan}, ".2f") == "1.80"
    assert format_as_paper(99594.5, "1") == "99600"


@pytest.mark.parametrize(
    ("value", "low", "high", "unit", "unbounded"),
    [
        (5.9, 2.2, 200, "1", False),
        (5.9, 2.2, 350, "1", True),
        (-5.9, -350, -2.2, "1", True),
        (5.9, -4e3, 4e3, "1", True),
        (5.9, 0.01, 7, "1", True),
        # An interval narrow relative to 1 bounds a number near zero, but not a length.
        (0.005, -0.6, 0.6, "1", False),
        (5.0, -1e3, 1e3, "nm", True),
        (5.0, 0.0, 400.0, "nm", False),
        (5.0, nan, 600.0, "nm", False),
        (5.0, 0.1, inf, "nm", True),
    ],
)
def test_an_interval_far_beyond_its_number_is_unbounded(value, low, high, unit, unbounded):
    assert is_unbounded(value, low, high, unit) == unbounded
