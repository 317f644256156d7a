"""Means of log-normal tests, and how often their samples hold the true mean."""

import numpy as np
import pandas as pd
import pytest

from hardcontact.own_surfaces.own_fit import MeasuredTests, measured_tests, sampled_means

COLUMNS = ["surface", "mean", "median", "count"]


def table(*rows):
    return pd.DataFrame([("a", *row) for row in rows], columns=COLUMNS)


def test_single_tests_and_a_summary_describe_the_same():
    forces = np.exp(0.7 * np.random.default_rng(1).standard_normal(4000)) * 1e-7
    single = measured_tests(table(*((force, force, 1) for force in forces)))
    assert single.mean == pytest.approx(forces.mean())
    summary = measured_tests(table((forces.mean(), np.median(forces), 4000)))
    assert summary.shape == pytest.approx(single.shape, rel=0.05) and summary.number == 4000


def test_one_test_has_no_samples():
    single = measured_tests(table((1e-7, 1e-7, 1)))
    assert np.isnan(single.shape)
    assert np.isnan(sampled_means(np.random.default_rng(1), single, 5)).all()


@pytest.mark.parametrize("shape, number", [(0.7, 40), (1.5, 40), (0.7, 4)])
def test_samples_hold_the_mean_as_often_as_they_say(shape, number):
    rng, held = np.random.default_rng(3), []
    for _ in range(300):
        forces = np.exp(shape * rng.standard_normal(number))
        tests = MeasuredTests(forces.mean(), np.log(forces).std(ddof=1), number)
        low, high = np.percentile(sampled_means(rng, tests, 400), [5, 95])
        held.append(low < np.exp(shape**2 / 2) < high)
    assert np.mean(held) > 0.85
