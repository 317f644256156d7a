"""The gap of one contact at single pixels, where its whole window is not needed."""

import numpy as np
from numpy.typing import NDArray

from hardcontact.contact.geometry import Bodies

__all__ = ["gaps_at"]

Floats = NDArray[np.float64]


def gaps_at(bodies: Bodies, position: NDArray[np.int_], offsets: NDArray[np.int_]) -> Floats:
    """Return the gaps (...) in nm at offsets (..., 2) in pixels from an apex at a position (2,)."""
    y, x = np.moveaxis((position + offsets) % bodies.substrate.pixels, -1, 0)
    gaps = bodies.geometry.paraboloid(offsets).sum(axis=-1) - bodies.substrate.heights[y, x]
    if bodies.roughness is not None:
        v, u = np.moveaxis(offsets % bodies.roughness.pixels, -1, 0)
        gaps -= bodies.roughness.heights[v, u]
    return np.asarray(gaps)
