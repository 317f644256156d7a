"""Quantities of the configuration: a number and a unit, and nothing else."""

import pytest

from hardcontact.base import units


@pytest.mark.parametrize(
    "text, unit, value",
    [
        ("10 uN", "N", 1e-5),
        ("25GPa", "Pa", 25e9),
        ("1 Å", "nm", 0.1),
        ("72 erg/cm2", "J/m2", 0.072),
        ("-3 nm", "nm", -3),
        (".5 nm", "nm", 0.5),
        ("5. nm", "nm", 5),
        ("46.3 mJ/m²", "J/m2", 0.0463),
        ("50 mN/m", "J/m2", 0.05),
    ],
)
def test_a_quantity_becomes_a_number_in_its_unit(text, unit, value):
    assert units.parse_quantity(text, unit) == value


@pytest.mark.parametrize(
    "text",
    ["10", "nm", "", "ten nm", "10 N", "nan nm", "inf nm", "9**9**9 nm", "1e999 nm", "2*3 nm",
     "10 foo", "10 Nm", "10 nm2", "10 mmm", ". nm", "١ nm", 10,
     None, ["1 nm"], "__import__('os') nm"],
)  # fmt: skip
def test_values_that_are_no_lengths_are_refused_in_one_line(text):
    with pytest.raises(
        ValueError, match="expected a length with a unit, such as 5.6nm or 250um, found"
    ) as refusal:
        units.parse_quantity(text, "nm")
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize(
    ("value", "unit", "words"),
    [(250e3, "nm", "250 µm"), (0.35, "nm", "350 pm"), (0.0463, "J/m2", "46.3 mJ/m²")],
)
def test_quantities_are_printed_with_the_fitting_prefix(value, unit, words):
    assert units.format_exact(value, unit) == words
