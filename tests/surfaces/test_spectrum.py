"""Spectra: interpolation, rms values, models, and the spectrum measured on scans."""

from functools import partial

import numpy as np
import pytest
from measurements import levelled_scan, uncd_density

from hardcontact.base.arrays import generator
from hardcontact.surfaces.spectral_models import (
    isotropic_through_points,
    profile_over_isotropic,
    self_affine,
    smooth_rolloff,
    varying_hurst,
)
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum, all_scales_rms, measured_psds


def test_table_interpolates_power_laws_exactly_and_ends_in_zero():
    wave = np.geomspace(0.01, 10, 30)
    q = np.array([0.0, 0.001, 0.02, 0.333, 9.9, 10.1])
    density = Spectrum(wave, 5 * wave**-3.4)(q)
    power_law = 5 * np.array([0.01, 0.01, 0.02, 0.333, 9.9, np.nan]) ** -3.4
    np.testing.assert_allclose(density[:-1], power_law[:-1], rtol=1e-9)
    assert density[-1] == 0


def test_rms_values_of_a_band_are_its_integrals():
    # C_iso = 1 nm4 from q = 1 to 2: (1/2 pi) ∫ q^(1 + 2k) dq, the Laplacian's a quarter of it.
    q = np.geomspace(1, 2, 20_001)
    rms_values = all_scales_rms(Spectrum(q, np.ones_like(q)))
    squares = np.array([3 / 2, 15 / 4, 63 / 6 / 4]) / (2 * np.pi)
    np.testing.assert_allclose(rms_values, np.sqrt(squares), rtol=1e-6)


def test_scans_have_the_measured_psd_of_their_spectrum():
    psds = [measured_psds(levelled_scan(generator(3, k), 256)) for k in range(12)]
    wave, _, _ = psds[0]
    mean_density = np.mean([isotropic for _, _, isotropic in psds], axis=0)
    is_reliable = (wave > 0.03) & (wave < 0.3)
    ratio = mean_density[is_reliable] / uncd_density(wave[is_reliable])
    np.testing.assert_allclose(ratio, 1, atol=0.15)


def test_points_of_a_profile_give_their_power_law():
    wavelengths, hurst = np.array([66.0, 7.0, 24.0, 15.0]), 0.7
    isotropic = Spectrum(WAVEVECTORS, WAVEVECTORS ** (-2 - 2 * hurst))
    q = 2 * np.pi / wavelengths
    profile = isotropic(q) * profile_over_isotropic(q, hurst)
    density = isotropic_through_points(WAVEVECTORS, wavelengths, profile)
    np.testing.assert_allclose(density, isotropic.density, rtol=1e-6)


def test_a_varying_hurst_exponent_is_the_local_slope():
    q = 2 * np.pi / 2000.0 * np.array([10.0, 100.0])
    step = 1e-6
    log_densities = [
        np.log(varying_hurst(q * (1 + s), 1e10, 2000.0, 1.7, -0.5)) for s in (-step, step)
    ]
    exponent = (log_densities[1] - log_densities[0]) / (2 * step)
    np.testing.assert_allclose(-1 - exponent / 2, [1.2, 0.7], rtol=1e-5)


@pytest.mark.parametrize(
    ("density", "at_rolloff"),
    [
        (self_affine, 3.0),
        (smooth_rolloff, 3 * 2**-1.8),
        (partial(varying_hurst, hurst_change=0.0), 3.0),
    ],
)
def test_models_end_in_a_plateau_and_in_a_power_law(density, at_rolloff):
    values = density(2 * np.pi / 930.0 * np.array([1e-5, 1.0, 1e5]), 3.0, 930.0, 0.8)
    np.testing.assert_allclose(values, [3.0, at_rolloff, 3.0 * 1e5**-3.6], rtol=1e-9)
