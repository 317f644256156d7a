"""The highest summits: width, density, height of the apex, search size."""

from itertools import product

import numpy as np
import pytest
from known_spectra import gaussian_spectrum, self_affine_spectrum
from scipy import integrate, stats

from hardcontact.base.arrays import generator
from hardcontact.surfaces.spectral_models import smooth_rolloff
from hardcontact.surfaces.spectrum import Spectrum, spectral_moment
from hardcontact.surfaces.synthesis import random_surface
from hardcontact.theory import summits
from hardcontact.theory.summits import search_size, spectrum_between

RADIUS = 250e3
#: Radius of a sphere so large that its highest summits obey the laws of high levels.
LARGE_RADIUS = 1e9


def full_band(spectrum):
    return spectrum_between(spectrum, 0, np.inf)


GAUSSIAN = full_band(gaussian_spectrum(rms=4, length=100))


def test_a_gaussian_autocorrelation_has_known_moments():
    # A spectrum at forty wavevectors per decade misses integrals by a few thousandths.
    spectrum = GAUSSIAN
    assert spectral_moment(spectrum, 0) == pytest.approx(16, rel=0.005)
    assert spectral_moment(spectrum, 2) == pytest.approx(2 * (4 / 100) ** 2, rel=0.005)
    assert spectral_moment(spectrum, 4) == pytest.approx(8 * 16 / 100**4, rel=0.005)


def test_a_gaussian_autocorrelation_has_summits_of_known_width():
    levels = np.array([1.5, 2.5, 4.0])
    half_widths = 100 * np.sqrt(-2 * np.log(1 - 1 / levels**2))  # exp(-d²/2l²) = 1 - 1/t²
    assert summits.summit_half_width(GAUSSIAN, levels) == pytest.approx(half_widths, rel=0.002)


def test_summits_at_high_levels_are_as_dense_as_maxima_of_a_smooth_surface():
    spectrum, level = GAUSSIAN, 5.0
    density = stats.norm.sf(level) / (np.pi * summits.summit_half_width(spectrum, [level])[0] ** 2)
    relative_square_slope = spectral_moment(spectrum, 2) / 2 / spectral_moment(spectrum, 0)
    maxima_density = (
        level * np.exp(-(level**2) / 2) * relative_square_slope / (2 * np.pi) ** 1.5  # Nayak
    )
    # At t = 5, sf(t) is 4 % below its asymptote, and a summit 2 % larger than 2 pi l²/t².
    assert density == pytest.approx(maxima_density, rel=0.08)


def test_short_waves_of_small_height_make_no_summits():
    q = np.geomspace(2 * np.pi / 1e4, 2 * np.pi, 600)
    long = 2 * np.pi * (4 * 100) ** 2 * np.exp(-((q * 100) ** 2) / 2)
    short = np.where(q > 2 * np.pi / 3, 2 * np.pi * 0.1**2 / np.pi / (q[-1] / 3) ** 2, 0)
    all_waves = full_band(Spectrum(q, long + short))
    long_waves = full_band(Spectrum(q, long + 1e-9))  # 1e-9: to keep the band
    # Short waves of some 0.1 nm make slopes, and so maxima.
    assert spectral_moment(all_waves, 2) > 1.5 * spectral_moment(long_waves, 2)
    assert summits.summit_half_width(all_waves, [3.5]) == pytest.approx(
        summits.summit_half_width(long_waves, [3.5]), rel=0.01
    )


def test_the_apex_of_a_rigid_contact_follows_gumbel_s_law():
    spectrum = GAUSSIAN
    apex = summits.apex_distribution(spectrum, LARGE_RADIUS, 0.0)
    # Lambda(t) = R m2/(sigma sqrt(2 pi)) exp(-t²/2) is 1 at the location; m2: mean square slope.
    mean_square_slope = spectral_moment(spectrum, 2) / 2
    location = np.sqrt(2 * np.log(LARGE_RADIUS * mean_square_slope / (4 * np.sqrt(2 * np.pi))))
    gumbel = stats.gumbel_r(location, 1 / location)
    assert apex.weights.sum() == pytest.approx(1)
    assert apex.mean() == pytest.approx(gumbel.mean(), rel=0.01)
    deviation = np.sqrt(apex.mean(apex.levels**2) - apex.mean() ** 2)
    assert deviation == pytest.approx(gumbel.std(), rel=0.05)


