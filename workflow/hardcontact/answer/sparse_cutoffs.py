"""Edges that were found between cutoffs far apart: how sure they are in another way, in words."""

import numpy as np
import xarray as xr

from hardcontact.answer.quantities import print_length
from hardcontact.figures.style import print_share
from hardcontact.scales.cutoffs import computed_cutoffs

__all__ = ["EDGES", "sparse_cutoffs"]

#: Neighbouring cutoffs of a larger ratio leave edges between them uncertain: forces change as much.
SPARSE = 2.0

EDGES = {"small": "The short edge of the band", "large": "The long edge of the band"}


def sparse_cutoffs(edges: xr.Dataset) -> list[str]:
    """Return which edges of a surface were found between cutoffs that lie far apart.

    Parameters
    ----------
    edges : xarray.Dataset
        Part of edges.nc of the surface.

    Returns
    -------
    list of str
        A sentence or two each: the cutoffs beside an edge, and what its interval is.
    """
    texts = []
    for side in EDGES:
        shorter, longer = _neighbours(edges.sel(side=side))
        if longer > SPARSE * shorter:
            texts.append(
                f"{EDGES[side]} is read off between the two cutoffs computed beside it, "
                f"{print_length(shorter)} and {print_length(longer)}; where between them it lies "
                f"is interpolated.{_interval(edges.sel(side=side))}"
            )
    return texts


def _interval(of_side: xr.Dataset) -> str:
    """Return what the interval of an edge is, if it has one: not the cutoffs beside it."""
    ends = of_side["edge_interval"].values
    if not np.isfinite(ends).any():
        return ""
    low, high = (print_length(end) if np.isfinite(end) else "an open end" for end in ends)
    return (
        f" Its {print_share(of_side.attrs['confidence'])} interval is another thing: from {low} "
        f"to {high}, as far as the scatter of forces may move it."
    )


def _neighbours(of_side: xr.Dataset) -> tuple[float, float]:
    """Return the cutoffs (nm) between which the edge of one side was found, NaN of an open one."""
    edge = of_side["edge"].item()
    known = computed_cutoffs(of_side["scale_ratio"])
    if np.isnan(edge):
        return np.nan, np.nan
    return float(known[known <= edge].max()), float(known[known >= edge].min())
