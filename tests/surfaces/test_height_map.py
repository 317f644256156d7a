"""The height map on disk: what xarray reads of it, and that it comes back as it was."""

import numpy as np
import pytest
import xarray as xr
from refusals import assert_says, refusal
from scan_files import cut

from hardcontact.records import dataset
from hardcontact.surfaces.height_map import HeightMap, read_height_map


@pytest.fixture
def surface():
    heights = np.random.default_rng(0).standard_normal((8, 12))
    return HeightMap(heights, 2500 / 512, periodic=True, basis="measured")


def test_a_map_comes_back_as_it_was_written(tmp_path, surface):
    dataset.write(surface.dataset(), tmp_path / "a.nc")
    again = read_height_map(tmp_path / "a.nc")
    np.testing.assert_array_equal(again.heights, surface.heights.astype(np.float32))
    assert again.heights.dtype == np.float32
    assert (again.pixel_size, again.periodic, again.basis) == (2500 / 512, True, "measured")


def test_xarray_reads_what_a_map_is(tmp_path, surface):
    dataset.write(surface.dataset(), tmp_path / "a.nc")
    stored = xr.load_dataset(tmp_path / "a.nc")
    again = read_height_map(tmp_path / "a.nc")
    assert stored.heights.dims == ("y", "x") and stored.heights.dtype == np.float32
    np.testing.assert_array_equal(stored.heights, again.heights)
    assert stored.heights.attrs["pixel_size"] == again.pixel_size
    assert stored.heights.attrs["units"] == stored.x.attrs["units"] == "nm"
    assert (bool(stored.attrs["periodic"]), stored.attrs["basis"]) == (True, "measured")
    # The centres of the pixels.
    np.testing.assert_allclose(stored.x, (np.arange(12) + 0.5) * surface.pixel_size)
    np.testing.assert_allclose(stored.y, (np.arange(8) + 0.5) * surface.pixel_size)


def test_size_of_a_square_map():
    surface = HeightMap(np.zeros((5, 5)), 3.0, periodic=False, basis="substitute")
    assert (surface.pixels, surface.size) == (5, 15.0)


def test_a_damaged_map_is_one_clear_line(tmp_path, surface):
    dataset.write(surface.dataset(), tmp_path / "a.nc")
    message = refusal(read_height_map, cut(tmp_path / "a.nc", 0.5))
    assert_says(message, "a.nc: expected a complete netCDF file, found")
