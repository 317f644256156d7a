"""C_iso from C_1D: closed forms, numerical integration of spectra with bends, scatter."""

import numpy as np
import pytest
from measurements import profile_of
from random_scans import uncd

from hardcontact.numbers.random import generator
from hardcontact.surfaces.measured_spectrum import isotropic_from_profile, variance_of_log
from hardcontact.surfaces.spectrum import BIN_EDGES, profile_from_isotropic_power_law

BINS = np.sqrt(BIN_EDGES[1:] * BIN_EDGES[:-1])
MEASURED = BINS[(BINS > 1e-4) & (BINS < 2)]
MANY = np.full(MEASURED.shape, 1e3)


def two_slopes(q):
    """C_iso ~ q^-2.4 above and q^-4.4 below 600 nm."""
    return 1e6 / ((q / 0.01) ** 2.4 + (q / 0.01) ** 4.4)


def two_rolloffs(q):
    """A plateau, q^-4, a second plateau and q^-3.2 again: grains with roughness of their own."""
    return 1e7 / (1 + (q / 0.01) ** 4) + 10 * (1 + q / 0.3) ** -3.2


@pytest.mark.parametrize("hurst", [0.1, 0.5, 0.8, 1.0, 1.4])
def test_power_laws_are_converted_as_in_closed_form(hurst):
    profile = 3.0 * MEASURED ** (-1 - 2 * hurst)
    expected = profile / profile_from_isotropic_power_law(MEASURED, hurst)
    np.testing.assert_allclose(isotropic_from_profile(MEASURED, profile, MANY), expected, rtol=1e-3)


@pytest.mark.parametrize(
    ("density", "within"), [(two_slopes, 0.02), (uncd, 0.07), (two_rolloffs, 0.11)]
)
def test_bent_spectra_come_back_from_their_integrals(density, within):
    converted = isotropic_from_profile(MEASURED, profile_of(density, MEASURED), MANY)
    np.testing.assert_allclose(converted / density(MEASURED), 1, atol=within)


def test_scatter_is_not_amplified_and_empty_bins_stay_empty():
    # A line of 20 µm: half a wave in a bin at its longest wavelengths, a hundred at 100 nm.
    seen = MEASURED > 2 * np.pi / 20_000
    waves = np.maximum(0.37e3 * MEASURED[seen], 1)
    errors = []
    for k in range(50):
        scatter = generator(1, k).gamma(waves, 1 / waves)
        profile = profile_of(uncd, MEASURED[seen]) * scatter
        profile[[1, 3]] = np.nan
        converted = isotropic_from_profile(MEASURED[seen], profile, waves)
        np.testing.assert_array_equal(np.isnan(converted), np.isnan(profile))
        errors.append(np.log(converted / uncd(MEASURED[seen])))
    known = np.isfinite(profile)
    error = np.array(errors)[:, known]
    expected = np.sqrt(variance_of_log(waves[known]))
    assert np.median(error.std(axis=0) / expected) < 1.25
    # The median logarithm of one wave is -0.37, and the plateau falls in steps that scatter gives.
    bias = np.abs(np.median(error, axis=0))
    assert bias.max() < 1.1 and bias[waves[known] > 10].max() < 0.25
