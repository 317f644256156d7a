"""Labelled datasets: whole or not there, joined along new dimensions."""

import numpy as np
import pytest
import xarray as xr
from refusals import assert_says, refusal
from scan_files import cut, heights

from hardcontact.records import dataset


@pytest.mark.parametrize("file_format", ["NETCDF4", "NETCDF3_64BIT"])
def test_what_is_written_is_read_back(tmp_path, file_format):
    values = xr.Dataset({"heights": (("y", "x"), heights(8, 8))}, attrs={"title": "a"})
    dataset.write(values, tmp_path / "a.nc", file_format)
    xr.testing.assert_identical(dataset.read(tmp_path / "a.nc"), values)


def test_equal_datasets_make_equal_files(tmp_path):
    for name in ("a.nc", "b.nc"):
        dataset.write(xr.Dataset({"texts": ("x", ["a", "ü"]), "n": ("x", [1, 2])}), tmp_path / name)
    assert (tmp_path / "a.nc").read_bytes() == (tmp_path / "b.nc").read_bytes()


@pytest.mark.parametrize("content", [b"", b"CDF", b"\x89HDF\r\n\x1a\n", b"no netCDF", bytes(4096)])
def test_another_file_is_refused(tmp_path, content):
    (tmp_path / "a.nc").write_bytes(content)
    assert_says(
        refusal(dataset.read, tmp_path / "a.nc"), "expected a complete netCDF file, found: "
    )


def test_a_missing_file_is_refused(tmp_path):
    assert_says(refusal(dataset.read, tmp_path / "a.nc"), "a.nc: expected", "No such file")


@pytest.mark.parametrize("share", [0.0, 0.01, 0.5, 0.9, 0.999])
def test_a_truncated_file_is_refused(tmp_path, share):
    path = tmp_path / "a.nc"
    dataset.write(xr.Dataset({"heights": (("y", "x"), heights(64, 64))}), path)
    message = refusal(dataset.read, cut(path, share))
    assert_says(message, "a.nc: expected a complete netCDF file", "found")


def test_a_failing_write_leaves_no_file(tmp_path):
    with pytest.raises(ValueError, match="unable to infer dtype"):
        dataset.write(xr.Dataset({"a": ("x", [{}])}), tmp_path / "a.nc")
    assert list(tmp_path.iterdir()) == []


def parts(*labels):
    """Make datasets of two forces each, all different."""
    return {
        label: xr.Dataset({"force": ("contact", [number, 10.0 * number])})
        for number, label in enumerate(labels)
    }


def test_parts_are_joined_in_the_order_of_their_keys():
    made = parts(("uncd", 2), ("uncd", 1), ("mcd", 2), ("mcd", 1))
    joined = dataset.stack(made, ("surface", "scan"))
    assert joined.force.dims == ("surface", "scan", "contact")
    assert joined.surface.values.tolist() == ["uncd", "mcd"]
    assert joined.scan.values.tolist() == [2, 1]
    for (surface, scan), part in made.items():
        np.testing.assert_array_equal(joined.force.sel(surface=surface, scan=scan), part.force)


def test_missing_parts_are_nan():
    made = parts(("uncd", 2), ("uncd", 1), ("mcd", 2))
    joined = dataset.stack(made, ("surface", "scan"))
    assert joined.scan.values.tolist() == [1, 2]
    assert joined.force.sel(surface="mcd", scan=1).isnull().all()
    np.testing.assert_array_equal(joined.force.sel(surface="uncd", scan=1), made["uncd", 1].force)


def test_no_dimension_leaves_the_only_part():
    made = parts(())
    assert dataset.stack(made, ()) is made[()]
