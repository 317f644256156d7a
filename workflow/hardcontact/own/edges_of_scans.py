"""The edges of the band of the user's surfaces, whose masters share few scans.

Real roughness goes on beyond the wavelengths of the scans, so an edge beyond the computed cutoffs
is open. Intervals come from parts of the scans, because scans are few: `paper.edges_of_masters` has
other scans for each master.
"""

from operator import truediv

import numpy as np
import xarray as xr

from hardcontact.base.statistics import widen_interval, with_interval
from hardcontact.base.units import DIMENSIONLESS
from hardcontact.inference.edges import EdgeStatus, edges_of_curves
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
    zero to infinity if it is not bounded. The error of the hindcast widens the intervals of
    measured surfaces.
    """
    curves = summarize_masters(
        scales, master_scans, lambda forces: _ratios_of_masters(forces, confidence)
    )
    if hindcast is not None:
        curves = _widen_ratios(curves, hindcast["hindcast_ratio"])
    edges = edges_of_curves(curves, tolerance)
    if hindcast is not None:
        edges = _without_rippled_edges(edges, hindcast["filtered_scan_ratio"], tolerance)
    interval_source = curves["interval_source"].isel(side=0, drop=True)
    return edges.merge(curves.assign(interval_source=interval_source))


def _ratios_of_masters(master_forces: MasterForces, confidence: float) -> xr.Dataset:
    """Return the force ratios of one surface and side, with intervals and their source."""
    half_width = half_width_over_masters(master_forces, truediv, "log_ratio_shift", confidence)
    ratio = master_forces.forces.filtered_force_ratio.mean("realization").values
    interval = logarithmic_interval(ratio, half_width)
    axis = "cutoff_wavelength"
    return xr.Dataset(
        with_interval("filtered_force_ratio", axis, ratio, interval, DIMENSIONLESS, confidence)
        | {"interval_source": master_forces.scan_parts.interval_source},
        {axis: master_forces.forces[axis].variable},
    )


def _widen_ratios(curves: xr.Dataset, hindcast_ratio: xr.DataArray) -> xr.Dataset:
    """Return ratios whose intervals contain the error of artificial roughness (surface, side).

    The error in the logarithm of a ratio is at most this logarithm: where the filter changes
    nothing, the ratio is one and has no error.
    """
    log_error = abs(np.log(hindcast_ratio.reindex(surface=curves["surface"]).fillna(1)))
    log_ratio = abs(np.log(curves["filtered_force_ratio"]))
    return widen_interval(curves, "filtered_force_ratio", np.exp(np.minimum(log_error, log_ratio)))


def _without_rippled_edges(
    edges: xr.Dataset, filtered_scan_ratio: xr.DataArray, tolerance: float
) -> xr.Dataset:
    """Return edges without the short edges of surfaces on which the filter makes ripples.

    Forces on masters may not show ripples (`shows_ripples`), because artificial roughness lowers
    them. `filtered_scan_ratio` is the force on the filtered scan relative to that on the scan.
    """
    ratio = filtered_scan_ratio.reindex(surface=edges["surface"])
    is_kept = ~(ratio < 1 - tolerance) | (edges["side"] != "short")
    status = edges["edge_status"].where(is_kept, EdgeStatus.RIPPLES)
    return edges.where(is_kept).assign(edge_status=status).transpose("surface", "side", ...)
