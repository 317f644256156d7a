"""Spectra joined from several scans of one surface, and samples of them."""

import numpy as np
import pytest
from measurements import gentle_density, measurement, random_line, random_map, two_sizes_and_a_line

from hardcontact.base.arrays import generator
from hardcontact.scans.extrapolation import HURST_SCATTER
from hardcontact.scans.joined_spectrum import (
    joined_spectrum,
    sample_curve,
    sample_spectra,
    smooth_curve,
)
from hardcontact.scans.measured_spectrum import (
    CALIBRATION_SCATTER,
    isotropic_psd,
    variance_of_log,
)
from hardcontact.surfaces.spectral_models import smooth_rolloff
from hardcontact.surfaces.spectrum import BIN_CENTRES, WAVEVECTORS


def test_two_maps_and_a_line_give_the_spectrum_of_the_surface():
    errors = []
    for seed in range(8):
        joined_data = joined_spectrum(two_sizes_and_a_line(seed), [None] * 3)
        wavevector = joined_data["bin_wavevector"].values
        errors.append(np.log(joined_data["joined_psd"].values / gentle_density(wavevector)))
    errors = np.array(errors)
    wavelength = 2 * np.pi / wavevector
    # Four pixels of the small map, a third of the line.
    is_measured = (wavelength > 16) & (wavelength < 40_000 / 3)
    is_finite = np.isfinite(errors[:, is_measured])
    assert is_finite.mean() > 0.95
    # The line alone reaches beyond 3 µm, with one wave in a bin, whose logarithm scatters by 1.3.
    assert np.abs(np.nanmean(errors[:, wavelength > 3000])) < 0.4
    has_few_waves = (wavelength > 1300) & (wavelength < 3000)
    has_many_waves = (wavelength > 16) & (wavelength < 1300)
    assert np.sqrt(np.nanmean(errors[:, has_few_waves] ** 2)) < 0.45
    assert np.sqrt(np.nanmean(errors[:, has_many_waves] ** 2)) < 0.15
    assert np.abs(np.nanmean(errors[:, has_many_waves], axis=0)).max() < 0.15
    assert not np.isfinite(errors[:, (wavelength < 15) | (wavelength > 14_000)]).any()


def test_bins_of_few_waves_are_smoothed_and_a_gap_is_bridged_between_them():
    errors, variances = [], []
    short = (2 * np.pi / WAVEVECTORS < 110) & (2 * np.pi / WAVEVECTORS > 13)
    for number in range(40):
        scan = random_map(generator(21, number), 128, 40.0, gentle_density)
        # Some 0.5 to 2 waves of the line are in a bin.
        line = random_line(generator(22, number), 76, 3.0, gentle_density)
        joined_data = joined_spectrum([scan, line], [None, None])
        density = joined_data["spectrum"].values[short]
        errors.append(np.log(density / gentle_density(WAVEVECTORS[short])))
        variances.append(np.trapezoid(density * WAVEVECTORS[short], WAVEVECTORS[short]))
    true = np.trapezoid(gentle_density(WAVEVECTORS[short]) * WAVEVECTORS[short], WAVEVECTORS[short])
    # Single bins scatter by 1.3, the logarithm of a single wave. Freed of the bias of the logarithm
    # their mean power is 1.8 times too large, the variance in a gap between them more.
    assert np.abs(np.mean(errors, axis=0)).max() < 0.25
    assert np.std(errors, axis=0).max() < 0.8
    assert np.mean(variances) == pytest.approx(true, rel=0.25)


def test_a_noise_floor_is_not_extrapolated():
    def surface(q):
        return smooth_rolloff(q, plateau=1e10, rolloff=10_000.0, hurst=0.8)

    wavelength = 2 * np.pi / WAVEVECTORS
    shorter = (wavelength < 50) & (wavelength > 1)
    largest_errors = []
    for seed in range(12):
        scan = random_map(generator(13, seed), 256, 10.0, surface)
        noise = generator(14, seed).normal(0, 3.0, scan.heights.shape)
        noisy = measurement(scan.heights + noise, 10.0)
        joined_data = joined_spectrum([noisy], [None])
        density = isotropic_psd(noisy)
        short = (2 * np.pi / BIN_CENTRES < 40) & np.isfinite(density)
        assert (density[short] > 50 * surface(BIN_CENTRES[short])).all()
        assert joined_data["limited_by"].values[0] == "noise"
        hurst, error = joined_data.attrs["tail_hurst"], joined_data.attrs["tail_hurst_error"]
        assert abs(hurst - 0.8) < 2.6 * error and error < 0.25
        ratio = joined_data["spectrum"].values[shorter] / surface(WAVEVECTORS[shorter])
        largest_errors.append(np.abs(np.log(ratio)).max())
    # The noise is ln 50 = 4 above the surface at 40 nm, and more at shorter wavelengths.
    assert np.median(largest_errors) < 1.0


