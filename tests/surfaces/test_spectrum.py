"""Spectra: published twins, moments, tables, what is measured of scans."""

import numpy as np
import pytest
from random_scans import UNCD, levelled_scan, measured_spectra, uncd
from refusals import assert_says, refusal

from hardcontact.numbers.random import generator
from hardcontact.records import dataset
from hardcontact.surfaces import spectrum
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum, measured_psds


def test_profile_and_isotropic_spectra_are_twins():
    # C_1D = 1.1e5 nm3 [1 + (q/q_r)^2]^-1.34 has C_iso = 6.1e7 nm4 [...]^-1.84: published pair.
    q = np.linspace(0, 400, 2_000_001) * 2 * np.pi / 930
    profile = np.trapezoid(uncd(q), q) / np.pi
    assert profile == pytest.approx(1.1e5, rel=0.01)


def test_table_interpolates_power_laws_exactly_and_ends_in_zero():
    wave = np.geomspace(0.01, 10, 30)
    q = np.array([0.0, 0.001, 0.02, 0.333, 9.9, 10.1])
    density = Spectrum(wave, 5 * wave**-3.4)(q)
    expected = 5 * np.array([0.01, 0.01, 0.02, 0.333, 9.9, np.nan]) ** -3.4
    np.testing.assert_allclose(density[:-1], expected[:-1], rtol=1e-9)
    assert density[-1] == 0


def test_moments_of_a_band_are_its_integrals():
    # C_iso = 1 nm4 from q = 1 to 2: (1/2 pi) ∫ q^(1 + 2k) dq, the Laplacian's a quarter of it.
    q = np.geomspace(1, 2, 20_001)
    moments = spectrum.all_scales_moments(Spectrum(q, np.ones_like(q)))
    squares = np.array([3 / 2, 15 / 4, 63 / 6 / 4]) / (2 * np.pi)
    np.testing.assert_allclose(moments, np.sqrt(squares), rtol=1e-6)


def test_measured_psd_of_scans_is_the_spectrum():
    wave, isotropic = measured_spectra(12, seed=3)
    middle = (wave > 0.03) & (wave < 0.3)
    ratio = isotropic[:, middle].mean(axis=0) / uncd(wave[middle])
    np.testing.assert_allclose(ratio, 1, atol=0.15)


def test_empty_bins_are_no_measurement():
    wave, *densities = measured_psds(levelled_scan(generator(8), 64, 20.0))
    outside = (wave < 2 * np.pi / (64 * 20.0) * 0.8) | (wave > 2 * np.pi / 40.0 * 1.5)
    for density in densities:
        assert np.isnan(density[outside]).all()
        assert (density[np.isfinite(density)] > 0).all()


def test_a_spectrum_comes_back_as_it_was_stored(tmp_path):
    dataset.write(spectrum.spectrum_dataset(UNCD.density), tmp_path / "a.nc")
    stored = spectrum.read_spectrum(tmp_path / "a.nc")
    np.testing.assert_array_equal(stored.wavevector, WAVEVECTORS)
    np.testing.assert_array_equal(stored.density, UNCD.density)


def test_a_missing_spectrum_is_one_clear_line(tmp_path):
    assert_says(refusal(spectrum.read_spectrum, tmp_path / "none.nc"), "none.nc: expected")
