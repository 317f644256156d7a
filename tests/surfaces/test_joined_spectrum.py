"""Spectra joined of several measurements of one surface, and of descriptions."""

import numpy as np
import pandas as pd
import pytest
from measurements import line_of, map_of, measurement
from random_scans import uncd
from refusals import assert_says, refusal

from hardcontact.base import dataset
from hardcontact.base.random import generator
from hardcontact.report.artificial import artificial_bands
from hardcontact.surfaces.extrapolated_spectrum import HURST_SCATTER, Tail
from hardcontact.surfaces.joined_spectrum import (
    described_spectrum,
    drawn_spectra,
    joined_spectrum,
    smoothed,
    stacked_spectra,
)
from hardcontact.surfaces.measured_spectrum import (
    CALIBRATION,
    measured_psd,
    variance_of_log,
)
from hardcontact.surfaces.reliable_band import reliable_band
from hardcontact.surfaces.spectrum import (
    BIN_CENTRES,
    WAVEVECTORS,
    self_affine,
    smooth_rolloff,
    spectrum_dataset,
)


def gentle(q):
    return 0.05 * uncd(q)


def two_sizes_and_a_line(seed):
    """A map of 10 µm, one of 1 µm and a line of 40 µm of one surface."""
    return [
        map_of(generator(seed, 0), 256, 40.0, gentle, path="large.spm"),
        map_of(generator(seed, 1), 256, 4.0, gentle, path="small.spm"),
        line_of(generator(seed, 2), 2000, 20.0, gentle, path="line.txt"),
    ]


def test_two_sizes_and_a_line_give_the_spectrum_of_the_surface_within_their_scatter():
    errors = []
    for seed in range(8):
        joined = joined_spectrum(two_sizes_and_a_line(seed), [None] * 3)
        wavevector = joined["bin_wavevector"].values
        errors.append(np.log(joined["joined"].values / gentle(wavevector)))
    errors = np.array(errors)
    wavelength = 2 * np.pi / wavevector
    seen = (wavelength > 16) & (wavelength < 40_000 / 3)
    known = np.isfinite(errors[:, seen])
    assert known.mean() > 0.95
    # The line alone reaches beyond 3 µm, with one wave in a bin, whose logarithm scatters by 1.3.
    assert np.abs(np.nanmean(errors[:, wavelength > 3000])) < 0.4
    few, many = ((wavelength > a) & (wavelength < b) for a, b in ((1300, 3000), (16, 1300)))
    assert np.sqrt(np.nanmean(errors[:, few] ** 2)) < 0.45
    assert np.sqrt(np.nanmean(errors[:, many] ** 2)) < 0.15
    assert np.abs(np.nanmean(errors[:, many], axis=0)).max() < 0.15
    assert not np.isfinite(errors[:, (wavelength < 15) | (wavelength > 14_000)]).any()


def test_bins_of_few_waves_are_smoothed_and_a_gap_is_bridged_between_them():
    errors, variances = [], []
    short = (2 * np.pi / WAVEVECTORS < 110) & (2 * np.pi / WAVEVECTORS > 13)
    for number in range(40):
        scan = map_of(generator(21, number), 128, 40.0, gentle)
        line = line_of(generator(22, number), 76, 3.0, gentle)  # some 0.5 to 2 waves in a bin
        joined = joined_spectrum([scan, line], [None, None])
        density = joined["spectrum"].values[short]
        errors.append(np.log(density / gentle(WAVEVECTORS[short])))
        variances.append(np.trapezoid(density * WAVEVECTORS[short], WAVEVECTORS[short]))
    true = np.trapezoid(gentle(WAVEVECTORS[short]) * WAVEVECTORS[short], WAVEVECTORS[short])
    # Single bins scatter by 1.3, the logarithm of a single wave. Freed of the bias of the logarithm
    # their mean power is 1.8 times too large, the variance in a gap between them more.
    assert np.abs(np.mean(errors, axis=0)).max() < 0.25
    assert np.std(errors, axis=0).max() < 0.8
    assert np.mean(variances) == pytest.approx(true, rel=0.25)


def pattern(kind, seed, pixels=192, pixel=50.0):
    """A height map (nm) of a grating, a step or waves without a roll-off, with some roughness."""
    rng = generator(61, seed)
    place = np.arange(pixels) * pixel
    period, edge = pixels * pixel / rng.uniform(4, 12), pixels * pixel * rng.uniform(0.2, 0.8)
    heights = {
        "grating": 20 * np.cos(2 * np.pi * place / period),
        "square grating": 10 * np.sign(np.cos(2 * np.pi * place / period)),
        "step": 25.0 * (place > edge),
        "waves": 0.0 * place,
    }[kind]
    rough = map_of(rng, pixels, pixel, lambda q: smooth_rolloff(q, 1e10, 1e5, 0.8))
    return measurement(heights + rough.heights, pixel)


