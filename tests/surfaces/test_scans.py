"""Bad scans: one line that names the file, what was expected and what was found."""

import numpy as np
import pytest
from refusals import assert_says, refusal
from scan_files import container, cut, heights, scan

from hardcontact.surfaces import scans


def test_a_good_scan_is_read_in_nm_with_rows_along_y(tmp_path):
    values = heights(32, 32)
    height_map = scans.read_scan(scan(tmp_path / "a.nc", values, (32.0, 32.0), "µm"))
    assert height_map.pixel_size == pytest.approx(1000.0)
    assert (height_map.periodic, height_map.basis) == (False, "measured")
    np.testing.assert_allclose(height_map.heights, 1000 * values.T, rtol=1e-6)
    assert scans.read_scan(tmp_path / "a.nc", basis="substitute").basis == "substitute"


@pytest.mark.parametrize("share", [0.01, 0.3, 0.7, 0.999])
def test_truncated_scan(tmp_path, share):
    message = refusal(scans.read_scan, cut(scan(tmp_path / "a.nc"), share))
    assert_says(message, "a.nc", "expected a whole file", "found")


def test_scan_without_physical_size(tmp_path):
    np.save(tmp_path / "a.npy", heights())
    np.savetxt(tmp_path / "a.txt", heights())
    for name in ("a.npy", "a.txt"):
        message = refusal(scans.read_scan, tmp_path / name)
        assert_says(message, name, "expected", "physical size", "found none")


def test_scan_without_unit(tmp_path):
    message = refusal(scans.read_scan, scan(tmp_path / "a.nc", unit=None))
    assert_says(message, "a.nc", "expected a unit of length", "found none")


def test_scan_in_a_unit_that_is_no_length(tmp_path):
    np.savetxt(tmp_path / "a.txt", heights())
    entry = {"name": "a", "datafile": {"original": "a.txt"}, "size": [320, 320], "unit": "V"}
    path = container(tmp_path / "a.zip", [entry], {"a.txt": tmp_path / "a.txt"})
    assert_says(refusal(scans.read_scan, path, "a"), "a.zip", "unit", "V")


@pytest.mark.parametrize(("lines", "undefined"), [(32, 1024), (17, 544)])
def test_scans_that_are_more_filled_than_measured_are_refused(tmp_path, lines, undefined):
    values = np.ma.masked_array(np.random.default_rng(0).random((32, 32)), False)
    values[:lines] = np.ma.masked
    path = scan(tmp_path / "a.nc", values)
    said = refusal(scans.read_scan, path, "", "harmonic")
    assert_says(said, "a.nc", "at most 50%", f"{undefined} of 1024")


def test_dataset_of_a_single_file(tmp_path):
    # Where there is one channel, there is none to choose.
    assert scans.read_measurement(scan(tmp_path / "a.nc"), "first").dataset == ""


def text_entry(name, file):
    return {"name": name, "datafile": {"original": file}, "size": [320, 320], "unit": "nm"}


def test_container_without_the_dataset(tmp_path):
    path = container(tmp_path / "a.zip", [text_entry("one", "1.txt"), text_entry("two", "2")], {})
    for dataset_name in ("three", ""):
        message = refusal(scans.read_scan, path, dataset_name)
        assert_says(message, "a.zip", "column dataset", "one, two", f"found {dataset_name!r}")
    assert_says(refusal(scans.read_scan, path, "one"), "a.zip", "the data file 1.txt")


def test_container_with_two_datasets_of_one_name(tmp_path):
    np.savetxt(tmp_path / "a.txt", heights())
    entries = [text_entry("one", "1.txt"), text_entry("one", "2.txt")]
    files = dict.fromkeys(("1.txt", "2.txt"), tmp_path / "a.txt")
    path = container(tmp_path / "a.zip", entries, files)
    message = refusal(scans.read_scan, path, "one")
    assert_says(message, "expected one scan 'one'", "found 1.txt, 2.txt")
    assert scans.read_scan(path, "2.txt").pixel_size == pytest.approx(10.0)


def test_container_says_what_its_data_file_does_not(tmp_path):
    values = heights()
    np.savetxt(tmp_path / "a.txt", values)
    entry = text_entry("one", "a.txt") | {"height_scale": 2.5}
    path = container(tmp_path / "a.zip", [entry], {"a.txt": tmp_path / "a.txt"})
    height_map = scans.read_scan(path, "one")
    assert height_map.pixel_size == pytest.approx(10.0)
    assert height_map.heights.std() == pytest.approx(2.5 * values.std())
