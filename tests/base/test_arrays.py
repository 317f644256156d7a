"""Generators depend on the seed and on their purpose, and on nothing else."""

import hashlib
from dataclasses import replace

import numpy as np

from hardcontact.base.arrays import generator
from hardcontact.base.statistics import Sampling


def sample_numbers(*arguments):
    return generator(*arguments).random(4).tolist()


def test_numbers_follow_from_the_seed_and_the_digest_of_the_names():
    words = np.frombuffer(hashlib.sha256(b"uncd/3").digest(), dtype="<u4").tolist()
    assert sample_numbers(7, "uncd", 3) == np.random.default_rng([7, *words]).random(4).tolist()


def test_each_purpose_has_its_own_random_numbers():
    study = Sampling(seed=3, sample_count=10, confidence=0.95)
    classical = replace(study, stream=("sampling", "classical"))
    number = generator(3, "sampling", "classical", "forces").random()
    assert classical.generator("forces").random() == number
    assert study.generator("forces").random() == generator(3, "sampling", "forces").random()
    assert study.generator("forces").random() != number
