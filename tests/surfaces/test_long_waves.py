"""Waves too long to be reliable, and other spectra that the same measurements allow."""

import numpy as np
import pytest
from measurements import measurement

from hardcontact.numbers.random import generator
from hardcontact.surfaces.extrapolated_spectrum import levelled_share, with_rolloff
from hardcontact.surfaces.joined_spectrum import drawn_spectra, joined_spectrum
from hardcontact.surfaces.measured_spectrum import levelled_topography
from hardcontact.surfaces.spectrum import (
    WAVEVECTORS,
    Spectrum,
    all_scales_moments,
    self_affine,
    spectrum_from,
)
from hardcontact.surfaces.synthesis import random_surface

SIZE, PIXELS = 5000.0, 128
KNOWN_TIP = [1e-3]


def scan_of(rng, rolloff, hurst=0.8, level=1e4):
    """A scan cut out of a random surface ten times as large, and its density."""

    def density(q):
        return self_affine(q, level * (rolloff / 100) ** (2 + 2 * hurst), rolloff, hurst)

    surface = random_surface(rng, 10 * PIXELS, SIZE / PIXELS, density)
    return measurement(surface.heights[:PIXELS, :PIXELS].astype(float), surface.pixel_size), density


def rms_height(spectrum):
    return all_scales_moments(spectrum)[0]


@pytest.mark.parametrize("kind", ["map", "profile"])
@pytest.mark.parametrize("order", [0.2, 0.5, 1.0, 2.0])
def test_levelling_leaves_what_a_plane_does_not_fit(kind, order):
    rng, place = generator(1), (np.arange(48) + 0.5) / 48 - 0.5
    axes = [place, place] if kind == "map" else [place]
    grid = np.stack([axis.ravel() for axis in np.meshgrid(*axes)])
    plane, _ = np.linalg.qr(np.vstack([np.ones(grid.shape[1]), grid]).T)
    left = []
    for angle, phase in 2 * np.pi * rng.uniform(size=(3000, 2)):
        direction = np.array([np.cos(angle), np.sin(angle)])[: len(grid)]
        wave = np.sqrt(2) * np.cos(2 * np.pi * order * direction @ grid + phase)
        left.append(((wave - plane @ (plane.T @ wave)) ** 2).mean())
    share = levelled_share(np.array([2 * np.pi * order]), 1.0, kind).item()
    error = np.std(left) / np.sqrt(len(left))
    assert share == pytest.approx(np.mean(left), abs=4 * error + 0.01 * share)


def test_a_spectrum_rises_to_its_rolloff_and_is_constant_beyond():
    density = with_rolloff(np.ones(len(WAVEVECTORS)), 1000.0, -3.0, 8000.0)
    wavelength = 2 * np.pi / WAVEVECTORS
    np.testing.assert_allclose(density, np.clip(wavelength / 1000, 1, 8) ** 3.0)


@pytest.mark.study
@pytest.mark.parametrize("rolloff", [SIZE / 3, 3 * SIZE])
def test_the_rms_height_of_all_scales_is_among_those_of_drawn_spectra(rolloff):
    held, trials = 0, 20
    for number in range(trials):
        scan, density = scan_of(generator(2, number), rolloff)
        rngs = (generator(3, number, draw) for draw in range(20))
        drawn = [rms_height(one) for one, _ in drawn_spectra(rngs, [scan], KNOWN_TIP)]
        held += min(drawn) < rms_height(Spectrum(WAVEVECTORS, density(WAVEVECTORS))) < max(drawn)
    assert held >= 17


def test_a_scan_below_its_rolloff_keeps_its_own_rms_height():
    for number in range(5):
        scan, _ = scan_of(generator(4, number), 10 * SIZE)
        rms = rms_height(spectrum_from(joined_spectrum([scan], KNOWN_TIP)))
        assert rms > 0.8 * levelled_topography(scan).heights().std()


def test_noise_is_not_taken_for_long_waves():
    rolloffs = []
    for number in range(4):
        scan, _ = scan_of(generator(9, number), SIZE / 3)
        noise = generator(10, number).normal(0, 0.5 * scan.heights.std(), scan.heights.shape)
        noisy = measurement(scan.heights + noise, scan.pixel_size)
        of_both = [joined_spectrum([one], KNOWN_TIP).attrs["rolloff"] for one in (scan, noisy)]
        rolloffs.append(np.log(of_both))
    clean, noisy = np.mean(rolloffs, axis=0)
    assert noisy - clean < 0.02


def test_a_draw_follows_from_its_generator_alone_and_draws_unknown_tips():
    scan, _ = scan_of(generator(7), SIZE, level=1.0)
    spectra = [
        next(drawn_spectra([generator(8, draw)], [scan], radii))[0].density
        for draw, radii in ((1, [None]), (1, [None]), (2, [None]), (1, [1.0]))
    ]
    np.testing.assert_array_equal(spectra[0], spectra[1])
    assert (spectra[0] != spectra[2]).any() and (spectra[0] != spectra[3]).any()
