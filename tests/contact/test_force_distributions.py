"""Statistics of forces drawn from a known log-normal."""

import numpy as np
import pytest
import xarray as xr
from scipy.stats import lognorm

from hardcontact.base.statistics import Sampling, bounds, student_log_interval
from hardcontact.contact.force_curves import FORCE_STATISTICS, force_statistics

KNOWN = lognorm(0.9, scale=6e-8)
FORCES = KNOWN.rvs(size=(5, 4, 200), random_state=np.random.default_rng(0))


def test_statistics_recover_a_known_distribution():
    computed = force_statistics(FORCES, 3e-8, Sampling(0, 200, 0.95))
    expected = (KNOWN.mean(), KNOWN.median(), 0.9, 6e-8, KNOWN.cdf(3e-8))
    for (name, unit), value in zip(FORCE_STATISTICS.items(), expected, strict=True):
        assert float(computed[name]) == pytest.approx(value, rel=0.1), name
        assert computed[name].attrs["units"] == unit
        low, high = bounds(computed, name)
        assert low < computed[name] < high, name
    assert float(computed.mean_force_at_pair) == pytest.approx(FORCES.mean())
    assert float(computed.median_force_at_pair) == pytest.approx(np.median(FORCES))
    assert float(computed.censored_fraction) == pytest.approx((FORCES < 3e-8).mean())


def test_missing_scans_and_contacts_do_not_count():
    padded = np.full((7, 5, 210), np.nan)
    padded[:5, 1:, :200] = FORCES
    sampling = Sampling(0, 20, 0.95)
    assert force_statistics(padded, 3e-8, sampling).equals(force_statistics(FORCES, 3e-8, sampling))


def test_the_interval_comes_from_scans_and_not_from_contacts():
    """Alike contacts, scans that differ: many contacts do not narrow the interval."""
    levels = 1e-7 * np.array([1.0, 2.0, 3.0, 4.0, 5.0])
    forces = np.broadcast_to(levels[:, None, None], (5, 1, 1000))
    computed = force_statistics(forces, 3e-8, Sampling(0, 1, 0.683))
    scans = xr.DataArray(levels, dims="scan")
    expected = student_log_interval(scans, 0.683, "scan")
    np.testing.assert_allclose(computed.mean_force_at_pair_interval, expected)
    np.testing.assert_allclose(computed.censored_fraction_interval, 0.0)


COVERED = {"median_force_at_pair": 0.94, "lognormal_median": 0.94, "lognormal_shape": 0.79}


@pytest.mark.study
@pytest.mark.parametrize("name", COVERED)
def test_the_interval_of_pooled_statistics_has_its_measured_coverage(name):
    """Five scans with a log-normal factor each, which enters the shape squared: it covers less."""
    rng = np.random.default_rng(0)
    shape, scatter, runs = 0.8, 0.4, 300
    known = np.hypot(shape, scatter) if name == "lognormal_shape" else 1.0
    held = 0
    for _ in range(runs):
        factor = rng.lognormal(0, scatter, (5, 1, 1))
        forces = factor * rng.lognormal(0, shape, (5, 1, 200))
        low, high = bounds(force_statistics(forces, 1e-9, Sampling(0, 1, 0.95)), name)
        held += bool(low <= known <= high)
    assert held / runs == pytest.approx(COVERED[name], abs=0.04)


def test_missing_forces_have_no_statistics():
    computed = force_statistics(np.full((2, 2, 3), np.nan), 3e-8, Sampling(0, 1, 0.9))
    assert all(computed[name].isnull().all() for name in computed.data_vars)
