"""C_iso of single maps and line scans: closed forms, scatter, slopes."""

import numpy as np
import pytest
from measurements import PIXEL, measurement, profile_density, random_line, random_map, uncd_density
from scipy.ndimage import gaussian_filter1d

from hardcontact.base.arrays import generator
from hardcontact.scans.measured_spectrum import (
    axis_ratio,
    independent_modes,
    isotropic_from_profile,
    isotropic_psd,
    local_slopes,
    variance_of_log,
)
from hardcontact.surfaces.spectral_models import profile_over_isotropic
from hardcontact.surfaces.spectrum import BIN_CENTRES


def test_a_tilt_does_not_change_the_spectrum():
    for scan in (random_map(generator(2), 64, PIXEL), random_line(generator(2), 300, PIXEL)):
        tilted = measurement(scan.heights + 3.0 * np.arange(scan.heights.shape[-1]), PIXEL)
        np.testing.assert_allclose(isotropic_psd(tilted), isotropic_psd(scan), rtol=1e-6)


def test_line_scans_have_the_spectrum_of_their_surface():
    lines = [random_line(generator(3, k), 1000, 10.0) for k in range(40)]
    ratio = np.mean([isotropic_psd(line) for line in lines], axis=0) / uncd_density(BIN_CENTRES)
    wavelength = 2 * np.pi / BIN_CENTRES
    is_reliable = np.isfinite(ratio) & (wavelength > 40) & (wavelength < lines[0].size / 3)
    np.testing.assert_allclose(np.log(ratio[is_reliable]), 0, atol=0.5)
    assert np.median(ratio[is_reliable]) == pytest.approx(1, abs=0.07)


@pytest.mark.parametrize("kind", ["map", "line scan"])
def test_spectra_scatter_by_their_number_of_independent_modes(kind):
    if kind == "map":
        scans = [random_map(generator(4, k), 64, 20.0) for k in range(100)]
    else:
        scans = [random_line(generator(5, k), 256, 20.0) for k in range(100)]
    logs = np.log([isotropic_psd(scan) for scan in scans])
    wavelength = 2 * np.pi / BIN_CENTRES
    is_reliable = (
        np.isfinite(logs).all(axis=0) & (wavelength > 60) & (wavelength < scans[0].size / 3)
    )
    modes = independent_modes(kind, scans[0].size)
    predicted_scatter = np.sqrt(variance_of_log(modes[is_reliable]))
    assert np.median(logs.std(axis=0)[is_reliable] / predicted_scatter) == pytest.approx(
        1, abs=0.25
    )


def test_power_laws_have_known_local_slopes_and_errors():
    wavevector = np.geomspace(0.01, 10, 31)
    variance = np.full(31, 0.1)
    slope, error = local_slopes(wavevector, wavevector**-3.3, variance)
    np.testing.assert_allclose(slope, -3.3, atol=1e-9)
    rng = generator(6)
    scatter = np.exp(rng.normal(0, 0.1**0.5, (400, 31)))
    noisy = [local_slopes(wavevector, wavevector**-3.3 * factor, variance)[0] for factor in scatter]
    np.testing.assert_allclose(np.std(noisy, axis=0) / error, 1, atol=0.15)


def test_axes_differ_where_the_lines_of_a_scan_are_smoothed():
    scan = random_map(generator(7), 256, PIXEL)
    isotropic_ratio = axis_ratio(scan)
    smoothed = measurement(gaussian_filter1d(scan.heights, 3.0, axis=1), PIXEL)
    wavelength = 2 * np.pi / BIN_CENTRES
    short = (wavelength > 4 * PIXEL) & (wavelength < 8 * PIXEL)
    assert (isotropic_ratio[short] < 1.2).all() and (axis_ratio(smoothed)[short] > 4).all()
    np.testing.assert_allclose(
        axis_ratio(measurement(smoothed.heights.T, PIXEL)), axis_ratio(smoothed)
    )
    assert (axis_ratio(random_line(generator(8), 100, PIXEL)) == 1).all()


BINS = BIN_CENTRES[(BIN_CENTRES > 1e-4) & (BIN_CENTRES < 2)]  # rad/nm
MANY_MODES = np.full(BINS.shape, 1e3)


def two_slopes(q):
    """C_iso ~ q^-2.4 above and q^-4.4 below 600 nm."""
    return 1e6 / ((q / 0.01) ** 2.4 + (q / 0.01) ** 4.4)


def rolloff_with_finer_roughness(q):
    """A plateau, then q^-4, which bends to about q^-3.2 where finer roughness prevails."""
    return 1e7 / (1 + (q / 0.01) ** 4) + 10 * (1 + q / 0.3) ** -3.2


@pytest.mark.parametrize("hurst", [0.1, 0.5, 0.8, 1.0, 1.4])
def test_converted_power_laws_match_the_closed_form(hurst):
    profile = 3.0 * BINS ** (-1 - 2 * hurst)
    density = profile / profile_over_isotropic(BINS, hurst)
    np.testing.assert_allclose(
        isotropic_from_profile(BINS, profile, MANY_MODES), density, rtol=1e-3
    )


@pytest.mark.parametrize(
    ("density", "tolerance"),
    [(two_slopes, 0.02), (uncd_density, 0.07), (rolloff_with_finer_roughness, 0.11)],
)
def test_bent_spectra_are_recovered_from_their_profiles(density, tolerance):
    converted = isotropic_from_profile(BINS, profile_density(density, BINS), MANY_MODES)
    np.testing.assert_allclose(converted / density(BINS), 1, atol=tolerance)
