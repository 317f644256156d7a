"""The edges of the band: the cutoffs at which the change of the force exceeds a tolerance.

The masters of substitutes are independent, those of the user's surfaces share few scans. Intervals
therefore come from `paper.edges_of_masters` or from `own.edges_of_scans`.
"""

from collections.abc import Hashable, Sequence
from enum import StrEnum
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats
from hardcontact.base.statistics import ENDS
from hardcontact.base.units import NM

#: The group of all surfaces.
MEAN_GROUP = "mean"


class ChangeCurve(NamedTuple):
    """The change of the force with the cutoff on one side; it is zero without a filter."""

    side: str  #: short: wavelengths below the cutoff are removed; long: wavelengths above it.
    cutoffs: Floats  #: (k,) in nm, by growing effect: ascending if short, descending if long.
    values: Floats  #: (k,) ln(ratio) for a single surface, the mean of |ratio - 1| for several.
    limits: tuple[float, float]  #: Lower and upper limit; a change within them does not count.


class EdgeStatus(StrEnum):
    """Whether a curve has an edge."""

    FOUND = "found"
    OPEN_ABOVE = "open_above"  #: The edge is longer than its bound.
    OPEN_BELOW = "open_below"  #: The edge is shorter than its bound.
    RIPPLES = "ripples"  #: No edge: ripples of the filter, not the roughness, change the force.
    NO_EDGE = "none"  #: No cutoff changes the force in closed form by the tolerance.


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

    Cutoffs are sorted; those with NaN in the first row are left out. If `spectrum_end` is known,
    the wavelength (nm) that removes nothing, all rows begin there with zero.
    """
    computed_columns = np.flatnonzero(np.isfinite(values[0]))
    order = computed_columns[np.argsort(cutoffs[computed_columns])]
    if side == "long":
        order = order[::-1]
    cutoffs, values = cutoffs[order], values[:, order]
    if spectrum_end is not None:
        cutoffs = np.append(spectrum_end, cutoffs)
        values = np.pad(values, ((0, 0), (1, 0)))
    return ChangeCurve(side, cutoffs, values[0], limits), values[1:]


def logarithmic_limits(tolerance: float) -> tuple[float, float]:
    """Return both limits of ln(ratio) for a relative change of the force, such as 0.1."""
    return float(np.log1p(-tolerance)), float(np.log1p(tolerance))


def _first_true(mask: NDArray[np.bool_]) -> int:
    """Return the index of the first True of a mask (k,), or k if all are False."""
    return int(mask.argmax()) if mask.any() else len(mask)


def _first_outside(values: Floats, limits: tuple[float, float]) -> int:
    """Return the index of the first value (k,) outside the limits, or k if all are within."""
    lower, upper = limits
    return _first_true((values < lower) | (values > upper))


def interpolate_edge(cutoffs: Floats, values: Floats, limits: tuple[float, float]) -> float:
    """Return the cutoff (nm) at which the values (k,) of a curve first leave its limits.

    They are linear in the logarithm of the cutoff. NaN if no value or the first one is outside.
    """
    crossing = _first_outside(values, limits)
    if crossing in (0, len(values)):
        return np.nan
    lower, upper = limits
    limit = upper if values[crossing] > upper else lower
    share = (limit - values[crossing - 1]) / (values[crossing] - values[crossing - 1])
    step = np.log(cutoffs[crossing] / cutoffs[crossing - 1])
    return float(np.exp(np.log(cutoffs[crossing - 1]) + share * step))


def find_edge(curve: ChangeCurve) -> Edge:
    """Return the edge of a curve, open if no value or the first one is outside the limits."""
    edge = interpolate_edge(curve.cutoffs, curve.values, curve.limits)
    if np.isfinite(edge):
        return Edge(edge, np.nan, EdgeStatus.FOUND)
    is_outside_at_once = _first_outside(curve.values, curve.limits) == 0
    bound = float(curve.cutoffs[0 if is_outside_at_once else -1])
    # The first cutoff of a short side is its shortest, the first of a long side its longest.
    is_open_below = is_outside_at_once == (curve.side == "short")
    return Edge(np.nan, bound, EdgeStatus.OPEN_BELOW if is_open_below else EdgeStatus.OPEN_ABOVE)


def shows_ripples(curve: ChangeCurve) -> bool:
    """Return whether a curve of ln(ratio) shows the ripples of the filter, not the roughness.

    Without its short waves a random surface has lower summits, so that the force rises. If it falls
    first, the filter has made higher summits: ripples near steps.
    """
    crossing = _first_outside(curve.values, curve.limits)
    value_outside = curve.values[crossing : crossing + 1]  # empty if the curve never leaves them
    return curve.side == "short" and bool((value_outside < 0).any())


def edge_interval(curve: ChangeCurve, lowest: Floats, highest: Floats) -> Floats:
    """Return the cutoffs (2,) in nm between which the edge lies, from the intervals of a curve.

    `lowest` and `highest` (k,) are the ends of the intervals of its values. The edge lies between
    the last cutoff before an interval reaches beyond the limits, and the first cutoff with an
    interval wholly outside. NaN for an end beyond the cutoffs, or without intervals.
    """
    if np.isnan([lowest, highest]).any():
        return np.full(2, np.nan)
    bounds = np.concatenate([[np.nan], curve.cutoffs, [np.nan]])
    lower, upper = curve.limits
    possibly_outside = _first_true((lowest < lower) | (highest > upper))
    surely_outside = _first_true((highest < lower) | (lowest > upper))
    interval = np.array(
        [bounds[possibly_outside], bounds[surely_outside + 1] if surely_outside else np.nan]
    )
    return interval if curve.side == "short" else interval[::-1]


def edges_of_curves(ratios: xr.Dataset, tolerance: float) -> xr.Dataset:
    """Return the edges of several curves of force ratios, with their bounds and intervals in nm.

    ``filtered_force_ratio`` (..., cutoff_wavelength), with its coordinate ``side``, may have an
    interval, and is NaN at cutoffs that a curve does not have. Open edges and ends are NaN.
    """
    dimensions = [dim for dim in ratios["filtered_force_ratio"].dims if dim != "cutoff_wavelength"]
    shape = [ratios.sizes[dim] for dim in dimensions]
    edges = []
    intervals = []  # A curve with ripples has neither edge nor interval.
    for index in np.ndindex(*shape):
        curve, (lowest, highest) = _curve_with_interval(
            ratios.isel(dict(zip(dimensions, index, strict=True))), tolerance
        )
        if shows_ripples(curve):
            edges.append(Edge(np.nan, np.nan, EdgeStatus.RIPPLES))
            intervals.append(np.full(2, np.nan))
        else:
            edges.append(find_edge(curve))
            intervals.append(edge_interval(curve, lowest, highest))
    variables = edge_variables(edges, dimensions, shape)
    variables["edge_interval"] = ((*dimensions, "end"), np.reshape(intervals, (*shape, 2)), NM)
    return xr.Dataset(variables, {dim: ratios[dim] for dim in dimensions} | {"end": ENDS})


def _curve_with_interval(ratios: xr.Dataset, tolerance: float) -> tuple[ChangeCurve, np.ndarray]:
    """Return one curve with the low and the high ends (2, k) of the intervals of its values."""
    ratio = ratios["filtered_force_ratio"].values
    unknown = np.full((len(ratio), 2), np.nan)
    interval = np.asarray(ratios.get("filtered_force_ratio_interval", unknown))
    if not np.isnan(interval).all():
        # If only some ratios have no interval, they are equal in all parts: zero width.
        interval = np.where(np.isnan(interval), ratio[:, None], interval)
    with np.errstate(divide="ignore"):  # the lower end of an interval without bounds is zero
        log_ratios = np.log([ratio, *interval.T])
    cutoffs = ratios["cutoff_wavelength"].values
    limits = logarithmic_limits(tolerance)
    return ordered_curve(str(ratios["side"].item()), cutoffs, log_ratios, limits)


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


def computed_cutoffs(values: xr.DataArray) -> Floats:
    """Return the ascending cutoffs (nm) at which any value (..., cutoff_wavelength) is finite."""
    dimensions = [dim for dim in values.dims if dim != "cutoff_wavelength"]
    return np.sort(values["cutoff_wavelength"].values[values.notnull().any(dimensions).values])


def last_cutoff(values: xr.DataArray, side: str) -> float:
    """Return the cutoff (nm) of a side, "short" or "long", that removes most of the roughness."""
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
