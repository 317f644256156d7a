"""Forces and long edges on mirrored windows, against whole surfaces and known ratios."""

import sys
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from periodic_maps import height_map
from repository import ROOT

sys.path.insert(0, str(ROOT / "tests/benchmarks"))

from validate_scan_sizes import (
    TABLE,
    TOLERANCE,
    Windows,
    filtered_forces,
    mean_forces,
    mirrored_windows,
    window_edges,
)

from hardcontact.base import dataset
from hardcontact.contact.contact import Contact
from hardcontact.own.edges_of_scans import edges_of_curves
from hardcontact.surfaces.height_map import HeightMap, level, mirror_stitch

CONTACT = Contact(radius=5e3, preload=10e-6, hardness=25e9, window=1280.0, contacts_per_row=2)
WINDOWS = Windows([320.0, 640.0], 2, [2.0, 5.0], CONTACT)
CUTOFFS = [90.0, 180.0, 400.0, 1000.0]


def random_heights(rms):
    return rms * np.random.default_rng(5).standard_normal((64, 64))


def test_the_edges_of_the_table_follow_from_its_ratios():
    table = dataset.read(TABLE)
    names = ["filtered_force_ratio", "filtered_force_ratio_interval"]
    for name, edge in edges_of_curves(table[names].assign_coords(side="long"), TOLERANCE).items():
        np.testing.assert_array_equal(table[f"long_{name}"].transpose(*edge.dims), edge)
    assert (table["force_over_largest"].isel(map_size=-1) == 1).all()


def test_a_window_that_holds_all_waves_has_ratios_and_force_of_the_whole_surface():
    """A surface made of mirror images of one window has no wave that this window lacks."""
    heights = np.random.default_rng(2).normal(0, 4, (16, 16))
    scan = HeightMap(heights, 20.0, periodic=False, basis="substitute")
    surface = height_map(np.tile(mirror_stitch(level(scan)).heights, (2, 2)), 20.0)
    (window,) = mirrored_windows(surface, 320.0, 1)
    window_forces = filtered_forces(window, CUTOFFS, WINDOWS)
    surface_forces = filtered_forces(
        surface, CUTOFFS, replace(WINDOWS, contact=replace(CONTACT, contacts_per_row=4))
    )
    np.testing.assert_allclose(window_forces[:-1], surface_forces[:-1], rtol=1e-5)
    assert np.isnan(window_forces[-1]) and surface_forces[-1] == pytest.approx(1, abs=1e-6)


def test_the_ratio_equals_that_of_a_surface_without_its_long_waves():
    heights = random_heights(3.0)
    order = np.fft.fftfreq(64, 1 / 64)
    transform = np.fft.fft2(heights)
    transform[np.hypot(order[:, None], order) <= 1280 / 400] = 0
    short_waves = height_map(np.fft.ifft2(transform).real, 20.0)
    force, ratio = filtered_forces(height_map(heights, 20.0), [400.0], WINDOWS)
    assert ratio * force == pytest.approx(mean_forces(short_waves, WINDOWS)[0], rel=1e-5)


def test_known_ratios_have_known_or_open_edges():
    ratios = [[1.5, 1.0, np.nan], [1.5, 1.2, np.nan], [2.0, 1.21, 1.0]]
    forces = xr.Dataset(
        {
            "filtered_force_ratio": (
                ("realization", "map_size", "cutoff_wavelength"),
                [ratios, ratios],
            ),
            "pull_off_force": (("realization", "map_size"), [[2.0, 3.0, 1.0]] * 2),
            "period": ("map_size", [1000.0, 1000.0, 8000.0]),
            "mirrored": ("map_size", [1, 1, 0]),
        },
        {"map_size": [500.0, 501.0, 8000.0], "cutoff_wavelength": [250.0, 1000.0, 4000.0]},
    )
    edges = window_edges({"one": forces}).isel(surface=0)
    # Linear in ln(ratio) against ln(wavelength).
    share = np.log(1.1) / np.log(1.5)
    assert edges["long_edge"].values[0] == pytest.approx(1000 * 0.25**share)
    assert edges["long_edge"].values[2] == pytest.approx(2000, rel=1e-3)
    assert np.isnan(edges["long_edge"][1]) and edges["long_edge_bound"][1] == 1000
    assert edges["long_edge_status"][1] == "open_above"
    assert edges["force_over_largest"].values.tolist() == [2.0, 3.0, 1.0]
