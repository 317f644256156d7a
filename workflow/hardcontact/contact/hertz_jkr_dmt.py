"""A smooth elastic sphere on a flat: Hertz without adhesion; from DMT to JKR with adhesion.

The last functions judge whether elasticity changes the force in a contact.

Lengths are in nm, forces in N, works of adhesion W in J/m², and moduli in Pa; R is the radius of
the sphere, E* the effective modulus. Pull-off forces are positive. Arrays broadcast.
"""

import math
from enum import StrEnum
from typing import Any

import numpy as np

from hardcontact.base.number import Number
from hardcontact.base.units import NANOMETRE
from hardcontact.contact.contact import Contact

#: A number or an array.
Values = Any
#: Work in J/m² to part diamond along (111): no known solids adhere more strongly. Source: J. E.
#: Field, The Properties of Diamond (Academic Press, 1979).
STRONGEST_WORK = 10.6
#: Effective modulus in Pa of ruby on diamond. It stands here, too, because an installed library has
#: no resources/; a test compares it with `published.effective_modulus`.
RUBY_ON_DIAMOND_MODULUS = 1 / ((1 - 0.29**2) / 365e9 + (1 - 0.22**2) / 1010e9)
#: Hardness in Pa below which the modulus is unknown: a tenth of the ruby's. Moduli are ten to some
#: hundred times the hardness, so bodies of equal hardness may differ tenfold in modulus.
SOFT_HARDNESS = 2.5e9
#: Largest negligible decrease of the force by elasticity, relative to a stiff sphere.
MAX_SOFTENING = 0.1


def hertz_peak_pressure(load: float, radius: float, modulus: float) -> float:
    """Return the peak pressure 3F/2πa² (Pa) of a sphere under a load F, with a³ = 3FR/4E*.

    Johnson, Contact Mechanics (Cambridge University Press, 1985), chapter 4.
    """
    a = np.cbrt(0.75 * load * radius * NANOMETRE / modulus)
    return float(1.5 * load / (np.pi * a**2))


def jkr_pull_off(work: Values, radius: Values) -> Values:
    """Return the pull-off force 1.5πWR of a compliant sphere.

    Johnson, Kendall and Roberts, Proc. R. Soc. A 324 (1971) 301.
    """
    return 1.5 * np.pi * work * radius * NANOMETRE


def dmt_pull_off(work: Values, radius: Values) -> Values:
    """Return the pull-off force 2πWR of a stiff sphere.

    Derjaguin, Muller and Toporov, J. Colloid Interface Sci. 53 (1975) 314.
    """
    return 2 * np.pi * work * radius * NANOMETRE


def smooth_pull_off(work: Values, radius: Values, area: Values, rho: Values) -> Values:
    """Return the force 2πWR + WA/ρ of a stiff sphere with an area A (nm²) in contact on a flat."""
    return dmt_pull_off(work, radius) + work * area * NANOMETRE / rho


def limit_forces(forces: Values, bound: Values) -> Values:
    """Return forces, or ends of intervals, limited to a bound.

    An infinite end stays, because it means that the end is not known.
    """
    return np.where(np.isinf(forces), forces, np.minimum(forces, bound))


def tabor_parameter(work: Values, radius: float, modulus: float, spacing: float) -> Values:
    """Return the Tabor parameter (RW²/E*²z0³)^⅓ with the spacing z0: small for DMT, large for JKR.

    Tabor, J. Colloid Interface Sci. 58 (1977) 2.
    """
    return np.cbrt(radius * NANOMETRE * work**2 / (modulus**2 * (spacing * NANOMETRE) ** 3))


def maugis_parameter(tabor: Values) -> Values:
    """Return the Maugis parameter λ = 2σ0 (R/πWK²)^⅓, 1.157 times the Tabor parameter.

    K = 4E*/3; the cohesive stress σ0 = 16W/(9√3 z0) is the greatest stress of the Lennard-Jones
    law. Maugis, J. Colloid Interface Sci. 150 (1992) 243.
    """
    return 32 / (9 * np.sqrt(3)) / np.cbrt(16 * np.pi / 9) * tabor


def pull_off_coefficient(maugis: Values) -> Values:
    """Return F/πWR, from 2 (DMT) to 3/2 (JKR): 7/4 - ¼ (4.04 λ^1.4 - 1)/(4.04 λ^1.4 + 1).

    This fit of Carpick, Ogletree and Salmeron, J. Colloid Interface Sci. 211 (1999) 395, was taken
    from Grierson, Flater and Carpick, J. Adhes. Sci. Technol. 19 (2005) 291.
    """
    scaled_maugis = 4.04 * np.asarray(maugis) ** 1.4
    return 7 / 4 - (scaled_maugis - 1) / (scaled_maugis + 1) / 4


def effective_work_of_adhesion(force: Values, radius: Values, coefficient: Values) -> Values:
    """Return the work F/(coefficient πR) of a smooth sphere from its `pull_off_coefficient`."""
    return force / (coefficient * np.pi * radius * NANOMETRE)


class Elasticity(StrEnum):
    """Whether elasticity changes the force of a smooth sphere.

    SOFT: it reduces the force by over MAX_SOFTENING. UNKNOWN: no modulus is known.
    """

    HARD, SOFT, UNKNOWN = "hard", "soft", "unknown"


def assumed_modulus(hardness: float) -> float:
    """Return the effective modulus (Pa) to assume at a hardness (Pa); NaN below SOFT_HARDNESS."""
    return RUBY_ON_DIAMOND_MODULUS if hardness >= SOFT_HARDNESS else math.nan


def judge_tabor_parameter(contact: Contact, effective_modulus: float) -> Number:
    """Return the Tabor parameter with rho as the spacing z0; the status is an `Elasticity`."""
    if math.isnan(effective_modulus):
        return Number("tabor_parameter", effective_modulus, status=Elasticity.UNKNOWN)
    value = float(tabor_parameter(contact.work, contact.radius, effective_modulus, contact.rho))
    softening = 1 - float(pull_off_coefficient(maugis_parameter(value))) / 2
    status = Elasticity.SOFT if softening > MAX_SOFTENING else Elasticity.HARD
    return Number("tabor_parameter", value, status=status)
