"""The closed form: against integrals, limits, and forces computed on random surfaces."""

import numpy as np
import pytest
from known_spectra import contact_of_area, gaussian_spectrum, self_affine_spectrum
from scipy import special, stats

from hardcontact.base.arrays import generator
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import join_bodies
from hardcontact.contact.pull_off import pull_off_dataset
from hardcontact.surfaces.spectrum import Spectrum
from hardcontact.surfaces.synthesis import random_surface
from hardcontact.theory.closed_form import (
    Regime,
    closed_form,
    critical_band,
    filtered_spectrum,
    smooth_force,
    surface_term,
)
from hardcontact.theory.summits import LEVELS, apex_distribution, spectrum_between, summits_above

RADIUS = 250e3


def contact(rho=5.6, area=400.0, radius=RADIUS):
    return contact_of_area(radius, rho, work=1.0, area=area)


@pytest.mark.parametrize(("sigma", "m", "rho"), [(4, 10, 5.6), (4, 10, 1), (17, 55, 3)])
def test_surface_and_summit_term_equal_the_integral_over_rings(sigma, m, rho):
    """The integral of theory.md, All rings."""
    y = np.linspace(m, m + 20 * rho + 8 * sigma, 1501)
    share_of_heights = np.linspace(0, 1, 1001)[:, None]
    height = -10 * sigma + share_of_heights * (y + 10 * sigma)
    attraction = stats.norm.pdf(height, 0, sigma) * np.exp(-(y - height) / rho)
    attraction_at_y = np.trapezoid(attraction, share_of_heights, axis=0) * (y + 10 * sigma)
    force = np.trapezoid(attraction_at_y, y) / rho
    both_terms = surface_term(m / sigma, sigma / rho) + stats.norm.sf(m / sigma)
    assert both_terms == pytest.approx(force, rel=3e-4)


def test_the_surface_term_has_its_asymptote_at_short_range():
    sigma, m, rho = 100.0, 300.0, 0.5  # nm
    asymptote = stats.norm.pdf(m / sigma) / (sigma / rho - m / sigma)
    assert surface_term(m / sigma, sigma / rho) == pytest.approx(asymptote, rel=1e-3)


def test_without_roughness_the_closed_form_is_the_force_of_a_smooth_sphere():
    flat = Spectrum(self_affine_spectrum().wavevector, 0 * self_affine_spectrum().density)
    form = closed_form(flat, contact())
    # The area in contact adds A/(2 pi R rho) of the force of DMT.
    dmt_ratio = 1 + contact().area / (2 * np.pi * RADIUS * contact().rho)
    assert form.force == pytest.approx(2 * np.pi * RADIUS * 1e-9 * dmt_ratio)
    assert form.dmt_ratio == pytest.approx(dmt_ratio, rel=1e-12)
    assert (form.regime, form.weibull_modulus) == (Regime.SMOOTH, np.inf)
    nearly_smooth = closed_form(self_affine_spectrum(rms=0.02), contact())
    assert nearly_smooth.regime == Regime.SMOOTH
    assert nearly_smooth.dmt_ratio == pytest.approx(1, abs=0.03)
    assert np.isnan(critical_band(flat, contact(), 0.1)).all()


def test_the_force_of_a_wide_contact_reaches_its_smooth_limit():
    wide = contact(area=0.57 * 2 * np.pi * RADIUS * contact().rho)
    for rms, error in ((0.0, 1e-6), (0.02, 0.03)):
        form = closed_form(self_affine_spectrum(rms), wide)
        assert form.dmt_ratio == pytest.approx(1.57, abs=error)
    assert np.isnan(critical_band(self_affine_spectrum(rms=0.02), wide, 0.1)).all()


def test_a_single_smooth_summit_attracts_like_a_sphere_of_its_radius():
    sigma, length, rho = 40.0, 300.0, 1e-3  # the range is so short that only one summit counts
    large_radius = 1e9  # so that the summit is high
    form = closed_form(gaussian_spectrum(sigma, length), contact(rho, 0.0, large_radius))
    level = form.apex_height / sigma
    # The mean curvature of high summits is the level times the mean square slope over sigma.
    summit_radius = length**2 / (sigma * level)
    assert form.regime == Regime.FEW_SUMMITS
    assert form.dmt_ratio == pytest.approx(summit_radius / large_radius, rel=0.1)


