"""Tests that measure the pull-off force on a surface: their mean and its uncertainty.

Tests scatter log-normally.
"""

from typing import NamedTuple

import numpy as np
import pandas as pd

from hardcontact.base.statistics import lognormal_shape

#: Largest deviation of the logarithm of a sampled mean; larger ones are clipped.
MAX_LOG_DEVIATION = 50.0


class MeasuredTests(NamedTuple):
    """Tests on one surface."""

    mean: float  #: Mean force in N.
    log_std: float  #: Standard deviation of the logarithm of a force; NaN for a single test.
    test_count: int  #: Number of tests.


def measured_tests(forces: pd.DataFrame) -> MeasuredTests:
    """Return the tests on one surface from its rows of the table of measured forces."""
    count = int(forces["count"].sum())
    mean = float(np.average(forces["mean"], weights=forces["count"]))
    if count < 2:
        return MeasuredTests(mean, np.nan, count)
    if len(forces) == 1:
        return MeasuredTests(mean, float(lognormal_shape(mean, forces["median"].iloc[0])), count)
    return MeasuredTests(mean, float(np.log(forces["mean"]).std(ddof=1)), count)


def sampled_means(rng: np.random.Generator, tests: MeasuredTests, samples: int) -> np.ndarray:
    """Sample mean forces (samples,) in N of a log-normal distribution from a few tests.

    The generalized pivot of the logarithm of the mean, mu + sigma²/2, is y - z s*/sqrt(n) + s*²/2
    with s*² = (n - 1) s²/chi²(n - 1). Here z is normal, and y and s are mean and standard deviation
    of the logarithms of n tests, mu and sigma their true values. The deviation of the pivot from
    y + s²/2 is added to the logarithm of the measured mean. NaN for a single test, whose scatter is
    unknown. Source: Krishnamoorthy and Mathew, J. Stat. Plan. Inference 115 (2003) 103.
    """
    if tests.test_count < 2:
        return np.full(samples, np.nan)
    freedom = tests.test_count - 1
    variance = tests.log_std**2
    sampled_variance = variance * freedom / rng.chisquare(freedom, samples)
    normal = rng.standard_normal(samples)
    deviation = (sampled_variance - variance) / 2 - normal * np.sqrt(
        sampled_variance / tests.test_count
    )
    return np.asarray(
        tests.mean * np.exp(np.clip(deviation, -MAX_LOG_DEVIATION, MAX_LOG_DEVIATION))
    )
