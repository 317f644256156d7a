"""Models of spectra: twins, integrals, local exponents, tails that continue what is above them."""

import numpy as np
import pytest

from hardcontact.surfaces import spectrum as spectral_models
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum, all_scales_moments


def test_profile_of_a_power_law_is_its_integral():
    q, hurst = 0.3, 0.7
    along = np.linspace(0, 600, 4_000_001)
    integral = np.trapezoid((q**2 + along**2) ** (-1 - hurst), along) / np.pi
    ratio = spectral_models.profile_from_isotropic_power_law(q, hurst)
    assert ratio * q ** (-2 - 2 * hurst) == pytest.approx(integral, rel=1e-4)


def test_points_of_a_profile_give_the_power_law_they_lie_on():
    wavelengths, hurst = np.array([66.0, 7.0, 24.0, 15.0]), 0.7
    isotropic = Spectrum(WAVEVECTORS, WAVEVECTORS ** (-2 - 2 * hurst))
    q = 2 * np.pi / wavelengths
    profile = isotropic(q) * spectral_models.profile_from_isotropic_power_law(q, hurst)
    density = spectral_models.profile_points(WAVEVECTORS, wavelengths, profile)
    np.testing.assert_allclose(density, isotropic.density, rtol=1e-6)


def test_published_model_of_ncd_has_its_published_height():
    q = np.geomspace(1e-6, 2 * np.pi / 72, 200_001)
    table = Spectrum(q, spectral_models.self_affine(q, 5e9, 2000.0, 0.8))
    assert all_scales_moments(table)[0] == pytest.approx(94, abs=0.5)


def test_without_change_a_varying_hurst_exponent_is_a_self_affine_spectrum():
    np.testing.assert_allclose(
        spectral_models.varying_hurst(WAVEVECTORS, 1e7, 800.0, 0.9, 0.0),
        spectral_models.self_affine(WAVEVECTORS, 1e7, 800.0, 0.9),
        rtol=1e-10,
    )


def test_a_varying_hurst_exponent_is_that_of_the_power_law_at_each_wavelength():
    q = 2 * np.pi / 2000.0 * np.array([10.0, 100.0])
    step = 1e-6
    around = [
        np.log(spectral_models.varying_hurst(q * (1 + s), 1e10, 2000.0, 1.7, -0.5))
        for s in (-step, step)
    ]
    exponent = (around[1] - around[0]) / (2 * step)
    np.testing.assert_allclose(-1 - exponent / 2, [1.2, 0.7], rtol=1e-5)


@pytest.fixture
def above():
    """A power law of H = 0.8 down to 20 nm."""
    return np.where(2 * np.pi / WAVEVECTORS > 20, WAVEVECTORS**-3.6, 0)


def test_a_tail_continues_the_power_law_above_it(above):
    tail = spectral_models.power_law_tail(above, 0.8, 1.0)
    inside = 2 * np.pi / WAVEVECTORS > 1.1
    np.testing.assert_allclose((above + tail)[inside], WAVEVECTORS[inside] ** -3.6, rtol=1e-9)
    assert (tail[2 * np.pi / WAVEVECTORS < 0.9] == 0).all()


def test_a_tail_grows_evenly_with_its_end(above):
    ends = np.geomspace(1.0, 0.99, 101)
    curvatures = [
        all_scales_moments(Spectrum(WAVEVECTORS, spectral_models.power_law_tail(above, 0.8, end)))[
            2
        ]
        for end in ends
    ]
    assert (np.diff(curvatures) >= 0).all()
    assert np.diff(curvatures).max() < 0.02 * curvatures[0]
