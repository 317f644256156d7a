"""Spectra beyond their band: long waves up to a roll-off, tails within bounds."""

import numpy as np
import pytest
from measurements import measurement
from random_scans import uncd

from hardcontact.base.random import generator
from hardcontact.surfaces.extrapolated_spectrum import (
    ATOMIC,
    GRADIENT,
    HALF_LAPLACIAN,
    continued_spectrum,
    levelled_share,
    with_rolloff,
)
from hardcontact.surfaces.joined_spectrum import drawn_spectra, joined_spectrum
from hardcontact.surfaces.spectrum import (
    WAVEVECTORS,
    Spectrum,
    all_scales_moments,
    self_affine,
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


BINS = 2 * np.pi * 10 ** (-3.45 + np.arange(19) / 10)  # 2.8 µm to 45 nm


def continued(density, wavevector=BINS):
    values = density(wavevector) if callable(density) else density
    return continued_spectrum(wavevector, values, np.full(wavevector.shape, 0.05))


def test_a_power_law_goes_on_to_the_atoms_and_is_constant_above():
    def gentle(q):
        return 1e-3 * uncd(q)

    spectrum, tail = continued(gentle)
    wavelength = 2 * np.pi / WAVEVECTORS
    measured = (wavelength > 45) & (wavelength < 2500)
    np.testing.assert_allclose(spectrum[measured] / gentle(WAVEVECTORS[measured]), 1, atol=0.02)
    # The last decade still bends from the roll-off: a tenth too little of H, twice C at the atoms.
    beyond = (wavelength > ATOMIC * 1.1) & (wavelength < 45)
    np.testing.assert_allclose(np.log(spectrum[beyond] / gentle(WAVEVECTORS[beyond])), 0, atol=0.75)
    assert (spectrum[wavelength < ATOMIC * 0.9] == 0).all()
    assert np.ptp(spectrum[wavelength > 2900]) == 0
    assert 0.7 <= tail.tail_hurst < 0.8 and tail.tail_ended_by == "atoms"
    assert tail.tail_fit_shortest == pytest.approx(2 * np.pi / BINS[-1])
    assert tail.tail_fit_longest == pytest.approx(10 * tail.tail_fit_shortest)


def test_the_rolloff_is_not_taken_for_the_exponent():
    def late(q):
        return 1e4 * (1 + (q * 200 / 2 / np.pi) ** 4) ** -0.9

    _, tail = continued(late)
    assert 0.6 < tail.tail_hurst < 0.8


@pytest.mark.parametrize(("slope", "hurst"), [(-1.2, 0.0), (-2.6, 0.3), (-4.7, 1.0)])
def test_the_exponent_is_one_of_a_self_affine_surface(slope, hurst):
    spectrum, tail = continued(lambda q: 1e-6 * q**slope)
    assert tail.tail_hurst == pytest.approx(hurst, abs=0.005)
    added = (WAVEVECTORS > BINS[-1] * 1.1) & (spectrum > 0)
    fitted = np.polyfit(np.log(WAVEVECTORS[added][:-1]), np.log(spectrum[added][:-1]), 1)[0]
    assert fitted == pytest.approx(-2 - 2 * hurst, abs=0.05)


@pytest.mark.parametrize("slope", [-1.0, -2.0, -3.0, -4.0])
@pytest.mark.parametrize("level", [1e2, 1e4])
def test_no_tail_takes_slope_and_curvature_beyond_those_of_known_surfaces(slope, level):
    spectrum, tail = continued(lambda q: level * (q / 0.02) ** slope)
    _, gradient, half_laplacian = all_scales_moments(Spectrum(WAVEVECTORS, spectrum))
    assert gradient < GRADIENT * 1.06 and half_laplacian < HALF_LAPLACIAN * 1.06
    assert (spectrum[2 * np.pi / WAVEVECTORS < ATOMIC * 0.9] == 0).all()
    ends = {"gradient": gradient / GRADIENT, "half_laplacian": half_laplacian / HALF_LAPLACIAN}
    reached = max(ends, key=ends.get)
    assert tail.tail_ended_by in ("atoms", reached)
    assert tail.tail_ended_by == "atoms" or ends[reached] > 0.85


def test_a_surface_that_is_measured_to_be_steeper_gets_no_tail():
    steep = 1e8 * (BINS / 0.02) ** -2.0
    spectrum, tail = continued(steep)
    assert (spectrum[WAVEVECTORS > BINS[-1] * 1.001] == 0).all()
    assert np.isnan(tail.tail_hurst)
    points = Spectrum(WAVEVECTORS, spectrum)(np.minimum(BINS, WAVEVECTORS[174]))
    np.testing.assert_allclose(points, steep, rtol=1e-6)


def test_a_spectrum_rises_to_its_rolloff_and_is_constant_beyond():
    density = with_rolloff(np.ones(len(WAVEVECTORS)), 1000.0, -3.0, 8000.0)
    wavelength = 2 * np.pi / WAVEVECTORS
    np.testing.assert_allclose(density, np.clip(wavelength / 1000, 1, 8) ** 3.0)
