"""Mean forces over scans; statistics of a known log-normal."""

import numpy as np
import pytest
import xarray as xr
from known_forces import power_forces
from scipy.stats import CensoredData, lognorm

from hardcontact.base.statistics import (
    Sampling,
    interval_ends,
    student_log_interval,
)
from hardcontact.paper.force_statistics import (
    STATISTIC_ATTRS,
    fit_lognormal,
    force_statistics,
    mean_forces,
)


def test_missing_scans_change_no_mean():
    forces = power_forces(spread=0.3, scans=5)
    incomplete_forces = forces.copy()
    incomplete_forces[0, 3:] = np.nan
    means, samples = mean_forces(incomplete_forces, Sampling(0, 10, 0.95))
    remaining_forces = forces.isel(surface=[0], scan=slice(3))
    remaining_means, remaining_samples = mean_forces(remaining_forces, Sampling(0, 10, 0.95))
    np.testing.assert_allclose(means[0], remaining_means[0])
    np.testing.assert_allclose(samples[:, 0], remaining_samples[:, 0])


def test_contact_models_share_random_numbers_but_surfaces_do_not():
    forces = power_forces(spread=0.3)
    _, samples = mean_forces(forces, Sampling(0, 20, 0.95))
    _, doubled_samples = mean_forces(2 * forces[1:], Sampling(0, 20, 0.95))
    np.testing.assert_allclose(doubled_samples, 2 * samples[:, 1:])
    assert abs(np.corrcoef(np.log(samples[:, :2, 0]).T)[0, 1]) < 0.9


KNOWN = lognorm(0.9, scale=6e-8)
FORCES = KNOWN.rvs(size=(5, 4, 200), random_state=np.random.default_rng(0))


def test_statistics_recover_a_known_distribution():
    statistics = force_statistics(FORCES, 3e-8, Sampling(0, 200, 0.95))
    known_values = (KNOWN.mean(), KNOWN.median(), 0.9, 6e-8, KNOWN.cdf(3e-8))
    for (name, attributes), value in zip(STATISTIC_ATTRS.items(), known_values, strict=True):
        assert float(statistics[name]) == pytest.approx(value, rel=0.1), name
        assert statistics[name].attrs["units"] == attributes["units"]
        low, high = interval_ends(statistics, name)
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


def test_missing_forces_have_no_statistics():
    statistics = force_statistics(np.full((2, 2, 3), np.nan), 3e-8, Sampling(0, 1, 0.9))
    assert all(statistics[name].isnull().all() for name in statistics.data_vars)


@pytest.mark.parametrize("floor", [1e-9, 3e-8, 2e-7])
def test_a_censored_fit_is_that_of_scipy_and_needs_a_force_above_the_floor(floor):
    forces = KNOWN.rvs(size=300, random_state=np.random.default_rng(1))
    is_below = forces < floor
    data = CensoredData(uncensored=forces[~is_below], left=np.full(is_below.sum(), floor))
    scipy_log_std, _, scipy_scale = lognorm.fit(data, floc=0)
    expected = pytest.approx((scipy_log_std, scipy_scale), rel=1e-3)
    assert fit_lognormal(forces, floor) == expected
    assert np.isnan(fit_lognormal(forces, 1.0)).all()
    assert fit_lognormal(np.full(9, 5e-8), 3e-8)[0] == pytest.approx(0, abs=1e-12)
