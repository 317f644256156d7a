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
def test_student_interval_equals_that_of_a_t_test(confidence):
    values = np.random.default_rng(0).normal(3.0, 1.0, (2, 5))
    values[1, 3:] = np.nan
    interval = statistics.student_interval(
        xr.DataArray(values, {"surface": ["a", "b"]}, ("surface", "scan")), confidence, "scan"
    )
    assert interval.dims == ("surface", "end") and interval.attrs == {"confidence": confidence}
    for row, row_values in zip(interval.values, values, strict=True):
        t_test_interval = stats.ttest_1samp(
            row_values[np.isfinite(row_values)], 0
        ).confidence_interval(confidence)
        np.testing.assert_allclose(row, t_test_interval, rtol=1e-12)


def test_student_log_interval_equals_a_t_test_on_logarithms_about_the_mean():
    values = np.random.default_rng(0).lognormal(0, 0.5, (2, 5))
    values[1, 3:] = np.nan
    interval = statistics.student_log_interval(
        xr.DataArray(values, {"surface": ["a", "b"]}, ("surface", "scan")), 0.9, "scan"
    )
    assert interval.dims == ("surface", "end") and interval.attrs == {"confidence": 0.9}
    for row, row_values in zip(interval.values, values, strict=True):
        logarithms = np.log(row_values[np.isfinite(row_values)])
        t_test_interval = stats.ttest_1samp(logarithms, 0).confidence_interval(0.9)
        shift = np.log(np.nanmean(row_values)) - logarithms.mean()
        np.testing.assert_allclose(np.log(row), np.array(t_test_interval) + shift, rtol=1e-12)


def test_samples_have_the_percentiles_of_the_interval_at_every_range():
    values = np.random.default_rng(1).lognormal(0, 0.4, (5, 3))
    samples = statistics.student_log_samples(np.random.default_rng(2), values, 200000)
    interval = statistics.student_log_interval(
        xr.DataArray(values, dims=("scan", "rho")), 0.9, "scan"
    )
    np.testing.assert_allclose(statistics.percentile_interval(samples, 0.9), interval, rtol=0.01)


def test_samples_keep_the_correlation_between_ranges():
    common = np.random.default_rng(1).lognormal(0, 0.4, (4, 1))
    values = common * np.array([1.0, 5.0]) ** np.array([1.0, 2.0])
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


def test_equal_forces_have_no_deviation_and_no_interval():
    assert statistics.fit_lognormal(np.full(9, 5e-8), 3e-8)[0] == pytest.approx(0, abs=1e-12)
    assert np.isnan(statistics.jackknife_interval(0.0, np.zeros(5), 0.95)).all()


@pytest.mark.parametrize("floor", [1e-9, 3e-8, 2e-7])
def test_censored_fit_has_the_greatest_likelihood(floor):
    forces = stats.lognorm(0.9, scale=6e-8).rvs(size=300, random_state=np.random.default_rng(1))
    is_below = forces < floor
    log_std, median, share = statistics.fit_lognormal(forces, floor)
    data = stats.CensoredData(uncensored=forces[~is_below], left=np.full(is_below.sum(), floor))
    scipy_log_std, _, scipy_scale = stats.lognorm.fit(data, floc=0)
    assert share == is_below.mean()
    assert (log_std, median) == pytest.approx((scipy_log_std, scipy_scale), rel=1e-3)

    def negative_log_likelihood(log_std, median):
        distribution = stats.lognorm(log_std, scale=median)
        return -distribution.logpdf(forces[~is_below]).sum() - is_below.sum() * distribution.logcdf(
            floor
        )

    assert (
        negative_log_likelihood(log_std, median)
        <= negative_log_likelihood(scipy_log_std, scipy_scale) + 1e-7
    )


def test_censored_fit_recovers_the_distribution_below_the_floor():
    distribution = stats.lognorm(0.9, scale=6e-8)
    forces = distribution.rvs(size=20000, random_state=np.random.default_rng(0))
    log_std, median, share_below = statistics.fit_lognormal(forces, 3e-8)
    assert log_std == pytest.approx(0.9, rel=0.03)
    assert median == pytest.approx(6e-8, rel=0.03)
    assert share_below == pytest.approx(distribution.cdf(3e-8), abs=0.01)
    log_std, median, share_below = statistics.fit_lognormal(forces * 1e-3, 3e-8)
    assert np.isnan(log_std) and np.isnan(median) and share_below == 1
