"""The distribution of forces over positions, against closed forms and sampled sums."""

from dataclasses import replace

import numpy as np
import pytest
from known_spectra import contact_of_area, gaussian_spectrum, self_affine_spectrum
from scipy import special, stats

from hardcontact.base.arrays import generator
from hardcontact.theory.closed_form import closed_form, contact_term, smooth_force
from hardcontact.theory.pull_off_statistics import (
    ForceStatistics,
    dispersion_index,
    field_variation,
    predict_statistics,
    summit_radius_variation,
)
from hardcontact.theory.summits import LEVELS, apex_distribution, spectrum_between, summits_above

SPHERE = contact_of_area(250e3, 5.6, 1.0, 400.0)
#: A sphere so flat that its highest summits obey the laws of high levels.
FLAT = 1e12
SIGMA = 4.0
SURFACE = gaussian_spectrum(SIGMA, 100)


def flat_contact(modulus, summits=0.0):
    """Return a contact of a modulus with the area of a number of mean summits."""
    spectrum = spectrum_between(SURFACE, 0, np.inf)
    _, number, bearing = summits_above(spectrum, FLAT)
    highest = apex_distribution(spectrum, FLAT, 0.0).mean()
    area = summits * np.interp(highest, LEVELS, bearing / np.maximum(number, 1e-99))
    level = apex_distribution(spectrum, FLAT, area).mean()
    return contact_of_area(FLAT, modulus * SIGMA / level, 1.0, area)


def sampled_sums(modulus, positions=4000, points=400):
    """Return sums of summits over positions: Σ R_i (G_1/G_i)^(1/k), R_i the radii of summits."""
    rng = generator(1, "clumps")
    arrivals = rng.exponential(size=(positions, points)).cumsum(axis=1)
    level = apex_distribution(spectrum_between(SURFACE, 0, np.inf), FLAT, 0.0).mean()
    radii = rng.choice(sampled_radii(rng, level), (positions, points))
    return (radii * (arrivals[:, :1] / arrivals) ** (1 / modulus)).sum(axis=1)


def sampled_radii(rng, level, count=400000):
    """Return 1/sqrt(K) of summits of SURFACE, sampled by the curvatures of points at a level."""
    # exp(-d²/2) has the fourth moment 3: h_xx and h_yy have the mean -t and the covariance
    # [[2, 0], [0, 2]] given the height t, h_xy the variance 1.
    xx, yy = -level + np.sqrt(2) * rng.standard_normal((2, count))
    curvature = xx * yy - rng.standard_normal(count) ** 2
    summit = (curvature > 0) & (xx < 0)
    weight = curvature[summit] / curvature[summit].sum()
    return 1 / np.sqrt(rng.choice(curvature[summit], count, p=weight))


@pytest.mark.parametrize(("rho", "low", "high"), [(2.0, 0.7, 0.9), (40.0, 0.99, 1.0)])
def test_the_mean_force_equals_the_closed_form(rho, low, high):
    """Rough summits below the sphere lessen it where single peaks decide, not for many points."""
    contact, spectrum = replace(SPHERE, rho=rho), self_affine_spectrum(30, 1000, 0.8, 5.0)
    force = closed_form(spectrum, contact).force
    assert predict_statistics(spectrum, contact).force == pytest.approx(force)
    assert low < force / closed_form(spectrum, contact, rough_close_points=False).force < high


def test_radii_of_summits_scatter_like_sampled_radii():
    spectrum = spectrum_between(SURFACE, 0, np.inf)
    apex = apex_distribution(spectrum, FLAT, 0.0)
    radii = sampled_radii(generator(1, "radii"), apex.mean())
    assert summit_radius_variation(spectrum, apex) == pytest.approx(
        radii.std() / radii.mean(), rel=0.003
    )


@pytest.mark.parametrize("modulus", [2.0, 4.0, 8.0])
def test_many_points_follow_weibull_s_law(modulus):
    law = predict_statistics(SURFACE, flat_contact(modulus))
    assert law.weibull_modulus == pytest.approx(modulus, rel=1e-3)
    weibull = stats.weibull_min(law.weibull_modulus)
    assert law.relative_std == pytest.approx(weibull.std() / weibull.mean(), rel=0.03)
    # ln F follows Gumbel's law.
    assert law.log_force_std == pytest.approx(np.pi / np.sqrt(6) / law.weibull_modulus, rel=0.03)


