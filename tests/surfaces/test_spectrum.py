"""Spectra: interpolation, rms values, models, and PSDs measured on scans."""

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


def test_a_power_law_is_constant_above_its_table_exact_in_it_and_zero_below():
    table_q = np.geomspace(0.01, 10, 30)
    power_law = Spectrum(table_q, 5 * table_q**-3.4)
    density = power_law(np.array([0.0, 0.001, 0.02, 0.333, 9.9]))
    expected_density = 5 * np.array([0.01, 0.01, 0.02, 0.333, 9.9]) ** -3.4
    np.testing.assert_allclose(density, expected_density, rtol=1e-9)
    assert power_law(10.1) == 0


def test_rms_values_of_a_band_are_its_integrals():
    # C_iso = 1 nm⁴ from q = 1 to 2: (1/2 pi) ∫ q^(1 + 2k) dq, a quarter for the half-Laplacian.
    q = np.geomspace(1, 2, 20_001)
    rms_values = all_scales_rms(Spectrum(q, np.ones_like(q)))
    squares = np.array([3 / 2, 15 / 4, 63 / 6 / 4]) / (2 * np.pi)
    np.testing.assert_allclose(rms_values, np.sqrt(squares), rtol=1e-6)


def test_the_mean_psd_of_scans_is_their_spectrum():
    psds = [measured_psds(levelled_scan(generator(3, k), 256)) for k in range(12)]
    q, _, _ = psds[0]
    mean_density = np.mean([isotropic for _, _, isotropic in psds], axis=0)
    is_reliable = (q > 0.03) & (q < 0.3)  # 21 to 210 nm
    ratio = mean_density[is_reliable] / uncd_density(q[is_reliable])
    np.testing.assert_allclose(ratio, 1, atol=0.15)


def test_the_power_law_of_points_of_a_profile_is_extrapolated():
    wavelengths, hurst = np.array([66.0, 7.0, 24.0, 15.0]), 0.7
    isotropic = Spectrum(WAVEVECTORS, WAVEVECTORS ** (-2 - 2 * hurst))
    q = 2 * np.pi / wavelengths
    profile = isotropic(q) * profile_over_isotropic(q, hurst)
    density = isotropic_through_points(WAVEVECTORS, wavelengths, profile)
    np.testing.assert_allclose(density, isotropic.density, rtol=1e-6)


def test_a_varying_hurst_exponent_changes_per_decade():
    q = 2 * np.pi / 2000.0 * np.array([10.0, 100.0])  # at a tenth and a hundredth of the roll-off
    step = 1e-6
    log_densities = [
        np.log(varying_hurst(q * factor, 1e10, 2000.0, hurst=1.7, hurst_change=-0.5))
        for factor in (1 - step, 1 + step)
    ]
    exponent = (log_densities[1] - log_densities[0]) / (2 * step)
    np.testing.assert_allclose(-1 - exponent / 2, [1.2, 0.7], rtol=1e-5)


@pytest.mark.parametrize(
    ("model", "density_at_rolloff"),
    [
        (self_affine, 3.0),
        (smooth_rolloff, 3 * 2**-1.8),  # 1 + (q/q_r)² = 2
        (partial(varying_hurst, hurst_change=0.0), 3.0),
    ],
)
def test_models_end_in_a_plateau_and_in_a_power_law(model, density_at_rolloff):
    q = 2 * np.pi / 930.0 * np.array([1e-5, 1.0, 1e5])
    density = model(q, plateau=3.0, rolloff=930.0, hurst=0.8)
    np.testing.assert_allclose(density, [3.0, density_at_rolloff, 3.0 * 1e5**-3.6], rtol=1e-9)
