"""Where a curve of the force against cutoffs leaves its tolerance: found, or open with a bound.

An edge is found between two cutoffs that were computed. Where the curve has left before the first
one, or does not leave up to the last, the edge is open, and a bound is all that is known.
"""

from typing import Any, NamedTuple

import numpy as np

from hardcontact.scales.critical_band import critical_wavelength


class Curve(NamedTuple):
    """A measure of the change of the force on one side, zero without a filter.

    Attributes
    ----------
    side : str
        small: wavelengths below the cutoff are removed; large: those above.
    cell : float
        Longest wavelength of the filtered surfaces in nm.
    cutoffs : numpy.ndarray
        (k,) nm, in the order of growing effect: growing on the small side, falling on the large.
    values : numpy.ndarray
        (3, k): as computed, the least and the greatest within the interval; the latter NaN where
        there is no interval. Of one surface ln(ratio), of several the mean of |ratio - 1|.
    limits : tuple of float
        Lower and upper; within them a change counts as none.
    """

    side: str
    cell: float
    cutoffs: np.ndarray
    values: np.ndarray
    limits: tuple[float, float]


class Edge(NamedTuple):
    """Where a curve leaves its tolerance.

    The wavelength, in nm, lies between two cutoffs and is NaN of an open edge; the bound, in nm, is
    what is known of an open edge and NaN otherwise. `at_least` says whether the edge is open and
    its bound one from below.
    """

    wavelength: float
    bound: float
    at_least: bool


def described_edge(curve: Curve) -> dict[str, Any]:
    """Return the edge of a curve with its interval, and status.

    The edge is that of `critical_wavelength`. The ends of its interval are cutoffs that were
    computed: the last one before any value within the intervals leaves the limits, and the first
    one at which all values have left. At the true edge the curve is at a limit, which its interval
    holds with the confidence asked for. Between two cutoffs nothing was computed, so that nothing
    but a curve that has no further crossing there is taken for granted, not a straight one.

    Parameters
    ----------
    curve : Curve
        With its interval.

    Returns
    -------
    dict
        ``edge``, ``edge_bound`` and ``edge_interval`` (2,) in nm, NaN where they are open;
        ``edge_at_least``, 1 where the edge is longer than its bound; ``edge_status``
        and ``interval_status`` (2,).
    """
    _, least, greatest = curve.values
    edge = _edge(curve)
    begins, ends = _first_outside(curve, greatest, least), _first_outside(curve, least, greatest)
    interval = np.array([_cutoff(curve, begins - 1), _cutoff(curve, ends) if ends else np.nan])
    if curve.side == "large":
        interval = interval[::-1]
    if np.isnan(curve.values).any():
        interval = np.full(2, np.nan)
    return {
        "edge": edge.wavelength,
        "edge_bound": edge.bound,
        "edge_at_least": int(edge.at_least),
        "edge_status": _status(edge, curve.cell),
        "edge_interval": interval,
        "interval_status": np.where(np.isfinite(interval), "found", "open"),
    }


def _first_outside(curve: Curve, above: np.ndarray, below: np.ndarray) -> int:
    """Return the place of the first cutoff beyond the limits, the number of cutoffs if none is.

    Beyond the upper limit count values of one row, beyond the lower one those of another.
    """
    lower, upper = curve.limits
    outside = np.flatnonzero((above > upper) | (below < lower))
    return int(outside[0]) if len(outside) else len(curve.cutoffs)


def _cutoff(curve: Curve, place: int) -> float:
    """Return a cutoff in nm, NaN beyond those computed."""
    return float(curve.cutoffs[place]) if 0 <= place < len(curve.cutoffs) else np.nan


def _edge(curve: Curve) -> Edge:
    """Return where the curve as computed leaves its limits, or that it is open."""
    small, value = curve.side == "small", curve.values[0]
    first = _first_outside(curve, value, value)
    if first == 0:
        return Edge(np.nan, float(curve.cutoffs[0]), not small)
    if first == len(curve.cutoffs):
        return Edge(np.nan, float(curve.cutoffs[-1]), small)
    return Edge(critical_wavelength(curve.cutoffs, value, curve.limits), np.nan, False)


def _status(edge: Edge, cell: float) -> str:
    """Return whether an edge was found, or what it lies beyond.

    Cutoffs between cell/sqrt(2) and the cell all act on its longest waves alone: beyond a bound
    there, no other cutoff could tell more.
    """
    if np.isfinite(edge.wavelength):
        return "found"
    at_end = edge.at_least and edge.bound > cell / np.sqrt(2)
    return "beyond the cell" if at_end else "beyond the cutoffs"