def test_sampled_spectra_scatter_by_calibration_and_exponent():
    scans = [
        random_map(generator(24), 128, 8.0, gentle_density),
        random_map(generator(25), 128, 40.0, gentle_density),
    ]
    rngs = (generator(26, sample) for sample in range(100))
    spectra, factors = zip(*sample_spectra(rngs, scans, [1e-3, 1e-3]), strict=True)
    # At 40 nm only the small map is reliable, with hundreds of waves.
    log_power = np.log([spectrum(2 * np.pi / 40) for spectrum in spectra])
    log_factors = 2 * np.log(factors)  # on C_iso, the square of those on heights
    assert (log_power - log_factors[:, 0]).std() < 0.1
    assert log_factors.std() == pytest.approx(CALIBRATION_SCATTER, rel=0.2)
    log_tails = np.log([spectrum(2 * np.pi / np.array([4.0, 8.0])) for spectrum in spectra])
    # Over an octave, ln C changes by (2 + 2H) ln 2.
    exponents = (log_tails[:, 1] - log_tails[:, 0]) / np.log(2) / 2 - 1
    assert HURST_SCATTER < exponents.std() < 2 * HURST_SCATTER  # with the error of the fit


def test_a_given_tip_radius_overrides_that_of_the_file():
    scan = random_map(generator(15), 128, 5.0, tip_radius=20.0)
    radii = [joined_spectrum([scan], [radius])["tip_radius"].item() for radius in (None, 8.0)]
    assert radii == [20.0, 8.0]


def patterned_map(kind, seed):
    """Return a map of a grating or a step with roughness, or of the roughness alone."""
    rng, pixels, pixel = generator(61, seed), 192, 50.0
    position = np.arange(pixels) * pixel
    period, edge = pixels * pixel / rng.uniform(4, 12), pixels * pixel * rng.uniform(0.2, 0.8)
    heights = {
        "grating": 20 * np.cos(2 * np.pi * position / period),
        "square grating": 10 * np.sign(np.cos(2 * np.pi * position / period)),
        "step": 25.0 * (position > edge),
        "roughness": 0.0 * position,
    }[kind]
    roughness = random_map(
        rng, pixels, pixel, lambda q: smooth_rolloff(q, plateau=1e10, rolloff=1e5, hurst=0.8)
    )
    return measurement(heights + roughness.heights, pixel)


@pytest.mark.parametrize("kind", ["grating", "square grating", "step", "roughness"])
def test_a_joined_spectrum_keeps_the_variance_of_its_bins(kind):
    for seed in range(5):
        scan = patterned_map(kind, seed)
        joined_data = joined_spectrum([scan], [1e-3])
        is_reliable = joined_data["reliable"].values[0] == 1
        variance_per_log = BIN_CENTRES[is_reliable] ** 2 * joined_data["psd"].values[0, is_reliable]
        joined_variance_per_log = (
            BIN_CENTRES[is_reliable] ** 2 * joined_data["joined_psd"].values[is_reliable]
        )
        assert joined_variance_per_log.sum() == pytest.approx(variance_per_log.sum(), rel=1e-12)
        if "grating" in kind:  # The peak of a grating stays in its bin.
            peak = variance_per_log.argmax()
            assert joined_variance_per_log[peak] == pytest.approx(variance_per_log[peak], rel=0.05)


def test_sampled_curves_scatter_with_the_stated_variance():
    modes = np.where((BIN_CENTRES > 0.02) & (BIN_CENTRES < 0.3), 0.01 / BIN_CENTRES**2, 1.5)
    is_measured = (
        (BIN_CENTRES > 0.005) & (BIN_CENTRES < 2) & ~((BIN_CENTRES > 0.1) & (BIN_CENTRES < 0.3))
    )
    density = np.where(is_measured, gentle_density(BIN_CENTRES), np.nan)
    point_variance = np.where(is_measured, variance_of_log(modes), np.nan)
    wavevector, mean, variance = smooth_curve(density, point_variance)
    curves = [sample_curve(generator(23, sample), density, point_variance) for sample in range(400)]
    sampled_logs = np.log([curve.density for curve in curves])
    np.testing.assert_allclose(
        sampled_logs.std(axis=0), np.sqrt(variance - CALIBRATION_SCATTER**2), rtol=0.15
    )
    assert (
        np.abs(sampled_logs.mean(axis=0) - np.log(mean)) < 0.25 * sampled_logs.std(axis=0)
    ).all()
    # A power law has no bends: it is its own mean.
    power_law = np.where(is_measured, BIN_CENTRES**-3.0, np.nan)
    _, mean, _ = smooth_curve(power_law, point_variance)
    np.testing.assert_allclose(mean, wavevector**-3.0, rtol=1e-6)