@pytest.mark.parametrize("kind", ["grating", "square grating", "step", "waves"])
def test_a_joined_spectrum_keeps_the_variance_of_its_bins(kind):
    for seed in range(5):
        scan = pattern(kind, seed)
        joined = joined_spectrum([scan], [1e-3])
        known = joined["reliable"].values[0] == 1
        power = BIN_CENTRES[known] ** 2 * joined["psd"].values[0, known]
        kept = BIN_CENTRES[known] ** 2 * joined["joined"].values[known]
        assert kept.sum() == pytest.approx(power.sum(), rel=0.01)
        if "grating" in kind:  # The line stands where it was measured.
            peak = power.argmax()
            assert kept[peak] == pytest.approx(power[peak], rel=0.05)


def test_a_noise_floor_is_not_continued():
    def self_affine(q):
        return smooth_rolloff(q, 1e10, 10_000.0, 0.8)

    scan = map_of(generator(13), 256, 10.0, self_affine)
    noisy = measurement(scan.heights + generator(14).normal(0, 3.0, scan.heights.shape), 10.0)
    joined = joined_spectrum([noisy], [None])
    wavevector, density = measured_psd(noisy)
    short = (2 * np.pi / wavevector < 40) & np.isfinite(density)
    assert (density[short] / self_affine(wavevector[short]) > 2).all()
    assert joined["limited_by"].values[0] == "noise"
    shorter = (2 * np.pi / WAVEVECTORS < 50) & (2 * np.pi / WAVEVECTORS > 1)
    ratio = joined["spectrum"].values[shorter] / self_affine(WAVEVECTORS[shorter])
    hurst, error, cut = (
        joined.attrs[name] for name in ("tail_hurst", "tail_hurst_error", "shortest_measured")
    )
    assert abs(hurst - 0.8) < 1.96 * error and error < 0.25
    # From the cut on the logarithm of C is wrong by twice the error of H for each e-fold.
    folds = np.log(cut * WAVEVECTORS[shorter] / (2 * np.pi))
    assert (np.abs(np.log(ratio)) < 0.4 + 2 * 1.96 * error * folds).all()


def test_curves_that_are_drawn_scatter_about_the_mean_as_it_says():
    waves = np.where((BIN_CENTRES > 0.02) & (BIN_CENTRES < 0.3), 0.01 / BIN_CENTRES**2, 1.5)
    known = (BIN_CENTRES > 0.005) & (BIN_CENTRES < 2) & ~((BIN_CENTRES > 0.1) & (BIN_CENTRES < 0.3))
    points = (
        np.where(known, gentle(BIN_CENTRES), np.nan),
        np.where(known, variance_of_log(waves), np.nan),
    )
    wavevector, mean, variance = smoothed(*points)
    drawn = np.log([smoothed(*points, generator(23, draw))[1] for draw in range(400)])
    np.testing.assert_allclose(drawn.std(axis=0), np.sqrt(variance - CALIBRATION**2), rtol=0.15)
    assert (np.abs(drawn.mean(axis=0) - np.log(mean)) < 0.25 * drawn.std(axis=0)).all()
    # A power law has no bends: it is its own mean.
    slope = np.where(known, BIN_CENTRES**-3.0, np.nan)
    np.testing.assert_allclose(smoothed(slope, points[1])[1], wavevector**-3.0, rtol=1e-6)


def test_draws_know_calibration_and_exponent_no_better_than_they_are():
    scans = [map_of(generator(24), 128, 8.0, gentle), map_of(generator(25), 128, 40.0, gentle)]
    rngs = (generator(26, draw) for draw in range(100))
    spectra, factors = zip(*drawn_spectra(rngs, scans, [1e-3, 1e-3]), strict=True)
    # Of the small map alone, which has hundreds of waves there.
    power = np.log([one(2 * np.pi / 40) for one in spectra]) - 2 * np.log(factors)[:, 0]
    assert power.std() < 0.1 and 2 * np.log(factors).std() == pytest.approx(CALIBRATION, rel=0.2)
    tails = np.log([one(2 * np.pi / np.array([4.0, 8.0])) for one in spectra])
    exponents = (tails[:, 1] - tails[:, 0]) / np.log(2) / 2 - 1
    assert HURST_SCATTER < exponents.std() < 2 * HURST_SCATTER  # with that of the waves fitted to


