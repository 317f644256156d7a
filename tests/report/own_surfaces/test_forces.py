"""Computed forces of the user's surfaces, and their ratios."""

import numpy as np
import pytest
from answer_inputs import (
    FORCE,
    PAIRS,
    RANGE,
    SURFACES,
    datasets,
    drop_interval,
    force,
    numbers_of,
    spectra,
)

from hardcontact.report.own_surfaces.forces import comparison_numbers, pair_numbers

#: The shortest wavelength (nm) of an octave that scans show.
OCTAVE = 80.0
#: d ln F / d ln a of this octave.
SENSITIVITY = -0.9


def test_the_force_at_other_pairs_follows_a_power_law_within_the_ranges():
    surface = datasets().select_surface(SURFACES[0])
    numbers = {number.name: number for number in pair_numbers(surface.force, PAIRS)}
    long_range = numbers["force_of_pair_long_range"]
    # The pair has half the work, and F ~ W rho^-0.5.
    assert long_range.value == pytest.approx(FORCE / 2 * (10 / RANGE) ** -0.5)
    assert numbers["force_of_pair_long_range_share"].value == PAIRS[1]["share_of_sets"]
    assert numbers["force_of_pair_long_range_range"].value == 10.0
    assert np.isnan(numbers["force_of_pair_short_range"].value)
    assert "force_of_pair_published" not in numbers  # the pair of the study itself


def test_the_sensitivity_to_the_range_needs_two_ranges():
    assert numbers_of()["range_sensitivity"].value == pytest.approx(-0.5)
    one_range = force().sel(rho=[5.6])
    assert np.isnan(numbers_of(force=one_range)["range_sensitivity"].value)


def compare(**others):
    data = datasets(2, **others)
    reference, twin = (data.select_surface(name) for name in data.force["surface"].values)
    return {number.name: number for number in comparison_numbers(twin, reference)}


def test_the_errors_of_both_forces_add_in_squares():
    ratio = compare()["force_over_reference"]
    assert ratio.value == pytest.approx(2)
    error = np.exp(np.sqrt(2) * np.log(1.25))
    assert (ratio.low, ratio.high) == pytest.approx((2 / error, 2 * error))
    assert compare(force=drop_interval(force(2)))["force_over_reference"].status == "no_interval"


def test_the_octave_whose_amplitude_differs_makes_the_ratio():
    data = spectra(2)
    wavelength = 2 * np.pi / data["wavevector"]
    is_octave = (wavelength >= OCTAVE) & (wavelength <= 2 * OCTAVE)
    is_twin = data["surface"] == data["surface"][1]
    data["spectrum"] = data["spectrum"] * (1 - 0.75 * (is_octave & is_twin))  # half the amplitude
    numbers = compare(spectra=data)
    name = "force_over_reference_octave_1"
    assert numbers[name].value == OCTAVE
    assert numbers[f"{name}_factor"].value == pytest.approx(0.5**SENSITIVITY, rel=0.03)
