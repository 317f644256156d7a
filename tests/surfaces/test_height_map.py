"""The height map on disk: what xarray reads of it, and that it comes back as it was."""

import os
import subprocess
import sys

import numpy as np
import pytest
import xarray as xr
from refusals import assert_says, refusal
from repository import ROOT
from scan_files import cut

from hardcontact.records import netcdf
from hardcontact.surfaces.height_map import HeightMap, read_height_map


@pytest.fixture
def surface():
    heights = np.random.default_rng(0).standard_normal((8, 12))
    return HeightMap(heights, 2500 / 512, periodic=True, basis="measured")


def test_a_map_comes_back_as_it_was_written(tmp_path, surface):
    netcdf.write(surface.arrays(), tmp_path / "a.nc")
    again = read_height_map(tmp_path / "a.nc")
    np.testing.assert_array_equal(again.heights, surface.heights.astype(np.float32))
    assert again.heights.dtype == np.float32
    assert (again.pixel_size, again.periodic, again.basis) == (2500 / 512, True, "measured")


def test_xarray_reads_what_a_map_is(tmp_path, surface):
    netcdf.write(surface.arrays(), tmp_path / "a.nc")
    dataset = xr.load_dataset(tmp_path / "a.nc")
    again = read_height_map(tmp_path / "a.nc")
    assert dataset.heights.dims == ("y", "x") and dataset.heights.dtype == np.float32
    np.testing.assert_array_equal(dataset.heights, again.heights)
    assert dataset.heights.attrs["pixel_size"] == again.pixel_size
    assert dataset.heights.attrs["units"] == dataset.x.attrs["units"] == "nm"
    assert (bool(dataset.attrs["periodic"]), dataset.attrs["basis"]) == (True, "measured")
    # The centres of the pixels.
    np.testing.assert_allclose(dataset.x, (np.arange(12) + 0.5) * surface.pixel_size)
    np.testing.assert_allclose(dataset.y, (np.arange(8) + 0.5) * surface.pixel_size)


def test_size_of_a_square_map():
    surface = HeightMap(np.zeros((5, 5)), 3.0, periodic=False, basis="substitute")
    assert (surface.pixels, surface.size) == (5, 15.0)


def test_a_damaged_map_is_one_clear_line(tmp_path, surface):
    netcdf.write(surface.arrays(), tmp_path / "a.nc")
    message = refusal(read_height_map, cut(tmp_path / "a.nc", 0.5))
    assert_says(message, "a.nc: expected a complete netCDF file, found")


@pytest.mark.parametrize("module", ["height_map", "filters", "topography", "spectrum", "synthesis"])
def test_import_costs_numpy_and_netcdf_alone(module):
    heavy = ["xarray", "pandas", "scipy", "SurfaceTopography", "matplotlib"]
    code = (
        f"import sys, hardcontact.surfaces.{module}\n"
        f"print([name for name in {heavy} if name in sys.modules])"
    )
    run = subprocess.run(
        [sys.executable, "-c", code],
        env=os.environ | {"PYTHONPATH": str(ROOT / "workflow")},
        text=True,
        capture_output=True,
    )
    assert run.stdout == "[]\n", run.stdout + run.stderr
