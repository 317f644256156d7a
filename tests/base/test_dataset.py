"""Damaged datasets are refused; sound datasets are stacked, and their variables described."""

import numpy as np
import pytest
import xarray as xr
from refusals import assert_says, refusal
from scan_files import random_heights, truncate_file

from hardcontact.base.dataset import (
    describe_variables,
    read_dataset,
    read_meanings,
    stack,
    write_dataset,
)


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


def test_variables_are_described_and_others_keep_their_names():
    named = xr.DataArray(1.0, attrs={"units": "N", "long_name": "Own."})
    data = xr.Dataset({"force": 1.0, "force_interval": 2.0, "named": named, "scan": 3})
    result = describe_variables(data, {"force": "Force."})
    names = {name: result[name].attrs.get("long_name") for name in result}
    assert names == {
        "force": "Force.", "force_interval": "Force.", "named": "Own.", "scan": None,
    }  # fmt: skip
    assert result.scan.units == "1" and "units" not in result.force.attrs
    assert data.force.attrs == {}


def test_the_meaning_in_one_dataset_overrides_that_in_all(tmp_path, monkeypatch):
    table = tmp_path / "variables.tsv"
    table.write_text("dataset\tvariable\tmeaning\n*\ta\tAll.\n*\tb\tAll.\none\ta\tOne.\n")
    monkeypatch.setattr("hardcontact.base.dataset.MEANINGS", table)
    assert read_meanings("one") == {"a": "One.", "b": "All."}
    assert read_meanings("another") == {"a": "All.", "b": "All."}
