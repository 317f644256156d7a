"""Types of arrays."""

import numpy as np
from numpy.typing import NDArray

#: An array of floats; docstrings say its shape and unit.
Floats = NDArray[np.float64]
