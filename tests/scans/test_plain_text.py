"""Plain texts of scans are read with commas, encodings, gaps, two units or no size."""

import numpy as np
import pytest
from refusals import assert_says, refusal
from scan_files import random_heights

from hardcontact.scans.plain_text import readable_text
from hardcontact.scans.reading import read_scan

PIXELS = 24
MAP = random_heights(PIXELS, PIXELS)  # in nm, on pixels of 10 nm
HEADER = ["# Channel: Height", "# Width: 0,240 µm", "# Height: 0,240 µm", "# Value units: m"]


def matrix(separator, form="{:.4f}", scale=1.0):
    """Return the rows of MAP as texts."""
    return [separator.join(form.format(scale * height) for height in row) for row in MAP]


def write_lines(path, lines, encoding="utf-8", end="\n"):
    path.write_bytes((end.join(lines) + end).encode(encoding))
    return path


def use_decimal_commas(lines):
    return [line.replace(".", ",") for line in lines]


ROWS_IN_METRES = matrix("\t", "{:.6e}", 1e-9)


@pytest.mark.parametrize(
    ("encoding", "has_commas"),
    [("utf-8", False), ("utf-8-sig", True), ("latin-1", True), ("utf-16", False)],
)
def test_a_matrix_with_a_header_is_read_in_every_encoding(tmp_path, encoding, has_commas):
    header = [line if has_commas else line.replace(",", ".") for line in HEADER]
    lines = [*header, *(use_decimal_commas(ROWS_IN_METRES) if has_commas else ROWS_IN_METRES)]
    scan = read_scan(write_lines(tmp_path / "a.txt", lines, encoding, "\r\n"))
    assert scan.pixel_size == pytest.approx(10.0)
    np.testing.assert_allclose(scan.heights, MAP, atol=1e-4)
    assert scan.notes == (("decimal commas read",) if has_commas else ())


MATRICES = {
    "blanks": matrix(" "),
    "commas": matrix(","),
    "commas and blanks": matrix(", "),
    "semicolons": matrix(";"),
    "decimal commas, semicolons": use_decimal_commas(matrix(";")),
    "decimal commas, tabs": use_decimal_commas(matrix("\t")),
    "a comma at the end": [f"{row}," for row in matrix(",")],
}


@pytest.mark.parametrize("name", MATRICES)
def test_a_bare_matrix_is_read_with_its_size_and_unit(tmp_path, name):
    path = write_lines(tmp_path / "a.csv", MATRICES[name])
    message = refusal(read_scan, path)
    assert_says(message, "physical size and unit", "found none", "--size 5000nm", "--unit nm")
    assert_says(refusal(read_scan, path, unit="nm"), "--size 5000nm", "scan.map_size")
    message = refusal(read_scan, path, map_size=240.0)
    assert_says(message, "expected a unit of length", "--unit nm")
    assert "--size" not in message
    scan = read_scan(path, unit="nm", map_size=240.0)
    assert scan.pixel_size == pytest.approx(10.0)
    np.testing.assert_allclose(scan.heights, MAP, atol=1e-4)
    coarse = read_scan(path, unit="mm,nm", map_size=480.0)  # the unit of positions is not used
    assert coarse.pixel_size == pytest.approx(20.0)
    np.testing.assert_allclose(coarse.heights, MAP, atol=1e-4)


def test_the_given_size_is_the_longer_side_of_files_without_a_size(tmp_path):
    path = write_lines(tmp_path / "a.txt", matrix(" ")[:20])
    assert read_scan(path, unit="nm", map_size=240.0).pixel_size == pytest.approx(10.0)
    path = write_lines(
        tmp_path / "b.txt", [*(line.replace(",", ".") for line in HEADER), *ROWS_IN_METRES]
    )
    scan = read_scan(path, unit="m", map_size=240.0)
    assert scan.pixel_size == pytest.approx(10.0) and scan.notes == ()


@pytest.mark.parametrize("word", ["", "nan", "***", "undefined"])
def test_empty_cells_and_words_are_undefined_pixels(tmp_path, word):
    rows = matrix(";")
    rows[3] = rows[3].replace(rows[3].split(";")[5], word, 1)
    path = write_lines(tmp_path / "a.csv", rows)
    scan = read_scan(path, undefined_pixels="harmonic", unit="nm", map_size=240.0)
    assert scan.undefined_count == 1
    defined = np.ones((PIXELS, PIXELS), bool)
    defined[3, 5] = False
    np.testing.assert_allclose(scan.heights[defined], MAP[defined], atol=1e-4)


