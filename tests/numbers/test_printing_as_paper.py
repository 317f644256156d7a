"""Quantities as text: the right prefix, few digits, no exponents."""

import math

import pytest

from hardcontact.numbers.printing import is_boundless, print_as_paper


@pytest.mark.parametrize(
    ("value", "unit", "printed"),
    [
        (43.0, "nm", "43 nm"),
        (1800.0, "nm", "1.8 µm"),
        (999.4, "nm", "999 nm"),
        (999.6, "nm", "1 µm"),
        (-2500.0, "nm", "-2.5 µm"),
        (8.8e-6, "N", "8.8 µN"),
        (0.06e-6, "N", "0.06 µN"),
        (0.0463, "J/m2", "46.3 mJ/m²"),
        (135e6, "Pa", "135 MPa"),
        (25e9, "Pa", "25 GPa"),
        (0.0479, "nm-1", "0.0479 nm⁻¹"),
        (400.0, "nm2", "400 nm²"),
        (1234.5, "1", "1230"),
        (3.0, "furlong", "3 furlong"),
        (math.nan, "nm", ""),
    ],
)
def test_a_quantity_has_a_unit_that_suits_its_size(value, unit, printed):
    assert print_as_paper(value, unit) == printed


def test_an_interval_has_the_unit_of_its_number():
    assert print_as_paper(1664.0, "nm", (876.0, 2841.0)) == "1.66 [0.876, 2.84] µm"
    assert print_as_paper(0.18, "1", (0.15, 0.29)) == "0.18 [0.15, 0.29]"


@pytest.mark.parametrize("interval", [(math.nan, 2.0), (1.0, math.nan)])
def test_an_interval_without_both_ends_is_none(interval):
    assert print_as_paper(1.5, "nm", interval) == "1.5 nm"


def test_digits_are_as_asked():
    assert print_as_paper(67.23, "nm", (46.81, 74.11), digits=2) == "67 [47, 74] nm"


@pytest.mark.parametrize(
    ("value", "low", "high", "unit", "boundless"),
    [
        (5.9, 2.2, 350, "1", False),
        (5.9, 1e-9, 1e6, "1", True),
        (5.9, -4e3, 4e3, "1", True),
        (5.9, 0.01, 7, "1", True),
        (0.0, 0.0, 0.0, "1", False),
        # A number near zero is bounded by an interval that is narrow beside one, a length is not.
        (0.005, -0.6, 0.6, "1", False),
        (0.0, -0.6, 0.6, "1", False),
        (5.0, -1e3, 1e3, "nm", True),
    ],
)
def test_an_interval_that_reaches_far_beyond_its_number_bounds_nothing(
    value, low, high, unit, boundless
):
    assert is_boundless(value, low, high, unit) == boundless
