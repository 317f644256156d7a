"""Mean forces of measured tests, and samples of them: tests scatter log-normally."""

from typing import NamedTuple

import numpy as np
import pandas as pd

from hardcontact.statistics import lognormal_shape

__all__ = ["MeasuredTests", "measured_tests", "sampled_means"]

#: Logarithms of a sampled mean beyond this are as good as infinite.
ENDLESS = 50.0


class MeasuredTests(NamedTuple):
    """Tests on one surface.

    Attributes
    ----------
    mean : float
        Of the forces in N.
    shape : float
        Standard deviation of the logarithm of a force; NaN of a single test.
    number : int
        Of the tests.
    """

    mean: float
    shape: float
    number: int


def measured_tests(forces: pd.DataFrame) -> MeasuredTests:
    """Return the tests on one surface.

    Parameters
    ----------
    forces : pandas.DataFrame
        Rows of one surface, of `study.measured_forces.measured_forces`:
        mean and median in N, count.

    Returns
    -------
    MeasuredTests
        Of a mean and median the shape of the log-normal that has both, sqrt(2 ln(mean/median)).
    """
    count = int(forces["count"].sum())
    mean = float(np.average(forces["mean"], weights=forces["count"]))
    if count < 2:
        return MeasuredTests(mean, np.nan, count)
    if len(forces) == 1:
        return MeasuredTests(mean, float(lognormal_shape(mean, forces["median"].iloc[0])), count)
    return MeasuredTests(mean, float(np.log(forces["mean"]).std(ddof=1)), count)


def sampled_means(rng: np.random.Generator, tests: MeasuredTests, samples: int) -> np.ndarray:
    """Draw mean forces of a log-normal distribution of which a few tests are known.

    The generalized pivot of the logarithm of the mean, mu + s²/2, is
    m - z s*/sqrt(n) + s*²/2 with s*² = (n - 1) s²/chi²(n - 1); z is normal, m and s are mean and
    deviation of the logarithms of n tests. Its deviation from m + s²/2 is added to the logarithm of
    the mean measured. Source: Krishnamoorthy and Mathew, J. Stat. Plan. Inference 115 (2003) 103.

    Parameters
    ----------
    rng : numpy.random.Generator
        Source of the samples.
    tests : MeasuredTests
        On one surface.
    samples : int
        How many are drawn.

    Returns
    -------
    numpy.ndarray
        (samples,) in N; NaN of a single test, whose scatter is unknown.
    """
    if tests.number < 2:
        return np.full(samples, np.nan)
    freedom, variance = tests.number - 1, tests.shape**2
    drawn = variance * freedom / rng.chisquare(freedom, samples)
    normal = rng.standard_normal(samples)
    deviation = (drawn - variance) / 2 - normal * np.sqrt(drawn / tests.number)
    return np.asarray(tests.mean * np.exp(np.clip(deviation, -ENDLESS, ENDLESS)))
