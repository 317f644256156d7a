"""Laws of attraction: their derivatives, the mixtures that they are, and known strengths."""

from typing import NamedTuple

import numpy as np
import pytest
from scipy import constants, integrate, optimize, special

from hardcontact.insight.interaction_laws import (
    EXPONENTIAL,
    LAWS,
    implied_over_known,
    pressure,
    work_shares,
)

BY_NAME = {law.name: law for law in LAWS}
POWERS = [law for law in LAWS if not law.exponential]
GAPS = np.concatenate([[0.0], np.geomspace(1e-3, 1e3, 400)])


def energy(law, gap, rho):
    """Return u = -U/W of a law at gaps >= 0 and a range in nm."""
    reduced = np.asarray(gap, float) / law.spacing(rho)
    return np.exp(-reduced) if law.exponential else (1 + reduced) ** -law.exponent


class Mixture(NamedTuple):
    """Exponential laws that add up to a law: their ranges (k,) in nm and their shares (k,) of W."""

    ranges: np.ndarray
    shares: np.ndarray


def mixture(law, rho, tolerance):
    """Return the mixture that is a power law: relative errors of its sums, at all of GAPS."""
    step = trapezoidal_step(law.exponent + 1, tolerance / 2)
    spacing = float(law.spacing(rho))
    first = special.gammaincinv(law.exponent, tolerance / 8) / (1 + GAPS[-1] / spacing)
    last = special.gammainccinv(law.exponent + 1, tolerance / 8)
    count = int(np.ceil(np.log(last / first) / step)) + 1
    ranges = spacing / (first * np.exp(step * np.arange(count)))
    return Mixture(ranges, work_shares(law, rho, ranges))


def trapezoidal_step(exponent, error):
    """Return the step in log t at which the trapezoidal rule has a relative error.

    By Poisson's summation it is 2 |Gamma(n + 2 pi i/step)|/Gamma(n), n the exponent, at every gap.
    """

    def excess(step):
        of_step = special.loggamma(exponent + 2j * np.pi / step).real
        return np.log(2) + of_step - special.gammaln(exponent) - np.log(error)

    return optimize.brentq(excess, 0.05, 1.5)


def sum_of_terms(terms, rho, gap):
    """Return energy u and pressure v (...) of a mixture at gaps (...) in nm; rho of the law."""
    decay = np.exp(-np.asarray(gap, float)[..., None] / terms.ranges)
    return decay @ terms.shares, decay @ (terms.shares * rho / terms.ranges)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
def test_pressure_is_the_slope_of_the_energy_and_adds_up_to_the_work(law):
    rho, gap, step = 2.5, np.array([0.3, 2.0, 11.0]), 1e-5
    slope = (energy(law, gap + step, rho) - energy(law, gap - step, rho)) / (2 * step)
    np.testing.assert_allclose(-slope * rho, pressure(law, gap, rho), rtol=1e-8)
    work, _ = integrate.quad(lambda g: float(pressure(law, g, rho)) / rho, 0, np.inf)
    assert work == pytest.approx(1, rel=1e-8)
    assert energy(law, 0, rho) == pressure(law, 0, rho) == 1


@pytest.mark.parametrize(
    ("name", "of_pressure"), [("van_der_waals", 3), ("retarded", 4), ("electrostatic", 2)]
)
def test_exponents_of_the_pressure_between_flats(name, of_pressure):
    # Far from contact the pressure falls by 2^n where the distance doubles.
    law = BY_NAME[name]
    ratio = pressure(law, 1e6, 1.0) / pressure(law, 2e6, 1.0)
    assert ratio == pytest.approx(2**of_pressure, rel=1e-5)


@pytest.mark.parametrize("law", POWERS, ids=lambda law: law.name)
@pytest.mark.parametrize("tolerance", [1e-3, 1e-5, 1e-9])
@pytest.mark.parametrize("rho", [0.15, 5.6])
def test_mixture_is_the_law_within_its_tolerance(law, tolerance, rho):
    terms = mixture(law, rho, tolerance)
    of_energy, of_pressure = sum_of_terms(terms, rho, GAPS)
    np.testing.assert_allclose(of_energy, energy(law, GAPS, rho), rtol=tolerance)
    np.testing.assert_allclose(of_pressure, pressure(law, GAPS, rho), rtol=tolerance)
    assert terms.shares.sum() == pytest.approx(1, abs=tolerance)
    assert (terms.shares > 0).all()


def test_mixture_of_a_loose_tolerance_is_not_that_of_a_tight_one():
    law, rho = BY_NAME["van_der_waals"], 1.0
    loose, tight = (mixture(law, rho, tolerance) for tolerance in (1e-3, 1e-9))
    assert len(loose.ranges) < len(tight.ranges)
    error = abs(sum_of_terms(loose, rho, GAPS)[1] / pressure(law, GAPS, rho) - 1).max()
    assert 1e-5 < error < 1e-3


@pytest.mark.parametrize(("step", "terms", "error"), [(0.6, 24, 7e-5), (0.4, 36, 2e-6)])
def test_number_of_terms_for_van_der_waals(step, terms, error):
    # Energy exponent 2 and g0 = 0.3 nm, at gaps up to 30 nm.
    law, rho, gap = BY_NAME["van_der_waals"], 0.15, np.linspace(0, 30, 2000)
    ranges = 0.3 / 25 * np.exp(step * np.arange(terms))
    found = sum_of_terms(Mixture(ranges, work_shares(law, rho, ranges)), rho, gap)
    assert abs(found[1] / pressure(law, gap, rho) - 1).max() < error


def test_power_law_of_large_exponent_is_the_exponential_law():
    steep = type(EXPONENTIAL)("steep", "steep", 1e7, np.nan)
    gap = np.linspace(0, 20, 50)
    np.testing.assert_allclose(
        pressure(steep, gap, 5.6), pressure(EXPONENTIAL, gap, 5.6), rtol=1e-5
    )


def test_known_strengths():
    # A = 12 pi g0² W; ideal mirrors attract with 1.30 mPa at 1 µm; 1 V over 1 nm is 4.4 MPa.
    work = 5e-19 / (12 * np.pi * (0.3e-9) ** 2)
    assert implied_over_known(BY_NAME["van_der_waals"], 0.15, work) == pytest.approx(1)
    mirrors = BY_NAME["retarded"]
    assert 3 * mirrors.known / (1e-6) ** 4 == pytest.approx(1.30e-3, rel=1e-3)
    assert BY_NAME["electrostatic"].known / 1e-18 == pytest.approx(constants.epsilon_0 / 2e-18)
    assert np.isnan(implied_over_known(EXPONENTIAL, 5.6, 0.0463))
