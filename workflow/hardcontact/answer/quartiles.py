"""What the quartiles of a described spectrum say of its surface, besides its realizations.

A surface with the id `x` is described by a median if surfaces `x_lower` and `x_upper` stand beside
it, described by both quartiles of the same source. How far these lie apart is how far measurements
of one surface differ between laboratories, which no number of realizations shows.
"""

import numpy as np
import xarray as xr

from hardcontact.answer.datasets import Datasets
from hardcontact.answer.force_curve import at_range
from hardcontact.answer.quantities import print_length, print_quantity

__all__ = ["over_quartiles", "quartile_sentences", "surfaces_with_quartiles"]

ENDINGS = ("_lower", "_upper")


def surfaces_with_quartiles(given: Datasets) -> dict[str, list[str]]:
    """Return, by surface, itself and both quartiles; only substitutes have quartiles."""
    ids = given.topography["surface"].values[given.topography["basis"].values == "substitute"]
    known = set(map(str, ids))
    groups = {name: [name, *(name + ending for ending in ENDINGS)] for name in map(str, ids)}
    return {name: group for name, group in groups.items() if known.issuperset(group)}


def over_quartiles(values: xr.DataArray, intervals: xr.DataArray) -> tuple[float, float]:
    """Return the least and the greatest of values (surface) and intervals (surface, bound)."""
    every = np.append(values.values.ravel(), intervals.values.ravel())
    return float(np.nanmin(every)), float(np.nanmax(every))


def quartile_sentences(given: Datasets) -> list[str]:
    """Return a sentence for each surface with quartiles: the span of its edges and its force.

    Parameters
    ----------
    given : Datasets
        Of the study.

    Returns
    -------
    list of str
        Plain text; empty without quartiles.
    """
    labels = given.labels()
    return [
        f"{labels[name]}, over the quartiles of its source and the realizations of each: the short "
        f"edge of the band {_edge(given.edges.sel(surface=group), 'small')}, the long edge "
        f"{_edge(given.edges.sel(surface=group), 'large')}, the mean force "
        f"{_force(given.force.sel(surface=group))}."
        for name, group in surfaces_with_quartiles(given).items()
    ]


def _edge(edges: xr.Dataset, side: str) -> str:
    """Return the span of the edges at one side, and how many of them were not found."""
    of_side = edges.sel(side=side)
    known = of_side["edge"].fillna(of_side["edge_bound"])
    low, high = map(print_length, over_quartiles(known, of_side["edge_interval"]))
    opened = int((of_side["edge_status"] != "found").sum())
    count = of_side.sizes["surface"]
    beyond = f" ({opened} of {count} edges are open: beyond what was computed)" if opened else ""
    return f"from {low} to {high}{beyond}"


def _force(force: xr.Dataset) -> str:
    here = at_range(force)
    low, high = over_quartiles(here["force"], here["force_interval"])
    return f"from {print_quantity(low, 'N')} to {print_quantity(high, 'N')}"
