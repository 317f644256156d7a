"""The type of float arrays, a random generator for each purpose of a study, and old seed words.

This module is small, because nearly all code imports it: each change of it reruns nearly all jobs.
"""

import hashlib

import numpy as np
from numpy.typing import NDArray

#: An array of floats; docstrings say its shape and unit.
Floats = NDArray[np.float64]

#: Words in seeds, by what their random numbers are for. The words are older than the names that
#: these things have now. They stay, because another word gives other random numbers, and so moves
#: all results.
SEED_WORDS = {
    "short": "small", "long": "large",  # The sides of the band.
    "masters of the study": "master", "masters of the sets": "variant",
    "forces on masters": "scales", "measured forces": "tests",
    "position of the sphere": "place on the sphere", "sampled spectrum": "drawn spectrum",
}  # fmt: skip


def generator(seed: int, *names: object) -> np.random.Generator:
    """Return the random generator for one purpose, e.g. ``generator(seed, "uncd", 3, "scan")``.

    The generator depends on the seed and the text of the names alone, so that jobs give the same
    numbers in any order and on any machine.
    """
    text = "/".join(str(name) for name in names).encode()
    words = np.frombuffer(hashlib.sha256(text).digest(), dtype="<u4")
    return np.random.default_rng([seed, *words.tolist()])
