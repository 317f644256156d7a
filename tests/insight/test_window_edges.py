"""Long edges from windows and whole surfaces: equal without long waves, at a known wave, open."""

import numpy as np
import pytest
import xarray as xr
from known_spectra import rough

from hardcontact.insight.scan_size_trials import ratio_of_means, window_edges
from hardcontact.insight.scan_windows import (
    WindowFilters,
    filtered_forces,
    filtered_window_forces,
    mean_forces,
    mirrored_windows,
)
from hardcontact.numbers.random import generator
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.synthesis import random_surface
from hardcontact.surfaces.topography import level, mirror_stitch

CONTACTS = {
    "sizes": [320.0, 640.0],
    "each": 2,
    "radius": 5e3,
    "ranges": [5.0],
    "window": 1280.0,
    "count": 2,
    "load": {"name": "one", "preload": 10e-6, "hardness": 25e9},
}
CUTOFFS = [90.0, 180.0, 400.0, 1000.0]
FEW = [90.0, 400.0]
FILTERS = WindowFilters([960.0, 1280.0], 20.0, 2, FEW, 3, CONTACTS)


def of_heights(heights):
    return HeightMap(heights, 20.0, periodic=True, basis="substitute")


def test_window_that_holds_all_waves_has_ratios_and_force_of_the_whole_surface():
    """A surface made of mirror images of one window has no wave that this window lacks."""
    scan = HeightMap(np.random.default_rng(2).normal(0, 4, (16, 16)), 20.0, False, "substitute")
    whole = of_heights(np.tile(mirror_stitch(level(scan)).heights, (2, 2)))
    (window,) = mirrored_windows(whole, 320.0, 1)
    of_window = filtered_forces(window, CUTOFFS, CONTACTS)
    of_whole = filtered_forces(whole, CUTOFFS, {**CONTACTS, "count": 4})
    np.testing.assert_allclose(of_window[:-1], of_whole[:-1], rtol=1e-5)
    assert np.isnan(of_window[-1]) and of_whole[-1] == pytest.approx(1, abs=1e-6)


def test_cutoffs_above_a_single_wave_keep_the_force_and_those_below_that_of_a_flat_surface():
    wave = 4 * np.cos(2 * np.pi * np.arange(64) / 16)  # of 320 nm
    surface, flat = of_heights(wave[:, None] + wave), of_heights(np.zeros((64, 64)))
    forces = filtered_forces(surface, CUTOFFS, CONTACTS)
    without = mean_forces(flat, CONTACTS)[0] / mean_forces(surface, CONTACTS)[0]
    assert abs(np.log(without)) > 0.3
    np.testing.assert_allclose(forces[1:], [without, without, 1, 1], rtol=1e-5)


def test_surfaces_without_roughness_keep_all_of_their_force():
    forces = filtered_window_forces("flat", rough(rms=1e-6), FILTERS)
    found = window_edges({"flat": forces}, 0.1, 0.95).isel(surface=0)
    ratios = found["long_ratio"].values
    np.testing.assert_allclose(ratios[np.isfinite(ratios)], 1, atol=1e-5)
    np.testing.assert_allclose(found["force_over_largest"], 1, atol=1e-5)
    assert (found["long_edge_bound"] == 90).all() and not found["long_edge_at_least"].any()


def test_windows_are_cut_out_of_the_larger_surface_and_averaged():
    forces = filtered_window_forces("one", rough(rms=8.0), FILTERS)
    rng = generator(3, "one", 1, "window edges 1280 nm")
    whole = random_surface(rng, 64, 20.0, rough(rms=8.0))
    fewer = {**CONTACTS, "count": 1}
    windows = [filtered_forces(one, FEW, fewer) for one in mirrored_windows(whole, 320.0, 2)]
    of_second = forces.isel(realization=1)
    expected = [np.mean(windows, axis=0), filtered_forces(whole, FEW, CONTACTS)]
    np.testing.assert_allclose(of_second["pull_off_force"][[0, -1]], [one[0] for one in expected])
    np.testing.assert_allclose(of_second["ratio"][[0, -1]], [one[1:] for one in expected])
    assert forces["period"].values.tolist() == [640, 1280, 960, 1280]
    assert forces["mirrored"].values.tolist() == [1, 1, 0, 0]


