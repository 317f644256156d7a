"""Intervals, resampling and log-normal fits."""

import numpy as np
import pytest
import xarray as xr
from scipy import stats

from hardcontact import statistics
from hardcontact.statistics import bounds


def ends(dataset, name="value"):
    return [end.values.tolist() for end in bounds(dataset, name)]


def test_a_variable_and_its_interval():
    interval = np.array([[0.5, 2.0], [1.5, 3.0]])
    units = {"units": "N"}
    dataset = xr.Dataset(
        statistics.with_interval("force", "surface", [1.0, 2.0], interval, units, 0.9),
        {"surface": ["a", "b"]},
    )
    assert set(dataset.data_vars) == {"force", "force_interval"}
    assert dataset.force_interval.dims == ("surface", "bound")
    assert dataset.bound.values.tolist() == ["low", "high"]
    assert dataset.force_interval.attrs == {"units": "N", "confidence": 0.9}
    assert dataset.force.attrs == units == {"units": "N"}
    low, high = bounds(dataset, "force")
    assert low.dims == high.dims == ("surface",) and "bound" not in low.coords
    np.testing.assert_array_equal(np.stack([low, high], axis=-1), interval)


def test_a_number_without_dimensions_has_an_interval_of_two():
    computed = xr.Dataset(statistics.with_interval("work", (), 1.0, [0.5, 2.0], {}, 0.95))
    assert computed.work_interval.dims == ("bound",) and ends(computed, "work") == [0.5, 2.0]


@pytest.mark.parametrize("confidence", [0.5, 0.95])
def test_percentile_interval_leaves_equal_tails(confidence):
    samples = np.random.default_rng(0).permutation(np.arange(10001.0))
    low, high = statistics.percentile_interval(samples, confidence)
    assert low == pytest.approx(5000 * (1 - confidence))
    assert high == pytest.approx(10000 - 5000 * (1 - confidence))


def test_percentile_interval_leaves_out_what_is_missing():
    samples = np.arange(12.0).reshape(3, 4).T
    samples[:, 1] = np.nan
    interval = statistics.percentile_interval(samples, 1.0)
    np.testing.assert_array_equal(interval, [[0, 3], [np.nan, np.nan], [8, 11]])


@pytest.mark.parametrize("confidence", [0.8, 0.95])
def test_student_interval_is_that_of_a_t_test(confidence):
    values = np.random.default_rng(0).normal(3.0, 1.0, (2, 5))
    values[1, 3:] = np.nan
    computed = statistics.student_interval(
        xr.DataArray(values, {"surface": ["a", "b"]}, ("surface", "scan")), confidence, "scan"
    )
    assert computed.dims == ("surface", "bound") and computed.attrs == {"confidence": confidence}
    for row, given in zip(computed.values, values, strict=True):
        expected = stats.ttest_1samp(given[np.isfinite(given)], 0).confidence_interval(confidence)
        np.testing.assert_allclose(row, expected, rtol=1e-12)


def test_resampling_draws_as_many_scans_as_there_are_and_never_a_missing_one():
    counts = statistics.resampling_counts(
        np.random.default_rng(0), np.array([True, False, True]), 2000
    )
    assert (counts.sum(axis=1) == 2).all() and (counts[:, 1] == 0).all()
    assert (counts[:, 0] == 1).mean() == pytest.approx(0.5, abs=0.05)


def test_published_lognormal_shapes():
    mean, median = [8.8, 0.4, 0.16, 0.11], [1.75, 0.31, 0.12, 0.06]
    np.testing.assert_allclose(
        statistics.lognormal_shape(mean, median), [1.80, 0.71, 0.76, 1.10], atol=0.006
    )


def test_lognormal_shape_of_a_lognormal():
    known = stats.lognorm(0.7, scale=3.0)
    assert statistics.lognormal_shape(known.mean(), known.median()) == pytest.approx(0.7)


def test_censored_fit_recovers_the_distribution_that_was_cut():
    known = stats.lognorm(0.9, scale=6e-8)
    forces = known.rvs(size=20000, random_state=np.random.default_rng(0))
    shape, median, below = statistics.lognormal_fit(forces, 3e-8)
    assert shape == pytest.approx(0.9, rel=0.03)
    assert median == pytest.approx(6e-8, rel=0.03)
    assert below == pytest.approx(known.cdf(3e-8), abs=0.01)
    shape, median, below = statistics.lognormal_fit(forces * 1e-3, 3e-8)
    assert np.isnan(shape) and np.isnan(median) and below == 1
