"""How large a scan must be: a rule for the excess of the force on small mirrored scans.

A contact finds its peaks within 2 sqrt(2 R sigma) of each other (`finite_scan`). A smaller scan,
mirrored, has fewer peaks, so that the sphere misses the highest of them. How much that counts may
depend on this draw size and on the roll-off, both over the size of the scan, and on the heights
over the range of adhesion. The rule is a power law of these three ratios, with exponents of either
sign as the fit finds them. It is fitted to some surfaces, and its error is found on others.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["Case", "ScanSizeRule", "fitted_rule", "rule_error"]

Floats = NDArray[np.float64]


class Case(NamedTuple):
    """Scans of surfaces under a sphere; all lengths in nm, of shapes that go with each other.

    Attributes
    ----------
    size : array_like
        Side of the scan.
    rms_height, roll_off : array_like
        Of the surface.
    radius : array_like
        Of the sphere.
    rho : array_like
        Range of adhesion.
    """

    size: ArrayLike
    rms_height: ArrayLike
    roll_off: ArrayLike
    radius: ArrayLike
    rho: ArrayLike

    def ratios(self) -> Floats:
        """Return logarithms (3, n) of draw size and roll-off over scan size, of sigma over rho."""
        size, height, roll_off, radius, rho = map(np.asarray, self)
        draw = 2 * np.sqrt(2 * radius * height)
        ratios = np.broadcast_arrays(draw / size, roll_off / size, height / rho)
        return np.asarray(np.log(np.stack(ratios)))


class ScanSizeRule(NamedTuple):
    """A power law: ln(force on the scan / on a large one) = strength * prod(ratios**exponents).

    Attributes
    ----------
    strength : float
        Where all ratios are 1.
    exponents : numpy.ndarray
        (3,) of the ratios of `Case`.
    """

    strength: float
    exponents: Floats

    def excess(self, case: Case) -> Floats:
        """Return the factor by which the force on a scan is too large."""
        logarithm = self.strength * np.exp(np.tensordot(self.exponents, case.ratios(), 1))
        return np.asarray(np.exp(logarithm))

    def size_for(self, case: Case, excess: float) -> Floats:
        """Return the side (nm) of a scan whose force is too large by a given factor.

        The size of the case does not matter.
        """
        one = case._replace(size=1.0)
        logarithm = np.log(self.strength) + np.tensordot(self.exponents, one.ratios(), 1)
        steepness = self.exponents[0] + self.exponents[1]
        return np.asarray(np.exp((logarithm - np.log(np.log(excess))) / steepness))


def fitted_rule(case: Case, excess: ArrayLike) -> ScanSizeRule:
    """Return the rule that fits measured factors best, by least squares of their logarithms.

    Logarithms of factors that scatter about one may be negative; they are fitted as they are.

    Parameters
    ----------
    case : Case
        Scans (n,).
    excess : array_like
        (n,) measured factors.

    Returns
    -------
    ScanSizeRule
        Of a strength above zero.

    Raises
    ------
    ValueError
        If there are fewer than four scans.
    """
    from scipy.optimize import least_squares

    ratios, measured = case.ratios(), np.log(np.asarray(excess, float))
    if measured.size < 4:
        raise ValueError(f"expected four scans or more to fit a rule to, found {measured.size}")

    def misfit(parameters: Floats) -> Floats:
        return np.asarray(np.exp(parameters[0] + parameters[1:] @ ratios) - measured)

    found = least_squares(misfit, np.array([np.log(0.3), 1.0, 0.0, 0.0])).x
    return ScanSizeRule(float(np.exp(found[0])), found[1:])


def rule_error(rule: ScanSizeRule, case: Case, excess: ArrayLike) -> tuple[float, float]:
    """Return the error of ln(force) with and without the rule as a correction, on given scans.

    A correction is worth making where the first is well below the second, on scans that the rule
    was not fitted to.

    Parameters
    ----------
    rule : ScanSizeRule
        Fitted to other scans.
    case : Case
        Scans (n,).
    excess : array_like
        (n,) measured factors.

    Returns
    -------
    corrected, uncorrected : float
        Root of the mean square of ln(excess), of the force divided by the rule's factor and as it
        is.
    """
    measured = np.log(np.asarray(excess, float))
    left = measured - np.log(rule.excess(case))
    return float(np.sqrt((left**2).mean())), float(np.sqrt((measured**2).mean()))
