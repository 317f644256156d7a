"""Spectra of substitutes: descriptions, calibration to Table 1, expected rms values of scans."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from measurements import PIXEL, UNCD, cut_scan, uncd_density
from paper_numbers import CONSTANTS, SUBSTRATES, SURFACES, default_spectrum, table1_rows
from repository import DESCRIPTION_HEADER
from scipy import stats

from hardcontact.base.arrays import generator
from hardcontact.surfaces import spectral_models, substitute_spectra
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.metrics import TABLE1_METRICS, metrics
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum, all_scales_rms
from hardcontact.surfaces.substitute_spectra import expected_scan_rms, scan_rms_weights
from hardcontact.surfaces.synthesis import random_surface


def test_no_self_affine_spectrum_meets_the_afm_rows_of_ncd():
    segment = pd.Series({"model": "self-affine", "rolloff_nm": np.nan})
    weights = scan_rms_weights(2048, PIXEL, 512)
    with pytest.raises(ValueError, match="expected a model .* missed by .* %"):
        substitute_spectra.calibrate_model(segment, table1_rows("ncd"), weights)


@pytest.mark.parametrize(
    ("rms_values", "message"),
    [
        # The longer waves have a larger gradient; no tail has so large a half-Laplacian (1/nm).
        ((0.01, 6.32), "that a power law below .* can add, found 0.01 and 6.32"),
        ((0.5, 200.0), "that a power law below .* can add, found 0.5 and 200"),
    ],
)
def test_rms_values_that_no_tail_can_add_are_refused(rms_values, message):
    longer_waves = np.where(2 * np.pi / WAVEVECTORS > 20, UNCD.density, 0)
    with pytest.raises(ValueError, match=message):
        substitute_spectra.calibrate_tail(longer_waves, *rms_values)


WEIGHTS = scan_rms_weights(512, PIXEL, 128)
NO_TABLE1 = pd.DataFrame({"value": [], "uncertainty": []})


@pytest.fixture
def write_description(tmp_path):
    """Return a function that writes segments to a description and returns its path."""

    def write(*segments):
        path = tmp_path / "surface.csv"
        rows = (f"{segment},assumed,none\n" for segment in segments)
        path.write_text(DESCRIPTION_HEADER + "".join(rows))
        return path

    return write


def test_segments_with_all_parameters_follow_their_models(write_description, tmp_path):
    (tmp_path / "points.csv").write_text("wavelength_nm,c1d_nm3\n66,234\n24,6.7\n7,0.095\n")
    path = write_description(
        "inf,1000,varying Hurst,5e9,2000,0.8,-0.1,",
        "1000,500,self-affine,5e9,2000,0.8,,",
        "500,50,smooth roll-off,6.1e7,930,0.84,,",
        "50,7,profile,,,,,points.csv",
        "7,0.31,power law,,,0.5,,",
    )
    density, segments, calibrated_rows = substitute_spectra.spectrum_from_description(
        path, NO_TABLE1, WEIGHTS
    )
    assert calibrated_rows == [] and len(segments) == 5
    table = Spectrum(WAVEVECTORS, density)
    q = 2 * np.pi / np.array([1500.0, 700.0, 200.0, 24.0])
    models = [
        spectral_models.varying_hurst(q[0], 5e9, 2000.0, 0.8, -0.1),
        spectral_models.self_affine(q[1], plateau=5e9, rolloff=2000.0, hurst=0.8),
        spectral_models.smooth_rolloff(q[2], plateau=6.1e7, rolloff=930.0, hurst=0.84),
    ]
    np.testing.assert_allclose(table(q)[:3], models, rtol=1e-3)
    points = np.array([66.0, 24.0, 7.0]), np.array([234.0, 6.7, 0.095])
    is_profile = (WAVEVECTORS > 2 * np.pi / 50) & (WAVEVECTORS < 2 * np.pi / 7)
    np.testing.assert_allclose(
        density[is_profile],
        spectral_models.isotropic_through_points(WAVEVECTORS, *points)[is_profile],
    )
    is_tail = (WAVEVECTORS > 2 * np.pi / 7) & (WAVEVECTORS < 2 * np.pi / 0.33)
    slopes = np.diff(np.log(density[is_tail])) / np.diff(np.log(WAVEVECTORS[is_tail]))
    np.testing.assert_allclose(slopes, -3)  # -2 - 2H
    assert (density[WAVEVECTORS > 2 * np.pi / 0.29] == 0).all()


@pytest.mark.parametrize("surface", SURFACES)
def test_default_spectra_have_no_jumps(surface):
    density = default_spectrum(surface).spectrum.values
    density = density[density > 0][:-1]  # The last point has only a share of the power law.
    slopes = np.diff(np.log(density)) / np.diff(np.log(WAVEVECTORS[: len(density)]))
    # A jump by a factor of two between two of 40 points a decade is a slope of 12.
    assert np.abs(slopes).max() < 6


@pytest.mark.parametrize("surface", SUBSTRATES)
def test_default_spectra_meet_table_1(surface):
    table1, default = table1_rows(surface), default_spectrum(surface)
    afm_rows = list(substitute_spectra.AFM_ROWS)
    tail_rows = list(substitute_spectra.TAIL_ROWS)
    assert default.attrs["table1_rows_met"] == ",".join([*afm_rows, *tail_rows])
    height, *slope_and_curvature = all_scales_rms(Spectrum(WAVEVECTORS, default.spectrum.values))
    np.testing.assert_allclose(slope_and_curvature, table1.value[tail_rows], rtol=1e-9)
    scan_rms = default.attrs["expected_scan_rms"]
    if surface in ("ncd", "mcd"):  # calibrated before the waves above 3 µm are cut off
        assert (np.abs(scan_rms - table1.value[afm_rows]) < table1.uncertainty[afm_rows] / 2).all()
    else:
        np.testing.assert_allclose(scan_rms, table1.value[afm_rows], rtol=1e-9)
    if surface != "polished_uncd":  # Its Gaussian substitute misses Table 1.
        error = height - table1.value["all_rms_height"]
        assert abs(error) < table1.uncertainty["all_rms_height"]


def test_permitted_spectra_scatter_like_the_means_of_table_1(write_description):
    table1 = table1_rows("uncd")
    rows = list(substitute_spectra.AFM_ROWS)
    mean_errors = table1.uncertainty[rows] / np.sqrt(5)
    weights = substitute_spectra.paper_scan_weights(CONSTANTS)
    path = write_description("inf,6.5,self-affine,,,,,")
    deviations = []
    for k in range(8):
        spectrum = substitute_spectra.sample_permitted_spectrum(
            generator(3, k), path, table1, CONSTANTS
        )
        rms_values = expected_scan_rms(spectrum, weights)
        deviations.append((rms_values - table1.value[rows]) / mean_errors)
    low, high = stats.chi2.ppf([0.001, 0.999], np.size(deviations))
    assert low < np.square(deviations).sum() < high


def test_rms_height_counts_only_waves_up_to_a_wavelength(write_description):
    path = write_description("inf,0.1,self-affine,1e9,1000,1.0,,")
    # (1/2 pi) ∫ q C_iso dq: the plateau from 4 µm to the roll-off, then C_iso ∝ q^-4.
    rolloff_q, lowest_q = 2 * np.pi / 1000, 2 * np.pi / 4000
    variance = 1e9 / (2 * np.pi) * ((rolloff_q**2 - lowest_q**2) / 2 + rolloff_q**2 / 2)
    assert substitute_spectra.described_rms_height(path, 4000.0) == pytest.approx(
        variance**0.5, rel=2e-3
    )


def test_expected_rms_values_agree_with_scans():
    weights = substitute_spectra.scan_rms_weights(1024, PIXEL, 256)
    rms_values = substitute_spectra.expected_scan_rms(uncd_density, weights)
    squares = []
    for k in range(6):
        surface = random_surface(generator(4, k), 1024, PIXEL, uncd_density)
        for start in range(0, 1024, 256):
            strip = replace(surface, heights=surface.heights[start:])
            scan_metrics = metrics(level_plane(cut_scan(strip, 256)))
            squares.append([scan_metrics[name] ** 2 for name in TABLE1_METRICS.values()])
    standard_error = np.std(squares, axis=0) / np.sqrt(len(squares))
    assert (np.abs(np.mean(squares, axis=0) - rms_values**2) < 4 * standard_error).all()