def test_the_radius_given_counts_before_that_of_the_file():
    scan = map_of(generator(15), 128, 5.0, tip_radius=20.0)
    radii = [joined_spectrum([scan], [given])["tip_radius"].item() for given in (None, 8.0)]
    assert radii == [20.0, 8.0]


def test_measurements_that_show_nothing_reliable_are_refused_in_one_line():
    noise = measurement(generator(17).normal(size=(64, 64)), 10.0, path="noise.spm")
    message = refusal(joined_spectrum, [noise], [None])
    assert_says(message, "expected", "at least 3", "found 0", "noise.spm", "noise floor")


def test_surfaces_are_stacked_with_their_limits_and_empty_places(tmp_path):
    coat = joined_spectrum(two_sizes_and_a_line(19), [None] * 3)
    rough = joined_spectrum([map_of(generator(20), 128, 10.0)], [None])
    labels = {"rough": "Rough", "coat": "My coat"}
    dataset.write(stacked_spectra({"rough": rough, "coat": coat}, labels), tmp_path / "a.nc")
    stacked = dataset.read(tmp_path / "a.nc")
    assert list(stacked["kind"].values[0]) == ["map", "", ""]
    assert stacked["reliable"].values[0, 1:].sum() == 0
    assert np.isnan(stacked["psd"].values[0, 1:]).all()
    for name, single in (("rough", rough), ("coat", coat)):
        chosen = stacked.sel(surface=name)
        np.testing.assert_array_equal(chosen["spectrum"], single["spectrum"])
        np.testing.assert_array_equal(chosen["joined"], single["joined"])
        for limit in ("shortest_measured", "longest_measured", *Tail._fields):
            assert chosen[limit].item() == single.attrs[limit]


BANDS = pd.DataFrame(
    {
        "longest_nm": [np.inf, 1e4, 1e3, 100.0, 10.0],
        "shortest_nm": [1e4, 1e3, 100.0, 10.0, 0.1],
        "basis": ["published", "published", "assumed", "measured", "inferred"],
        "source": ["a", "a", "none", "b", "c"],
    }
)


def stored(bands=BANDS):
    """Return the spectrum of a substitute as the study stores it."""
    return spectrum_dataset(self_affine(WAVEVECTORS, 1e9, 2000.0, 0.8)).assign_attrs(
        basis="substitute", calibrated_to_table1="", bands=bands.to_csv(index=False)
    )


def test_known_bands_are_those_of_published_or_measured_sources():
    found = described_spectrum(stored(), "x.csv")
    assert found.notes.values.tolist() == ["a", "b"]
    np.testing.assert_allclose(found.longest_reliable, [1e6, 100.0])
    np.testing.assert_allclose(found.shortest_reliable, [1e3, 10.0])
    wavelength = 2 * np.pi / found.bin_wavevector.values
    known = (wavelength > 1e3) | ((wavelength > 10) & (wavelength <= 100))
    expected = self_affine(found.bin_wavevector.values, 1e9, 2000.0, 0.8)
    np.testing.assert_allclose(found.joined, np.where(known, expected, np.nan), rtol=0.03)
    assert np.isnan(found.attrs["tail_hurst"]) and set(found.limited_by.values) == {"source"}


def test_what_is_not_known_is_artificial():
    stacked = stacked_spectra({"x": described_spectrum(stored(), "x.csv")}, {"x": "X"})
    bands = artificial_bands(stacked.sel(surface="x"))
    np.testing.assert_allclose(bands, [(0, 10), (100, 1000), (1e6, np.inf)])


def test_only_what_is_reliable_is_joined():
    scans = two_sizes_and_a_line(10)
    noise = generator(11).normal(0, 10.0, scans[0].heights.shape)
    scans[0] = measurement(scans[0].heights + noise, scans[0].pixel_size)
    joined = joined_spectrum(scans, [None] * 3)
    wavelength = 2 * np.pi / joined["bin_wavevector"].values
    for place, scan in enumerate(scans):
        band, stored = reliable_band(scan, None), joined.isel(measurement=place)
        within = (wavelength >= band.shortest) & (wavelength <= band.longest)
        np.testing.assert_array_equal(stored["reliable"] == 1, within & np.isfinite(stored["psd"]))
    assert joined["limited_by"].values[0] == "noise"
