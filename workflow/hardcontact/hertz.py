"""Contact of a smooth elastic sphere and a flat without adhesion: Hertz.

Johnson, Contact Mechanics (Cambridge University Press, 1985), chapter 4.
"""

import numpy as np

__all__ = ["contact", "effective_modulus"]

METRE = 1e-9  # a nanometre in metres


def effective_modulus(modulus_1, poisson_1, modulus_2, poisson_2):
    """Effective modulus E* (Pa) of two bodies: 1/E* is the sum of (1 - nu²)/E; moduli in Pa."""
    return 1 / ((1 - poisson_1**2) / modulus_1 + (1 - poisson_2**2) / modulus_2)


def contact(load, radius, modulus):
    """Contact radius a (nm), peak pressure (Pa) and approach (nm) of a sphere under a load.

    load: N; radius: nm; modulus: E* in Pa. a³ = 3FR/4E*, p0 = 3F/2πa², approach a²/R.
    """
    a = np.cbrt(0.75 * load * radius * METRE / modulus)
    return a / METRE, 1.5 * load / (np.pi * a**2), a**2 / (radius * METRE) / METRE
