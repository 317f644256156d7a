"""Calibration: fits return what made the numbers, tails add what is missing, rows are read."""

import numpy as np
import pandas as pd
import pytest
from random_scans import PIXEL, UNCD

from hardcontact.records import published
from hardcontact.records.published import rows_met
from hardcontact.surfaces import spectrum as spectral_models
from hardcontact.surfaces import substitute_spectra as calibration
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum, all_scales_moments
from hardcontact.surfaces.substitute_spectra import expected_moments, transfer_weights


def rows(values):
    """Table 1 of one surface: the rows that fix the spectrum of scans."""
    return pd.DataFrame({"value": values}, index=list(spectral_models.AFM_ROWS))


def band(model, rolloff=np.nan):
    """A band of a description whose other parameters are left to Table 1."""
    return pd.Series({"model": model, "rolloff_nm": rolloff})


@pytest.fixture(scope="module")
def weights():
    return transfer_weights(1024, PIXEL, 256)


def scans_of(density, weights):
    """Table 1 of a surface whose scans have this spectrum."""
    return rows(expected_moments(Spectrum(WAVEVECTORS, density), weights))


def test_a_self_affine_spectrum_is_found_again(weights):
    truth = (1.0e7, 800.0, 0.9)
    table1 = scans_of(spectral_models.self_affine(WAVEVECTORS, *truth), weights)
    parameters = calibration.calibrate_model(band("self-affine"), table1, weights)
    assert list(parameters) == ["plateau_nm4", "rolloff_nm", "hurst"]
    np.testing.assert_allclose(list(parameters.values()), truth, rtol=1e-6)


def test_a_varying_hurst_exponent_is_found_again(weights):
    truth = spectral_models.varying_hurst(WAVEVECTORS, 1.0e10, 2000.0, 1.6, -0.5)
    table1 = scans_of(truth, weights)
    found = calibration.calibrate_model(band("varying Hurst", 2000.0), table1, weights)
    assert list(found) == ["plateau_nm4", "hurst", "hurst_change"]
    np.testing.assert_allclose(list(found.values()), (1.0e10, 1.6, -0.5), rtol=1e-6)


def test_no_self_affine_spectrum_has_the_scans_of_ncd(at_root):
    table = published.table1("resources/paper/table1.csv")
    ncd = calibration.rows_of_surface(table, "ncd", "gradient", "half_laplacian")
    with pytest.raises(ValueError, match="expected three numbers .* missed by .* %"):
        calibration.calibrate_model(band("self-affine"), ncd, transfer_weights(2048, PIXEL, 512))


@pytest.fixture
def above():
    """UNCD's spectrum on WAVEVECTORS down to 20 nm."""
    return np.where(2 * np.pi / WAVEVECTORS > 20, UNCD.density, 0)


@pytest.mark.parametrize("moments", [(1.17, 6.32), (1.0, 4.0), (0.9, 5.9)])
def test_a_tail_completes_slope_and_curvature(above, moments):
    tail = spectral_models.power_law_tail(above, *calibration.calibrate_tail(above, *moments))
    found = all_scales_moments(Spectrum(WAVEVECTORS, above + tail))[1:]
    np.testing.assert_allclose(found, moments, rtol=1e-9)


@pytest.mark.parametrize(
    ("moments", "message"),
    [
        ((0.01, 6.32), "slope and curvature above .* found 0.01 and 6.32"),
        ((0.5, 200.0), "that a power law below .* can add, found 0.5 and 200"),
    ],
)
def test_a_tail_refuses_what_it_cannot_add(above, moments, message):
    with pytest.raises(ValueError, match=message):
        calibration.calibrate_tail(above, *moments)


def test_table1_is_turned_into_gradient_and_half_laplacian():
    table = pd.DataFrame(
        {
            "surface": ["uncd", "uncd", "uncd", "mcd"],
            "quantity": ["afm_rms_height", "afm_rms_slope", "all_rms_curvature", "afm_rms_slope"],
            "value": [2.0, 3.0, 4.0, 9.0],
            "uncertainty": [0.2, 0.3, 0.4, 0.9],
        }
    )
    same = calibration.rows_of_surface(table, "uncd", "gradient", "half_laplacian")
    np.testing.assert_array_equal(same.value, [2, 3, 4])
    other = calibration.rows_of_surface(table, "uncd", "profile", "laplacian")
    assert list(other.index) == ["afm_rms_height", "afm_rms_slope", "all_rms_curvature"]
    np.testing.assert_allclose(other.value, [2, 3 * 2**0.5, 2])
    np.testing.assert_allclose(other.uncertainty, [0.2, 0.3 * 2**0.5, 0.2])
    assert calibration.rows_of_surface(table, "my own", "gradient", "laplacian").empty


def test_rows_that_calibrate_are_rows_of_the_published_table(at_root):
    table = published.table1("resources/paper/table1.csv")
    for _, of_surface in table.groupby("surface"):
        assert {*spectral_models.AFM_ROWS, *spectral_models.TAIL_ROWS} == set(
            of_surface.quantity
        ) - {"all_rms_height"}


def test_rows_met_are_those_named():
    assert rows_met("afm_rms_height,all_rms_slope") == ["afm_rms_height", "all_rms_slope"]
    assert rows_met("") == []
