"""Numbers about the scales of roughness, of curves that are known."""

import numpy as np
from paper_claims import NUMBERS, near
from paper_datasets import make_band, make_inference, make_scales

from hardcontact.claims.scale_quantities import (
    change_inside_band,
    change_outside_band,
    critical_over_interaction_radius,
    flat_limit_fraction,
    small_scale_change,
    smoothest_ratio,
    stylus_ratio,
)
from hardcontact.statistics import bounds


def test_change_outside_band():
    change = change_outside_band(make_band(), NUMBERS).sel(group="pooled")
    np.testing.assert_allclose(change["value"], [0.05, 0.05])
    low, high = bounds(change, "value")
    np.testing.assert_allclose(low, [0.05 - 0.0105, 0.05 - 0.0095])
    np.testing.assert_allclose(high, [0.05 + 0.0105, 0.05 + 0.0095])


def test_changes_of_cutoffs():
    band = make_band()
    inside = change_inside_band(band, NUMBERS).sel(side="large", group="pooled")
    near(inside, 0.6)
    near(small_scale_change(band, NUMBERS), [0.0] * 5)
    band["scale_ratio"].loc[{"side": "small", "cutoff_wavelength": 10.0}] = 0.8
    near(small_scale_change(band, NUMBERS), [0.2] * 5)
    near(stylus_ratio(band, NUMBERS), [4.0] * 5)


def test_smoothest_ratio_takes_the_last_small_cutoff():
    np.testing.assert_allclose(smoothest_ratio(make_band())["value"], 4.0)


def test_flat_limit_fraction():
    fraction = flat_limit_fraction(make_scales())["value"]
    np.testing.assert_allclose(fraction, 1.0e-3 / (2 * np.pi * 0.25e-3))


def test_critical_wavelength_over_the_interaction_radius():
    ratio = critical_over_interaction_radius(make_band(), make_inference())
    near(ratio.sel(side="large", group="pooled", contact_model="plastic"), 1800 / 1673, rtol=1e-3)
