"""Spectra beyond their band: long waves up to a roll-off, tails within bounds."""

import numpy as np
import pytest
from known_spectra import BINS
from measurements import map_of, measurement
from random_scans import uncd
from scipy import stats

from hardcontact.base.random import generator
from hardcontact.contact.contact import contact_of_area
from hardcontact.surfaces.extrapolated_spectrum import (
    ATOMIC,
    GRADIENT,
    HALF_LAPLACIAN,
    Tail,
    continued_spectrum,
    has_exponent,
    levelled_share,
    with_rolloff,
)
from hardcontact.surfaces.hurst_exponent import fitted_hurst
from hardcontact.surfaces.joined_spectrum import drawn_spectra, joined_spectrum
from hardcontact.surfaces.spectrum import (
    WAVEVECTORS,
    Spectrum,
    all_scales_moments,
    self_affine,
    smooth_rolloff,
    spectrum_from,
)
from hardcontact.surfaces.synthesis import random_surface
from hardcontact.theory.closed_form import closed_form
from hardcontact.theory.prediction import trim_spectrum

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


def continued(density, wavevector=BINS):
    values = density(wavevector) if callable(density) else density
    fit = fitted_hurst(wavevector, values, np.full(wavevector.shape, 1e-4))
    return continued_spectrum(wavevector, values, fit)


def test_a_power_law_goes_on_to_the_atoms_and_is_constant_above():
    def gentle(q):
        return 1e-3 * uncd(q)

    spectrum, tail = continued(gentle)
    wavelength = 2 * np.pi / WAVEVECTORS
    measured = (wavelength > 45) & (wavelength < 2500)
    np.testing.assert_allclose(spectrum[measured] / gentle(WAVEVECTORS[measured]), 1, atol=0.02)
    beyond = (wavelength > ATOMIC * 1.1) & (wavelength < 45)
    np.testing.assert_allclose(np.log(spectrum[beyond] / gentle(WAVEVECTORS[beyond])), 0, atol=0.05)
    assert (spectrum[wavelength < ATOMIC * 0.9] == 0).all()
    assert np.ptp(spectrum[wavelength > 2900]) == 0
    assert tail.tail_hurst == pytest.approx(0.84, abs=0.005) and tail.tail_ended_by == "atoms"
    assert tail.tail_fit_shortest == pytest.approx(2 * np.pi / BINS[-1])
    assert tail.tail_fit_longest == pytest.approx(10 * tail.tail_fit_shortest)


def coarse_surface(rng, model, size):
    """A surface of at most 60 nm and known slopes, H of 0.3 to 1, roll-off to half of the size."""
    hurst, part = rng.uniform(0.3, 1), np.exp(rng.uniform(*np.log([0.05, 0.5])))
    density = model(WAVEVECTORS, 1.0, part * size, hurst)
    density[2 * np.pi / WAVEVECTORS < ATOMIC] = 0
    largest = np.array([60.0, 0.7 * GRADIENT, 0.7 * HALF_LAPLACIAN])
    factor = (largest / all_scales_moments(Spectrum(WAVEVECTORS, density))).min()
    return hurst, Spectrum(WAVEVECTORS, factor**2 * density)


@pytest.mark.study
def test_coarse_maps_tell_exponent_and_force_within_their_intervals():
    pixels, pixel, draws = 256, 400.0, 8
    contact = contact_of_area(250e3, 5.6, 0.05, 400.0)

    def log_force(spectrum):
        return np.log(closed_form(trim_spectrum(spectrum), contact).force)

    errors, held_exponents, held_forces = [], 0, 0
    for number in range(40):
        rng, model = generator(51, number), (smooth_rolloff, self_affine)[number % 2]
        hurst, surface = coarse_surface(rng, model, pixels * pixel)
        scans = [map_of(rng, pixels, pixel, surface)]
        joined = joined_spectrum(scans, KNOWN_TIP)
        error = abs(joined.attrs["tail_hurst"] - hurst)
        errors.append(error)
        held_exponents += error < 1.96 * joined.attrs["tail_hurst_error"]
        force = log_force(spectrum_from(joined))
        rngs = (generator(52, number, draw) for draw in range(draws))
        shifts = [log_force(drawn) - force for drawn, _ in drawn_spectra(rngs, scans, KNOWN_TIP)]
        half = stats.t.ppf(0.975, draws) * np.sqrt(np.mean(np.square(shifts)))
        held_forces += abs(log_force(surface) - force) < half
    assert np.median(errors) < 0.05
    assert held_exponents >= 36 and held_forces >= 36


@pytest.mark.parametrize(
    ("hurst", "bins", "known"),
    [(0.8, 11, True), (1.0, 11, False), (0.0, 11, False), (0.8, 3, False)],
)
def test_an_exponent_at_a_bound_or_of_few_bins_is_none(hurst, bins, known):
    assert has_exponent(Tail(hurst, 0.1, 45.0, 45.0 * 10 ** ((bins - 1) / 10), "atoms")) == known
    assert has_exponent(Tail(tail_ended_by="gradient"))


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
