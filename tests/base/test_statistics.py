"""Intervals, samples of means and log-normal fits."""

import numpy as np
import pytest
import xarray as xr
from scipy import stats

from hardcontact.base import statistics


def test_percentile_interval_skips_missing_samples():
    samples = np.arange(12.0).reshape(3, 4).T
    samples[:, 1] = np.nan
    interval = statistics.percentile_interval(samples, 1.0)
    np.testing.assert_array_equal(interval, [[0, 3], [np.nan, np.nan], [8, 11]])


@pytest.mark.parametrize("confidence", [0.8, 0.95])
def test_student_intervals_equal_those_of_t_tests(confidence):
    """The interval of positive values is a t-test on logarithms, moved to that of the mean."""
    values = np.random.default_rng(0).lognormal(0, 0.5, (2, 5))
    values[1, 3:] = np.nan
    forces = xr.DataArray(values, {"surface": ["a", "b"]}, ("surface", "scan"))
    interval = statistics.student_interval(forces, confidence, "scan")
    log_interval = statistics.student_log_interval(forces, confidence, "scan")
    for result in (interval, log_interval):
        assert result.dims == ("surface", "end") and result.attrs == {"confidence": confidence}
    for row, surface_forces in enumerate((values[0], values[1, :3])):
        logarithms = np.log(surface_forces)
        expected, log_expected = (
            np.array(stats.ttest_1samp(sample, 0).confidence_interval(confidence))
            for sample in (surface_forces, logarithms)
        )
        np.testing.assert_allclose(interval[row], expected, rtol=1e-12)
        shift = np.log(surface_forces.mean()) - logarithms.mean()
        np.testing.assert_allclose(np.log(log_interval[row]), log_expected + shift, rtol=1e-12)


def test_samples_have_the_percentiles_of_the_interval_at_every_range():
    values = np.random.default_rng(1).lognormal(0, 0.4, (5, 3))
    samples = statistics.student_log_samples(np.random.default_rng(2), values, 200000)
    interval = statistics.student_log_interval(
        xr.DataArray(values, dims=("scan", "rho")), 0.9, "scan"
    )
    np.testing.assert_allclose(statistics.percentile_interval(samples, 0.9), interval, rtol=0.01)


def test_samples_keep_the_correlation_between_ranges():
    common = np.random.default_rng(1).lognormal(0, 0.4, (4, 1))
    values = common * np.array([1.0, 25.0])
    samples = statistics.student_log_samples(np.random.default_rng(0), values, 50)
    np.testing.assert_allclose(samples[:, 1] / samples[:, 0], 25.0)
    assert np.ptp(samples[:, 0]) > 0


def test_one_scan_has_no_interval_and_no_samples():
    two_values = np.array([[2.0, 3.0]])
    samples = statistics.student_log_samples(np.random.default_rng(0), two_values, 4)
    assert samples.shape == (4, 2) and np.isnan(samples).all()
    interval = statistics.student_log_interval(
        xr.DataArray(two_values[0], dims="scan")[:1], 0.9, "scan"
    )
    assert interval.isnull().all()
    assert np.isnan(statistics.jackknife_interval(2.0, [np.nan], 0.9)).all()
    assert np.isnan(statistics.jackknife_interval(0.0, np.zeros(5), 0.95)).all()
    assert np.isnan(statistics.percentile_interval(np.empty((0, 3)), 0.9)).all()


def test_jackknife_of_a_geometric_mean_equals_the_t_test_on_logarithms():
    values = np.random.default_rng(0).lognormal(0, 0.5, 6)
    left_out = [stats.gmean(np.delete(values, scan)) for scan in range(6)]
    t_test_interval = stats.ttest_1samp(np.log(values), 0).confidence_interval(0.9)
    interval = statistics.jackknife_interval(stats.gmean(values), left_out, 0.9)
    np.testing.assert_allclose(np.log(interval), t_test_interval, rtol=1e-12)


def test_mean_and_median_of_a_lognormal_give_the_deviation_of_its_logarithm():
    distribution = stats.lognorm(0.7, scale=3.0)
    log_std = statistics.log_std_of_lognormal(distribution.mean(), distribution.median())
    assert log_std == pytest.approx(0.7)
