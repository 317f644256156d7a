"""The edges of the band of the user's surfaces, with intervals from parts of scans.

The user's masters share few scans. In the paper's study each has its own (`edges_of_masters`).
"""

from operator import truediv

import numpy as np
import xarray as xr

from hardcontact.base.statistics import as_variables, widen_interval
from hardcontact.base.units import DIMENSIONLESS
from hardcontact.inference.edges import CUTOFF, edges_of_ratios, remove_rippled_edges
from hardcontact.inference.mean_forces import (
    MasterForces,
    MasterScans,
    half_width_over_masters,
    logarithmic_interval,
    summarize_masters,
)


def edges_of_scans(
    forces: xr.Dataset,
    hindcast: xr.Dataset | None,
    master_scans: MasterScans,
    tolerance: float,
    confidence: float,
) -> xr.Dataset:
    """Return the edges of the band of every surface and the force ratios, with intervals.

    `forces` is filtered_forces.nc, `hindcast` hindcast.nc, or None if all surfaces are substitutes.
    """
    ratios = summarize_masters(
        forces, master_scans, lambda masters: _ratios_of_masters(masters, confidence)
    )
    if hindcast is not None:
        ratios = _widen_ratios(ratios, hindcast["hindcast_ratio"])
    edges = edges_of_ratios(ratios, tolerance)
    if hindcast is not None:
        # Masters may hide ripples, because artificial roughness lowers their forces.
        scan_ratio = hindcast["filtered_scan_ratio"].reindex(surface=edges["surface"])
        are_rippled = (edges["side"] == "short") & (scan_ratio < 1 - tolerance)
        edges = remove_rippled_edges(edges, are_rippled).transpose("surface", "side", ...)
    interval_source = ratios["interval_source"].isel(side=0, drop=True)
    return edges.merge(ratios.assign(interval_source=interval_source))


def _ratios_of_masters(master_forces: MasterForces, confidence: float) -> xr.Dataset:
    """Return the force ratios of one surface and side, with intervals and their source."""
    half_width = half_width_over_masters(master_forces, truediv, "log_ratio_shift", confidence)
    ratio = master_forces.forces.filtered_force_ratio.mean("realization").values
    interval = logarithmic_interval(ratio, half_width)
    return xr.Dataset(
        as_variables("filtered_force_ratio", CUTOFF, ratio, interval, DIMENSIONLESS, confidence)
        | {"interval_source": master_forces.scan_parts.interval_source},
        {CUTOFF: master_forces.forces[CUTOFF].variable},
    )


def _widen_ratios(ratios: xr.Dataset, hindcast_ratio: xr.DataArray) -> xr.Dataset:
    """Return ratios whose intervals contain the error of artificial roughness."""
    # Where the filter changes nothing, there is no error.
    log_error = abs(np.log(hindcast_ratio.reindex(surface=ratios["surface"]).fillna(1)))
    log_ratio = abs(np.log(ratios["filtered_force_ratio"]))
    return widen_interval(ratios, "filtered_force_ratio", np.exp(np.minimum(log_error, log_ratio)))
