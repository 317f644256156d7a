"""Random numbers of samples by their purpose."""

from hardcontact.base.random import generator
from hardcontact.base.statistics import Sampling


def test_each_purpose_has_its_own_random_numbers():
    study, classical = Sampling(3, 10, 0.95), Sampling(3, 10, 0.95, ("sampling", "classical"))
    number = generator(3, "sampling", "classical", "scales").random()
    assert classical.generator("scales").random() == number
    assert study.generator("scales").random() == generator(3, "sampling", "scales").random()
