"""Spectra and random surfaces: Parseval, moments, PSD in = PSD out, calibration, masters."""

import numpy as np
import pandas as pd
import pytest
from scipy.stats import skew

from hardcontact import fourier, spectrum, synthesis, topography

PIXEL = 2500 / 512


def uncd(q):
    return spectrum.smooth_rolloff(q, 6.1e7, 930.0, 0.84)


def table(density):
    return spectrum.WAVEVECTORS, density(spectrum.WAVEVECTORS)


def measured_spectra(count, seed):
    """Wavevectors (bins,) and C_iso (scan, bins) of levelled scans of UNCD's spectrum."""
    isotropic = []
    for k in range(count):
        rng = synthesis.generator(seed, k)
        scan = synthesis.substitute_scan(rng, 256, PIXEL, 512, uncd, 0.0, 0.0)
        wave, _, density = spectrum.measure(topography.level(scan, PIXEL), PIXEL)
        isotropic.append(density)
    return wave, np.array(isotropic)


def grid_variance(density, pixels, pixel_size):
    """Variance that a spectrum has on a periodic grid (Parseval), its mean left out."""
    wave = 2 * np.pi * np.fft.fftfreq(pixels, pixel_size)
    modes = density(np.hypot(wave[:, None], wave))
    modes[0, 0] = 0
    return modes.sum() / (pixels * pixel_size) ** 2


def test_profile_and_isotropic_spectra_are_twins():
    # C_1D = 1.1e5 nm3 [1 + (q/q_r)^2]^-1.34 has C_iso = 6.1e7 nm4 [...]^-1.84: published pair.
    q = np.linspace(0, 400, 2_000_001) * 2 * np.pi / 930
    profile = np.trapezoid(uncd(q), q) / np.pi
    assert profile == pytest.approx(1.1e5, rel=0.01)


def test_profile_of_a_power_law_is_its_integral():
    q, hurst = 0.3, 0.7
    along = np.linspace(0, 600, 4_000_001)
    integral = np.trapezoid((q**2 + along**2) ** (-1 - hurst), along) / np.pi
    ratio = spectrum.profile_from_isotropic_power_law(q, hurst)
    assert ratio * q ** (-2 - 2 * hurst) == pytest.approx(integral, rel=1e-4)


def test_table_interpolates_power_laws_exactly_and_ends_in_zero():
    wave = np.geomspace(0.01, 10, 30)
    q = np.array([0.0, 0.001, 0.02, 0.333, 9.9, 10.1])
    found = spectrum.at(q, wave, 5 * wave**-3.4)
    expected = 5 * np.array([0.01, 0.01, 0.02, 0.333, 9.9, np.nan]) ** -3.4
    np.testing.assert_allclose(found[:-1], expected[:-1], rtol=1e-9)
    assert found[-1] == 0


def test_self_affine_height_is_the_moment_of_its_spectrum():
    q = np.geomspace(1e-6, 1e3, 200_001)
    moments = spectrum.all_scales_moments(q, spectrum.self_affine(q, 5e9, 2000.0, 0.8))
    assert moments[0] == pytest.approx(spectrum.self_affine_height(5e9, 2000.0, 0.8), rel=1e-4)
    assert moments[0] == pytest.approx(94, abs=0.5)  # the published model of NCD


def test_random_surface_has_the_variance_of_its_spectrum():
    variances = [
        synthesis.random_surface(synthesis.generator(1, k), 256, 20.0, uncd).var()
        for k in range(40)
    ]
    error = np.std(variances) / np.sqrt(len(variances))
    assert abs(np.mean(variances) - grid_variance(uncd, 256, 20.0)) < 4 * error
    assert abs(synthesis.random_surface(synthesis.generator(1), 64, 20.0, uncd).mean()) < 1e-5


