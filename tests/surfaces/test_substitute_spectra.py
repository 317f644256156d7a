"""Descriptions of substitutes: each model of a band, refusals, the spectrum as it is stored."""

import numpy as np
import pandas as pd
import pytest
from random_scans import PIXEL
from refusals import assert_says, refusal
from repository import ROOT

from hardcontact.records import published
from hardcontact.surfaces import spectrum as spectral_models
from hardcontact.surfaces import substitute_spectra
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum, all_scales_moments
from hardcontact.surfaces.substitute_spectra import expected_moments, transfer_weights

HEADER = (
    "longest_nm,shortest_nm,model,plateau_nm4,rolloff_nm,hurst,hurst_change,table,basis,source\n"
)
WEIGHTS = transfer_weights(512, PIXEL, 128)
NO_TABLE1 = pd.DataFrame({"value": [], "uncertainty": []})
#: The paper's scans, made small.
CONSTANTS = pd.DataFrame({"value": {"scan_pixels": 64.0, "scan_size": 2500.0}})


@pytest.fixture
def described(tmp_path):
    """Write a description of these bands; its path."""

    def write(*bands):
        path = tmp_path / "surface.csv"
        path.write_text(HEADER + "".join(f"{band},assumed,none\n" for band in bands))
        return path

    return write


@pytest.fixture
def polished(at_root):
    table1 = published.table1("resources/paper/table1.csv")
    return substitute_spectra.rows_of_surface(table1, "polished_uncd", "gradient", "half_laplacian")


def test_bands_with_all_parameters_are_their_models(described, tmp_path):
    (tmp_path / "points.csv").write_text("wavelength_nm,c1d_nm3\n66,234\n24,6.7\n7,0.095\n")
    path = described(
        "inf,1000,varying Hurst,5e9,2000,0.8,-0.1,",
        "1000,500,self-affine,5e9,2000,0.8,,",
        "500,50,smooth roll-off,6.1e7,930,0.84,,",
        "50,7,profile,,,,,points.csv",
        "7,0.31,power law,,,0.5,,",
    )
    density, bands, calibrated = substitute_spectra.from_description(path, NO_TABLE1, WEIGHTS)
    assert calibrated == [] and len(bands) == 5
    table = Spectrum(WAVEVECTORS, density)
    q = 2 * np.pi / np.array([1500.0, 700.0, 200.0, 24.0])
    expected = [
        spectral_models.varying_hurst(q[0], 5e9, 2000.0, 0.8, -0.1),
        spectral_models.self_affine(q[1], 5e9, 2000.0, 0.8),
        spectral_models.smooth_rolloff(q[2], 6.1e7, 930.0, 0.84),
    ]
    np.testing.assert_allclose(table(q)[:3], expected, rtol=1e-3)
    points = np.array([66.0, 24.0, 7.0]), np.array([234.0, 6.7, 0.095])
    inside = (WAVEVECTORS > 2 * np.pi / 50) & (WAVEVECTORS < 2 * np.pi / 7)
    np.testing.assert_allclose(
        density[inside], spectral_models.profile_points(WAVEVECTORS, *points)[inside]
    )
    tail = (WAVEVECTORS > 2 * np.pi / 7) & (WAVEVECTORS < 2 * np.pi / 0.33)
    slopes = np.diff(np.log(density[tail])) / np.diff(np.log(WAVEVECTORS[tail]))
    np.testing.assert_allclose(slopes, -3)
    assert (density[WAVEVECTORS > 2 * np.pi / 0.29] == 0).all()


@pytest.mark.parametrize(
    "band", ["inf,6.5,self-affine,,,,,", "inf,6.5,varying Hurst,,2000,,,"], ids=["H", "H'"]
)
def test_blank_parameters_are_calibrated_to_table1(described, polished, band):
    path = described(band, "6.5,0,power law,,,,,")
    weights = transfer_weights(2048, PIXEL, 512)
    density, bands, calibrated = substitute_spectra.from_description(path, polished, weights)
    assert calibrated == [*spectral_models.AFM_ROWS, *spectral_models.TAIL_ROWS]
    assert bands[["plateau_nm4", "rolloff_nm", "hurst"]].loc[0].notna().all()
    assert bands[["shortest_nm", "hurst"]].loc[1].notna().all()
    table = Spectrum(WAVEVECTORS, density)
    found = [*expected_moments(table, weights), *all_scales_moments(table)[1:]]
    np.testing.assert_allclose(found, polished.value[calibrated], rtol=1e-9)


