"""Laws of attraction across a gap, and each of them as a mixture of exponential laws.

A law gives the energy per area U(g) = -W u(g) and the pressure p(g) = -dU/dg = -(W/rho) v(g)
across the gap g, with u(0) = v(0) = 1. In every law W is the work of adhesion and rho = W/|p(0)| is
the range. Eq. 1 of the paper is u = v = exp(-g/rho). Eq. 3 sums the pressure over pixels.

A power law of exponent m describes two flats whose atoms are the spacing g0 = m rho apart where the
flats touch: U = -W (1 + g/g0)^-m and p = -(m W/g0) (1 + g/g0)^-(m + 1). The energy per area of two
flats at the distance D is A/(12 pi D²) for instantaneous dispersion (m = 2), pi² hbar c/(720
D³) between ideal mirrors for retarded dispersion (m = 3), and eps0 V²/(2 D) for a constant
potential difference V (m = 1): Israelachvili, Intermolecular and Surface Forces, 3rd ed. (2011);
Casimir, Proc. K. Ned. Akad. Wet. 51 (1948) 793.

Since (1 + x)^-m = (1/Gamma(m)) int_0^inf t^(m-1) exp(-t) exp(-t x) dt, such a law is a mixture of
exponential laws of the ranges g0/t. Their works of adhesion add up to W and follow a gamma
distribution of t. The trapezoidal rule in log t gives the integral. The mixture holds only for gaps
g >= 0: where bodies interpenetrate, the terms of small range diverge.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import constants, special

from hardcontact.contact.force_curves import interpolate_to_ranges

Floats = NDArray[np.float64]

NANOMETRE = 1e-9

#: Upper end of the Hamaker constants of solids across vacuum, in J: metals have 3e-19 to 5e-19,
#: dielectrics less (assumed after Israelachvili).
MAX_HAMAKER_CONSTANT = 5e-19

#: Difference of contact potentials in V: the typical difference between work functions.
CONTACT_POTENTIAL = 1.0


@dataclass(frozen=True)
class Law:
    """A law of attraction."""

    name: str  #: Name in datasets.
    label: str  #: Name in figures.
    #: Exponent m of the energy; infinite for the exponential law, the limit at equal range.
    exponent: float
    #: Largest known W g0^m of the mechanism in J m^(m - 2); NaN for a law without a mechanism.
    max_strength: float

    @property
    def exponential(self) -> bool:
        """Whether this is the law of Eq. 1."""
        return bool(np.isinf(self.exponent))

    def spacing(self, rho: ArrayLike) -> Floats:
        """Return g0 in nm at a range in nm; for the exponential law the range itself."""
        return np.asarray(rho, float) * (1.0 if self.exponential else self.exponent)


EXPONENTIAL = Law("exponential", "exponential (Eq. 1)", np.inf, np.nan)

#: The law of the paper, then the laws that the paper mentions.
LAWS = (
    EXPONENTIAL,
    Law("van_der_waals", "van der Waals", 2.0, MAX_HAMAKER_CONSTANT / (12 * np.pi)),
    Law("retarded", "retarded (Casimir)", 3.0, np.pi**2 * constants.hbar * constants.c / 720),
    Law("electrostatic", "electrostatic", 1.0, constants.epsilon_0 * CONTACT_POTENTIAL**2 / 2),
)


def pressure(law: Law, gap: ArrayLike, rho: ArrayLike) -> Floats:
    """Return the relative pressure v = -p rho/W of a law.

    gap, rho: gaps of at least 0 and ranges in nm; they broadcast.
    Returns v of the broadcast shape.
    """
    reduced = np.asarray(gap, float) / law.spacing(rho)
    if law.exponential:
        return np.asarray(np.exp(-reduced))
    return np.asarray((1 + reduced) ** -(law.exponent + 1))


def work_shares(law: Law, rho: ArrayLike, ranges: ArrayLike) -> Floats:
    """Return the shares of W that exponential laws have in a power law.

    rho: ranges (...) of the power law in nm.
    ranges: ranges (k,) of the exponential laws in nm, evenly spaced in their logarithm, in either
        order.
    Returns shares (..., k).
    """
    ranges = np.asarray(ranges, float)
    step = abs(np.log(ranges[1] / ranges[0]))
    t = law.spacing(rho)[..., None] / ranges
    return np.asarray(step * np.exp(law.exponent * np.log(t) - t - special.gammaln(law.exponent)))


def strength_over_known(law: Law, rho: ArrayLike, work: ArrayLike) -> Floats:
    """Return W g0^m relative to the largest known value of the mechanism.

    Above one the attraction is stronger than the mechanism allows.

    rho, work: range in nm and work of adhesion in J/m²; they broadcast.
    Returns of the broadcast shape, NaN for a law without a mechanism.
    """
    if law.exponential:
        return np.full(np.broadcast(rho, work).shape, np.nan)
    metres = law.spacing(rho) * NANOMETRE
    return np.asarray(np.asarray(work, float) * metres**law.exponent / law.max_strength)


def range_grid(anchor: float, step: float, low: float, high: float) -> Floats:
    """Return ranges of adhesion that are evenly spaced in their logarithm.

    anchor: a range in nm that the grid contains.
    low, high: limits in nm that the grid covers.
    Returns ascending ranges (n,) in nm.
    """
    start = np.floor(np.log(low / anchor) / step)
    stop = np.ceil(np.log(high / anchor) / step)
    return np.asarray(anchor * np.exp(step * np.arange(start, stop + 1)))


def law_forces(law: Law, rho: ArrayLike, ranges: Floats, forces: ArrayLike) -> Floats:
    """Return the forces of a law from the forces of exponential laws at the same W.

    Forces of the exponential law itself are interpolated between its ranges.

    rho: ranges (n,) of the law in nm.
    ranges: ascending ranges (k,) of the exponential laws in nm, evenly spaced in their logarithm.
    forces: forces (..., k) of the exponential laws in N.
    Returns forces (..., n) in N.
    """
    values = np.asarray(forces, float)
    if law.exponential:
        return interpolate_to_ranges(values, ranges, np.asarray(rho, float))
    return np.asarray(values @ work_shares(law, rho, ranges).T)
