"""The index of slopes by shortest wavelength."""

import numpy as np
import pytest
from published_contact import MODULUS

from hardcontact.contact.elastic_limit import SLOPE_OVER_PRESSURE, pressure_over_hardness
from hardcontact.surfaces.spectrum import Spectrum, all_scales_rms


def test_a_parabola_has_the_slope_over_pressure_of_hertz():
    # Mean of (r/R)² over a disc of radius a: a²/2R²; mean pressure of Hertz: 4 E* a/(3 pi R).
    assert 1 / SLOPE_OVER_PRESSURE == pytest.approx(4 / (3 * np.pi) * np.sqrt(2))


def test_every_octave_of_a_fourth_power_adds_the_same_to_the_squared_slope():
    q = np.geomspace(1e-3, 10, 401)
    spectra = {"flat": Spectrum(q, 5 * q**-4.0), "cut": Spectrum(q, 5 * q**-4.0 * (q < 0.1))}
    index = pressure_over_hardness(spectra, MODULUS, 25e9)
    slope = index * SLOPE_OVER_PRESSURE * 25e9 / MODULUS
    closed_form_slope = np.sqrt(5 * np.log(q / q[0]) / (2 * np.pi))
    np.testing.assert_allclose(
        slope.sel(surface="flat")[::-1], closed_form_slope, rtol=1e-6, atol=1e-9
    )
    for name, spectrum in spectra.items():
        total_slope = all_scales_rms(spectrum)[1]
        assert slope.sel(surface=name)[0] == pytest.approx(total_slope)
    cut_slope = slope.sel(surface="cut")
    assert cut_slope.sel(shortest_wavelength=60, method="nearest") == pytest.approx(cut_slope[0])
