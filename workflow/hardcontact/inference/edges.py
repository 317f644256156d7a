"""The edges of the critical band: the cutoffs at which the change of the force exceeds a tolerance.

`paper.edges_of_masters` finds the edges of substitutes, whose masters are independent, and
`own.edges_of_scans` those of the user's surfaces, whose masters share few scans.
"""

from collections.abc import Hashable, Sequence
from enum import StrEnum
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.units import NM

#: The group of all surfaces.
MEAN_GROUP = "mean"


class ChangeCurve(NamedTuple):
    """The change of the force with the cutoff on one side; it is zero without a filter."""

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


def computed_cutoffs(values: xr.DataArray) -> Floats:
    """Return the ascending cutoffs (nm) at which any value (..., cutoff_wavelength) is finite."""
    dimensions = [dim for dim in values.dims if dim != "cutoff_wavelength"]
    cutoffs = values["cutoff_wavelength"].values[values.notnull().any(dimensions).values]
    return np.sort(cutoffs)


def last_cutoff(values: xr.DataArray, side: str) -> float:
    """Return the cutoff (nm) of a side, "short" or "long", that removes most of the roughness.

    The values (..., cutoff_wavelength) of this side are NaN at the cutoffs of the other side.
    """
    return float(computed_cutoffs(values)[-1 if side == "short" else 0])


def edges_or_bounds(edges: xr.Dataset) -> xr.DataArray:
    """Return the edges (..., side, group) in nm, with their bounds in place of open edges."""
    return edges["edge"].fillna(edges["edge_bound"])


def mean_band(edges: xr.Dataset) -> tuple[float, float]:
    """Return both edges (nm) of the mean change over all surfaces, or their bounds."""
    mean_edges = edges_or_bounds(edges).sel(group=MEAN_GROUP)
    return float(mean_edges.sel(side="short")), float(mean_edges.sel(side="long"))


def labelled_edges(
    edges: xr.Dataset, scales: xr.Dataset, tolerance: float, confidence: float
) -> xr.Dataset:
    """Return edges.nc: edges with label and source of each surface, and settings of the study."""
    return edges.assign(label=scales["label"], source=scales["source"]).assign_attrs(
        tolerance=tolerance,
        confidence=confidence,
        rho=scales.attrs["rho"],
        sphere_radius=scales.attrs["sphere_radius"],
    )


def edge_variables(
    edges: Sequence[Edge], dimensions: Sequence[Hashable], shape: Sequence[int]
) -> dict[str, Any]:
    """Return ``edge``, ``edge_bound`` and ``edge_status`` as variables of this shape."""
    values, bounds, statuses = (np.reshape(column, shape) for column in zip(*edges, strict=True))
    return {
        "edge": (dimensions, values, NM),
        "edge_bound": (dimensions, bounds, NM),
        "edge_status": (dimensions, statuses),
    }
