"""Generators depend on the seed and on what they are for, and on nothing else."""

import hashlib

import numpy as np

from hardcontact.base.random import generator


def drawn(*arguments):
    return generator(*arguments).random(4).tolist()


def test_same_names_same_numbers_whatever_was_drawn_before():
    first = drawn(1, "uncd", 3, "scan")
    drawn(1, "ncd", 3, "scan")
    np.random.default_rng().random(100)
    assert drawn(1, "uncd", 3, "scan") == first


def test_other_seed_or_names_other_numbers():
    different = [
        (1, "uncd", 3),
        (2, "uncd", 3),
        (1, "uncd", 4),
        (1, "ncd", 3),
        (1, 3, "uncd"),
        (1,),
    ]
    assert len({tuple(drawn(*arguments)) for arguments in different}) == len(different)


def test_names_count_as_their_text():
    assert drawn(1, "uncd", 3) == drawn(1, "uncd", "3")


def test_the_sequence_is_that_of_the_digest_of_the_names():
    words = np.frombuffer(hashlib.sha256(b"uncd/3").digest(), dtype="<u4").tolist()
    assert drawn(7, "uncd", 3) == np.random.default_rng([7, *words]).random(4).tolist()
