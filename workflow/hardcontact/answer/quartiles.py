"""What the quartiles of a described spectrum say of its surface, besides its realizations.

A surface with the id `x` is described by a median if surfaces `x_lower` and `x_upper` stand beside
it, described by both quartiles of the same source. How far these lie apart is how far measurements
of one surface differ between laboratories, which no number of realizations shows.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr

from hardcontact.answer.datasets import Datasets, at_range
from hardcontact.answer.facts import Fact, fact_of, known
from hardcontact.answer.surface_facts import EDGES, edge_fact

ENDINGS = ("_lower", "_upper")
#: What a span is called, by whether its low and its high end are known.
STATUS = {
    (True, True): "between", (True, False): "more_than", (False, True): "at_most",
    (False, False): "not_bounded",
}  # fmt: skip


class Span(NamedTuple):
    """A quantity of a surface and how far it differs over the quartiles of its source."""

    surface: str  #: Its label.
    fact: Fact  #: Of the median, without an interval.
    least: Fact  #: Of the median and both quartiles.
    most: Fact  #: The same.
    intervals: Fact  #: The span of all their intervals; an end is None if one of them is not known.


def surfaces_with_quartiles(given: Datasets) -> dict[str, list[str]]:
    """Return, by surface, itself and both quartiles; only substitutes have quartiles."""
    ids = given.topography["surface"].values[given.topography["basis"].values == "substitute"]
    known_ids = set(map(str, ids))
    groups = {name: [name, *(name + ending for ending in ENDINGS)] for name in map(str, ids)}
    return {name: group for name, group in groups.items() if known_ids.issuperset(group)}


def quartile_spans(given: Datasets) -> list[Span]:
    """Return the spans of both edges and of the force of each surface with quartiles."""
    labels, spans = given.labels(), []
    for name, group in surfaces_with_quartiles(given).items():
        edges = given.edges.sel(surface=group)
        for side, of_side in ((side, edges.sel(side=side)) for side in EDGES):
            facts = [edge_fact(of_side.sel(surface=one), EDGES[side], "computed") for one in group]
            spans.append(_span(labels[name], facts, of_side["edge_interval"]))
        here = at_range(given.force.sel(surface=group))
        forces = [fact_of(here.sel(surface=one), "force", "force_mean") for one in group]
        spans.append(_span(labels[name], forces, here["force_interval"]))
    return spans


def _span(label: str, facts: Sequence[Fact], intervals: xr.DataArray) -> Span:
    """Return the span of facts, and that of their intervals (surface, bound).

    An end of the latter is bounded if that of every interval is: zero and infinity bound nothing.
    """
    bare = [
        one._replace(low=None, high=None, status=one.status if "open" in one.status else "known")
        for one in facts
    ]
    ends = intervals.where((intervals > 0) & np.isfinite(intervals)).transpose("surface", "bound")
    low, high = known(ends.values[:, 0].min()), known(ends.values[:, 1].max())
    ends_known = (low is not None, high is not None)
    ordered = sorted(bare, key=lambda fact: fact.value or 0.0)
    span = Fact("intervals", None, facts[0].unit, low, high, STATUS[ends_known])
    return Span(label, bare[0], ordered[0], ordered[-1], span)
