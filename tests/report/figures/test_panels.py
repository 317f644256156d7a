"""Panels: bands, edges and hatched wavelengths end where they should; maps lack some waves."""

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure

from hardcontact.report.figures import fig_scales, panels

CURVE = xr.Dataset(
    {"value": ("x", [1.0, 2, 4]), "low": ("x", [0.5, 1, np.nan]), "high": ("x", [3.0, 5, np.nan])},
    {"x": [1.0, 10, 100]},
)


def test_bands_are_filled_where_both_ends_are_bounded():
    axes = Figure().subplots()
    unbounded = CURVE.assign(low=("x", [0.5, 1.0, 2.0]), high=("x", [3.0, 5.0, np.inf]))
    for curve in (CURVE, unbounded):
        panels.draw_band(axes, CURVE["x"], curve, "red")
    for band in axes.collections:
        (path,) = band.get_paths()
        assert {tuple(point) for point in path.vertices} == {(1, 0.5), (1, 3), (10, 1), (10, 5)}


@pytest.mark.parametrize(
    ("numbers", "symbols"),  # value, low and high, and the symbols drawn
    [((20, 10, 30), ["h"]), ((20, 10, 500), [">", "h"]), ((500, 100, 500), [">"])],
)
def test_edges_at_the_last_cutoff_are_open(numbers, symbols):
    axes = Figure().subplots()
    edges = xr.Dataset(
        dict(zip(("value", "low", "high"), numbers, strict=True)), {"group": "averaged"}
    ).expand_dims("group")
    no_surface = xr.DataArray([], {"surface": []}, name="label")
    panels.draw_edges(axes, edges, no_surface, {">": 500})
    interval, *marks = axes.lines
    assert tuple(interval.get_xdata()) == numbers[1:]
    assert [mark.get_marker() for mark in marks] == symbols


def test_shades_end_with_the_axes_and_lie_above_the_strip():
    axes = Figure().subplots()
    axes.set(xscale="log", xlim=(10, 1000))
    panels.draw_tolerance(axes, 0.1)
    panels.hatch_wavelengths(axes, [(0.0, 20.0), (500.0, np.inf), (2000.0, 3000.0)])
    strip, *shades = axes.patches
    assert all(shade.get_zorder() > strip.get_zorder() for shade in shades)
    spans = [(shade.get_x(), shade.get_x() + shade.get_width()) for shade in shades]
    assert np.allclose(spans, [(10, 20), (500, 1000)])
    assert axes.get_xlim() == (10, 1000)


def test_maps_of_the_question_lack_the_waves_on_one_side_of_the_band():
    size, pixels = 2500.0, 256
    position = (0.5 + np.arange(pixels)) / pixels
    # Cosines that are even about both edges: wavelengths of 5 µm, 250 nm and 25 nm.
    long, middle, short = (np.cos(np.pi * order * position) for order in (1, 20, 200))
    heights = np.tile(long + middle + short, (pixels, 1))
    scan = xr.Dataset({"example_heights": (("row", "column"), heights), "scan_size": size})
    maps = fig_scales.filtered_heights(scan, [43.0, 1800.0])
    profiles = {
        "all wavelengths": long + middle + short,
        "none below 43 nm": long + middle,
        "none above 1.8 µm": middle + short,
    }
    assert list(maps) == list(profiles)
    for title, profile in profiles.items():
        np.testing.assert_allclose(maps[title], np.tile(profile, (pixels, 1)), atol=1e-5)
