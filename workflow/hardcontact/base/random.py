"""Random generators, one for each named purpose."""

import hashlib

import numpy as np


def generator(seed: int, *names: object) -> np.random.Generator:
    """Return the random generator for one purpose, e.g. ``generator(seed, "uncd", 3, "scan")``.

    It depends on the seed and the text of the names alone, never on the order of execution or the
    machine.
    """
    text = "/".join(str(name) for name in names).encode()
    words = np.frombuffer(hashlib.sha256(text).digest(), dtype="<u4")
    return np.random.default_rng([seed, *words.tolist()])
