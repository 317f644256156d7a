"""Reading of scans of every kind, in formats that can be written here: heights, spacing, notes."""

import gzip
from dataclasses import fields, replace

import numpy as np
import pytest
from refusals import assert_says, refusal
from scan_files import (
    MAP_WRITERS,
    SCAN_WRITERS,
    random_heights,
    write_container,
    write_nanoscope,
    write_scan,
)
from SurfaceTopography import NonuniformLineScan, Topography, UniformLineScan

from hardcontact.base.dataset import write_dataset
from hardcontact.scans.formats import find_tip_radius
from hardcontact.scans.reading import list_scans, read_scan
from hardcontact.surfaces.height_map import HeightMap, load_height_map, refuse_line_scan


def write_and_list(write, path, topography):
    """Write a topography; return the path and the dataset of the file."""
    write(topography, path)
    (dataset,) = list_scans(path)
    return path, dataset


def map_of(heights):
    """Return a map with heights (x, y) in nm on pixels of 10 nm."""
    return Topography(heights, tuple(10.0 * count for count in heights.shape), unit="nm")


def write_columns(path, *columns, unit="nm"):
    header = f"Lateral units: {unit}\nValue units: {unit}"
    np.savetxt(path, np.column_stack(columns), fmt="%.9g", header=header)
    return path


#: Shape (x, y) of a map, the square that is read, and the note on it.
TALL = ((48, 32), np.s_[8:40, :], ["cropped from 48 x 32 to 32 x 32 pixels"])
WIDE = ((32, 51), np.s_[:, 9:41], ["cropped from 32 x 51 to 32 x 32 pixels"])


@pytest.mark.parametrize(
    ("suffix", "shape", "square", "notes"),
    [
        *((suffix, *TALL) for suffix in MAP_WRITERS),
        ("nc", *WIDE),
        ("nc", (32, 32), np.s_[:, :], []),
    ],
)
def test_a_map_is_read_as_its_central_square(tmp_path, suffix, shape, square, notes):
    heights = random_heights(*shape)
    file = write_and_list(MAP_WRITERS[suffix], tmp_path / f"a.{suffix}", map_of(heights))
    scan = read_scan(*file)
    np.testing.assert_allclose(scan.heights, heights[square].T, atol=1e-12)
    assert scan.pixel_size == pytest.approx(10.0)
    assert scan.kind == "map" and scan.undefined_count == 0
    assert scan.tip_radius is None
    assert [note for note in scan.notes if "cropped" in note] == notes


@pytest.mark.parametrize("suffix", MAP_WRITERS)
def test_gaps_of_a_map_are_filled_harmonically(tmp_path, suffix):
    x, y = np.mgrid[:32, :32]
    saddle = 0.3 * x - 0.2 * y + 0.01 * x * y  # harmonic, so filling restores it
    heights = np.ma.masked_array(saddle, False)
    heights[3, 4:9] = heights[20:24, 20:24] = np.ma.masked
    file = write_and_list(MAP_WRITERS[suffix], tmp_path / f"a.{suffix}", map_of(heights))
    assert_says(refusal(read_scan, *file), "found 21", "scan.undefined_pixels: harmonic")
    scan = read_scan(*file, undefined_pixels="harmonic")
    np.testing.assert_allclose(scan.heights, saddle.T, atol=1e-9)
    assert scan.undefined_count == 21
    assert "21 undefined pixels of 1024 filled" in scan.notes


def test_a_round_aperture_is_cropped_to_the_square_inside(tmp_path):
    y, x = np.indices((64, 64)) - 31.5
    heights = np.ma.masked_array(np.arange(64.0**2).reshape(64, 64), np.hypot(y, x) > 32)
    heights[30, 30] = np.ma.masked  # a gap inside is filled
    scan = read_scan(
        write_scan(tmp_path / "a.nc", heights, (640.0, 640.0)), undefined_pixels="harmonic"
    )
    assert (scan.pixels, scan.undefined_count) == (45, 1)
    assert scan.pixels == pytest.approx(64 / np.sqrt(2), abs=1)
    small = heights[22:42, 22:42]
    y, x = np.indices(small.shape) - 9.5
    path = write_scan(tmp_path / "small.nc", np.ma.masked_where(np.hypot(y, x) > 10, small))
    assert_says(
        refusal(read_scan, path, undefined_pixels="harmonic"),
        "expected 16 to 8192 pixels",
        "found 1",
    )


