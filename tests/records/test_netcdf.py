"""Arrays on disk: what is written is read back, here and by xarray."""

import subprocess
import sys

import numpy as np
import pytest
import xarray as xr
from refusals import assert_says, refusal
from repository import ROOT, environment
from scan_files import cut

from hardcontact.records import dataset, netcdf
from hardcontact.records.netcdf import Arrays

VALUES = {
    "doubles": (("y", "x"), np.array([[0.0, -1.5e-300, np.nan], [np.inf, 9.969e36, 1 / 3]])),
    "floats": (("x",), np.array([1 / 3, np.nan, -1e38], dtype="float32")),
    "whole": (("x",), np.array([-(2**62), 0, 2**62])),
    "small": (("y",), np.array([-128, 127], dtype="int8")),
    "number": ((), np.array(5.6)),
    "count": ((), np.array(7)),
    "text": ((), np.array("ρ in µm")),
    "texts": (("y", "x"), np.array([["", "a", "ü"], ["plastic", "rigid", "λ_S"]])),
    "none": (("nothing",), np.zeros(0)),
}
COORDINATES = {
    "x": (("x",), np.array([0.5, 1.5, 2.5])),
    "y": (("y",), np.array(["uncd", "ncd"])),
    "label": (("y",), np.array(["UNCD", "NCD"])),
    "scan": ((), np.array(3)),
}
ATTRIBUTES = {"title": "a title", "periodic": 1, "pixel_size": 4.8828125, "note": "µ"}


def described(values):
    """Give every array attributes of its own."""
    return {
        name: (dimensions, array, {"units": "nm", "long_name": f"{name} µ", "share": 0.1})
        for name, (dimensions, array) in values.items()
    }


ARRAYS = Arrays(described(VALUES), described(COORDINATES), ATTRIBUTES)


def assert_same(arrays, others):
    assert arrays.attributes == others.attributes
    for part, other in zip(arrays[:2], others[:2], strict=True):
        assert part.keys() == other.keys()
        for name, (dimensions, values, attributes) in part.items():
            assert other[name][0] == dimensions and other[name][2] == attributes, name
            np.testing.assert_array_equal(other[name][1], values)
            assert np.asarray(other[name][1]).dtype.kind == values.dtype.kind, name
            assert values.dtype.kind == "U" or other[name][1].dtype == values.dtype, name


def test_what_is_written_is_read_back(tmp_path):
    netcdf.write(ARRAYS, tmp_path / "a.nc")
    assert_same(ARRAYS, netcdf.read(tmp_path / "a.nc"))


def test_xarray_reads_what_is_written(tmp_path):
    netcdf.write(ARRAYS, tmp_path / "a.nc")
    xr.testing.assert_identical(dataset.read(tmp_path / "a.nc"), xr.Dataset(*ARRAYS))


def test_what_xarray_writes_is_read(tmp_path):
    dataset.write(xr.Dataset(*ARRAYS), tmp_path / "a.nc")
    assert_same(ARRAYS, netcdf.read(tmp_path / "a.nc"))


def test_what_is_read_can_be_written_again(tmp_path):
    dataset.write(xr.Dataset(*ARRAYS), tmp_path / "a.nc")
    netcdf.write(netcdf.read(tmp_path / "a.nc"), tmp_path / "b.nc")
    xr.testing.assert_identical(dataset.read(tmp_path / "b.nc"), dataset.read(tmp_path / "a.nc"))


def test_lists_and_numbers_are_arrays_too(tmp_path):
    netcdf.write(Arrays({"a": (("x",), [1, 2], {}), "b": ((), 0.5, {})}, {}, {}), tmp_path / "a.nc")
    variables = netcdf.read(tmp_path / "a.nc").variables
    assert variables["a"][1].tolist() == [1, 2] and variables["b"][1] == 0.5


def test_equal_arrays_make_equal_files(tmp_path):
    for name in ("a.nc", "b.nc"):
        netcdf.write(ARRAYS, tmp_path / name)
    assert (tmp_path / "a.nc").read_bytes() == (tmp_path / "b.nc").read_bytes()


def test_dimensions_that_contradict_each_other_leave_no_file(tmp_path):
    arrays = Arrays({"a": (("x",), [1, 2], {}), "b": (("x",), [1, 2, 3], {})}, {}, {})
    with pytest.raises((ValueError, IndexError)):
        netcdf.write(arrays, tmp_path / "a.nc")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("share", [0.0, 0.01, 0.3, 0.5, 0.7, 0.9, 0.999])
@pytest.mark.parametrize("read", [netcdf.read, dataset.read])
def test_a_truncated_file_is_refused(tmp_path, read, share):
    netcdf.write(ARRAYS, tmp_path / "a.nc")
    message = refusal(read, cut(tmp_path / "a.nc", share))
    assert_says(message, "a.nc: expected a complete netCDF file, found: ", "delete it")


@pytest.mark.parametrize("content", [b"", b"CDF", b"\x89HDF\r\n\x1a\n", b"no netCDF", bytes(4096)])
def test_another_file_is_refused(tmp_path, content):
    (tmp_path / "a.nc").write_bytes(content)
    for read in (netcdf.read, dataset.read):
        assert_says(refusal(read, tmp_path / "a.nc"), "expected a complete netCDF file, found: ")


def test_a_missing_file_is_refused(tmp_path):
    for read in (netcdf.read, dataset.read):
        assert_says(refusal(read, tmp_path / "a.nc"), "a.nc: expected", "No such file")


def test_xarray_is_not_imported():
    """Importing it takes longer than many jobs compute."""
    run = subprocess.run(
        [
            sys.executable,
            "-c",
            "import sys\nfrom hardcontact.records import log, netcdf, origin\n"
            "from hardcontact.records import job\n"
            "sys.exit(str({'xarray', 'pandas', 'scipy'} & set(sys.modules) or ''))",
        ],
        env=environment(ROOT),
        capture_output=True,
        text=True,
    )
    assert run.stderr.strip() == "", run.stderr
