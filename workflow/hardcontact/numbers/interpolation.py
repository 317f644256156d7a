"""Interpolation of forces between the rms heights that a scan was computed at."""

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline

Floats = NDArray[np.float64]


def height_weights(heights: Floats, at: Floats) -> Floats:
    """Return the weights (at, amplitude) of logarithms of forces at `heights`, all in nm.

    Those of a cubic spline in the root of the height.
    """
    if len(heights) == 1:
        return np.ones((len(at), 1))
    degree = min(3, len(heights) - 1)
    spline = make_interp_spline(np.sqrt(heights), np.eye(len(heights)), k=degree)
    return np.asarray(spline(np.sqrt(at)))
