"""Laws of attraction across a gap, and each of them as a mixture of exponential laws.

A law gives the energy per area U(g) = -W u(g) and the pressure p(g) = -dU/dg = -(W/rho) v(g)
across the gap g, with u(0) = v(0) = 1: W is the work of adhesion and rho = W/|p(0)| the range, in
every law alike. Eq. 1 of the paper is u = v = exp(-g/rho). Eq. 3 sums the pressure over pixels.

A power law of exponent m is that of two flats whose atoms are the spacing g0 = m rho apart where
the flats touch: U = -W (1 + g/g0)^-m and p = -(m W/g0) (1 + g/g0)^-(m + 1). Per area of two flats
at the distance D the energy is A/(12 pi D²) for instantaneous dispersion (m = 2), pi² hbar c/(720
D³) between ideal mirrors for retarded dispersion (m = 3), and eps0 V²/(2 D) for a constant
potential difference V (m = 1): Israelachvili, Intermolecular and Surface Forces, 3rd ed. (2011);
Casimir, Proc. K. Ned. Akad. Wet. 51 (1948) 793.

Since (1 + x)^-m = (1/Gamma(m)) int_0^inf t^(m-1) exp(-t) exp(-t x) dt, such a law is a mixture of
exponential laws of the ranges g0/t, whose works of adhesion add up to W and follow a gamma
distribution of t. The integral is taken by the trapezoidal rule in log t. The mixture holds for
gaps g >= 0 alone: where bodies interpenetrate the terms of small range diverge.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import constants, special

from hardcontact.contact.force_curves import on_fine_grid

Floats = NDArray[np.float64]

NANOMETRE = 1e-9

#: Upper end of the Hamaker constants of solids across vacuum, in J: metals have 3e-19 to 5e-19,
#: dielectrics less (assumed after Israelachvili).
HAMAKER = 5e-19

#: A difference of contact potentials, in V: the scale of differences between work functions.
POTENTIAL = 1.0


@dataclass(frozen=True)
class Law:
    """A form of the attraction."""

    name: str  #: In data.
    label: str  #: In figures.
    #: m, of the energy; infinite for the exponential law, the limit at equal range.
    exponent: float
    #: Largest W g0^m in J m^(m - 2) that the mechanism is known to give; NaN where there is none.
    known: float

    @property
    def exponential(self) -> bool:
        """Whether this is the law of Eq. 1."""
        return bool(np.isinf(self.exponent))

    def spacing(self, rho: ArrayLike) -> Floats:
        """Return g0 in nm at a range in nm; for the exponential law the range itself."""
        return np.asarray(rho, float) * (1.0 if self.exponential else self.exponent)


EXPONENTIAL = Law("exponential", "exponential (Eq. 1)", np.inf, np.nan)

#: The law of the paper first, then the forms that it names.
LAWS = (
    EXPONENTIAL,
    Law("van_der_waals", "van der Waals", 2.0, HAMAKER / (12 * np.pi)),
    Law("retarded", "retarded (Casimir)", 3.0, np.pi**2 * constants.hbar * constants.c / 720),
    Law("electrostatic", "electrostatic", 1.0, constants.epsilon_0 * POTENTIAL**2 / 2),
)


def pressure(law: Law, gap: ArrayLike, rho: ArrayLike) -> Floats:
    """Return v = -p rho/W of a law at gaps >= 0 and a range, both in nm; they broadcast."""
    reduced = np.asarray(gap, float) / law.spacing(rho)
    if law.exponential:
        return np.asarray(np.exp(-reduced))
    return np.asarray((1 + reduced) ** -(law.exponent + 1))


def work_shares(law: Law, rho: ArrayLike, ranges: ArrayLike) -> Floats:
    """Return the shares (..., k) of W that exponential laws of given ranges have in a power law.

    `rho` (...) are ranges of the law, `ranges` (k,) those of the exponential laws, evenly spaced in
    their logarithm, in either order, all in nm.
    """
    ranges = np.asarray(ranges, float)
    step = abs(np.log(ranges[1] / ranges[0]))
    t = law.spacing(rho)[..., None] / ranges
    return np.asarray(step * np.exp(law.exponent * np.log(t) - t - special.gammaln(law.exponent)))


def implied_over_known(law: Law, rho: ArrayLike, work: ArrayLike) -> Floats:
    """Return W g0^m over the largest that the mechanism is known to give; NaN where none is.

    `rho` is in nm, `work` in J/m². Above one the attraction is stronger than the mechanism allows.
    """
    if law.exponential:
        return np.full(np.broadcast(rho, work).shape, np.nan)
    metres = law.spacing(rho) * NANOMETRE
    return np.asarray(np.asarray(work, float) * metres**law.exponent / law.known)


def range_grid(anchor: float, step: float, low: float, high: float) -> Floats:
    """Return ranges in nm, even in their logarithm, that hold `anchor` and cover `low` to `high`.

    `step` is that of the logarithm.
    """
    start, stop = np.floor(np.log(low / anchor) / step), np.ceil(np.log(high / anchor) / step)
    return np.asarray(anchor * np.exp(step * np.arange(start, stop + 1)))


def law_forces(law: Law, rho: ArrayLike, ranges: Floats, forces: ArrayLike) -> Floats:
    """Return the forces (..., n) in N of a law from those (..., k) of exponential laws, at one W.

    `rho` (n,) are ranges of the law, `ranges` (k,) those of the exponential laws, rising, evenly
    spaced in their logarithm, all in nm. Forces of the exponential law are interpolated between its
    ranges.
    """
    values = np.asarray(forces, float)
    if law.exponential:
        return on_fine_grid(values, ranges, np.asarray(rho, float))
    return np.asarray(values @ work_shares(law, rho, ranges).T)