def test_a_unit_and_a_size_that_the_file_contradicts_are_not_used_in_silence(tmp_path):
    path = write_scan(tmp_path / "a.nc", random_heights(32, 32), (320.0, 320.0))
    assert read_scan(path, unit="nm", map_size=320.0).notes == ()
    scan = read_scan(path, unit="um", map_size=640.0)
    assert scan.size == pytest.approx(320.0)
    assert_says("; ".join(scan.notes), "unit, um, is not used", "states nm", "640 nm", "320 nm")


@pytest.mark.parametrize("axis", [0, 1])
def test_a_map_is_too_steep_along_either_axis(tmp_path, axis):
    steps = 1e6 * (np.indices((32, 32))[axis] % 2)
    path = write_scan(tmp_path / "a.nc", steps, (320.0, 320.0))
    assert_says(refusal(read_scan, path), "a mean slope of at most 10")


def test_heights_under_a_mask_count_unless_it_is_excluded(tmp_path):
    path = tmp_path / "marked.gwy"
    heights = random_heights(32, 32)
    is_marked = heights > np.sort(heights, None)[-20]
    map_of(np.ma.masked_array(heights, is_marked)).to_gwy(str(path))
    # The writer fills masked pixels with zeros.
    metres = (heights * 1e-9).T.astype("<f8")
    holed = np.where(is_marked.T, 0, metres)
    path.write_bytes(path.read_bytes().replace(holed.tobytes(), metres.tobytes()))
    unmasked = read_scan(path)
    np.testing.assert_allclose(unmasked.heights, heights.T, atol=1e-12)
    assert_says(unmasked.notes[0], "take care", "marks 19 of 1024 pixels", "--mask exclude")
    assert read_scan(path, undefined_pixels="harmonic", mask="exclude").undefined_count == 19


def test_only_gaps_in_the_square_are_filled_and_at_most_half_of_it(tmp_path):
    heights = np.ma.masked_array(random_heights(48, 32), False)
    heights[:8] = heights[40:] = np.ma.masked
    assert read_scan(write_scan(tmp_path / "a.nc", heights, (480.0, 320.0))).undefined_count == 0
    heights[:25] = np.ma.masked
    path = write_scan(tmp_path / "a.nc", heights, (480.0, 320.0))
    message = refusal(read_scan, path, undefined_pixels="harmonic")
    assert_says(message, "a.nc", "at most 50%", "found 544 of 1024")


def test_pixels_that_are_not_square_are_resampled_to_the_larger_width(tmp_path):
    x, y = np.mgrid[:48, :64]
    heights = np.ma.masked_array(0.3 * x - 0.2 * y, False)  # linear: interpolation is exact
    heights[20, 31] = np.ma.masked
    file = write_scan(tmp_path / "a.nc", heights, (960.0, 640.0))  # 20 nm x 10 nm
    scan = read_scan(file, undefined_pixels="harmonic")
    assert scan.pixel_size == pytest.approx(20.0) and scan.undefined_count == 0
    heights_on_grid = (0.3 * x - 0.2 * y)[8:40, ::2].T
    np.testing.assert_allclose(scan.heights, heights_on_grid, atol=1e-9)
    assert scan.notes[0] == "resampled from pixels of 20 nm x 10 nm to 20 nm"
    assert len(scan.notes) == 2  # with the gap that was filled
    flat = write_scan(tmp_path / "b.nc", sizes=(320.0, 3200.0))
    assert_says(refusal(read_scan, flat), "16 to 8192 pixels", "found 3 x 32")


