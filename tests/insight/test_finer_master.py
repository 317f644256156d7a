"""One master on several pixels: the same waves, forces as computed alone, intervals, edges."""

import numpy as np
import pytest
from periodic_maps import height_map, periodic_noise

from hardcontact.insight.finer_master import FinerMaster, on_coarser_pixels, on_several_pixels
from hardcontact.scales.filtered_masters import filtered_pull_off

PIXELS, SIZE = 128, 256.0
GIVEN = FinerMaster(
    pixels=[64, 128],
    cutoffs=[9.0, 20.0, 90.0],
    radius=500.0,
    rho=3.0,
    contact={"window": 512.0, "count": 8, "preload": 1e-7, "hardness": 1e9},  # 25 coarse pixels
    tolerance=0.1,
    confidence=0.95,
)


def waves(*amplitudes):
    """Return a map of waves (order, amplitude in nm) along both axes."""
    x = np.arange(PIXELS) / PIXELS
    along = sum(height * np.cos(2 * np.pi * order * x) for order, height in amplitudes)
    return height_map(along[:, None] + along, SIZE / PIXELS)


def test_coarser_pixels_keep_their_waves_alone():
    master, long = waves((3, 2.0), (31, 0.5), (40, 1.0)), waves((3, 2.0), (31, 0.5))
    coarse = on_coarser_pixels(master, 64)
    np.testing.assert_allclose(coarse.heights, long.heights[::2, ::2], atol=1e-12)
    assert coarse.pixel_size == SIZE / 64
    assert on_coarser_pixels(master, PIXELS) is master


def test_forces_are_those_of_each_map_and_cutoff_alone():
    master = height_map(periodic_noise(PIXELS, 2.0, 1), SIZE / PIXELS)
    found = on_several_pixels(master, GIVEN)
    array = {key: GIVEN.contact[key] for key in ("window", "count")}
    load = {"name": "one", "preload": 1e-7, "hardness": 1e9}
    common = {"side": "small", "radius": 500.0, "rho": 3.0, "loads": [load], **array}
    for pixels in GIVEN.pixels:
        surface, of_pixels = on_coarser_pixels(master, pixels), found.sel(pixels=pixels)
        scales = {"pixels": pixels, "cutoffs": [20.0]}
        alone = filtered_pull_off(surface, None, {**common, "scales": scales}).isel(load=0)
        whole, cut = alone.unfiltered_pull_off_force, alone.pull_off_force[0]
        np.testing.assert_array_equal(of_pixels.unfiltered_pull_off_force, whole)
        filtered = of_pixels.pull_off_force.sel(cutoff_wavelength=20)
        np.testing.assert_allclose(filtered, cut, rtol=1e-4)  # heights are stored in float32
        ratio = of_pixels.ratio.sel(cutoff_wavelength=20).item()
        assert ratio == pytest.approx(float(cut.mean() / whole.mean()))
        low, high = of_pixels.ratio_interval.sel(cutoff_wavelength=20).values
        assert low < ratio < high
    finest = found.unfiltered_pull_off_force.mean(["contact_y", "contact_x"])
    np.testing.assert_allclose(found.force_over_finest, finest / finest[-1])


def test_waves_that_coarse_pixels_hold_leave_forces_as_they_are():
    long = on_several_pixels(waves((2, 1.0)), GIVEN)
    assert long.force_over_finest.values == pytest.approx(1, abs=0.02)
    np.testing.assert_allclose(*long.ratio.values, rtol=0.02)
    rough = on_several_pixels(waves((2, 1.0), (50, 2.0)), GIVEN)
    assert rough.force_over_finest.values[0] > 1.3  # roughness below the coarse pixels is missing
    assert rough.ratio.values[0, 0] == pytest.approx(1) and rough.ratio.values[1, 0] > 1.3


def test_equal_contacts_have_intervals_of_no_width():
    flat = on_several_pixels(height_map(np.zeros((PIXELS, PIXELS)), SIZE / PIXELS), GIVEN)
    assert flat.ratio_interval.values == pytest.approx(1)
    # An edge of at least the last cutoff: its interval begins there and is open above.
    assert flat.edge.isnull().all()
    np.testing.assert_array_equal(flat.edge_interval, [[90, np.nan]] * 2)
