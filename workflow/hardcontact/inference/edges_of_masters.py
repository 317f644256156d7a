"""Edges of the band of substitutes: edges.nc.

Each master of a substitute has a scan of its own, so that samples of the mean over masters give the
scatter of an edge. The user's masters share scans (`edges_of_scans`). The group `mean` has the edge
of the change averaged over coatings, because the paper has one band for all coatings.
"""

from typing import Any

import numpy as np
import xarray as xr

from hardcontact.base.statistics import Sampling
from hardcontact.base.units import DIMENSIONLESS, NM
from hardcontact.inference.edges import (
    CUTOFF,
    MEAN_GROUP,
    edges_or_bounds,
    find_edges,
    logarithmic_limits,
)


def edges_of_masters(
    forces: xr.Dataset, tolerance: float, sampling: Sampling
) -> tuple[xr.Dataset, xr.DataArray]:
    """Return ratios and changes of the force with their edges, and sampled edges.

    Ratios are (..., side, surface, cutoff_wavelength), changes (..., side, group,
    cutoff_wavelength), edges (..., side, group). `forces` has ``filtered_force_ratio`` (...,
    surface, realization, side, cutoff_wavelength), with the number of a master as realization, and
    ``spectrum_end`` (surface, side) in nm. Sampled edges are (1 + sample, ..., side, group). The
    first is the edge itself, NaN if it is open. In the others the bound replaces an open edge.
    """
    # The word "scales" is a part of the seed: another word would give other samples.
    ratios = sampling.sample_means("scales", forces["filtered_force_ratio"], "realization")
    ratios = ratios.transpose("sample", ..., "side", "surface", CUTOFF)
    group_ratios = ratios.rename(surface="group")
    changes = abs(group_ratios - 1)
    # The mean over surfaces is that of |ratio - 1|, because signs would cancel.
    mean_change = changes.mean("group", skipna=False).expand_dims(group=[MEAN_GROUP], axis=-2)
    spectrum_ends = forces["spectrum_end"].rename(surface="group")
    group_edges = [
        find_edges(xr.ufuncs.log(group_ratios), logarithmic_limits(tolerance), spectrum_ends),
        find_edges(mean_change, (-np.inf, tolerance), spectrum_ends.mean("group")),
    ]
    edges = xr.concat(group_edges, "group")
    sampled_edges = edges["edge"].where(edges["sample"] == 0, edges_or_bounds(edges))
    variables: dict[str, Any] = {}
    for name, values, attributes in (
        ("edge", sampled_edges, NM),
        ("filtered_force_change", xr.concat([changes, mean_change], "group"), DIMENSIONLESS),
        ("filtered_force_ratio", ratios, DIMENSIONLESS),
    ):
        dimensions = [str(dim) for dim in values.dims[1:]]
        variables |= sampling.sampled_variables(name, dimensions, values.values, attributes)
    result = edges.isel(sample=0, drop=True).assign_coords(ratios.coords).assign(variables)
    return result, sampled_edges