def test_a_file_that_may_state_a_wrong_size_has_a_caution(tmp_path):
    square = read_scan(write_scan(tmp_path / "b.nc", random_heights(48, 32), (300.0, 300.0)))
    assert_says(
        square.notes[1],
        "take care: the file states 300 nm x 300 nm for 48 x 32 pixels",
        "if its pixels are square, 300 nm x 200 nm were scanned",
        "stretched 1.5 times along y",
    )
    # A text that was cut short looks as if its pixels were not square.
    map_of(random_heights(64, 64)).to_matrix(str(tmp_path / "a.asc"))
    lines = (tmp_path / "a.asc").read_text().splitlines()
    (tmp_path / "a.asc").write_text("\n".join(lines[: len(lines) // 2]))
    resampled = read_scan(tmp_path / "a.asc")
    assert_says("; ".join(resampled.notes), "resampled", "take care", "lines are missing")


def test_a_file_of_gzip_is_read_like_the_file_in_it(tmp_path):
    path = write_scan(tmp_path / "a.nc")
    (tmp_path / "a.nc.gz").write_bytes(gzip.compress(path.read_bytes()))
    np.testing.assert_array_equal(read_scan(tmp_path / "a.nc.gz").heights, read_scan(path).heights)


def test_an_offset_is_subtracted_before_heights_are_judged(tmp_path):
    heights = random_heights(32, 32)
    scan = read_scan(write_scan(tmp_path / "a.nc", heights + 1e8))  # 10 cm
    centred = scan.heights - scan.heights.mean()
    np.testing.assert_allclose(centred, heights.T - heights.mean(), atol=1e-6)
    assert scan.notes == ("offset of 100 mm subtracted",)
    for offset in (1e14, np.inf):  # no digits of a height are left
        message = refusal(
            read_scan, write_scan(tmp_path / "b.nc", heights + offset), undefined_pixels="harmonic"
        )
        assert_says(message, "b.nc: expected")


def test_a_given_unit_serves_files_without_a_unit(tmp_path):
    positions, heights = np.arange(100) * 0.01, 1e-3 * random_heights(100)
    np.savetxt(tmp_path / "a.txt", np.column_stack([positions, heights]))
    assert_says(refusal(read_scan, tmp_path / "a.txt"), "unit", "found none", "--unit")
    scan = read_scan(tmp_path / "a.txt", unit="um")
    assert scan.pixel_size == pytest.approx(10.0) and scan.notes == ("unit um (given by the user)",)
    np.testing.assert_allclose(scan.heights, 1e3 * heights)


@pytest.mark.parametrize("suffix", SCAN_WRITERS)
def test_a_line_scan_is_read_and_its_gaps_are_filled_linearly(tmp_path, suffix):
    heights = np.ma.masked_array(np.linspace(0, 8, 41), False)
    heights[5:9] = np.ma.masked
    profile = UniformLineScan(heights, 410.0, unit="nm")
    file = write_and_list(SCAN_WRITERS[suffix], tmp_path / f"a.{suffix}", profile)
    assert_says(refusal(read_scan, *file), "found 4", "undefined_pixels")
    scan = read_scan(*file, undefined_pixels="harmonic")
    assert (scan.kind, scan.file_unit) == ("line scan", "nm")
    assert scan.undefined_count == 4
    assert scan.pixel_size == pytest.approx(10.0)
    np.testing.assert_allclose(scan.heights, np.linspace(0, 8, 41), atol=1e-12)
    assert not any("resampled" in note for note in scan.notes)
    message = refusal(refuse_line_scan, scan)
    assert_says(message, f"a.{suffix}", "expected a height map, found a line scan")


@pytest.mark.parametrize(
    ("suffix", "unit", "nanometres"), [("nc", "nm", 1.0), ("xyz", "m", 1e9), ("zip", "m", 1e9)]
)
def test_an_uneven_line_scan_is_resampled_on_its_median_spacing(tmp_path, suffix, unit, nanometres):
    # 1e-6 of the unit, which the reader of text takes for nothing, is 1 um for metres.
    positions = np.concatenate([np.arange(0, 300, 10.0), np.arange(300, 401, 20.0)])
    corner = np.abs(positions - 200.0) / 50  # straight between points: interpolation is exact
    line = NonuniformLineScan(positions / nanometres, corner / nanometres, unit=unit)
    scan = read_scan(*write_and_list(SCAN_WRITERS[suffix], tmp_path / f"a.{suffix}", line))
    assert scan.pixel_size == pytest.approx(10.0)
    resampled = np.abs(np.arange(0, 401, 10) - 200.0) / 50
    np.testing.assert_allclose(scan.heights, resampled, atol=1e-9)
    assert scan.notes == ("resampled from spacings of 10 to 20 nm to their median of 10 nm",)


def test_rounded_positions_are_uniform_and_may_run_from_right_to_left(tmp_path):
    positions, heights = np.round(np.arange(200) * 0.09956, 4), random_heights(200)
    for name, order in (("a.xyz", slice(None)), ("b.xyz", slice(None, None, -1))):
        columns = positions[order], 1e-3 * heights[order]
        scan = read_scan(write_columns(tmp_path / name, *columns, unit="µm"))
        assert scan.pixel_size == pytest.approx(99.56, rel=1e-4)
        np.testing.assert_allclose(scan.heights, heights, rtol=1e-6)
        assert scan.notes == ()


@pytest.mark.parametrize(
    ("positions", "message_parts"),
    [
        (np.r_[0:201:10, 196:397:10], ["a reentrant one at point 22"]),
        (np.r_[0:201:10, 200:401:10], ["a reentrant one at point 22"]),
        (np.append(np.arange(40) * 1e-2, 1e6), ["16 to 1048576 points", "found 100000000"]),
        (np.arange(9) * 10, ["16 to 1048576 points", "found 9"]),
    ],
)
def test_faulty_positions_of_a_line_scan_are_refused(tmp_path, positions, message_parts):
    path = write_columns(tmp_path / "a.xyz", positions, random_heights(len(positions)))
    assert_says(refusal(read_scan, path), "a.xyz: expected", *message_parts)


def test_a_nanoscope_file_is_read_with_y_upwards_from_its_channel_of_heights(tmp_path):
    counts = np.round(random_heights(24, 40) * 100)
    path = write_nanoscope(tmp_path / "a.001", counts, (400.0, 240.0), ["Phase", "Height Sensor"])
    scan = read_scan(path)
    assert (scan.channel, scan.file_unit) == ("Height Sensor", "nm")
    assert scan.kind == "map"
    assert scan.notes[0] == "channel Height Sensor read: Phase holds no heights"
    assert scan.pixel_size == pytest.approx(10.0)
    np.testing.assert_allclose(scan.heights, 0.1 * counts[::-1, 8:32], atol=1e-9)


def test_a_channel_of_heights_is_read_by_its_name_or_number(tmp_path):
    counts = np.round(random_heights(24, 40) * 100)
    path = tmp_path / "a.001"
    write_nanoscope(path, counts, (400.0, 240.0), ["Height", "Height Sensor", "Phase"])
    channels = [read_scan(path, name).channel for name in ("", "Height Sensor", "2")]
    assert channels == ["Height", "Height Sensor", "Height Sensor"]
    assert_says(refusal(read_scan, path, "Phase"), "a channel of heights, found only Phase (deg)")
    message = refusal(read_scan, path, "Error")
    assert_says(message, "one of the channels of heights (Height, Height Sensor)", "'Error'")
    assert read_scan(path).notes[0] == "other channels of heights: Height Sensor"
    write_nanoscope(path, counts, (400.0, 240.0), ["Height"])
    assert read_scan(path, "Height").channel == "Height"
    assert_says(refusal(read_scan, path, "Sensor"), "(Height)", "found 'Sensor'")
    write_nanoscope(path, counts, (400.0, 240.0), ["Phase"])
    assert_says(refusal(read_scan, path), "a channel of heights, found only Phase (deg)")


def test_the_channel_that_a_container_names_is_read(tmp_path):
    counts = np.round(random_heights(40, 40) * 100)
    file = write_nanoscope(tmp_path / "a.001", counts, (400.0, 400.0), ["Height", "Height Sensor"])
    entry = {"name": "one", "datafile": {"original": "a.001"}, "data_source": 1}
    path = write_container(tmp_path / "a.zip", [entry | {"height_scale": 0.5}], {"a.001": file})
    scan = read_scan(path, "one")
    assert scan.channel == "Height Sensor" and scan.notes == ()
    assert scan.heights.std() == pytest.approx(0.1 * counts.std())  # the file's scale


def test_a_scan_of_a_container_is_found_by_its_file_or_a_unique_name(tmp_path):
    np.savetxt(tmp_path / "a.txt", random_heights())
    entries = [
        {"name": name, "datafile": {"original": file}, "size": [320, 320], "unit": "nm"}
        for name, file in (("one", "1.txt"), ("one", "2.txt"), ("two", "3.txt"))
    ]
    path = write_container(tmp_path / "a.zip", entries, {"2.txt": tmp_path / "a.txt"})
    for name, message_parts in (
        ("one", ["that names one scan", "found 2 of 'one' among one (1.txt), one (2.txt)"]),
        ("three", ["that names one scan", "found 0 of 'three'"]),
        ("two", ["found one that its reader cannot follow", "no item named '3.txt'"]),
    ):
        assert_says(refusal(read_scan, path, name), "a.zip", *message_parts)
    assert read_scan(path, "2.txt").pixel_size == pytest.approx(10.0)


@pytest.mark.parametrize(
    "topography",
    [map_of(random_heights(48, 32)), UniformLineScan(random_heights(40), 400.0, unit="nm")],
)
@pytest.mark.parametrize("statements", [{"tip_radius": 8.0}, {"tip_radius": None, "notes": ()}])
def test_a_stored_scan_keeps_every_field(tmp_path, topography, statements):
    file = write_and_list(MAP_WRITERS["nc"], tmp_path / "a.nc", topography)
    scan = replace(read_scan(*file), **statements)
    write_dataset(scan.to_dataset(), tmp_path / "stored.nc")
    stored_scan = load_height_map(tmp_path / "stored.nc")
    for field in fields(HeightMap):
        stored_value = getattr(stored_scan, field.name)
        np.testing.assert_array_equal(stored_value, getattr(scan, field.name))


def instrument(value, unit):
    return {"instrument": {"parameters": {"tip_radius": {"value": value, "unit": unit}}}}


WORDS = {"description": "tip radius 7 nm"}


@pytest.mark.parametrize(
    ("file", "container", "radius"),
    [
        ({}, {"description": "Tip radius: 8 nm."}, 8.0),
        ({}, {"description": "Initial tip radii - 17 nm. \nFinal tip radii - 26 nm."}, 26.0),
        ({}, {"description": "Scan sizes - 300 µm. Tip radius - ~5µm."}, 5000.0),
        ({}, instrument(10, "nm") | WORDS, 10.0),  # a number before words
        (instrument(12.5, "µm"), instrument(10, "nm") | WORDS, 12500.0),  # the file before both
        (instrument("sharp", "nm"), WORDS, 7.0),
        ({}, {"description": "Tip radius unknown. Scan size 10 nm."}, None),
        ({}, {"instrument": None, "description": None}, None),
        ({}, instrument(8, "V"), None),
        ({}, instrument([8], "nm"), None),
        ({}, instrument(float("nan"), "nm"), None),
        ({}, instrument(1, "km"), None),
    ],
)
def test_the_tip_radius_is_read_from_the_file_or_from_words(file, container, radius):
    stated_radius, notes = find_tip_radius(file, container)
    assert stated_radius == (None if radius is None else pytest.approx(radius))
    assert len(notes) == (radius is not None)
