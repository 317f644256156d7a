"""Edges of surfaces whose forces are known, and their intervals."""

import numpy as np
import pytest
import xarray as xr
from known_masters import LONG, SHORT, filtered_forces

from hardcontact.inference.edges import edges_of_shared_scans
from hardcontact.inference.mean_forces import MasterScans


def edges_of(curves, scans, hindcast=None, spread=0.0):
    """Return the edges of ratios (surface, side, cutoff), with a number of scans a surface."""
    master_scans = MasterScans(
        scan_counts={"a": scans, "b": scans}, tiles=2, touched_patches={"a": 99, "b": 99}
    )
    forces = filtered_forces(curves, spread)
    return edges_of_shared_scans(forces, hindcast, master_scans, tolerance=0.1, confidence=0.95)


def make_hindcast(ratio=1.0, filtered_scan_ratio=1.0):
    """Return hindcast.nc of surface a, whose long side shows no octave."""
    return xr.Dataset(
        {
            "hindcast_ratio": (("surface", "side"), [[ratio, np.nan]]),
            "filtered_scan_ratio": ("surface", [filtered_scan_ratio]),
        },
        {"surface": ["a"], "side": ["short", "long"]},
    )


@pytest.mark.parametrize("scans", [1, 2, 3])
def test_intervals_surround_the_edge_within_the_cutoffs_of_their_side(scans):
    edges = edges_of([[SHORT, LONG]], scans, spread=0.2).sel(surface="a")
    low, high = edges.edge_interval.sel(end="low"), edges.edge_interval.sel(end="high")
    assert not (low >= edges.edge).any() and not (high <= edges.edge).any()
    assert edges.edge_interval.notnull().any()
    for side, shortest, longest in (("short", 10, 1000), ("long", 1000, 4000)):
        bounds = edges.edge_interval.sel(side=side).dropna("end")
        assert ((bounds >= shortest) & (bounds <= longest)).all()
    assert edges.interval_source.item() == ("quarters" if scans < 3 else "scans")


def test_curves_that_never_cross_the_tolerance_give_bounds():
    flat_short = [1.0, 1.01, 1.02, np.nan, np.nan]
    steep_long = [np.nan, np.nan, 5.0, 3.0, 2.0]
    edges = edges_of([[flat_short, steep_long]], scans=1, spread=0.05).sel(surface="a")
    assert edges.edge.isnull().all()
    np.testing.assert_array_equal(edges.edge_bound, [1000, 4000])
    assert edges.edge_status.values.tolist() == ["open_above", "open_above"]
    edges = edges_of([[[1.0] * 5, [2.0] * 5]], scans=3).sel(surface="a")
    assert edges.edge_status.values.tolist() == ["open_above", "open_above"]


def test_the_error_of_artificial_roughness_widens_intervals():
    """It adds in squares, and is at most the change itself, so that it denies no change."""
    error = np.log(1.5)
    curves = [[SHORT, LONG]]
    plain = edges_of(curves, scans=3, spread=0.1).sel(surface="a")
    wide = edges_of(curves, 3, make_hindcast(ratio=1 / 1.5), spread=0.1).sel(surface="a")
    half_width, wide_half_width = (
        np.log(edges.filtered_force_ratio_interval.sel(end="high") / edges.filtered_force_ratio)
        for edges in (plain, wide)
    )
    added = np.sqrt(wide_half_width**2 - half_width**2)
    change = np.log(plain.filtered_force_ratio.sel(side="short"))
    np.testing.assert_allclose(added.sel(side="short"), np.minimum(change, error))
    np.testing.assert_allclose(added.sel(side="long").dropna("cutoff_wavelength"), 0, atol=1e-7)
    low, high = wide.edge_interval.sel(side="short").values
    assert low < wide.edge.sel(side="short") and not high < 1000


def test_scans_on_which_the_filter_ripples_have_no_short_edge():
    curves = [[SHORT, LONG]] * 2
    plain = edges_of(curves, scans=3, spread=0.1)
    edges = edges_of(curves, 3, make_hindcast(filtered_scan_ratio=0.5), spread=0.1)
    assert edges.edge_status.values.tolist() == [["ripples", "found"], ["found", "found"]]
    assert np.isnan(edges.edge.sel(surface="a", side="short"))
    xr.testing.assert_equal(edges.sel(side="long"), plain.sel(side="long"))
    xr.testing.assert_equal(edges.sel(surface="b"), plain.sel(surface="b"))
