"""Intervals of the edges of the band that end at the last cutoff computed, and so are open."""

from collections.abc import Sequence

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.scales.cutoffs import last_cutoff

__all__ = ["with_open_ends"]

#: The end of the interval of an edge that may lie beyond the cutoffs, by the side of the edge.
OPEN_END = {"small": "high", "large": "low"}


def with_open_ends(claims: pd.DataFrame, bands: Sequence[xr.Dataset]) -> pd.DataFrame:
    """Add which end of each interval is open, because no cutoff was computed beyond it.

    An edge beyond the cutoffs counts as the last one. Sets have fewer cutoffs than the study, whose
    own number may lie beyond theirs: an interval that is stretched to it is open there too.

    Parameters
    ----------
    claims : pandas.DataFrame
        As from `verdicts.read_verdicts`.
    bands : sequence of xarray.Dataset
        What the intervals come from, band.nc and sets.nc: scale_change (..., side, group,
        cutoff_wavelength).

    Returns
    -------
    pandas.DataFrame
        The claims with the column `open_end`: "low", "high" or "".
    """
    marked = claims.assign(open_end="")
    for side, end in OPEN_END.items():
        last = np.array([last_cutoff(band["scale_change"].sel(side=side), side) for band in bands])
        for group in bands[0]["group"].values:
            place = marked["id"] == f"critical_wavelength_{side}_{group}"
            for number, limit in marked.loc[place, ["computed", end]].values:
                beyond = number >= last if end == "high" else number <= last
                if np.isclose(limit, last).any() or (beyond.any() and np.isclose(limit, number)):
                    marked.loc[place, "open_end"] = end
    return marked