@pytest.mark.parametrize("area", [0.0, 0.3, 4.0, 49.0])
def test_exponential_areas_of_poisson_summits_have_a_known_distribution(area):
    # n areas of mean 1 sum to less than `area` if a Poisson number of mean `area` is at least n.
    counts, n = np.geomspace(1e-4, 300, 200), np.arange(1000)[:, None]
    terms = stats.poisson.pmf(n, counts) * stats.poisson.sf(n - 1, area)
    probability = summits._probability_of_smaller_area(counts, np.full(200, area))
    assert probability[0] > 0.99 and probability[-1] < 1e-20
    np.testing.assert_allclose(probability, terms.sum(axis=0), rtol=1e-11, atol=1e-19)


def test_a_large_contact_area_is_the_bearing_area():
    spectrum, area = GAUSSIAN, 3e6
    level = summits.apex_distribution(spectrum, LARGE_RADIUS, area).mean()
    bearing_area = 2 * np.pi * LARGE_RADIUS * 4 * integrate.quad(stats.norm.sf, level, 10)[0]
    assert bearing_area == pytest.approx(area, rel=1e-3)
    assert level < summits.apex_distribution(spectrum, LARGE_RADIUS, 400).mean()


def test_the_mean_apex_height_matches_random_surfaces():
    spectrum = self_affine_spectrum(rolloff=300, shortest=40)
    pixels, size, radius = 256, 2560.0, 20e3
    # The longest waves of the map stand for wavelengths up to twice its size.
    spectrum_on_map = spectrum_between(spectrum, 2 * np.pi / (2 * size), np.inf)
    offset = (np.arange(pixels) - pixels / 2) * 10.0
    sphere = (offset[:, None] ** 2 + offset**2) / (2 * radius)
    apex_heights = [
        (random_surface(generator(3, k), pixels, 10.0, spectrum).heights - sphere).max()
        for k in range(120)
    ]
    mean_level = summits.apex_distribution(spectrum_on_map, radius, 0.0).mean()
    mean_height = mean_level * np.sqrt(spectral_moment(spectrum_on_map, 0))
    assert mean_height == pytest.approx(np.mean(apex_heights), rel=0.08)


def test_a_sphere_follows_long_waves_of_small_curvature():
    spectrum = self_affine_spectrum(rolloff=1e6)  # longer than all waves of the grid
    rough_spectrum = summits.find_rough_spectrum(spectrum, RADIUS)
    assert rough_spectrum.wavevector[0] > 10 * spectrum.wavevector[0]
    followed_spectrum = spectrum_between(spectrum, 0, rough_spectrum.wavevector[0])
    curvature = np.sqrt(spectral_moment(followed_spectrum, 4)) / 2
    assert curvature == pytest.approx(0.1 / RADIUS, rel=0.01)
    assert summits.find_rough_spectrum(spectrum, 1.0) is None  # a tiny sphere follows all waves
    smooth = Spectrum(spectrum.wavevector, 0 * spectrum.density)
    assert summits.find_rough_spectrum(smooth, RADIUS) is None


@pytest.mark.parametrize(("rms_height", "radius"), [(4.0, 50e3), (8.0, 20e3), (2.0, 100e3)])
def test_the_search_size_is_twice_the_rms_distance_of_the_highest_points(rms_height, radius):
    pixels, pixel = 256, 40.0
    q = np.geomspace(2 * np.pi / (pixels * pixel), np.pi / pixel, 300)
    spectrum = Spectrum(q, smooth_rolloff(q, plateau=1.0, rolloff=930.0, hurst=0.84))
    spectrum = Spectrum(q, spectrum.density * rms_height**2 / spectral_moment(spectrum, 0))
    position = pixel * (np.arange(pixels) - pixels // 2)
    squares = position[:, None] ** 2 + position**2
    squared_distances = []
    for trial in range(60):
        heights = random_surface(generator(3, trial), pixels, pixel, spectrum).heights
        heights = rms_height / heights.std() * heights
        for shift in product((0, 85, 170), repeat=2):  # nine positions on the periodic surface
            heights_above_sphere = np.roll(heights, shift, (0, 1)) - squares / (2 * radius)
            squared_distances.append(squares.flat[heights_above_sphere.argmax()])
    rms_distance = search_size(spectrum, radius, 0.0) / 2
    assert np.sqrt(np.mean(squared_distances)) == pytest.approx(rms_distance, rel=0.05)