@pytest.mark.parametrize("summits", [3.0, 30.0])
def test_the_level_of_n_summits_scatters_like_a_gamma_variable(summits):
    law = predict_statistics(SURFACE, flat_contact(3.0, summits))
    # Exponential areas fill the contact with 1 + Poisson's number of summits.
    number = 1 + np.arange(200)
    chance = stats.poisson.pmf(number - 1, law.touching_count - 1)
    centre = chance @ special.digamma(number)
    spread = chance @ (special.polygamma(1, number) + (special.digamma(number) - centre) ** 2)
    assert law.log_force_std == pytest.approx(np.sqrt(spread) / law.weibull_modulus, rel=0.1)


@pytest.mark.parametrize("summits", [3.0, 30.0])
def test_n_summits_attract_like_the_mean_power_of_a_gamma_variable(summits):
    contact = flat_contact(3.0, summits)
    plastic = predict_statistics(SURFACE, contact)
    rigid = predict_statistics(SURFACE, replace(contact, preload=0.0))
    # The contact area itself attracts, too.
    area_force = smooth_force(contact) * (1 - 1 / (1 + contact_term(contact)))
    power, number = 2 / (plastic.weibull_modulus + rigid.weibull_modulus), 1 + np.arange(200)
    chance = stats.poisson.pmf(number - 1, plastic.touching_count - 1)
    mean_power = chance @ np.exp(special.gammaln(number + power) - special.gammaln(number))
    force_ratio = (plastic.force - area_force) / rigid.force
    assert force_ratio == pytest.approx(mean_power / special.gamma(1 + power), rel=0.01)


@pytest.mark.parametrize("cover", [0.05, 0.3, 0.6])
def test_numbers_of_hard_discs_scatter_by_their_compressibility(cover):
    def pressure(share):
        return share / (1 - share) ** 2

    slope = (pressure(cover + 1e-5) - pressure(cover - 1e-5)) / 2e-5
    assert dispersion_index(cover) == pytest.approx(1 / slope, rel=1e-6)


@pytest.mark.parametrize("modulus", [0.1, 0.3, 0.5])
def test_few_summits_scatter_like_sums_of_poisson_summits(modulus):
    law, sums = predict_statistics(SURFACE, flat_contact(modulus)), sampled_sums(modulus)
    assert law.log_force_std == pytest.approx(np.log(sums).std(), rel=0.1)


def test_a_field_of_large_heights_scatters_like_the_sum_over_powers():
    # exp(n s² exp(-d²/2l²)) expanded, and each power averaged over exp(-d²/2 spot).
    rho, power = 3.0, np.arange(1, 40)
    contact = contact_of_area(250e3, rho, 1.0, 0.0)
    spot = 2 * contact.radius * rho
    terms = (SIGMA / rho) ** (2 * power) / special.factorial(power) / (1 + power * spot / 100**2)
    variation = field_variation(spectrum_between(SURFACE, 0, np.inf), contact)
    assert variation == pytest.approx(np.sqrt(terms.sum()), rel=1e-3)
    assert variation > 1.2 * np.sqrt(terms[0])


def test_the_moments_of_a_mixture_equal_those_of_its_samples():
    mixture = ForceStatistics(
        1.0, 1.0, np.array([1.0, 3.0]), np.array([0.3, 0.7]), np.array([0.2, 0.4])
    )
    rng = generator(1, "mixture")
    level = rng.choice(2, 400000, p=mixture.weights)
    spread = mixture.log_force_stds[level]
    forces = mixture.means[level] * rng.lognormal(-(spread**2) / 2, spread)
    assert mixture.force == pytest.approx(forces.mean(), rel=0.01)
    assert mixture.relative_std == pytest.approx(forces.std() / forces.mean(), rel=0.01)
    assert mixture.log_force_std == pytest.approx(np.log(forces).std(), rel=0.01)


def test_without_roughness_all_positions_have_the_same_force():
    smooth = predict_statistics(
        gaussian_spectrum(1e-6, 1e5), contact_of_area(250e3, 5.6, 1.0, 400.0)
    )
    assert smooth.log_force_std == 0
    assert smooth.force > 2 * np.pi * 250e3 * 1e-9
