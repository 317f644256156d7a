"""The ratio of two forces, with the errors of both, and the octave that makes it."""

import numpy as np
import pytest
from answer_inputs import datasets, drop_interval, force, spectra

from hardcontact.report.own_surfaces.comparison import comparison_numbers

#: The shortest wavelength (nm) of an octave that scans show.
OCTAVE = 80.0
#: d ln F / d ln a of this octave.
SENSITIVITY = -0.9


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
