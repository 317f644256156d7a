"""The critical band in edges.nc, whichever way its edges were found.

`paper.edges_of_masters` finds those of substitutes, whose masters are independent, and
`own.edges_of_scans` those of the user's surfaces, whose masters share few scans.
"""

from collections.abc import Hashable, Sequence
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.units import NM
from hardcontact.inference.curve_edges import Edge

#: The group of all surfaces.
MEAN_GROUP = "mean"


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
    """Return edges.nc: edges with the names of the surfaces and the settings that they hold for."""
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
    columns: dict[str, tuple[list[Any], dict[str, str]]] = {
        "edge": ([edge.value for edge in edges], NM),
        "edge_bound": ([edge.bound for edge in edges], NM),
        "edge_status": ([edge.status for edge in edges], {}),
    }
    return {
        name: (dimensions, np.reshape(values, shape), attributes)
        for name, (values, attributes) in columns.items()
    }
