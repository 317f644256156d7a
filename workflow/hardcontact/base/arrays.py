"""Arrays of floats, and the random generators that fill them.

Nearly all code depends on these: apart from the rest of the library, they change rarely, and with
them the digests of all results.
"""

import hashlib

import numpy as np
from numpy.typing import NDArray

#: An array of floats; docstrings say its shape and unit.
Floats = NDArray[np.float64]


def generator(seed: int, *names: object) -> np.random.Generator:
    """Return the random generator for one purpose, e.g. ``generator(seed, "uncd", 3, "scan")``.

    It depends on the seed and the text of the names alone, never on the order of execution or the
    machine.
    """
    text = "/".join(str(name) for name in names).encode()
    words = np.frombuffer(hashlib.sha256(text).digest(), dtype="<u4")
    return np.random.default_rng([seed, *words.tolist()])
