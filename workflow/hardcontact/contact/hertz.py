"""Contact of a smooth elastic sphere and a flat without adhesion: Hertz.

Johnson, Contact Mechanics (Cambridge University Press, 1985), chapter 4.
"""

from typing import NamedTuple

import numpy as np

NANOMETRE = 1e-9  # m


class HertzContact(NamedTuple):
    """A smooth elastic sphere on a flat: contact radius and approach in nm, peak pressure in Pa."""

    radius: float
    peak_pressure: float
    approach: float


def effective_modulus(
    modulus_1: float, poisson_1: float, modulus_2: float, poisson_2: float
) -> float:
    """Return the effective modulus E* of two bodies in Pa: 1/E* is the sum of (1 - nu²)/E."""
    return 1 / ((1 - poisson_1**2) / modulus_1 + (1 - poisson_2**2) / modulus_2)


def contact(load: float, radius: float, modulus: float) -> HertzContact:
    """Return the contact of a sphere under a load: a³ = 3FR/4E*, p0 = 3F/2πa², approach a²/R.

    The load F is in N, the radius R in nm and the effective modulus E* in Pa.
    """
    a = np.cbrt(0.75 * load * radius * NANOMETRE / modulus)
    return HertzContact(
        a / NANOMETRE, 1.5 * load / (np.pi * a**2), a**2 / (radius * NANOMETRE) / NANOMETRE
    )