def test_force_is_that_of_the_surface_less_its_long_waves_and_unknown_above_the_period():
    heights = 3 * np.random.default_rng(5).standard_normal((64, 64))
    surface = of_heights(heights)
    order = np.fft.fftfreq(64, 1 / 64)
    transform = np.fft.fft2(heights)
    transform[np.hypot(order[:, None], order) <= 1280 / 400] = 0
    rest = of_heights(np.fft.ifft2(transform).real)
    force, ratio, beyond = filtered_forces(surface, [400.0, 1300.0], CONTACTS)
    assert force == pytest.approx(mean_forces(surface, CONTACTS)[0])
    assert ratio * force == pytest.approx(mean_forces(rest, CONTACTS)[0], rel=1e-5)
    assert np.isnan(beyond)


def known(ratios, force=(2.0, 1.0), scatter=1.0):
    """Return forces of two realizations about ratios (edge_size, cutoff_wavelength)."""
    about = np.array([scatter, 1 / scatter])
    return xr.Dataset(
        {
            "ratio": (
                ("realization", "edge_size", "cutoff_wavelength"),
                about[:, None, None] * np.array(ratios),
            ),
            "pull_off_force": (("realization", "edge_size"), np.array([force, force])),
            "period": ("edge_size", [1000.0, 8000.0]),
            "mirrored": ("edge_size", [1, 0]),
        },
        {"edge_size": [500.0, 8000.0], "cutoff_wavelength": [250.0, 1000.0, 4000.0]},
    )


def test_edges_are_where_known_ratios_leave_the_tolerance():
    ratios = [[1.5, 1.0, np.nan], [2.0, 1.21, 1.0]]
    found = window_edges({"one": known(ratios)}, 0.1, 0.95).sel(surface="one")
    # Linear in ln(ratio) over ln(wavelength): of four, four octaves away, and half of two.
    share = np.log(1.1) / np.log(1.5)
    assert found["long_edge"].values[0] == pytest.approx(1000 * 0.25**share)
    assert found["long_edge"].values[1] == pytest.approx(2000, rel=1e-3)
    assert found["force_over_largest"].values.tolist() == [2.0, 1.0]


def test_an_edge_is_open_where_the_longest_waves_of_a_window_matter():
    ratios = [[1.5, 1.2, np.nan], [2.0, 1.21, 1.0]]
    found = window_edges({"one": known(ratios)}, 0.1, 0.95).isel(surface=0, edge_size=0)
    assert np.isnan(found["long_edge"]) and found["long_edge_bound"] == 1000
    assert found["long_edge_status"] == "beyond the cell" and found["long_edge_at_least"] == 1


def test_more_scatter_gives_a_wider_interval_of_the_edge():
    ratios = [[1.5, 1.0, np.nan], [2.0, 1.21, 1.0]]
    low, high = (
        window_edges({"one": known(ratios, scatter=one)}, 0.1, 0.95)["long_ratio_interval"]
        for one in (1.001, 1.01)
    )
    width = [float(one[0, 1, 1, 1] - one[0, 1, 1, 0]) for one in (low, high)]
    # Student's t of two realizations: 12.7 standard errors of the logarithm on either side.
    assert width[0] == pytest.approx(2 * 1.21 * 12.706 * np.log(1.001), rel=0.01)
    assert width[1] > 9 * width[0]


def test_ratio_of_means_is_that_of_known_forces_with_the_interval_of_single_ones():
    forces = xr.DataArray([[2.0, 3.0], [8.0, 3.0]], dims=("realization", "edge_size"))
    reference = xr.DataArray([1.0, 1.0], dims="realization")
    ratio, interval = ratio_of_means(forces, reference, 0.95)
    assert ratio.values.tolist() == [5.0, 3.0]
    # The logarithms of 2 and 8 have a standard error of ln 2: 12.7 of them on either side.
    assert np.log(interval[0] / 5).values == pytest.approx(
        [-12.706 * np.log(2), 12.706 * np.log(2)], rel=1e-4
    )
    assert interval[1].values == pytest.approx([3.0, 3.0])
