"""Datasets are whole or not there."""

from pathlib import Path

import pytest
import xarray as xr
from conftest import assert_says, cut, heights, refusal

from hardcontact import dataset


@pytest.mark.parametrize("share", [0.0, 0.01, 0.5, 0.9, 0.999])
def test_damaged_dataset(tmp_path, share):
    path = tmp_path / "a.nc"
    values = xr.Dataset({"heights": (("y", "x"), heights(64, 64))})
    dataset.write(values, path, title="a", parameters="{}", inputs=[], code=[])
    assert dataset.read(path).heights.shape == (64, 64)
    message = refusal(dataset.read, cut(path, share))
    assert_says(message, "a.nc", "expected a complete netCDF file", "found")


def test_missing_dataset(tmp_path):
    assert_says(refusal(dataset.read, tmp_path / "a.nc"), "a.nc", "expected", "found")


def test_a_failing_write_leaves_what_was_there(tmp_path):
    (tmp_path / "old.nc").write_text("whole")
    for target in (tmp_path / "new.nc", tmp_path / "old.nc"):
        with pytest.raises(RuntimeError), dataset.atomic_path(target) as temporary:
            Path(temporary).write_text("half")
            raise RuntimeError
    assert [path.read_text() for path in tmp_path.iterdir()] == ["whole"]
