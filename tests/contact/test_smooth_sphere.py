"""Smooth spheres, Hertz and from DMT to JKR: closed forms and published numbers."""

import numpy as np
import pytest
from published_contact import CONTACT, MODULUS, RADIUS, SPACING, WORK
from refusals import assert_says, refusal
from scipy.optimize import brentq

from hardcontact.contact import smooth_sphere

LAMBDAS = np.geomspace(0.01, 100, 41)


def test_numbers_of_ruby_on_diamond():
    assert MODULUS == pytest.approx(289.7e9, rel=2e-4)
    contact, pressure, approach = smooth_sphere.hertz_contact(10e-6, RADIUS, MODULUS)
    assert pressure == pytest.approx(137e6, rel=5e-3)  # 135 MPa are published
    assert approach == pytest.approx(contact**2 / RADIUS)
    tabor = smooth_sphere.tabor_parameter(WORK, RADIUS, MODULUS, SPACING)
    assert tabor == pytest.approx(0.618, abs=5e-4)
    assert smooth_sphere.maugis_parameter(tabor) == pytest.approx(0.7155, abs=5e-4)
    assert smooth_sphere.maugis_parameter(1.0) == pytest.approx(1.157, abs=1e-4)


def test_the_pressure_of_hertz_carries_the_load():
    contact = smooth_sphere.hertz_contact(3e-6, 5e3, 100e9)
    carried = 2 / 3 * contact.peak_pressure * np.pi * (contact.radius * 1e-9) ** 2
    assert carried == pytest.approx(3e-6)


@pytest.mark.parametrize("law", ["transition_coefficient", "maugis_dugdale_coefficient"])
def test_transition_leads_from_dmt_to_jkr(law):
    coefficient = getattr(smooth_sphere, law)(LAMBDAS)
    assert (np.diff(coefficient) < 0).all()
    assert coefficient[0] == pytest.approx(2, abs=5e-3)
    assert coefficient[-1] == pytest.approx(1.5, abs=5e-4)
    assert smooth_sphere.dmt_pull_off(WORK, RADIUS) == pytest.approx(72.7e-6, rel=1e-3)
    assert smooth_sphere.jkr_pull_off(WORK, RADIUS) == pytest.approx(1.5 / 2 * 72.7e-6, rel=1e-3)


def test_fit_keeps_to_the_exact_pair():
    error = smooth_sphere.transition_coefficient(
        LAMBDAS
    ) / smooth_sphere.maugis_dugdale_coefficient(LAMBDAS)
    assert np.abs(error - 1).max() == pytest.approx(0.0165, abs=5e-4)


@pytest.mark.parametrize("maugis", [0.03, 0.3, 0.937, 5.0])
def test_exact_pair_by_solving_for_the_cohesive_zone(maugis):
    """The pair as printed: the first equation gives m for a radius, the second the force."""

    def root_and_angle(m):
        return np.sqrt(m**2 - 1), np.arctan(np.sqrt(m**2 - 1))

    def balance(m, radius):
        root, angle = root_and_angle(m)
        own = maugis * radius**2 / 2 * (root + (m**2 - 2) * angle)
        return own + 4 / 3 * maugis**2 * radius * (root * angle - m + 1) - 1

    def force(radius):
        m = brentq(balance, 1, 1e6, args=(radius,))
        root, angle = root_and_angle(m)
        return radius**3 - maugis * radius**2 * (root + m**2 * angle)

    least = min(force(radius) for radius in np.linspace(0.01, 2.0, 800))
    assert smooth_sphere.maugis_dugdale_coefficient(maugis) == pytest.approx(-least, rel=1e-5)


@pytest.mark.parametrize(
    "law", [smooth_sphere.transition_coefficient, smooth_sphere.maugis_dugdale_coefficient]
)
def test_self_consistent_work_gives_the_force_back(law):
    works = np.array([1e-6, 8e-5, 7e-3, 0.0463, 2.0, 1e3])
    tabor = smooth_sphere.tabor_parameter(works, RADIUS, MODULUS, SPACING)
    forces = law(smooth_sphere.maugis_parameter(tabor)) * np.pi * RADIUS * 1e-9 * works
    found = smooth_sphere.self_consistent_work_of_adhesion(forces, *CONTACT, law)
    np.testing.assert_allclose(found, works, rtol=1e-6)
    assert np.isnan(smooth_sphere.self_consistent_work_of_adhesion(np.nan, *CONTACT))


def test_what_is_not_positive_is_refused():
    assert_says(refusal(smooth_sphere.maugis_dugdale_coefficient, [1.0, 0.0]), "Maugis", "found 0")
    message = refusal(smooth_sphere.self_consistent_work_of_adhesion, 0.0, *CONTACT)
    assert_says(message, "pull-off force", "positive")
