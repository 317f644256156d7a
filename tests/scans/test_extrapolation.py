"""Spectra beyond the wavelengths measured: a roll-off, and tails within bounds."""

import numpy as np
import pytest
from measurements import gentle_density, measurement

from hardcontact.base.arrays import generator
from hardcontact.scans.extrapolation import (
    ATOMIC_WAVELENGTH,
    MAX_GRADIENT,
    MAX_HALF_LAPLACIAN,
    Tail,
    extrapolate_long_waves,
    extrapolate_short_waves,
    fit_hurst_exponent,
    is_tail_known,
    share_after_levelling,
)
from hardcontact.scans.joined_spectrum import joined_spectrum
from hardcontact.surfaces.spectral_models import self_affine
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum, all_scales_rms
from hardcontact.surfaces.synthesis import random_surface

BINS = 2 * np.pi * 10 ** (-3.45 + np.arange(19) / 10)  # in rad/nm: wavelengths 2.8 µm to 45 nm


@pytest.mark.parametrize("kind", ["map", "line scan"])
@pytest.mark.parametrize("order", [0.2, 0.5, 1.0, 2.0])  # waves in the width of the scan
def test_levelling_leaves_what_a_plane_does_not_fit(kind, order):
    rng, position = generator(1), (np.arange(48) + 0.5) / 48 - 0.5
    axes = [position, position] if kind == "map" else [position]
    grid = np.stack([axis.ravel() for axis in np.meshgrid(*axes)])
    plane, _ = np.linalg.qr(np.vstack([np.ones(grid.shape[1]), grid]).T)
    remaining = []
    for angle, phase in 2 * np.pi * rng.uniform(size=(3000, 2)):
        direction = np.array([np.cos(angle), np.sin(angle)])[: len(grid)]
        wave = np.sqrt(2) * np.cos(2 * np.pi * order * direction @ grid + phase)
        remaining.append(((wave - plane @ (plane.T @ wave)) ** 2).mean())
    share = share_after_levelling(np.array([2 * np.pi * order]), 1.0, kind).item()
    error = np.std(remaining) / np.sqrt(len(remaining))
    assert share == pytest.approx(np.mean(remaining), abs=4 * error + 0.01 * share)


def test_noise_does_not_lengthen_the_rolloff():
    def density(q):
        return self_affine(q, plateau=2.5e8, rolloff=1667.0, hurst=0.8)

    log_rolloffs = []
    for number in range(4):
        # The scan is a tenth as wide as the surface, and three times as wide as the roll-off.
        surface = random_surface(generator(9, number), 1280, 39.0, density)
        scan = measurement(surface.heights[:128, :128].astype(float), 39.0)
        noise = generator(10, number).normal(0, 0.5 * scan.heights.std(), scan.heights.shape)
        noisy = measurement(scan.heights + noise, 39.0)
        spectra = [joined_spectrum([image], [None]) for image in (scan, noisy)]
        log_rolloffs.append([np.log(spectrum.attrs["rolloff"]) for spectrum in spectra])
    clean_log, noisy_log = np.mean(log_rolloffs, axis=0)
    assert noisy_log - clean_log < 0.02


def extrapolate(density):
    """Return C_iso on WAVEVECTORS, extrapolated from C_iso at BINS, and its tail."""
    fit = fit_hurst_exponent(BINS, density, np.full(BINS.shape, 1e-4))
    return extrapolate_short_waves(BINS, density, fit)


def test_a_power_law_is_extrapolated_to_atoms_and_constant_at_long_waves():
    spectrum, tail = extrapolate(gentle_density(BINS))
    wavelength = 2 * np.pi / WAVEVECTORS
    is_measured = (wavelength > 45) & (wavelength < 2500)
    np.testing.assert_allclose(
        spectrum[is_measured] / gentle_density(WAVEVECTORS[is_measured]), 1, atol=0.02
    )
    is_tail = (wavelength > ATOMIC_WAVELENGTH * 1.1) & (wavelength < 45)
    np.testing.assert_allclose(
        np.log(spectrum[is_tail] / gentle_density(WAVEVECTORS[is_tail])), 0, atol=0.05
    )
    assert (spectrum[wavelength < ATOMIC_WAVELENGTH * 0.9] == 0).all()
    assert np.ptp(spectrum[wavelength > 2900]) == 0
    # The density falls as q^-3.68 = q^(-2 - 2H).
    assert tail.tail_hurst == pytest.approx(0.84, abs=0.005) and tail.tail_ended_by == "atoms"
    assert tail.tail_fit_shortest == pytest.approx(2 * np.pi / BINS[-1])
    assert tail.tail_fit_longest == pytest.approx(10 * tail.tail_fit_shortest)


