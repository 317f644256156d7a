"""Ends of the intervals of edges at and beyond the last cutoff."""

from math import nan

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from hardcontact.paper.open_ends import add_open_ends


def band(cutoffs):
    """Return the changes at cutoffs (nm) of both sides; cutoffs below 300 nm are short."""
    change = np.where([np.array(cutoffs) < 300, np.array(cutoffs) > 300], 0.5, nan)
    dims = ("side", "group", "cutoff_wavelength")
    return xr.Dataset(
        {"filtered_force_change": (dims, change[:, None])},
        {"side": ["short", "long"], "group": ["mcd"], "cutoff_wavelength": cutoffs},
    )


#: Bands of a study and its sets: short cutoffs end at 250 and 120 nm, long cutoffs at 500 nm.
BANDS = [band([20, 43, 120, 250, 500, 1800, 3500]), band([43, 120, 500, 1800])]


@pytest.mark.parametrize(
    ("side", "edge", "low", "high", "end"),
    [
        ("short", 60, 40, 119, ""),
        ("short", 60, 40, 120, "high"),  # the last cutoff of the sets
        ("short", 60, 40, 250, "high"),  # of the study
        ("short", 60, 40, 200, ""),
        ("short", 130, 100, 130, "high"),  # stretched to a number beyond the cutoffs of the sets
        ("short", 110, 100, 110, ""),
        ("short", 130, 120, 140, ""),
        ("long", 900, 500, 2000, "low"),
        ("long", 900, 501, 3500, ""),
        ("long", 480, 480, 2000, "low"),
        ("long", 900, nan, nan, ""),
    ],
)
def test_an_end_at_or_beyond_the_last_cutoff_is_open(side, edge, low, high, end):
    numbers = {"computed": edge, "low": low, "high": high}
    names = [f"{side}_edge_first", f"{side}_edge_mean", "range_of_adhesion"]
    claims = add_open_ends(pd.DataFrame([{"id": name, **numbers} for name in names]), BANDS)
    assert claims["open_end"].tolist() == [end, end, ""]
