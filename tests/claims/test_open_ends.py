"""Open ends of intervals: where no cutoff was computed beyond them."""

import numpy as np
import pandas as pd
import pytest
from figure_inputs.scales import band
from figure_inputs.sets import sets

from hardcontact.claims.verdicts import with_open_ends
from hardcontact.scales.critical_band import last_cutoff

#: Cutoffs (nm) of the study go from 20 to 250 and from 500 to 3500, those of the sets to 120.
BANDS = [band(), sets().sel(cutoff_wavelength=slice(30, 2700)).drop_sel(cutoff_wavelength=250)]


def marked(side, computed, low, high, group="mcd"):
    """The open end of the interval of an edge, beside one that is no edge."""
    numbers = {"computed": computed, "low": low, "high": high}
    names = [f"edge_{side}_{group}", f"critical_wavelength_{side}_{group}", "range_of_adhesion"]
    claims = pd.DataFrame([{"id": name, **numbers} for name in names])
    found = with_open_ends(claims, BANDS)["open_end"]
    assert found.iloc[0] == found.iloc[1] and found.iloc[2] == "" and "open_end" not in claims
    return found.iloc[0]


def test_the_last_cutoff_is_the_one_that_removes_most():
    for side, last in {"small": [250, 120], "large": [500, 500]}.items():
        changes = [one["scale_change"].sel(side=side) for one in BANDS]
        assert [last_cutoff(one, side) for one in changes] == last


@pytest.mark.parametrize("group", ["polished_uncd", "mcd", "pooled"])
@pytest.mark.parametrize(
    ("side", "computed", "low", "high", "end"),
    [
        ("small", 60, 40, 119, ""),
        ("small", 60, 40, 120, "high"),  # the last cutoff of the sets
        ("small", 60, 40, 250, "high"),  # of the study
        ("small", 60, 40, 200, ""),
        ("small", 130, 100, 130, "high"),  # stretched to a number beyond the cutoffs of the sets
        ("small", 110, 100, 110, ""),
        ("small", 130, 120, 140, ""),
        ("large", 900, 500, 2000, "low"),
        ("large", 900, 501, 3500, ""),
        ("large", 480, 480, 2000, "low"),
        ("large", 900, np.nan, np.nan, ""),
    ],
)
def test_an_end_at_or_beyond_the_last_cutoff_is_open(side, computed, low, high, end, group):
    assert marked(side, computed, low, high, group) == end
