"""Laws of attraction: their derivatives, their mixtures, and known strengths."""

import numpy as np
import pytest
from scipy import constants, integrate

from hardcontact.theory.interaction_laws import (
    EXPONENTIAL,
    LAWS,
    pressure,
    range_grid,
    strength_over_known,
    work_shares,
)
from hardcontact.theory.law_forces import MIXED_RANGES

BY_NAME = {law.name: law for law in LAWS}
POWERS = [law for law in LAWS if not law.exponential]


def energy(law, gap, rho):
    """Return u = -U/W of a law at gaps >= 0 and a range in nm."""
    reduced = np.asarray(gap, float) / law.spacing(rho)
    return np.exp(-reduced) if law.exponential else (1 + reduced) ** -law.exponent


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
def test_pressure_is_the_slope_of_the_energy_and_adds_up_to_the_work(law):
    rho, gap, step = 2.5, np.array([0.3, 2.0, 11.0]), 1e-5
    slope = (energy(law, gap + step, rho) - energy(law, gap - step, rho)) / (2 * step)
    np.testing.assert_allclose(-slope * rho, pressure(law, gap, rho), rtol=1e-8)
    work, _ = integrate.quad(lambda g: float(pressure(law, g, rho)) / rho, 0, np.inf)
    assert work == pytest.approx(1, rel=1e-8)
    assert energy(law, 0, rho) == pressure(law, 0, rho) == 1


@pytest.mark.parametrize("law", POWERS, ids=lambda law: law.name)
@pytest.mark.parametrize(("anchor", "error"), [(5.6, 3e-4), (7.95, 6e-3), (8.4, 3e-4)])
def test_mixtures_of_the_study_s_ranges_give_the_pressure_of_every_law(law, anchor, error):
    ranges, gap = range_grid(anchor, **MIXED_RANGES), np.append(0.0, np.geomspace(0.01, 300.0, 100))
    assert np.isclose(ranges, anchor, rtol=1e-12).any()
    assert ranges[0] <= MIXED_RANGES["low"] and ranges[-1] >= MIXED_RANGES["high"]
    for rho in range_grid(anchor, 0.03, 0.1, 40.0):
        shares = work_shares(law, rho, ranges)
        mixture = rho * (shares / ranges * np.exp(-gap[:, None] / ranges)).sum(axis=1)
        np.testing.assert_allclose(mixture, pressure(law, gap, rho), rtol=error)


def test_a_power_law_of_large_exponent_is_the_exponential_law():
    steep = type(EXPONENTIAL)("steep", "steep", 1e7, np.nan)
    gap = np.linspace(0, 20, 50)
    np.testing.assert_allclose(
        pressure(steep, gap, 5.6), pressure(EXPONENTIAL, gap, 5.6), rtol=1e-5
    )


def test_known_laws_have_their_known_strengths():
    # A = 12 pi g0² W; ideal mirrors attract with 1.30 mPa at 1 µm; 1 V over 1 nm is 4.4 MPa.
    work = 5e-19 / (12 * np.pi * (0.3e-9) ** 2)
    assert strength_over_known(BY_NAME["van_der_waals"], 0.15, work) == pytest.approx(1)
    mirrors = BY_NAME["retarded"]
    assert 3 * mirrors.max_strength / (1e-6) ** 4 == pytest.approx(1.30e-3, rel=1e-3)
    assert BY_NAME["electrostatic"].max_strength / 1e-18 == pytest.approx(
        constants.epsilon_0 / 2e-18
    )
    assert np.isnan(strength_over_known(EXPONENTIAL, 5.6, 0.0463))
