"""Damaged datasets are refused; sound ones are stacked along new dimensions."""

import numpy as np
import pytest
import xarray as xr
from refusals import assert_says, refusal
from scan_files import random_heights, truncate_file

from hardcontact.base.dataset import read_dataset, stack, write_dataset


def test_texts_of_different_length_are_stacked_whole(tmp_path):
    for name, word in {"a": "pixels", "b": "smoothing"}.items():
        write_dataset(xr.Dataset({"limit": ("scan", [word])}), tmp_path / name)
    datasets = {(name,): read_dataset(tmp_path / name) for name in ("a", "b")}
    write_dataset(stack(datasets, ["surface"]), tmp_path / "both")
    limits = read_dataset(tmp_path / "both")["limit"].values
    assert limits.ravel().tolist() == ["pixels", "smoothing"]


def test_equal_datasets_make_equal_files(tmp_path):
    for name in ("a.nc", "b.nc"):
        write_dataset(xr.Dataset({"texts": ("x", ["a", "ü"]), "n": ("x", [1, 2])}), tmp_path / name)
    assert (tmp_path / "a.nc").read_bytes() == (tmp_path / "b.nc").read_bytes()


@pytest.mark.parametrize("content", [b"", b"CDF", b"no netCDF", 0.01, 0.5, 0.999, None])
def test_a_damaged_dataset_is_refused(tmp_path, content):
    """The file has other content, is truncated to a share of its length, or is missing."""
    path = tmp_path / "a.nc"
    if isinstance(content, float):
        write_dataset(xr.Dataset({"heights": (("y", "x"), random_heights(64, 64))}), path)
        truncate_file(path, content)
    elif content is not None:
        path.write_bytes(content)
    assert_says(refusal(read_dataset, path), "a.nc: expected a complete netCDF file, found: ")


def test_datasets_are_stacked_in_the_order_of_their_keys_with_nan_for_missing_ones():
    labels = [("uncd", 2), ("uncd", 1), ("mcd", 2)]
    datasets = {label: xr.Dataset({"force": ("contact", [*label[1:]])}) for label in labels}
    forces = stack(datasets, ("surface", "scan"))["force"]
    assert forces.dims == ("surface", "scan", "contact")
    assert forces["surface"].values.tolist() == ["uncd", "mcd"]
    np.testing.assert_array_equal(forces.sel(scan=[2, 1])[..., 0], [[2, 1], [2, np.nan]])
