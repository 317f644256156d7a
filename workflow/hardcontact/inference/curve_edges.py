"""The edge of one curve: the cutoff at which the change of the force exceeds the tolerance."""

from enum import StrEnum
from typing import NamedTuple

import numpy as np

from hardcontact.base.arrays import Floats


class ChangeCurve(NamedTuple):
    """A measure of the change of the force on one side, zero without a filter."""

    side: str  #: short: wavelengths below the cutoff are removed; long: wavelengths above it.
    #: (k,) in nm, in the order of growing effect: ascending on the short side, descending on the
    #: long side.
    cutoffs: Floats
    #: (k,) ln(ratio) for a single surface, which passes through zero where the ratio crosses one;
    #: the mean of |ratio - 1| for several.
    values: Floats
    limits: tuple[float, float]  #: Lower and upper limit; a change within them does not count.


class EdgeStatus(StrEnum):
    """Whether a curve has an edge."""

    FOUND = "found"
    #: The edge is longer or shorter than its bound.
    OPEN_ABOVE, OPEN_BELOW = "open_above", "open_below"
    #: There is no edge: ripples of the filter, not the roughness, change the force; or no cutoff
    #: changes the force in closed form by the tolerance.
    RIPPLES, NO_EDGE = "ripples", "none"


class Edge(NamedTuple):
    """The edge of a curve, or a bound of it."""

    value: float  #: In nm; NaN if the edge is open.
    bound: float  #: Cutoff in nm beyond which an open edge lies; NaN for another status.
    status: EdgeStatus


def ordered_curve(
    side: str,
    cutoffs: Floats,
    values: Floats,
    limits: tuple[float, float],
    spectrum_end: float | None = None,
) -> tuple[ChangeCurve, Floats]:
    """Return the curve of the first row of values (row, k), and the other rows at its cutoffs.

    Cutoffs (k,) are in any order; those at which the first row is NaN are left out. All rows begin
    with zero at `spectrum_end`, the wavelength (nm) at which nothing is removed, if there is one.
    """
    computed = np.flatnonzero(np.isfinite(values[0]))
    order = computed[np.argsort(cutoffs[computed])][:: 1 if side == "short" else -1]
    cutoffs, values = cutoffs[order], values[:, order]
    if spectrum_end is not None:
        cutoffs = np.append(spectrum_end, cutoffs)
        values = np.pad(values, ((0, 0), (1, 0)))
    return ChangeCurve(side, cutoffs, values[0], limits), values[1:]


def logarithmic_limits(tolerance: float) -> tuple[float, float]:
    """Return the limits of ln(ratio) between which the force counts as unchanged.

    The tolerance is a relative change of the force, such as 0.1.
    """
    return float(np.log1p(-tolerance)), float(np.log1p(tolerance))


def first_outside(lowest: Floats, highest: Floats, limits: tuple[float, float]) -> int:
    """Return the index of the first cutoff at which a curve is outside its limits.

    The lowest values (k,) are compared with the lower limit, the highest values with the upper
    limit. Returns the number of cutoffs if the curve is never outside.
    """
    lower, upper = limits
    is_outside = (lowest < lower) | (highest > upper)
    return int(is_outside.argmax()) if is_outside.any() else len(is_outside)


def interpolate_edge(cutoffs: Floats, curve: Floats, limits: tuple[float, float]) -> float:
    """Return the cutoff (nm) at which a curve first leaves its limits.

    Cutoffs and curve (k,) are in the order of growing effect; the curve is interpolated linearly in
    the logarithm of the wavelength. NaN if the curve never leaves its limits, or is outside at
    the first cutoff.
    """
    crossing = first_outside(curve, curve, limits)
    if crossing in (0, len(curve)):
        return np.nan
    lower, upper = limits
    limit = upper if curve[crossing] > upper else lower
    share = (limit - curve[crossing - 1]) / (curve[crossing] - curve[crossing - 1])
    step = np.log(cutoffs[crossing] / cutoffs[crossing - 1])
    return float(np.exp(np.log(cutoffs[crossing - 1]) + share * step))


def find_edge(curve: ChangeCurve) -> Edge:
    """Return the edge of a curve.

    It is open if the curve is outside its limits at the first cutoff already, or within them up to
    the last cutoff.
    """
    edge = interpolate_edge(curve.cutoffs, curve.values, curve.limits)
    if np.isfinite(edge):
        return Edge(edge, np.nan, EdgeStatus.FOUND)
    is_outside_at_once = first_outside(curve.values, curve.values, curve.limits) == 0
    bound = float(curve.cutoffs[0 if is_outside_at_once else -1])
    # The first cutoff of a short side is its shortest, the first of a long side its longest.
    is_open_below = is_outside_at_once == (curve.side == "short")
    return Edge(np.nan, bound, EdgeStatus.OPEN_BELOW if is_open_below else EdgeStatus.OPEN_ABOVE)


def shows_ripples(curve: ChangeCurve) -> bool:
    """Return whether a curve of ln(ratio) shows the ripples of the filter, not the roughness.

    Without its short waves a random surface has lower summits, and the force rises. If the force
    first leaves its limits by falling, the filter made summits that are higher than the surface:
    its ripples beside steps.
    """
    crossing = first_outside(curve.values, curve.values, curve.limits)
    value_outside = curve.values[crossing : crossing + 1]  # empty if the curve never leaves them
    return curve.side == "short" and bool((value_outside < 0).any())


def edge_interval(curve: ChangeCurve, lowest: Floats, highest: Floats) -> Floats:
    """Return the cutoffs (2,) in nm between which the edge lies, from the intervals of a curve.

    lowest, highest: ends (k,) of the intervals of the values. One end is the last cutoff before any
    value within the intervals leaves the limits. The other end is the first cutoff at which all
    values have left. The only assumption is that the curve does not cross its limits twice between
    two cutoffs. NaN for an end before the first or after the last cutoff, or without intervals.
    """
    if np.isnan([lowest, highest]).any():
        return np.full(2, np.nan)
    bounds = np.concatenate([[np.nan], curve.cutoffs, [np.nan]])
    first_possible = first_outside(lowest, highest, curve.limits)
    # Swapped ends: even the value nearest to the limits is outside.
    last_possible = first_outside(highest, lowest, curve.limits)
    interval = np.array(
        [bounds[first_possible], bounds[last_possible + 1] if last_possible else np.nan]
    )
    return interval if curve.side == "short" else interval[::-1]