def test_psd_in_is_psd_out_over_the_ensemble():
    pixels, size = 256, 5120.0
    mean = np.zeros((pixels, pixels // 2 + 1))
    for k in range(60):
        surface = synthesis.random_surface(synthesis.generator(2, k), pixels, size / pixels, uncd)
        mean += np.abs(np.fft.rfft2(surface)) ** 2 * (size / pixels**2) ** 2 / 60
    wave = (
        2
        * np.pi
        * np.hypot(
            np.fft.fftfreq(pixels, size / pixels)[:, None], np.fft.rfftfreq(pixels, size / pixels)
        )
    )
    for low, high in ((0.003, 0.01), (0.01, 0.03), (0.03, 0.1), (0.1, 0.15)):
        ring = (wave > low) & (wave < high)
        assert (mean[ring] / uncd(wave[ring])).mean() == pytest.approx(1, abs=0.05)


def test_measured_psd_of_scans_is_the_spectrum():
    wave, isotropic = measured_spectra(12, seed=3)
    middle = (wave > 0.03) & (wave < 0.3)
    ratio = np.nanmean(isotropic, axis=0)[middle] / uncd(wave[middle])
    np.testing.assert_allclose(ratio, 1, atol=0.15)


def test_expected_moments_are_those_of_scans():
    weights = spectrum.transfer_weights(1024, PIXEL, 256)
    expected = spectrum.expected_moments(*table(uncd), weights)
    found = []
    for k in range(6):
        surface = synthesis.random_surface(synthesis.generator(4, k), 1024, PIXEL, uncd)
        for i in range(0, 1024, 256):
            scan = topography.level(surface[i : i + 256, :256], PIXEL)
            metrics = topography.metrics(scan, PIXEL)
            found.append(
                [
                    metrics[name] ** 2
                    for name in ("rms_height", "rms_gradient", "rms_half_laplacian")
                ]
            )
    error = np.std(found, axis=0) / np.sqrt(len(found))
    assert (np.abs(np.mean(found, axis=0) - expected**2) < 4 * error).all()


def test_calibration_returns_the_spectrum_that_made_the_numbers():
    truth = (1.0e7, 800.0, 0.9)
    weights = spectrum.transfer_weights(1024, PIXEL, 256)
    moments = spectrum.expected_moments(*table(lambda q: spectrum.self_affine(q, *truth)), weights)
    values = [*moments, spectrum.self_affine_height(*truth)]
    published = pd.DataFrame(
        {"value": values, "uncertainty": np.array(values) * 0.1},
        index=list(spectrum.SELF_AFFINE_ROWS),
    )
    found = spectrum.calibrate_self_affine(published, weights)
    np.testing.assert_allclose(found, truth, rtol=0.02)


def test_calibration_refuses_what_no_self_affine_surface_is():
    weights = spectrum.transfer_weights(256, PIXEL, 64)
    published = pd.DataFrame(
        {"value": [1.0, 5.0, 1e-6, 50.0], "uncertainty": [0.01, 0.05, 1e-8, 0.5]},
        index=list(spectrum.SELF_AFFINE_ROWS),
    )
    with pytest.raises(ValueError, match="missed by"):
        spectrum.calibrate_self_affine(published, weights)


def test_tail_completes_slope_and_curvature():
    above = np.where(2 * np.pi / spectrum.WAVEVECTORS > 20, uncd(spectrum.WAVEVECTORS), 0)
    level = above[above > 0][-1]
    hurst, shortest = spectrum.calibrate_tail(above, 20.0, level, 1.17, 6.32)
    first = 2 * np.pi / 20.0
    tail = np.geomspace(first, 2 * np.pi / shortest, 5000)
    _, slope, curvature = spectrum.all_scales_moments(
        tail, level * (tail / first) ** (-2 - 2 * hurst)
    )
    _, slope_above, curvature_above = spectrum.all_scales_moments(spectrum.WAVEVECTORS, above)
    assert np.hypot(slope, slope_above) == pytest.approx(1.17, rel=1e-3)
    assert np.hypot(curvature, curvature_above) == pytest.approx(6.32, rel=1e-3)


def test_skewed_heights_keep_their_spectrum():
    surface = synthesis.random_surface(synthesis.generator(5), 512, PIXEL, uncd)
    heights = synthesis.skewed(surface, 0.54)
    np.testing.assert_allclose(
        np.abs(np.fft.rfft2(heights))[0, 1:], np.abs(np.fft.rfft2(surface))[0, 1:], rtol=1e-3
    )
    assert skew(heights, axis=None) == pytest.approx(0.54, abs=0.1)


def test_random_numbers_depend_on_the_purpose_alone():
    first = synthesis.generator(7, "uncd", 1).random()
    assert first == synthesis.generator(7, "uncd", 1).random()
    others = {
        synthesis.generator(7, "uncd", 2).random(),
        synthesis.generator(7, "ncd", 1).random(),
        synthesis.generator(8, "uncd", 1).random(),
    }
    assert first not in others and len(others) == 3


@pytest.fixture(scope="module")
def stitched():
    scan = synthesis.substitute_scan(synthesis.generator(6), 64, 20.0, 128, uncd, 0.0, 0.0)
    return topography.mirror_stitch(topography.level(scan, 20.0))


def band(heights, pixel_size, low, high):
    """The part with wavelengths between low and high, on the surface's own grid."""
    wave = 2 * np.pi * np.fft.fftfreq(heights.shape[0], pixel_size)
    radius = np.hypot(wave[:, None], wave)
    keep = (radius < 2 * np.pi / low * 0.999) & (radius > 2 * np.pi / high * 1.001)
    return np.fft.ifft2(np.fft.fft2(heights) * keep).real


def test_small_scale_master_keeps_the_scan_above_the_transition(stitched):
    quiet = spectrum.WAVEVECTORS, np.zeros_like(spectrum.WAVEVECTORS)
    master, fine = synthesis.small_scale_master(
        synthesis.generator(1), stitched, 20.0, 512, 100.0, quiet
    )
    assert fine == 5.0 and master.dtype == np.float32
    kept, _ = fourier.lowpass(stitched, 20.0, 100.0)
    np.testing.assert_allclose(master, fourier.interpolate(kept, 512), atol=1e-4)


def test_small_scale_master_adds_the_spectrum_below_and_a_plateau_above(stitched):
    # The scan's part set to zero: what is left is the added roughness alone.
    flat, added = np.zeros_like(stitched), []
    for k in range(8):
        master, fine = synthesis.small_scale_master(
            synthesis.generator(9, k), flat, 20.0, 512, 100.0, table(uncd)
        )
        added.append(master)
    pixels, size = 512, 512 * fine
    power = np.mean([np.abs(np.fft.fft2(m)) ** 2 for m in added], axis=0) * (size / pixels**2) ** 2
    wave = 2 * np.pi * np.fft.fftfreq(pixels, fine)
    radius = np.hypot(wave[:, None], wave)
    edge = 2 * np.pi / 100.0
    above = (radius < edge) & (radius > 0)
    below = (radius > edge) & (radius < 0.5)
    assert power[above].mean() == pytest.approx(uncd(edge), rel=0.1)
    assert (power[below] / uncd(radius[below])).mean() == pytest.approx(1, abs=0.05)


def test_large_scale_master_keeps_the_scan_below_the_transition(stitched):
    master, pixel_size = synthesis.large_scale_master(
        synthesis.generator(2), stitched, 20.0, 2, 500.0, table(uncd)
    )
    repeated = np.tile(stitched, (2, 2))
    assert master.shape == repeated.shape and pixel_size == 20.0
    np.testing.assert_allclose(
        band(master, 20.0, 40, 499), band(repeated, 20.0, 40, 499), atol=1e-3
    )
    difference = master - repeated
    np.testing.assert_allclose(band(difference, 20.0, 40, 499), 0, atol=1e-3)


def test_scan_to_scan_spread_fills_up_to_the_published_one():
    arguments = (256, PIXEL, 64, uncd)
    natural = synthesis.scan_to_scan_spread(synthesis.generator(3), *arguments, 1e-6)
    wide = synthesis.scan_to_scan_spread(synthesis.generator(3), *arguments, 0.5)
    assert natural == 0
    assert 0 < wide < np.sqrt(np.log1p(0.25))


def test_table1_is_turned_into_gradient_and_half_laplacian():
    rows = pd.DataFrame(
        {"value": [2.0, 3.0, 4.0], "uncertainty": [0.2, 0.3, 0.4]},
        index=["afm_rms_height", "afm_rms_slope", "all_rms_curvature"],
    )
    same = spectrum.as_gradient_and_half_laplacian(rows, "gradient", "half_laplacian")
    pd.testing.assert_frame_equal(same, rows)
    other = spectrum.as_gradient_and_half_laplacian(rows, "profile", "laplacian")
    np.testing.assert_allclose(other.value, [2, 3 * 2**0.5, 2])
    np.testing.assert_allclose(other.uncertainty, [0.2, 0.3 * 2**0.5, 0.2])


def test_empty_bins_are_no_measurement():
    scan = synthesis.substitute_scan(synthesis.generator(8), 64, 20.0, 128, uncd, 0.0, 0.0)
    wave, *densities = spectrum.measure(topography.level(scan, 20.0), 20.0)
    outside = (wave < 2 * np.pi / (64 * 20.0) * 0.8) | (wave > 2 * np.pi / 40.0 * 1.5)
    for density in densities:
        assert np.isnan(density[outside]).all()
        assert (density[np.isfinite(density)] > 0).all()


def test_spectrum_of_scans_continues_beyond_their_band():
    found = spectrum.from_scans(*measured_spectra(8, seed=10))
    assert np.isfinite(found).all() and (found > 0).all()
    middle = (spectrum.WAVEVECTORS > 0.03) & (spectrum.WAVEVECTORS < 0.3)
    ratio = found[middle] / uncd(spectrum.WAVEVECTORS[middle])
    np.testing.assert_allclose(ratio, 1, atol=0.35)
    # Constant at long wavelengths, and a decade below the pixels within what its slope allows.
    assert np.ptp(found[spectrum.WAVEVECTORS < 2 * np.pi / 2000]) == 0
    beyond = spectrum.at(6.0, spectrum.WAVEVECTORS, found)
    assert 1 / 3 < beyond / uncd(6.0) < 3
