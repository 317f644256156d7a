"""Edges of means over masters whose force ratios are known, and their intervals."""

import numpy as np
import xarray as xr
from known_masters import master_ratios

from hardcontact.base.statistics import Sampling, interval_ends, student_log_interval
from hardcontact.inference.edges import edges_of_independent_masters

CUTOFFS = [10.0, 100.0, 1000.0, 10000.0]
LONG = [np.nan, np.nan, 3.0, 1.0]


def edges_of(ratios, samples=0, confidence=0.95):
    """Return the edges of ratios (surface, realization, side, cutoff)."""
    sampling = Sampling(seed=0, sample_count=samples, confidence=confidence)
    edges, _ = edges_of_independent_masters(master_ratios(ratios, CUTOFFS), 0.1, sampling)
    return edges


def test_averaged_change_is_the_mean_of_absolute_changes():
    increasing = [[1.0, 1.2, np.nan, np.nan], [np.nan, np.nan, 3.0, 1.0]]
    decreasing = [[1.0, 0.8, np.nan, np.nan], [np.nan, np.nan, 0.6, 1.0]]
    edges = edges_of([[increasing], [decreasing]])
    np.testing.assert_allclose(
        edges.filtered_force_change.sel(group="averaged"),
        [[0.0, 0.2, np.nan, np.nan], [np.nan, np.nan, 1.2, 0.0]],
    )
    assert edges.filtered_force_ratio.dims == ("side", "surface", "cutoff_wavelength")
    np.testing.assert_allclose(edges.filtered_force_ratio.sel(surface="b"), decreasing)
    # ln(ratio) is linear in ln(cutoff) from 10 to 100 nm, and so is the mean of |ratio - 1|.
    edge_of_a = 10 ** (1 + np.log(1.1) / np.log(1.2))
    edge_of_b = 10 ** (1 + np.log(0.9) / np.log(0.8))
    averaged_edge = 10 ** (1 + 0.1 / 0.2)
    np.testing.assert_allclose(edges.edge.sel(side="short"), [edge_of_a, edge_of_b, averaged_edge])
    assert edges.edge_interval.isnull().all()


FLAT = [[1.0, 1.0, np.nan, np.nan], [np.nan, np.nan, 1.0, 1.0]]


def test_curves_within_the_tolerance_have_the_last_cutoff_as_bound_and_interval():
    edges = edges_of([[FLAT] * 2], samples=5)
    assert edges.edge.isnull().all()
    np.testing.assert_array_equal(edges.edge_bound, [[100.0] * 2, [1000.0] * 2])
    np.testing.assert_array_equal(edges.edge_status, [["open_above"] * 2, ["open_below"] * 2])
    np.testing.assert_allclose(edges.edge_interval.sel(side="short"), 100.0)
    np.testing.assert_allclose(edges.edge_interval.sel(side="long"), 1000.0)


def test_intervals_describe_the_scatter_of_realizations():
    rows = [[[1.0, ratio, np.nan, np.nan], LONG] for ratio in (1.2, 1.3, 1.45)]
    edges = edges_of([rows], samples=4000, confidence=0.9)
    short = edges.sel(side="short", cutoff_wavelength=100.0)
    ratio_interval = student_log_interval(xr.DataArray([1.2, 1.3, 1.45], dims="n"), 0.9, "n")
    np.testing.assert_allclose(short.filtered_force_ratio_interval[0], ratio_interval, rtol=0.03)
    np.testing.assert_allclose(
        short.filtered_force_change_interval.sel(group="a"), ratio_interval - 1, rtol=0.2
    )
    low, high = interval_ends(edges.sel(side="short", group="a"), "edge")
    # The upper end of the change gives the lower end of the wavelength.
    edge_interval = 10 ** (1 + np.log(1.1) / np.log(ratio_interval.values))
    np.testing.assert_allclose([high, low], edge_interval, rtol=0.3)
    assert edges.edge_interval.attrs["confidence"] == 0.9