@pytest.mark.parametrize(
    ("band", "part"),
    [
        ("inf,20,cubic,1,1,1,,", "expected the model self-affine, .* found 'cubic'"),
        ("inf,20,profile,,,,,none.csv", "none.csv"),
        ("inf,20,self-affine,,,,,", "afm_rms_height"),
    ],
)
def test_a_band_that_cannot_be_made_is_named(described, band, part):
    path = described(band)
    with pytest.raises(ValueError, match=f"surface.csv: band from inf nm: .*{part}"):
        substitute_spectra.from_description(path, NO_TABLE1, WEIGHTS)


def test_the_refusal_of_a_band_is_one_line(described):
    message = refusal(
        substitute_spectra.from_description, described("inf,20,cubic,1,1,1,,"), NO_TABLE1, WEIGHTS
    )
    assert_says(message, "surface.csv", "expected", "found")


def test_spectrum_of_a_substitute_says_what_scans_would_show(described, polished):
    path = described("inf,20,smooth roll-off,6.1e7,930,0.84,,")
    stored = substitute_spectra.substitute_spectrum(path, polished, CONSTANTS)
    inside = WAVEVECTORS < 2 * np.pi / 20
    np.testing.assert_array_equal(stored.wavevector, WAVEVECTORS)
    np.testing.assert_allclose(
        stored.spectrum[inside],
        spectral_models.smooth_rolloff(WAVEVECTORS[inside], 6.1e7, 930.0, 0.84),
    )
    assert (stored.attrs["basis"], stored.attrs["calibrated_to_table1"]) == ("substitute", "")
    expected = expected_moments(
        Spectrum(WAVEVECTORS, stored.spectrum.values), transfer_weights(256, 2500 / 64, 64)
    )
    np.testing.assert_array_equal(stored.attrs["expected_scan_moments"], expected)


@pytest.mark.parametrize("end", ["", "_lower", "_upper"])
@pytest.mark.parametrize("coating", ["crn_smoother", "crn_rougher"])
def test_description_of_chromium_nitride_makes_power_laws_without_a_jump(coating, end):
    path = ROOT / f"resources/spectra/{coating}{end}.csv"
    density, bands, calibrated = substitute_spectra.from_description(path, NO_TABLE1, None)
    *measured, last = bands.basis
    assert (set(measured), last, calibrated) == ({"measured"}, "assumed", [])
    # Constant above the first edge; the last band continues beyond the source.
    fitted = bands.iloc[:-1]
    starts = np.append(fitted.rolloff_nm[0], fitted.longest_nm[1:])
    expected = np.full(len(WAVEVECTORS), fitted.plateau_nm4[0])
    for hurst, start, stop in zip(fitted.hurst, starts, [*starts[1:], 0.0], strict=True):
        within = np.clip(2 * np.pi / WAVEVECTORS, stop, start)
        expected *= (start / within) ** (-2 - 2 * hurst)
    inside = WAVEVECTORS < 2 * np.pi / 0.11
    # Edges lie between points of the table of spectra: each band begins up to half a cell off.
    np.testing.assert_allclose(density[inside], expected[inside], rtol=0.15)


@pytest.mark.parametrize(
    "content", [b"", b"a,b\n1,2\n", b"\xff\xfe", b'"', b"model,table,longest_nm\n\xb5,,1\n", None]
)
def test_what_is_no_description_is_named(tmp_path, content):
    path = tmp_path / "a.csv"
    path.write_bytes(content) if content is not None else path.mkdir()
    message = refusal(substitute_spectra.described_rms_height, path, 1000.0)
    assert_says(message, "a.csv: expected bands of a spectrum", "found")
    assert len(message.splitlines()) == 1