def mean_power(touching_count, exponent):
    """Return the mean of G_n^exponent (theory.md, "What do the summits add up to?").

    The highest summit touches, and a Poisson number of others.
    """
    n = 1 + np.arange(200)
    probability = stats.poisson.pmf(n - 1, touching_count - 1)
    return probability @ np.exp(special.gammaln(n + exponent) - special.gammaln(n))


@pytest.mark.parametrize("filling_count", [3.0, 30.0])
def test_plastic_forces_grow_like_the_mean_power_of_g_n(filling_count):
    """F is proportional to G_n^(1/k), in rigid contact with n = 1."""
    sigma = 4.0
    large_radius = 1e12  # so that the highest summits obey the laws of high levels
    spectrum = gaussian_spectrum(sigma)
    rough_spectrum = spectrum_between(spectrum, 0, np.inf)
    _, counts, bearing_areas = summits_above(rough_spectrum, large_radius)
    highest_level = apex_distribution(rough_spectrum, large_radius, 0.0).mean()
    summit_areas = bearing_areas / np.maximum(counts, 1e-99)
    area = filling_count * np.interp(highest_level, LEVELS, summit_areas)
    apex = apex_distribution(rough_spectrum, large_radius, area)
    rho = 3 * sigma / apex.mean()  # the modulus is 3
    plastic_contact = contact(rho, area, large_radius)
    rigid_contact = contact(rho, 0.0, large_radius)
    plastic = closed_form(spectrum, plastic_contact)
    rigid = closed_form(spectrum, rigid_contact)
    area_force = smooth_force(plastic_contact) - smooth_force(rigid_contact)
    exponent = 2 / (plastic.weibull_modulus + rigid.weibull_modulus)  # 1/k
    touching_count = apex.mean(np.interp(apex.levels, LEVELS, counts))
    expected_ratio = mean_power(touching_count, exponent) / mean_power(1, exponent)
    assert (plastic.force - area_force) / rigid.force == pytest.approx(expected_ratio, rel=0.01)


@pytest.mark.parametrize(("rho", "low", "high"), [(2.0, 0.7, 0.9), (40.0, 0.99, 1.0)])
def test_rough_close_points_lower_the_force_if_the_range_is_short(rho, low, high):
    spectrum = self_affine_spectrum(rms=30, shortest=5.0)
    smooth_points = closed_form(spectrum, contact(rho), rough_close_points=False)
    assert low < closed_form(spectrum, contact(rho)).force / smooth_points.force < high


@pytest.mark.parametrize(("rms", "rho", "error"), [(4, 5.6, 0.2), (4, 20, 0.05), (40, 5.6, 0.4)])
def test_the_closed_form_predicts_forces_on_random_surfaces(rms, rho, error):
    pixels, size, radius = 512, 10e3, 50e3
    spectrum = self_affine_spectrum(rms, rolloff=800.0, shortest=80.0)
    # The preload over the hardness is 400 nm².
    loaded = Contact(radius=radius, preload=1e-5, hardness=25e9, window=size, contacts_per_row=8)
    forces = []
    for number in range(3):
        surface = random_surface(generator(7, number), pixels, size / pixels, spectrum)
        bodies = join_bodies(surface, None, loaded)
        plastic = pull_off_dataset(bodies, loaded, [rho]).sel(contact_model="plastic")
        forces.append(plastic["pull_off_force"].values.mean())
    form = closed_form(spectrum, contact(rho, 400.0, radius))
    assert form.force == pytest.approx(np.mean(forces), rel=error)


def test_the_force_reaches_the_tolerance_at_the_edges():
    spectrum = self_affine_spectrum(rms=17, shortest=10.0)
    short, long = critical_band(spectrum, contact(), 0.1)
    assert 10 < short < 300 < long < 5000
    unfiltered = closed_form(spectrum, contact(), rough_close_points=False).dmt_ratio
    for side, edge in (("short", short), ("long", long)):
        filtered = filtered_spectrum(spectrum, side, edge)
        ratio = closed_form(filtered, contact(), rough_close_points=False).dmt_ratio / unfiltered
        assert min(abs(np.log(ratio / limit)) for limit in (0.9, 1.1)) < 0.02
