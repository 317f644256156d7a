"""What a bootstrap draws its numbers for, and the intervals it gives."""

import numpy as np
import xarray as xr

from hardcontact.adhesion.bootstrap import Bootstrap
from hardcontact.random import generator


def test_numbers_are_drawn_for_a_purpose():
    study, varied = Bootstrap(3, 10, 0.95), Bootstrap(3, 10, 0.95, ("bootstrap", "robustness"))
    expected = generator(3, "bootstrap", "robustness", "scales").random()
    assert varied.generator("scales").random() == expected
    assert study.generator("scales").random() == generator(3, "bootstrap", "scales").random()


def test_interval_is_that_of_the_samples():
    samples = np.arange(101.0)[:, None] * [1, 2]
    computed = xr.Dataset(
        Bootstrap(0, 101, 0.9).with_interval("work", "surface", [50.0, 100.0], samples, {})
    )
    np.testing.assert_allclose(computed.work_interval, [[5, 95], [10, 190]])
    assert computed.work_interval.attrs == {"confidence": 0.9}
