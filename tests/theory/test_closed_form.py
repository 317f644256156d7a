"""The closed form: against integrals, limits, and forces computed on random surfaces."""

import numpy as np
import pytest
from known_spectra import rough, rounded
from scipy import stats

from hardcontact.base.random import generator
from hardcontact.contact.contact import Contact, contact_of_area
from hardcontact.contact.geometry import bodies
from hardcontact.contact.pull_off import pull_off_of_pair
from hardcontact.surfaces.spectrum import Spectrum
from hardcontact.surfaces.synthesis import random_surface
from hardcontact.theory.closed_form import (
    SINGLE_PEAKS,
    SMOOTH,
    closed_form,
    edges,
    filtered_spectrum,
    gaussian_share,
)
from hardcontact.theory.summits import moment

RADIUS = 250e3


def contact(rho=5.6, area=400.0, radius=RADIUS):
    return contact_of_area(radius, rho, 1.0, area)


@pytest.mark.parametrize(("sigma", "m", "rho"), [(4, 10, 5.6), (4, 10, 1), (17, 55, 3)])
def test_both_terms_are_the_integral_over_gaps_and_heights(sigma, m, rho):
    gap = np.linspace(m, m + 20 * rho + 8 * sigma, 1501)
    below = np.linspace(0, 1, 1001)[:, None]
    height = -10 * sigma + below * (gap + 10 * sigma)  # up to the sphere
    attraction = stats.norm.pdf(height, 0, sigma) * np.exp(-(gap - height) / rho)
    of_gap = np.trapezoid(attraction, below, axis=0) * (gap + 10 * sigma)
    force = np.trapezoid(of_gap, gap) / rho
    both = gaussian_share(sigma, m, rho) + stats.norm.sf(m / sigma)
    assert both == pytest.approx(force, rel=3e-4)


def test_the_first_term_freezes():
    sigma, m, rho = 100.0, 300.0, 0.5
    frozen = stats.norm.pdf(m / sigma) / (sigma / rho - m / sigma)
    assert gaussian_share(sigma, m, rho) == pytest.approx(frozen, rel=1e-3)


def test_without_roughness_the_force_is_that_of_a_smooth_sphere():
    flat = Spectrum(rough().wavevector, 0 * rough().density)
    found = closed_form(flat, contact())
    # Beside it the area in contact alone attracts, by A/(2 pi R rho) of that.
    relative = 1 + contact().area / (2 * np.pi * RADIUS * contact().range)
    assert found.force == pytest.approx(2 * np.pi * RADIUS * 1e-9 * relative)
    assert found.relative == pytest.approx(relative, rel=1e-12)
    assert (found.regime, found.freezing) == (SMOOTH, 0.0)
    little = closed_form(rough(0.02), contact())
    assert little.regime == SMOOTH and little.relative == pytest.approx(1, abs=0.03)
    assert np.isnan(edges(flat, contact(), 0.1)).all()


def test_the_force_of_a_wide_contact_goes_to_its_limit_as_roughness_vanishes():
    wide = contact(area=0.57 * 2 * np.pi * RADIUS * contact().range)
    little, none = (closed_form(rough(height), wide) for height in (0.02, 0.0))
    assert none.relative == pytest.approx(1.57) == pytest.approx(little.relative, abs=0.03)
    assert np.isnan(edges(rough(0.02), wide, 0.1)).all()


def test_a_single_smooth_summit_is_a_sphere_of_its_radius():
    sigma, length, rho = 40.0, 300.0, 1e-3  # so short a range that only one summit counts
    flat = 1e9  # so that the summit is a high one
    found = closed_form(rounded(sigma, length), contact(rho, 0.0, flat))
    level = found.closest_approach / sigma
    summit = length**2 / (sigma * level)  # its curvature is t m2/sigma
    assert found.regime == SINGLE_PEAKS
    assert found.relative == pytest.approx(summit / flat, rel=0.1)


def test_force_is_linear_in_work_and_area_of_contact_attracts():
    double = closed_form(rough(), contact_of_area(RADIUS, 5.6, 2.0, 400.0))
    assert double.force == pytest.approx(2 * closed_form(rough(), contact()).force)
    rigid, plastic = (closed_form(rough(), contact(area=area)) for area in (0.0, 400.0))
    assert plastic.closest_approach < rigid.closest_approach
    assert plastic.force > rigid.force


@pytest.mark.parametrize(
    ("rms", "rho", "of_spectrum", "of_contacts"),
    [(4, 5.6, 0.2, 0.05), (4, 20, 0.05, 0.02), (40, 5.6, 0.4, 0.4)],
)
def test_forces_on_random_surfaces(rms, rho, of_spectrum, of_contacts):
    pixels, size, radius = 512, 10e3, 50e3
    spectrum = rough(rms, 800.0, 0.8, 80.0)
    touching = Contact(radius=radius, preload=1e-5, hardness=25e9, window=size, count=8)
    forces, approaches = [], []
    for k in range(3):
        surface = random_surface(generator(7, k), pixels, size / pixels, spectrum)
        pair = bodies(surface, None, touching)
        plastic = pull_off_of_pair(pair, touching, [rho]).sel(contact_model="plastic")
        forces.append(plastic["pull_off_force"].values.mean())
        approaches.append(-plastic["closest_approach"].values)
    at = contact(rho, 400.0, radius)
    for given, error in ((None, of_spectrum), (np.array(approaches), of_contacts)):
        assert closed_form(spectrum, at, given).force == pytest.approx(np.mean(forces), rel=error)


def test_edges_are_where_the_force_has_changed():
    spectrum = rough(17, 1000, 0.8, 10.0)
    short, long = edges(spectrum, contact(), 0.1)
    assert 10 < short < 300 < long < 5000
    whole = closed_form(spectrum, contact(), rough_below=False).relative
    for side, edge in (("small", short), ("large", long)):
        part = filtered_spectrum(spectrum, side, edge)
        left = closed_form(part, contact(), rough_below=False).relative / whole
        assert min(abs(np.log(left / end)) for end in (0.9, 1.1)) < 0.02


def test_filters_add_up_to_the_spectrum():
    spectrum = rough()
    parts = [filtered_spectrum(spectrum, side, 300.0) for side in ("small", "large")]
    total = sum(moment(part, 0) for part in parts)
    assert total == pytest.approx(moment(filtered_spectrum(spectrum, "small", 1e-3), 0), rel=0.02)
    assert not filtered_spectrum(spectrum, "small", 1e9).density.any()
