"""Spectra joined of several measurements of one surface."""

import numpy as np
import pytest
from measurements import gentle_density, measurement, random_line, random_map, two_sizes_and_a_line

from hardcontact.base.arrays import generator
from hardcontact.scans.extrapolation import HURST_SCATTER
from hardcontact.scans.joined_spectrum import joined_spectrum, sample_spectra
from hardcontact.scans.measured_spectrum import CALIBRATION_SCATTER, isotropic_psd
from hardcontact.scans.reliable_band import reliable_band
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
        line = random_line(
            generator(22, number), 76, 3.0, gentle_density
        )  # some 0.5 to 2 waves in a bin
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
    rngs = (generator(26, draw) for draw in range(100))
    spectra, factors = zip(*sample_spectra(rngs, scans, [1e-3, 1e-3]), strict=True)
    # At 40 nm only the small map is reliable, with hundreds of waves.
    power = np.log([spectrum(2 * np.pi / 40) for spectrum in spectra]) - 2 * np.log(factors)[:, 0]
    assert power.std() < 0.1 and 2 * np.log(factors).std() == pytest.approx(
        CALIBRATION_SCATTER, rel=0.2
    )
    tails = np.log([spectrum(2 * np.pi / np.array([4.0, 8.0])) for spectrum in spectra])
    exponents = (tails[:, 1] - tails[:, 0]) / np.log(2) / 2 - 1
    assert HURST_SCATTER < exponents.std() < 2 * HURST_SCATTER  # and the error of the fit


def test_a_given_tip_radius_overrides_that_of_the_file():
    scan = random_map(generator(15), 128, 5.0, tip_radius=20.0)
    radii = [joined_spectrum([scan], [radius])["tip_radius"].item() for radius in (None, 8.0)]
    assert radii == [20.0, 8.0]


def test_only_reliable_wavelengths_are_joined():
    scans = two_sizes_and_a_line(10)
    noise = generator(11).normal(0, 10.0, scans[0].heights.shape)
    scans[0] = measurement(scans[0].heights + noise, scans[0].pixel_size)
    joined_data = joined_spectrum(scans, [None] * 3)
    wavelength = 2 * np.pi / joined_data["bin_wavevector"].values
    for number, scan in enumerate(scans):
        band = reliable_band(scan, None, isotropic_psd(scan))
        measurement_data = joined_data.isel(measurement=number)
        is_in_band = (wavelength >= band.shortest) & (wavelength <= band.longest)
        np.testing.assert_array_equal(
            measurement_data["reliable"] == 1, is_in_band & np.isfinite(measurement_data["psd"])
        )
    assert joined_data["limited_by"].values[0] == "noise"
