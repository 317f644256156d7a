"""Numbers about the scales of roughness, of curves that are known."""

import numpy as np
import pytest
import xarray as xr
from paper_claims import NUMBERS, near
from paper_datasets import make_band, make_scales

from hardcontact.claims.inference_quantities import (
    band_edge,
    change_inside_band,
    change_outside_band,
    critical_over_interaction_radius,
    flat_limit_fraction,
    small_scale_change,
    smoothest_ratio,
    stylus_change,
)
from hardcontact.numbers.statistics import Sampling, bounds
from hardcontact.scales.critical_band import critical_band


def test_change_outside_band():
    change = change_outside_band(make_band(), NUMBERS).sel(group="pooled")
    near(change, [0.05, 0.05])
    low, high = bounds(change, "value")
    np.testing.assert_allclose(low, 0.045)
    np.testing.assert_allclose(high, 0.055)


def test_changes_of_cutoffs():
    band = make_band()
    near(change_inside_band(band, NUMBERS).sel(side="large", group="pooled"), 0.6)
    near(small_scale_change(band, NUMBERS), [0.0] * 5)
    band["scale_change"].loc[{"side": "small", "cutoff_wavelength": 10.0}] = 0.2
    near(small_scale_change(band, NUMBERS), [0.2] * 5)
    near(stylus_change(band, NUMBERS), [3.0] * 5)


def test_smoothest_ratio_takes_the_last_small_cutoff():
    near(smoothest_ratio(make_band()), [4.0] * 4)
    descending = make_band().sortby("cutoff_wavelength", ascending=False)
    near(smoothest_ratio(descending), [4.0] * 4)


def test_the_edge_of_a_curve_that_never_leaves_is_its_last_cutoff():
    band = make_band()
    near(band_edge(band).sel(group="pooled"), [46.0, 1750.0])
    band["critical_wavelength"].loc[{"group": "ncd"}] = np.nan
    near(band_edge(band).sel(group="ncd"), [1000.0, 200.0])
    near(band_edge(band).sel(group="mcd"), [46.0, 1750.0])


def test_flat_limit_fraction():
    near(flat_limit_fraction(make_scales()), [1.0e-3 / (2 * np.pi * 0.25e-3)] * 4)


def test_critical_wavelength_over_the_interaction_radius():
    ratio = critical_over_interaction_radius(make_band(), NUMBERS)
    near(ratio.sel(side="large", group="pooled"), 1750 / 1673, rtol=1e-3)


@pytest.mark.parametrize("seed", range(5))
def test_one_curve_gives_one_verdict(seed):
    """The edge lies beyond the published one where no cutoff outside the band changes the force."""
    cutoffs = {"small": [10.0, 20.0, 43.0, 80.0], "large": [500.0, 1800.0, 2700.0, 5000.0]}
    axis = sorted(sum(cutoffs.values(), []))
    rng = np.random.default_rng(seed)
    ratio = xr.DataArray(
        1 + 0.12 * rng.normal(size=(40, 1, 2, len(axis))),
        {"side": list(cutoffs), "cutoff_wavelength": axis},
        ("surface", "realization", "side", "cutoff_wavelength"),
    )
    of_side = {side: ratio["cutoff_wavelength"].isin(known) for side, known in cutoffs.items()}
    known = xr.where(ratio["side"] == "small", of_side["small"], of_side["large"])
    scales = xr.Dataset(
        {
            "ratio": ratio.where(known),
            "unfiltered_wavelength": (("surface", "side"), np.tile([1.0, 2e4], (40, 1))),
        },
        {"surface": [f"s{number}" for number in range(40)]},
    )
    band = critical_band(scales, 0.1, Sampling(0, 0, 0.95))
    edge, change = (
        computed["value"] for computed in (band_edge(band), change_outside_band(band, NUMBERS))
    )
    for side, holds in (
        ("small", edge.sel(side="small") > 43),
        ("large", edge.sel(side="large") < 1800),
    ):
        np.testing.assert_array_equal(holds, change.sel(side=side) < 0.1)
        assert 0 < int(holds.sum()) < holds.size
