"""The posterior against closed forms: forces that are powers of the range."""

import numpy as np
import pytest

from hardcontact.paper.posterior import log_mean_error, sample_range_and_work, summarize_samples

COUNT = 40_000
LOG_RANGES = np.linspace(np.log(0.01), np.log(1000.0), 2001)


def sample(exponents, log_targets, errors):
    """Return samples of ln range and ln work if forces at 1 J/m² are powers of the range."""
    rng = np.random.default_rng(1)
    curves = np.multiply.outer(exponents, LOG_RANGES)[None]
    index, log_work = sample_range_and_work(
        curves, np.array(log_targets), np.array(errors), rng, COUNT
    )
    return LOG_RANGES[index], log_work


def test_two_powers_determine_range_and_work():
    # ln F1 = ln W + ln rho, ln F2 = ln W - ln rho: half the difference, half the sum.
    log_range, log_work = sample([1.0, -1.0], [3.0, 1.0], [0.2, 0.1])
    deviation = np.hypot(0.2, 0.1) / 2
    for samples, mean in ((log_range, 1.0), (log_work, 2.0)):
        assert samples.mean() == pytest.approx(mean, abs=5 * deviation / np.sqrt(COUNT))
        assert samples.std() == pytest.approx(deviation, rel=0.02)


def test_forces_independent_of_the_range_leave_it_to_its_prior():
    log_range, log_work = sample([0.0, 0.0], [1.0, 1.0], [0.1, 0.1])
    middle, span = LOG_RANGES[[0, -1]].mean(), np.ptp(LOG_RANGES)
    assert log_range.mean() == pytest.approx(middle, abs=0.01 * span)
    assert log_range.std() == pytest.approx(span / np.sqrt(12), rel=0.02)
    assert log_work.std() == pytest.approx(0.1 / np.sqrt(2), rel=0.02)


def test_the_error_of_a_mean_is_the_log_deviation_of_a_log_normal_mean():
    forces = np.random.default_rng(2).lognormal(0, 0.7, (200_000, 6)).mean(axis=1)
    relative_std = forces.std() / forces.mean()
    assert log_mean_error(0.7, 6) == pytest.approx(np.sqrt(np.log1p(relative_std**2)), rel=0.002)
    assert log_mean_error(0.7, 1) == pytest.approx(0.7)


def test_samples_are_described_by_median_and_interval():
    summary = summarize_samples(np.arange(1.0, 202.0), np.arange(201.0), 0.95)
    assert summary.range_of_adhesion == 101
    np.testing.assert_allclose(summary.work_of_adhesion_interval, [5, 195])
    assert summary.sampled_work_of_adhesion.attrs["units"] == "J m-2"