Y, X = (10.0 * axis.ravel() for axis in np.indices((PIXELS, PIXELS)))
POINTS = np.column_stack([X, Y, MAP.ravel()])
GAPS = np.random.default_rng(2).choice(len(POINTS), 30, replace=False)  # points left out


def write_points(path, points, separator=" "):
    np.savetxt(path, points, "%.6f", separator)
    return path


@pytest.mark.parametrize(("separator", "step"), [(" ", 1), (",", -1), (";", 1)])
def test_missing_points_are_undefined_pixels(tmp_path, separator, step):
    points = np.delete(POINTS, GAPS, axis=0)[::step]
    path = write_points(tmp_path / "a.xyz", points, separator)
    assert_says(refusal(read_scan, path, unit="nm"), "undefined", "found 30")
    scan = read_scan(path, undefined_pixels="harmonic", unit="nm")
    assert scan.pixel_size == pytest.approx(10.0) and scan.undefined_count == 30
    defined = np.delete(np.arange(len(POINTS)), GAPS)
    np.testing.assert_allclose(scan.heights.ravel()[defined], POINTS[defined, 2], atol=1e-5)
    notes = ("unit nm (given by the user)", "30 undefined pixels of 576 filled")
    assert scan.notes == notes


@pytest.mark.parametrize("gaps", [[], GAPS])
def test_points_may_have_two_units(tmp_path, gaps):
    points = np.delete(POINTS, gaps, axis=0) * [1e-3, 1e-3, 1]  # positions in µm
    path = write_points(tmp_path / "a.xyz", points)
    scan = read_scan(path, undefined_pixels="harmonic", unit="um,nm")
    assert scan.pixel_size == pytest.approx(10.0)
    assert scan.heights.ravel()[5] == pytest.approx(MAP.ravel()[5], abs=1e-5)
    message = refusal(read_scan, path, undefined_pixels="harmonic", unit="um")
    assert_says(message, "--unit mm,nm (scan.unit: mm,nm) gives")
    line = write_points(tmp_path / "b.txt", np.column_stack([1e-3 * X[:PIXELS], MAP[0]]))
    np.testing.assert_allclose(read_scan(line, unit="um,nm").heights, MAP[0], atol=1e-5)
    angstroms = write_points(tmp_path / "c.xyz", points * [1, 1, 10])
    for unit in ("um,angstrom", "um,Å"):
        scan_in_angstroms = read_scan(angstroms, undefined_pixels="harmonic", unit=unit)
        np.testing.assert_allclose(scan_in_angstroms.heights, scan.heights, atol=1e-5)


@pytest.mark.parametrize("gaps", [[], GAPS])
def test_points_near_those_of_a_grid_are_interpolated_on_the_grid(tmp_path, gaps):
    rng = np.random.default_rng(3)
    points = POINTS.copy()
    points[:, :2] += rng.normal(0, 0.8, (len(POINTS), 2))  # up to a quarter of a pixel
    points[:, 2] = 5 * np.sin(points[:, 0] / 40) * np.cos(points[:, 1] / 50)
    path = write_points(tmp_path / "a.xyz", rng.permutation(np.delete(points, gaps, axis=0)))
    scan = read_scan(path, undefined_pixels="harmonic", unit="nm")
    assert scan.heights.shape == MAP.shape and scan.undefined_count == len(gaps)
    assert scan.pixel_size == pytest.approx(10.0, rel=0.01)
    true_heights = (5 * np.sin(X / 40) * np.cos(Y / 50)).reshape(MAP.shape)
    inner = np.s_[2:-2, 2:-2]
    np.testing.assert_allclose(scan.heights[inner], true_heights[inner], atol=0.2)
    assert_says(scan.notes[0], "beside a grid", "interpolated")


@pytest.mark.parametrize(
    "points",
    [
        np.random.default_rng(1).uniform(0, 100, (400, 3)),  # on no grid
        np.random.default_rng(1).permutation(POINTS)[:200],  # mostly gaps
        np.vstack([POINTS[:-1], POINTS[:1]]),  # one twice
    ],
)
def test_points_that_make_no_map_are_refused(tmp_path, points):
    path = write_points(tmp_path / "a.xyz", points)
    message = refusal(read_scan, path, undefined_pixels="harmonic", unit="nm")
    assert_says(message, "a.xyz: expected points x, y, height on a regular grid")


@pytest.mark.parametrize(
    "content",
    [b"\0\1\2", b"PK\3\4" + bytes(9), b"", b"words, and; others\n", b"1,2\n3,4\n", b"x\n1.5 2\n"],
)
def test_content_that_is_no_scan_changes_in_its_separators_at_most(content):
    assert readable_text(content)[0].replace(b" ", b",") == content.replace(b" ", b",")
