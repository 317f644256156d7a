"""Open ends of the intervals of edges.

The computed cutoffs end within some intervals: such an end is the last cutoff, only a bound.
"""

from collections.abc import Sequence

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.inference.edges import last_cutoff

#: Claims about an edge, with its side.
EDGE_CLAIMS = {
    "short_edge_first": "short", "short_edge_mean": "short", "short_edge_mean_at_least": "short",
    "long_edge_first": "long", "long_edge_mean": "long", "long_edge_mean_at_most": "long",
}  # fmt: skip
#: End of the interval that may lie beyond the cutoffs, by the side of the edge.
OPEN_END = {"short": "high", "long": "low"}


def find_open_end(
    side: str, value: float, low: float, high: float, bands: Sequence[xr.Dataset]
) -> str:
    """Return the end of the interval of an edge (nm) that lies beyond the computed cutoffs.

    It is ``"low"``, ``"high"``, or ``""`` if both ends are within the cutoffs of the `bands`.
    """
    end = OPEN_END[side]
    limit = high if end == "high" else low
    last_cutoffs = np.array(
        [last_cutoff(band["filtered_force_change"].sel(side=side), side) for band in bands]
    )
    value_is_open = (value >= last_cutoffs if end == "high" else value <= last_cutoffs).any()
    is_open = np.isclose(limit, last_cutoffs).any() or (value_is_open and np.isclose(limit, value))
    return end if is_open else ""


def add_open_ends(claims: pd.DataFrame, bands: Sequence[xr.Dataset]) -> pd.DataFrame:
    """Add the column `open_end` to claims about edges; it is ``""`` for other claims.

    An edge beyond the cutoffs counts as the last cutoff. The sets have fewer cutoffs than the
    study, so that the edge of the study may lie beyond theirs. An interval that is stretched to
    such an edge is open there, too. The `bands`, edges.nc and sets.nc, give the cutoffs.
    """
    sides = claims["id"].map(EDGE_CLAIMS)
    rows = zip(sides, claims["computed"], claims["low"], claims["high"], strict=True)
    ends = [find_open_end(*row, bands) if isinstance(row[0], str) else "" for row in rows]
    return claims.assign(open_end=ends)
