"""What sums over smooth and rough spheres have in common: the form of their terms, exponentials."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats

#: Sums (contact_y, contact_x) over all pixels but contact pixels, and a function that returns the
#: factor of the sphere at the contact pixels as seen from the contact (i, j).
SphereTerms = tuple[Floats, Callable[[tuple[int, int]], Floats]]


def exponential(heights: NDArray[np.floating], highest: float, rho: float) -> NDArray[np.floating]:
    """Return exp((heights - highest)/rho) in the precision of the heights (nm)."""
    attraction = heights - highest
    attraction /= rho
    return np.asarray(np.exp(attraction, out=attraction))
