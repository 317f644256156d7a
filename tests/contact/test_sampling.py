"""What samples are drawn for, and the intervals they give."""

import numpy as np
import xarray as xr

from hardcontact.base.random import generator
from hardcontact.base.statistics import Sampling


def test_numbers_are_drawn_for_a_purpose():
    study, varied = Sampling(3, 10, 0.95), Sampling(3, 10, 0.95, ("sampling", "robustness"))
    expected = generator(3, "sampling", "robustness", "scales").random()
    assert varied.generator("scales").random() == expected
    assert study.generator("scales").random() == generator(3, "sampling", "scales").random()


def test_interval_is_that_of_the_samples():
    samples = np.arange(101.0)[:, None] * [1, 2]
    computed = xr.Dataset(
        Sampling(0, 101, 0.9).with_interval("work", "surface", [50.0, 100.0], samples, {})
    )
    np.testing.assert_allclose(computed.work_interval, [[5, 95], [10, 190]])
    assert computed.work_interval.attrs == {"confidence": 0.9}


def test_without_samples_there_is_no_interval():
    computed = xr.Dataset(
        Sampling(0, 0, 0.9).with_interval("work", "surface", [1.0, 2.0], np.empty((0, 2)), {})
    )
    assert computed.work.values.tolist() == [1, 2]
    assert computed.work_interval.shape == (2, 2) and computed.work_interval.isnull().all()