@pytest.mark.parametrize(
    ("hurst", "bins", "is_known"),
    [(0.8, 11, True), (1.0, 11, False), (0.0, 11, False), (0.8, 3, False)],
)
def test_an_exponent_at_a_bound_or_from_few_bins_is_unknown(hurst, bins, is_known):
    tail = Tail(hurst, 0.1, 45.0, 45.0 * 10 ** ((bins - 1) / 10), "atoms")
    assert is_tail_known(tail) == is_known
    assert is_tail_known(Tail(tail_ended_by="gradient"))


@pytest.mark.parametrize(("slope", "hurst"), [(-1.2, 0.0), (-2.6, 0.3), (-4.7, 1.0)])
def test_the_exponent_is_clipped_to_those_of_self_affine_surfaces(slope, hurst):
    spectrum, tail = extrapolate(1e-6 * BINS**slope)
    assert tail.tail_hurst == pytest.approx(hurst, abs=0.005)
    is_tail = (WAVEVECTORS > BINS[-1] * 1.1) & (spectrum > 0)
    tail_slope = np.polyfit(np.log(WAVEVECTORS[is_tail][:-1]), np.log(spectrum[is_tail][:-1]), 1)[0]
    assert tail_slope == pytest.approx(-2 - 2 * hurst, abs=0.005)


@pytest.mark.parametrize("slope", [-1.0, -2.0, -3.0, -4.0])
@pytest.mark.parametrize("level", [1e2, 1e4])
def test_no_tail_takes_slope_and_curvature_beyond_table_1(slope, level):
    spectrum, tail = extrapolate(level * (BINS / 0.02) ** slope)
    _, gradient, half_laplacian = all_scales_rms(Spectrum(WAVEVECTORS, spectrum))
    assert gradient < MAX_GRADIENT and half_laplacian < MAX_HALF_LAPLACIAN
    assert (spectrum[2 * np.pi / WAVEVECTORS < ATOMIC_WAVELENGTH * 0.9] == 0).all()
    shares_of_bound = {
        "gradient": gradient / MAX_GRADIENT,
        "half_laplacian": half_laplacian / MAX_HALF_LAPLACIAN,
    }
    nearest_bound = max(shares_of_bound, key=shares_of_bound.get)
    assert tail.tail_ended_by in ("atoms", nearest_bound)
    assert tail.tail_ended_by == "atoms" or shares_of_bound[nearest_bound] > 0.95


def test_a_steeper_surface_than_in_table_1_has_no_tail():
    steep = 1e8 * (BINS / 0.02) ** -2.0
    spectrum, tail = extrapolate(steep)
    assert (spectrum[WAVEVECTORS > BINS[-1] * 1.001] == 0).all()
    assert np.isnan(tail.tail_hurst)
    last_wavevector = WAVEVECTORS[spectrum > 0].max()  # just below the last of BINS
    points = Spectrum(WAVEVECTORS, spectrum)(np.minimum(BINS, last_wavevector))
    np.testing.assert_allclose(points, steep, rtol=1e-6)


def test_a_spectrum_rises_to_its_rolloff_and_is_constant_beyond():
    density = extrapolate_long_waves(np.ones(len(WAVEVECTORS)), 1000.0, -3.0, 8000.0)
    wavelength = 2 * np.pi / WAVEVECTORS
    np.testing.assert_allclose(density, np.clip(wavelength / 1000, 1, 8) ** 3.0)


@pytest.mark.parametrize("sharpness", [1, 2, 4, 20])
@pytest.mark.parametrize("rolloff", [200.0, 400.0, 1000.0])
def test_the_rolloff_does_not_bias_the_hurst_exponent(rolloff, sharpness):
    def bent(q):
        return (1 + (q * rolloff / 2 / np.pi) ** (2 * sharpness)) ** (-1.7 / sharpness)

    fit = fit_hurst_exponent(BINS, bent(BINS), np.full(BINS.shape, 1e-4))
    assert fit.exponent == pytest.approx(0.7, abs=0.1)
    np.testing.assert_allclose([fit.shortest, fit.longest], 2 * np.pi / BINS[[-1, -11]])
