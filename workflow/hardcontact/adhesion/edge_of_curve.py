"""Where a curve of changes of the force leaves its tolerance: found, or open with a bound.

An edge is found between two cutoffs that were computed. Where the curve has left before the first
one, or does not leave up to the last, the edge is open, and a bound is all that is known.
"""

from typing import Any, NamedTuple

import numpy as np

from hardcontact.adhesion.critical_band import critical_wavelength

__all__ = ["SIDES", "Curve", "Edge", "described_edge", "edge_of_curve"]

SIDES = ["small", "large"]


class Curve(NamedTuple):
    """Changes |ratio - 1| of the force on one side, from no filter on.

    Attributes
    ----------
    side : str
        small: wavelengths below the cutoff are removed; large: those above.
    cell : float
        Longest wavelength of the filtered surfaces in nm.
    cutoffs : numpy.ndarray
        (k,) nm, in the order of growing effect: growing on the small side, falling on the large.
    changes : numpy.ndarray
        (3, k): as computed, the least and the greatest within the interval; the latter NaN where
        there is no interval.
    """

    side: str
    cell: float
    cutoffs: np.ndarray
    changes: np.ndarray


class Edge(NamedTuple):
    """Where a curve leaves its tolerance.

    Attributes
    ----------
    wavelength : float
        In nm, between two cutoffs; NaN of an open edge.
    bound : float
        In nm, what is known of an open edge; NaN of one that is found.
    at_least : bool
        Whether the bound is one from below.
    """

    wavelength: float
    bound: float
    at_least: bool


def edge_of_curve(curve: Curve, changes: np.ndarray, tolerance: float) -> Edge:
    """Return the edge of one row of changes of a curve.

    Parameters
    ----------
    curve : Curve
        Its side and cutoffs.
    changes : numpy.ndarray
        (k,) changes of the force.
    tolerance : float
        The change that counts.

    Returns
    -------
    Edge
        Found by `critical_wavelength`, or open.
    """
    small = curve.side == "small"
    if changes[0] > tolerance:
        return Edge(np.nan, float(curve.cutoffs[0]), not small)
    found = critical_wavelength(curve.cutoffs, changes, tolerance)
    if np.isnan(found):
        return Edge(np.nan, float(curve.cutoffs[-1]), small)
    return Edge(found, np.nan, small)


def described_edge(curve: Curve, tolerance: float) -> dict[str, Any]:
    """Return the edge of a curve with its interval, status and text.

    The interval holds the wavelengths at which the tolerance lies within the interval of the
    change: it begins where the greatest change leaves the tolerance, and ends where the least one
    does. At the true edge the change is the tolerance, which its interval holds with the confidence
    asked for.

    Parameters
    ----------
    curve : Curve
        With its interval.
    tolerance : float
        The change that counts.

    Returns
    -------
    dict
        ``edge``, ``edge_bound`` and ``edge_interval`` (2,) in nm, NaN where they are open;
        ``edge_status``, ``interval_status`` (2,) and ``edge_text``.
    """
    edge, late, early = (edge_of_curve(curve, row, tolerance) for row in curve.changes)
    ends = [early, late] if curve.side == "small" else [late, early]
    interval = np.array([end.wavelength for end in ends])
    status, reason = _status(edge, curve.cell)
    known = not np.isnan(curve.changes).any() and interval[0] != interval[1]
    if reason and not np.isfinite(interval).any():  # which says no more than that it is open
        known = False
    if not known:
        interval[:] = np.nan
    return {
        "edge": edge.wavelength,
        "edge_bound": edge.bound,
        "edge_status": status,
        "edge_interval": interval,
        "interval_status": np.where(np.isfinite(interval), "found", "open"),
        "edge_text": _text(edge, interval, reason, known),
    }


def _status(edge: Edge, cell: float) -> tuple[str, str]:
    """Return the status of an edge, and of an open one the reason in words.

    Cutoffs between cell/sqrt(2) and the cell all act on its longest waves alone: beyond a bound
    there, no other cutoff could tell more.
    """
    if np.isfinite(edge.wavelength):
        return "found", ""
    if not edge.at_least:
        return "beyond the cutoffs", "no shorter cutoff was computed"
    if edge.bound > cell / np.sqrt(2):
        return "beyond the cell", "the scans end here"
    return "beyond the cutoffs", "no longer cutoff was computed"


def _text(edge: Edge, interval: np.ndarray, reason: str, known: bool) -> str:
    """Return an edge and the ends of its interval, if that is known, in words and one unit."""
    value = edge.bound if reason else edge.wavelength
    unit, scale = ("µm", 1e3) if value >= 1e3 else ("nm", 1.0)
    number, low, high = _numbers(np.array([value, *interval]) / scale)
    text = f"{number} {unit}"
    if reason:
        text = f"at {'least' if edge.at_least else 'most'} {text}: {reason}"
    return f"{text} [{low}, {high}]" if known else f"{text}, no interval"


def _numbers(values: np.ndarray) -> list[str]:
    """Return numbers with as few digits, two or more, as tell them apart; NaN is open."""
    known = np.unique(values[np.isfinite(values)])
    for digits in range(2, 7):
        texts = [f"{float(f'{value:.{digits}g}'):.10g}" for value in values]
        if len({*texts} - {"nan"}) == len(known):
            break
    return ["open" if text == "nan" else text for text in texts]
