"""Calibration: expected moments are those of scans, fits return what made the numbers."""

import numpy as np
import pandas as pd
import pytest
from random_scans import PIXEL, UNCD, uncd

from hardcontact import published
from hardcontact.random import generator
from hardcontact.surfaces import calibration, spectrum
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum
from hardcontact.surfaces.substitute_scans import substitute_scan
from hardcontact.surfaces.synthesis import random_surface
from hardcontact.surfaces.topography import level, metrics

MOMENTS = ("rms_height", "rms_gradient", "rms_half_laplacian")


def rows(values, uncertainties):
    """Table 1 of one surface: the rows that fix a self-affine spectrum."""
    return pd.DataFrame(
        {"value": values, "uncertainty": uncertainties}, index=list(calibration.SELF_AFFINE_ROWS)
    )


def test_expected_moments_are_those_of_scans():
    weights = calibration.transfer_weights(1024, PIXEL, 256)
    expected = calibration.expected_moments(uncd, weights)
    squares = []
    for k in range(6):
        surface = random_surface(generator(4, k), 1024, PIXEL, uncd)
        for start in range(0, 1024, 256):
            strip = type(surface)(surface.heights[start:], PIXEL, True, "substitute")
            values = metrics(level(substitute_scan(generator(0), strip, 256)))
            squares.append([values[name] ** 2 for name in MOMENTS])
    error = np.std(squares, axis=0) / np.sqrt(len(squares))
    assert (np.abs(np.mean(squares, axis=0) - expected**2) < 4 * error).all()


def test_calibration_returns_the_spectrum_that_made_the_numbers():
    truth = (1.0e7, 800.0, 0.9)
    weights = calibration.transfer_weights(1024, PIXEL, 256)
    moments = calibration.expected_moments(lambda q: spectrum.self_affine(q, *truth), weights)
    values = np.array([*moments, spectrum.self_affine_height(*truth)])
    parameters = calibration.calibrate_self_affine(rows(values, 0.1 * values), weights)
    np.testing.assert_allclose(parameters, truth, rtol=0.02)


def test_calibration_refuses_what_no_self_affine_surface_is():
    weights = calibration.transfer_weights(256, PIXEL, 64)
    impossible = rows([1.0, 5.0, 1e-6, 50.0], [0.01, 0.05, 1e-8, 0.5])
    with pytest.raises(ValueError, match="expected Table 1 of a self-affine surface, .* missed by"):
        calibration.calibrate_self_affine(impossible, weights)


@pytest.fixture
def above():
    """UNCD's spectrum on WAVEVECTORS down to 20 nm."""
    return np.where(2 * np.pi / WAVEVECTORS > 20, UNCD.density, 0)


def test_tail_completes_slope_and_curvature(above):
    start = above[above > 0][-1]
    hurst, shortest = calibration.calibrate_tail(above, 20.0, start, (1.17, 6.32))
    first = 2 * np.pi / 20.0
    wave = np.geomspace(first, 2 * np.pi / shortest, 5000)
    tail = Spectrum(wave, start * (wave / first) ** (-2 - 2 * hurst))
    _, slope, curvature = spectrum.all_scales_moments(tail)
    _, slope_above, curvature_above = spectrum.all_scales_moments(Spectrum(WAVEVECTORS, above))
    assert np.hypot(slope, slope_above) == pytest.approx(1.17, rel=1e-3)
    assert np.hypot(curvature, curvature_above) == pytest.approx(6.32, rel=1e-3)


def test_tail_refuses_moments_that_are_exceeded_above_it(above):
    start = above[above > 0][-1]
    with pytest.raises(ValueError, match="slope and curvature above .* found 0.01 and 6.32"):
        calibration.calibrate_tail(above, 20.0, start, (0.01, 6.32))


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
        assert {*calibration.SELF_AFFINE_ROWS, *calibration.TAIL_ROWS} == set(of_surface.quantity)
