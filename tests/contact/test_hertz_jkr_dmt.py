"""Smooth spheres, Hertz and from DMT to JKR: closed forms and published numbers."""

import numpy as np
import pytest
from paper_numbers import MODULUS, RADIUS, SPACING, WORK
from scipy.optimize import brentq

from hardcontact.contact import hertz_jkr_dmt

LAMBDAS = np.geomspace(0.01, 100, 41)


def test_ruby_on_diamond_has_the_published_numbers():
    assert MODULUS == pytest.approx(289.7e9, rel=2e-4)
    pressure = hertz_jkr_dmt.hertz_peak_pressure(10e-6, RADIUS, MODULUS)
    assert pressure == pytest.approx(137e6, rel=5e-3)  # 135 MPa are published
    tabor = hertz_jkr_dmt.tabor_parameter(WORK, RADIUS, MODULUS, SPACING)
    assert tabor == pytest.approx(0.618, abs=5e-4)
    assert hertz_jkr_dmt.maugis_parameter(tabor) == pytest.approx(0.7155, abs=5e-4)
    assert hertz_jkr_dmt.maugis_parameter(1.0) == pytest.approx(1.157, abs=1e-4)


def test_the_pull_off_coefficient_leads_from_dmt_to_jkr():
    coefficient = hertz_jkr_dmt.pull_off_coefficient(LAMBDAS)
    assert (np.diff(coefficient) < 0).all()
    assert coefficient[0] == pytest.approx(2, abs=5e-3)
    assert coefficient[-1] == pytest.approx(1.5, abs=5e-4)
    assert hertz_jkr_dmt.dmt_pull_off(WORK, RADIUS) == pytest.approx(72.7e-6, rel=1e-3)  # 2πWR
    assert hertz_jkr_dmt.jkr_pull_off(WORK, RADIUS) == pytest.approx(1.5 / 2 * 72.7e-6, rel=1e-3)


@pytest.mark.parametrize("maugis", [0.03, 0.3, 0.937, 5.0])
def test_the_pull_off_coefficient_matches_the_exact_solution_of_maugis(maugis):
    """The first equation gives m for a radius, the second the force; the fit keeps to 1.7 %."""

    def root_and_angle(m):
        return np.sqrt(m**2 - 1), np.arctan(np.sqrt(m**2 - 1))

    def balance(m, radius):
        root, angle = root_and_angle(m)
        attraction = maugis * radius**2 / 2 * (root + (m**2 - 2) * angle)
        return attraction + 4 / 3 * maugis**2 * radius * (root * angle - m + 1) - 1

    def force(radius):
        m = brentq(balance, 1, 1e6, args=(radius,))
        root, angle = root_and_angle(m)
        return radius**3 - maugis * radius**2 * (root + m**2 * angle)

    exact = -min(force(radius) for radius in np.linspace(0.01, 2.0, 800))
    assert hertz_jkr_dmt.pull_off_coefficient(maugis) == pytest.approx(exact, rel=0.017)
