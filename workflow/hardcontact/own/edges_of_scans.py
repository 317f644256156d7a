"""The edges of the critical band of the user's surfaces, whose masters share few scans.

Real roughness goes on beyond the wavelengths of the scans, so an edge beyond the computed cutoffs
is open. Intervals come from parts of the scans, because scans are few.
"""

from operator import truediv

import numpy as np
import xarray as xr

from hardcontact.base.statistics import ENDS, widen_interval, with_interval
from hardcontact.base.units import DIMENSIONLESS, NM
from hardcontact.inference.edges import (
    ChangeCurve,
    Edge,
    EdgeStatus,
    edge_interval,
    edge_variables,
    find_edge,
    logarithmic_limits,
    ordered_curve,
    shows_ripples,
)
from hardcontact.own.mean_forces import (
    MasterForces,
    MasterScans,
    half_width_over_masters,
    logarithmic_interval,
    summarize_masters,
)


def edges_of_scans(
    scales: xr.Dataset,
    hindcast: xr.Dataset | None,
    master_scans: MasterScans,
    tolerance: float,
    confidence: float,
) -> xr.Dataset:
    """Return the edges of the band of every surface, with intervals from scans or their parts.

    `scales` are the forces on filtered masters, as in scales.nc. An interval of a ratio runs from
    zero to infinity if it is not bounded; ``interval_is_conditional`` is 1 if it is conditional on
    one or two scans. The error of the hindcast widens the intervals of measured surfaces.
    """
    curves = summarize_masters(
        scales, master_scans, lambda forces: _force_ratios(forces, confidence)
    )
    if hindcast is not None:
        curves = _widen_ratios(curves, hindcast["hindcast_ratio"])
    edges = edges_of_curves(curves, tolerance)
    if hindcast is not None:
        edges = _without_ripples(edges, hindcast["filtered_scan_ratio"] < 1 - tolerance)
    curves = curves.transpose("surface", "side", ...)
    descriptions = curves[["interval_is_conditional", "interval_source", "interval_scans"]]
    return (
        curves[["filtered_force_ratio", "filtered_force_ratio_interval"]]
        .merge(descriptions.isel(side=0, drop=True))
        .merge(edges)
    )


def _force_ratios(master_forces: MasterForces, confidence: float) -> xr.Dataset:
    """Return the force ratios of one surface and side, with intervals and their source."""
    half = half_width_over_masters(master_forces, truediv, "log_ratio_shift", confidence)
    ratio = master_forces.forces.filtered_force_ratio.mean("realization").values
    interval = logarithmic_interval(ratio, half)
    axis = "cutoff_wavelength"
    return xr.Dataset(
        with_interval("filtered_force_ratio", axis, ratio, interval, DIMENSIONLESS, confidence)
        | {
            "interval_is_conditional": int(master_forces.scan_parts.are_quarters),
            "interval_source": master_forces.scan_parts.interval_source,
            "interval_scans": master_forces.scan_parts.scan_count,
        },
        {axis: master_forces.forces[axis].variable},
    )


def _widen_ratios(curves: xr.Dataset, hindcast_ratio: xr.DataArray) -> xr.Dataset:
    """Return ratios whose intervals contain the error of artificial roughness (surface, side).

    The error in the logarithm of a ratio is at most this logarithm, so that a ratio of one, where
    the filter changes nothing, has no error.
    """
    log_error = abs(np.log(hindcast_ratio.reindex(surface=curves["surface"]).fillna(1)))
    log_ratio = abs(np.log(curves["filtered_force_ratio"]))
    return widen_interval(curves, "filtered_force_ratio", np.exp(np.minimum(log_error, log_ratio)))


def _without_ripples(edges: xr.Dataset, has_ripples: xr.DataArray) -> xr.Dataset:
    """Return edges without the short edges of surfaces on which the filter makes ripples.

    Ripples are where removing short wavelengths lowers the force: less roughness should raise it.
    """
    is_rippled = has_ripples.reindex(surface=edges["surface"], fill_value=False)
    is_kept = ~is_rippled | (edges["side"] != "short")
    status = edges["edge_status"].where(is_kept, EdgeStatus.RIPPLES)
    return edges.where(is_kept).assign(edge_status=status).transpose("surface", "side", ...)


def edges_of_curves(ratios: xr.Dataset, tolerance: float) -> xr.Dataset:
    """Return the edges of several curves of force ratios, with their bounds and intervals in nm.

    ``filtered_force_ratio`` (..., cutoff_wavelength) may have an interval, and is NaN at cutoffs
    that a curve does not have; ``side`` is a coordinate. ``edge``, ``edge_bound`` and
    ``edge_interval`` are NaN if they are open; ``edge_status`` is as in `Edge`.
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
    interval = np.reshape(intervals, (*shape, 2))
    variables["edge_interval"] = ((*dimensions, "end"), interval, NM)
    return xr.Dataset(variables, {dim: ratios[dim] for dim in dimensions} | {"end": ENDS})


def _curve_with_interval(ratios: xr.Dataset, tolerance: float) -> tuple[ChangeCurve, np.ndarray]:
    """Return one curve with the low and the high ends (2, k) of the intervals of its values."""
    ratio = ratios["filtered_force_ratio"].values
    unknown = np.full((len(ratio), 2), np.nan)
    interval = np.asarray(ratios.get("filtered_force_ratio_interval", unknown))
    if not np.isnan(interval).all():
        # If other ratios have intervals, a ratio without one is equal in all parts: zero width.
        interval = np.where(np.isnan(interval), ratio[:, None], interval)
    with np.errstate(divide="ignore"):  # the lower end of an interval without bounds is zero
        log_ratios = np.log([ratio, *interval.T])
    return ordered_curve(
        str(ratios["side"].item()),
        ratios["cutoff_wavelength"].values,
        log_ratios,
        logarithmic_limits(tolerance),
    )
