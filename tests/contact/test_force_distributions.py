"""Statistics of forces sampled from a known log-normal."""

import numpy as np
import pytest
import xarray as xr
from scipy.stats import lognorm

from hardcontact.base.statistics import Sampling, bounds, student_log_interval
from hardcontact.contact.force_curves import FORCE_STATISTICS, force_statistics

KNOWN = lognorm(0.9, scale=6e-8)
FORCES = KNOWN.rvs(size=(5, 4, 200), random_state=np.random.default_rng(0))


def test_statistics_recover_a_known_distribution():
    statistics = force_statistics(FORCES, 3e-8, Sampling(0, 200, 0.95))
    known_values = (KNOWN.mean(), KNOWN.median(), 0.9, 6e-8, KNOWN.cdf(3e-8))
    for (name, unit), value in zip(FORCE_STATISTICS.items(), known_values, strict=True):
        assert float(statistics[name]) == pytest.approx(value, rel=0.1), name
        assert statistics[name].attrs["units"] == unit
        low, high = bounds(statistics, name)
        assert low < statistics[name] < high, name
    assert float(statistics.mean_force_at_pair) == pytest.approx(FORCES.mean())
    assert float(statistics.median_force_at_pair) == pytest.approx(np.median(FORCES))
    assert float(statistics.censored_fraction) == pytest.approx((FORCES < 3e-8).mean())


def test_missing_scans_and_contacts_do_not_count():
    padded = np.full((7, 5, 210), np.nan)
    padded[:5, 1:, :200] = FORCES
    sampling = Sampling(0, 20, 0.95)
    assert force_statistics(padded, 3e-8, sampling).equals(force_statistics(FORCES, 3e-8, sampling))


def test_the_interval_comes_from_scans_and_not_from_contacts():
    """Scans differ and their contacts do not: many contacts do not narrow the interval."""
    levels = 1e-7 * np.array([1.0, 2.0, 3.0, 4.0, 5.0])
    forces = np.broadcast_to(levels[:, None, None], (5, 1, 1000))
    statistics = force_statistics(forces, 3e-8, Sampling(0, 1, 0.683))
    scans = xr.DataArray(levels, dims="scan")
    scan_interval = student_log_interval(scans, 0.683, "scan")
    np.testing.assert_allclose(statistics.mean_force_at_pair_interval, scan_interval)
    np.testing.assert_allclose(statistics.censored_fraction_interval, 0.0)


COVERED = {"median_force_at_pair": 0.94, "lognormal_median": 0.94, "lognormal_shape": 0.79}


@pytest.mark.study
@pytest.mark.parametrize("name", COVERED)
def test_the_interval_of_pooled_statistics_has_its_measured_coverage(name):
    """Five scans with a log-normal factor each, which enters the shape squared: it covers less."""
    rng = np.random.default_rng(0)
    shape, scatter, runs = 0.8, 0.4, 300
    true_value = np.hypot(shape, scatter) if name == "lognormal_shape" else 1.0
    contained_count = 0
    for _ in range(runs):
        factor = rng.lognormal(0, scatter, (5, 1, 1))
        forces = factor * rng.lognormal(0, shape, (5, 1, 200))
        low, high = bounds(force_statistics(forces, 1e-9, Sampling(0, 1, 0.95)), name)
        contained_count += bool(low <= true_value <= high)
    assert contained_count / runs == pytest.approx(COVERED[name], abs=0.04)


def test_missing_forces_have_no_statistics():
    statistics = force_statistics(np.full((2, 2, 3), np.nan), 3e-8, Sampling(0, 1, 0.9))
    assert all(statistics[name].isnull().all() for name in statistics.data_vars)
