"""What the quartiles of a described spectrum say of its surface, besides its realizations.

A surface with the id `x` is described by a median if surfaces `x_lower` and `x_upper` stand beside
it, described by both quartiles of the same source. How far these lie apart is how far measurements
of one surface differ between laboratories, which no number of realizations shows.
"""

import numpy as np
import xarray as xr

from hardcontact.answer.datasets import Datasets, at_range
from hardcontact.numbers.printing import print_length, print_quantity

ENDINGS = ("_lower", "_upper")


def surfaces_with_quartiles(given: Datasets) -> dict[str, list[str]]:
    """Return, by surface, itself and both quartiles; only substitutes have quartiles."""
    ids = given.topography["surface"].values[given.topography["basis"].values == "substitute"]
    known = set(map(str, ids))
    groups = {name: [name, *(name + ending for ending in ENDINGS)] for name in map(str, ids)}
    return {name: group for name, group in groups.items() if known.issuperset(group)}


def over_quartiles(values: xr.DataArray) -> tuple[float, float]:
    """Return the least and the greatest of values of any dimensions, NaN where none is known."""
    known = values.values[np.isfinite(values.values)]
    return (float(known.min()), float(known.max())) if known.size else (np.nan, np.nan)


def quartile_sentences(given: Datasets) -> list[str]:
    """Return a sentence for each surface with quartiles: its edges, its force and their spans."""
    labels = given.labels()
    return [
        f"{labels[name]}, with the span over the quartiles of its source and that of all their "
        f"intervals: short edge of the band {_edge(given.edges.sel(surface=group), 'small')}; "
        f"long edge {_edge(given.edges.sel(surface=group), 'large')}; "
        f"mean force {_force(given.force.sel(surface=group))}."
        for name, group in surfaces_with_quartiles(given).items()
    ]


def _edge(edges: xr.Dataset, side: str) -> str:
    """Return the edge of the first surface at one side, its span, and that of the intervals."""
    of_side = edges.sel(side=side)
    known = of_side["edge"].fillna(of_side["edge_bound"]).values
    texts = [
        _open(str(text), status != "found") + print_length(value)
        for value, text, status in zip(
            known, of_side["edge_text"].values, of_side["edge_status"].values, strict=True
        )
    ]
    least, most = texts[int(np.nanargmin(known))], texts[int(np.nanargmax(known))]
    return _with_spans(texts[0], least, most, of_side["edge_interval"], "nm")


def _open(text: str, is_open: bool) -> str:
    """Return the words before the bound of an open edge, as its own text has them."""
    return "" if not is_open else "at least " if text.startswith("at least") else "at most "


def _force(force: xr.Dataset) -> str:
    here = at_range(force)
    values = here["force"]
    least, most = (print_quantity(end, "N") for end in over_quartiles(values))
    first = print_quantity(values.isel(surface=0).item(), "N")
    return _with_spans(first, least, most, here["force_interval"], "N")


def _with_spans(first: str, least: str, most: str, intervals: xr.DataArray, unit: str) -> str:
    """Return a value, the span of all, and that of their intervals (surface, bound).

    An end of the latter is bounded if that of every interval is: zero and infinity bound nothing.
    """
    span = f"{first} ({least} to {most}" if least != most else f"{first} (all three alike"
    known = intervals.where((intervals > 0) & np.isfinite(intervals))
    ends = known.transpose("surface", "bound").values
    low, high = ends[:, 0].min(), ends[:, 1].max()
    low_text, high_text = (print_quantity(float(end), unit) for end in (low, high))
    if np.isnan(low) and np.isnan(high):
        return f"{span}; intervals not bounded)"
    if np.isnan(low) or np.isnan(high):
        return f"{span}; {f'below {high_text}' if np.isnan(low) else f'above {low_text}'})"
    return f"{span}; {low_text} to {high_text})"
