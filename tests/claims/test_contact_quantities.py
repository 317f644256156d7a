"""Numbers about contact against closed forms."""

import numpy as np
import xarray as xr
from paper_claims import NUMBERS, near
from paper_datasets import make_adhesion, make_elastic, make_topography
from paper_numbers import SUBSTRATES

from hardcontact.claims.contact_quantities import (
    contact_height,
    deformation_over_adhesion,
    elastic_change,
    peak_over_hardness,
    plastic_contact_area,
    plastic_over_elastic_area,
    tabor_at_range,
)
from hardcontact.numbers.statistics import bounds


def test_contact_height_is_taken_scan_by_scan():
    height = contact_height(make_adhesion(), make_topography())
    assert set(height["surface"].values) == set(SUBSTRATES)
    near(height.sel(contact_model="plastic", surface="uncd"), 60 / 17.4)
    np.testing.assert_allclose(*bounds(height, "value"))  # apex and roughness scatter alike


def test_contact_pixels():
    near(plastic_contact_area(make_adhesion()), [100, 400])


def test_tabor_parameter_with_the_range_as_the_spacing():
    modulus = 289.7e9  # Pa, of ruby and diamond
    expected = np.cbrt(0.25e-3 * 0.0463**2 / (modulus**2 * 5.6e-9**3))
    own = np.cbrt(0.25e-3 * 0.0463**2 / (modulus**2 * 0.3e-9**3))
    near(tabor_at_range(xr.Dataset({"tabor_parameter": own}), NUMBERS), expected)


def test_elastic_contact():
    elastic = make_elastic()
    change = elastic_change(elastic)
    near(change, [0.01] * 4)
    np.testing.assert_allclose(bounds(change, "value")[1], 0.01)
    near(peak_over_hardness(elastic), [2.4, 2.8, 3.2, 3.2])
    area = np.mean(1 / np.array([0.98, 0.99, 1.0, 1.01, 1.02]))
    expected = np.array([400 / 300, 1.6, 2.0, 2.0]) * area
    near(plastic_over_elastic_area(elastic), expected)


def test_deformation_energy_of_one_wave():
    """E* q h²/8 of a wave of amplitude h; of many waves of the same length the same a height²."""
    q, height, modulus, work = 0.02, 3.0, 289.7e9, 0.0463
    wavevector = np.linspace(0.0199, 0.0201, 201)
    width = wavevector[1] - wavevector[0]
    spectrum = np.zeros((1, 1, 201))
    spectrum[0, 0, 100] = 2 * np.pi * height**2 / (q * width)  # h_rms² = 1/2π ∫ q C dq
    topography = xr.Dataset(
        {"psd_isotropic": (("surface", "scan", "wavevector"), spectrum)},
        {"surface": ["mcd"], "wavevector": wavevector},
    )
    elastic = make_elastic(["mcd"]).assign_attrs(effective_modulus=modulus, work_of_adhesion=work)
    amplitude = np.sqrt(2) * height
    expected = modulus * q * 1e9 * (amplitude * 1e-9) ** 2 / 8 / work
    near(deformation_over_adhesion(topography, elastic), [expected])


def test_deformation_needs_a_spectrum():
    topography = make_topography()
    topography["psd_isotropic"][1, 2:] = np.nan
    partly = deformation_over_adhesion(topography, make_elastic())
    full = deformation_over_adhesion(make_topography(), make_elastic())
    near(partly.sel(surface="uncd"), full["value"].sel(surface="uncd") * 0.985)
