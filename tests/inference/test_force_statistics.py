"""Mean forces over scans; statistics of a known log-normal."""

import numpy as np
import xarray as xr
from known_forces import power_forces
from scipy.stats import lognorm

from hardcontact.base.statistics import Sampling, student_log_interval
from hardcontact.inference.force_statistics import force_statistics, sample_mean_forces


def sampling(samples, confidence=0.95):
    return Sampling(seed=0, sample_count=samples, confidence=confidence)


def test_missing_scans_change_no_mean():
    forces = power_forces(spread=0.3, scans=5)
    incomplete_forces = forces.where((forces.surface != forces.surface[0]) | (forces.scan < 3))
    means = sample_mean_forces(incomplete_forces, sampling(10))  # (1 + sample, surface, rho)
    remaining_forces = forces.isel(surface=[0], scan=slice(3))
    np.testing.assert_allclose(means[:, :1], sample_mean_forces(remaining_forces, sampling(10)))


def test_random_numbers_depend_on_the_surface_but_not_on_the_forces():
    forces = power_forces(spread=0.3)
    samples = sample_mean_forces(forces, sampling(20))[1:]
    doubled_samples = sample_mean_forces(2 * forces.isel(surface=slice(1, None)), sampling(20))[1:]
    np.testing.assert_allclose(doubled_samples, 2 * samples[:, 1:])
    first_surface, second_surface = np.log(samples[:, :2, 0]).T
    assert abs(np.corrcoef(first_surface, second_surface)[0, 1]) < 0.9


KNOWN = lognorm(0.9, scale=6e-8)
#: Forces (scan, sphere_scan, contact) in N.
FORCES = KNOWN.rvs(size=(5, 4, 200), random_state=np.random.default_rng(0))


def test_statistics_recover_a_known_distribution():
    values, intervals = force_statistics(FORCES, sampling(200))
    # Mean, median, standard deviation of ln F, median of the fitted log-normal.
    known_values = (KNOWN.mean(), KNOWN.median(), 0.9, 6e-8)
    np.testing.assert_allclose(values, known_values, rtol=0.1)
    assert ((intervals[:, 0] < values) & (values < intervals[:, 1])).all()
    np.testing.assert_allclose(values[:2], (FORCES.mean(), np.median(FORCES)))


def test_missing_scans_and_contacts_do_not_count():
    padded = np.full((7, 5, 210), np.nan)
    padded[:5, 1:, :200] = FORCES
    padded_values, padded_intervals = force_statistics(padded, sampling(20))
    values, intervals = force_statistics(FORCES, sampling(20))
    np.testing.assert_array_equal(padded_values, values)
    np.testing.assert_array_equal(padded_intervals, intervals)


def test_the_interval_comes_from_scans_and_not_from_contacts():
    levels = 1e-7 * np.array([1.0, 2.0, 3.0, 4.0, 5.0])
    forces = np.broadcast_to(levels[:, None, None], (5, 1, 1000))
    _, intervals = force_statistics(forces, sampling(1, confidence=0.683))
    scan_interval = student_log_interval(xr.DataArray(levels, dims="scan"), 0.683, "scan")
    np.testing.assert_allclose(intervals[0], scan_interval)


def test_missing_forces_have_no_statistics():
    statistics = force_statistics(np.full((2, 2, 3), np.nan), sampling(1))
    assert all(np.isnan(numbers).all() for numbers in statistics)
