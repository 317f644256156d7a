"""What samples are drawn for, and the intervals they give."""

from hardcontact.base.random import generator
from hardcontact.base.statistics import Sampling


def test_each_purpose_has_its_own_random_numbers():
    study, varied = Sampling(3, 10, 0.95), Sampling(3, 10, 0.95, ("sampling", "robustness"))
    expected = generator(3, "sampling", "robustness", "scales").random()
    assert varied.generator("scales").random() == expected
    assert study.generator("scales").random() == generator(3, "sampling", "scales").random()
