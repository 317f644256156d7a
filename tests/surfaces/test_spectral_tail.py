"""Measured spectra beyond their band: exponents held in bounds, slope and curvature bounded."""

import numpy as np
import pytest
from random_scans import uncd

from hardcontact.surfaces.extrapolated_spectrum import (
    ATOMIC,
    GRADIENT,
    HALF_LAPLACIAN,
    continued_spectrum,
)
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum, all_scales_moments

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


def test_three_points_are_enough_and_measured_ones_stay():
    points = np.array([0.01, 0.0126, 0.0158])
    spectrum, _ = continued(points**-3.0, points)
    np.testing.assert_allclose(Spectrum(WAVEVECTORS, spectrum)(points[1]), points[1] ** -3.0, 0.01)


def test_points_below_the_distance_of_atoms_are_kept():
    points = 2 * np.pi / np.array([1.0, 0.5, 0.2, 0.1])
    spectrum, tail = continued(1e-9 * points**-3.0, points)
    assert spectrum[-1] > 0 and np.isnan(tail.tail_hurst)
