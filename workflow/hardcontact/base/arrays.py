"""The type of float arrays, and a random generator for each purpose of a study.

This module is small, because nearly all code imports it: each change of it reruns nearly all jobs.
"""

import hashlib

import numpy as np
from numpy.typing import NDArray

#: An array of floats; docstrings say its shape and unit.
Floats = NDArray[np.float64]


def generator(seed: int, *names: object) -> np.random.Generator:
    """Return the random generator for one purpose, e.g. ``generator(seed, "uncd", 3, "scan")``.

    The generator depends on the seed and the text of the names alone, so that jobs give the same
    numbers in any order and on any machine.
    """
    text = "/".join(str(name) for name in names).encode()
    words = np.frombuffer(hashlib.sha256(text).digest(), dtype="<u4")
    return np.random.default_rng([seed, *words.tolist()])
