"""Where the law of two plates may be applied gap by gap, as Eq. 3 of the paper does.

Lengths in nm. A law that sums over pairs of volume elements may be, opposite a plane: each element
of the rough body sees the same half-space, whatever stands beside it. Two rough bodies share the
second order term h1 h2 of waves of the wavevector q, which their elements, apart also along the
surface, weaken by `pair_damping`.

Between conductors the field is bent, too. With rough waves of the variance dV on one of them, the
second order in h of Laplace's equation raises the attraction by `conductor_kernel` dV/s²; for long
waves this is a third of the mean square slope, as in the derivative expansion of Fosco, Lombardo
and Mazzitelli, Ann. Phys. 327 (2012) 2050. The slope is that of the whole plane: where k = rho
m/sigma² is below one the summits that attract have less, so that this is an upper bound there. It
holds for the electrostatic law; the retarded one is neither a sum over pairs nor covered.
workflow/report/theory.md has both derivations.
"""

from collections.abc import Mapping

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike
from scipy import special, stats

from hardcontact.insight.closed_form import Contact, closed_form
from hardcontact.insight.interaction_laws import LAWS
from hardcontact.insight.summits import banded
from hardcontact.surfaces.spectrum import Floats, Spectrum

#: The law whose damping is told: of pairs, and of the longest reach among those that are.
PAIRS = LAWS[1]
#: q s beyond which sinh overflows and its inverse is nothing.
LARGEST = 300.0


def pair_damping(exponent: float, phase: ArrayLike) -> Floats:
    """Return the share (...) of the local second order that pairs leave of waves at phases q s > 0.

    A pair attracts as r^-(m + 4) if plates do as s^-m, the exponent m. The Hankel transform of
    (r² + s²)^-(n + 1), n = 1 + m/2, is 2 pi (q/2s)^n K_n(q s)/Gamma(n + 1).
    """
    order, x = 1 + exponent / 2, np.asarray(phase, float)
    return np.asarray(2 * (x / 2) ** order * special.kv(order, x) / special.gamma(order))


def conductor_kernel(phase: ArrayLike) -> Floats:
    """Return what local pressures miss of p (s/h)² (...) for waves <h²> at phases x = q s > 0."""
    x = np.minimum(phase, LARGEST)
    return np.asarray(2 * np.asarray(phase) / np.tanh(x) + (x / np.sinh(x)) ** 2 - 3)


def attraction_gap(rms_height: float, approach: float, rho: float) -> float:
    """Return the mean gap (nm) of the points that do not touch, weighted by their attraction.

    They are normal about sigma²/rho with the deviation sigma, cut off at m, the approach: the gap
    is m - sigma²/rho of many points and rho/(1 - k) of single peaks.
    """
    below = approach / rms_height - rms_height / rho
    hazard = np.exp(stats.norm.logpdf(below) - special.log_ndtr(below))
    return float(rms_height * (below + hazard))


def conductor_excess(spectrum: Spectrum, gap: float) -> float:
    """Return the share of the attraction that local pressures miss between conductors at a gap."""
    waves = banded(spectrum, 0, np.inf)
    if waves is None:
        return 0.0
    q = waves.wavevector
    missed = waves.density * q**2 * conductor_kernel(q * gap) / (2 * np.pi * gap**2)
    return float(np.trapezoid(missed, np.log(q)))


def local_law(
    spectra: Mapping[str, Spectrum], contact: Contact, short_edge: xr.DataArray
) -> xr.Dataset:
    """Return where Eq. 3 is doubtful, over surface, from their short edges (nm).

    ``attraction_gap`` in nm, ``conductor_excess``, and ``pair_damping`` at the short edge of PAIRS.
    """
    forms = [closed_form(one, contact) for one in spectra.values()]
    gap = [attraction_gap(one.rms_height, one.closest_approach, contact.rho) for one in forms]
    excess = [conductor_excess(one, s) for one, s in zip(spectra.values(), gap, strict=True)]
    edges = short_edge.sel(surface=list(spectra)).values
    damping = pair_damping(PAIRS.exponent, 2 * np.pi * np.array(gap) / edges)
    one = {"units": "1"}
    return xr.Dataset(
        {
            "attraction_gap": ("surface", gap, {"units": "nm"}),
            "conductor_excess": ("surface", excess, one),
            "pair_damping": ("surface", damping, one),
        },
        {"surface": list(spectra)},
    )
