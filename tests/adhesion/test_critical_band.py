"""Critical wavelengths of curves that leave their tolerance at a known cutoff."""

import numpy as np
import pytest
import xarray as xr

from hardcontact.adhesion import critical_band as band
from hardcontact.adhesion.bootstrap import Bootstrap
from hardcontact.statistics import bounds

CUTOFFS = [10.0, 100.0, 1000.0, 10000.0]
SMALL = [1.0, 1.2, np.nan, np.nan]
LARGE = [np.nan, np.nan, 3.0, 1.0]
LEAVES = {"small": 10**1.5, "large": 10**3.95}  # where SMALL and LARGE cross 1.1


def scales(ratios):
    """ratios: (surface, realization, side, cutoff)."""
    ratios = np.asarray(ratios)
    surfaces = ["a", "b"][: len(ratios)]
    return xr.Dataset(
        {
            "ratio": (("surface", "realization", "side", "cutoff_wavelength"), ratios),
            "unfiltered_wavelength": (("surface", "side"), [[1.0, 20000.0]] * len(ratios)),
            "label": ("surface", [f"surface {name}" for name in surfaces]),
            "basis": ("surface", ["measured"] * len(surfaces)),
        },
        {"surface": surfaces, "side": ["small", "large"], "cutoff_wavelength": CUTOFFS},
        {"sphere_radius": 0.25e6, "parameters": "those of scales"},
    )


def test_critical_wavelength_interpolates_in_log_wavelength():
    cutoffs, ratios = np.array([1.0, 10.0, 100.0]), np.array([1.0, 1.05, 1.15])
    assert band.critical_wavelength(cutoffs, ratios, 0.1) == pytest.approx(10**1.5)
    falling = np.array([1.0, 1.0, 0.8])
    assert band.critical_wavelength(cutoffs, falling, 0.1) == pytest.approx(10**1.5)
    assert np.isnan(band.critical_wavelength(cutoffs, np.array([1.0, 0.95, 1.05]), 0.1))


def test_each_side_is_read_from_its_unfiltered_end():
    computed = band.critical_band(scales([[[SMALL, LARGE]] * 3]), 0.1, Bootstrap(0, 20, 0.95))
    for side, expected in LEAVES.items():
        for group in ("a", "pooled"):
            chosen = computed.sel(side=side, group=group)
            assert float(chosen.critical_wavelength) == pytest.approx(expected)
            np.testing.assert_allclose(chosen.critical_wavelength_interval, expected)


def test_pooled_curve_is_the_mean_over_surfaces():
    flat = [[1.0, 1.0, np.nan, np.nan], [np.nan, np.nan, 1.0, 1.0]]
    computed = band.critical_band(scales([[[SMALL, LARGE]], [flat]]), 0.1, Bootstrap(0, 5, 0.95))
    np.testing.assert_allclose(
        computed.scale_ratio.sel(group="pooled"),
        [[1.0, 1.1, np.nan, np.nan], [np.nan, np.nan, 2.0, 1.0]],
    )
    assert computed.critical_wavelength.sel(group="b").isnull().all()


def test_curves_that_never_leave_bound_the_interval_by_their_last_cutoff():
    flat = [[1.0, 1.0, np.nan, np.nan], [np.nan, np.nan, 1.0, 1.0]]
    computed = band.critical_band(scales([[flat] * 2]), 0.1, Bootstrap(0, 5, 0.95))
    assert computed.critical_wavelength.isnull().all()
    np.testing.assert_allclose(computed.critical_wavelength_interval.sel(side="small"), 10000.0)
    np.testing.assert_allclose(computed.critical_wavelength_interval.sel(side="large"), 10.0)


def test_interval_resamples_realizations():
    weak, strong = [1.0, 1.15, np.nan, np.nan], [1.0, 1.45, np.nan, np.nan]
    computed = band.critical_band(
        scales([[[weak, LARGE], [strong, LARGE]]]), 0.1, Bootstrap(0, 400, 0.9)
    )
    low, high = bounds(computed.sel(side="small", group="a"), "critical_wavelength")
    assert float(low) == pytest.approx(10 ** (1 + 0.1 / 0.45))  # the strong one twice
    assert float(high) == pytest.approx(10 ** (1 + 0.1 / 0.15))
    assert computed.critical_wavelength_interval.attrs["confidence"] == 0.9


def test_band_of_a_study_names_its_surfaces():
    computed = band.find_critical_band(
        scales([[[SMALL, LARGE]], [[SMALL, LARGE]]]), 0.1, Bootstrap(0, 5, 0.9)
    )
    assert computed.group.values.tolist() == ["a", "b", "pooled"]
    assert computed.label.sel(surface="b") == "surface b"
    assert computed.basis.values.tolist() == ["measured"] * 2
    assert computed.attrs == {"scale_tolerance": 0.1, "confidence": 0.9, "sphere_radius": 0.25e6}
