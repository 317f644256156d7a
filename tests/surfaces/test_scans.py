"""Reading of scans of every kind, in formats that can be written here: heights, spacing, notes."""

from dataclasses import replace

import numpy as np
import pytest
from refusals import assert_says, refusal
from scan_files import (
    MAPS,
    MAPS_AND_LINES,
    UNEVEN_LINES,
    container,
    heights,
    nanoscope,
    scan,
)
from SurfaceTopography import NonuniformLineScan, Topography, UniformLineScan

from hardcontact.records import dataset
from hardcontact.surfaces import scans
from hardcontact.surfaces.scan_heights import stated_tip_radius
from hardcontact.surfaces.scans import (
    list_measurements,
    read_measurement,
    read_scan,
    read_stored,
)


def written(write, path, topography):
    """Write a topography; return its path and the name of the dataset."""
    write(topography, path)
    (member,) = list_measurements(path)
    return path, member


def map_of(values, pixel_size=10.0):
    sizes = [count * pixel_size for count in values.shape]
    return Topography(values, tuple(sizes), unit="nm")


def line(positions, values, unit="nm"):
    return NonuniformLineScan(np.asarray(positions, float), np.asarray(values, float), unit=unit)


@pytest.mark.parametrize("form", MAPS)
def test_map(tmp_path, form):
    values = heights()
    path, member = written(MAPS[form], tmp_path / f"a.{form}", map_of(values))
    measured = read_measurement(path, member)
    assert (measured.path, measured.dataset, measured.kind) == (str(path), member, "map")
    assert (measured.undefined, measured.tip_radius) == (0, None)
    assert measured.pixel_size == pytest.approx(10.0)
    np.testing.assert_allclose(measured.heights, values.T, atol=1e-12)


@pytest.mark.parametrize("form", MAPS)
@pytest.mark.parametrize(
    ("shape", "note", "square"),
    [
        ((48, 32), "cropped from 48 x 32 to 32 x 32 pixels", np.s_[8:40, :]),
        ((32, 51), "cropped from 32 x 51 to 32 x 32 pixels", np.s_[:, 9:41]),
    ],
)
def test_rectangle_is_cropped_to_its_central_square(tmp_path, form, shape, note, square):
    values = heights(*shape)
    file = written(MAPS[form], tmp_path / f"a.{form}", map_of(values))
    measured = read_measurement(*file)
    np.testing.assert_allclose(measured.heights, values[square].T, atol=1e-12)
    assert note in measured.notes
    assert measured.pixel_size == pytest.approx(10.0)
    scanned = read_scan(*file)
    assert (scanned.pixels, scanned.size) == (32, pytest.approx(320.0))


@pytest.mark.parametrize("form", MAPS)
def test_gaps_of_a_map_are_filled_harmonically(tmp_path, form):
    x, y = np.mgrid[:32, :32]
    plane = 0.3 * x - 0.2 * y + 0.01 * x * y  # harmonic, so that gaps are filled by itself
    values = np.ma.masked_array(plane, False)
    values[3, 4:9] = values[20:24, 20:24] = np.ma.masked
    file = written(MAPS[form], tmp_path / f"a.{form}", map_of(values))
    assert_says(refusal(read_measurement, *file), "found 21", "scan.undefined_pixels: harmonic")
    measured = read_measurement(*file, "harmonic")
    np.testing.assert_allclose(measured.heights, plane.T, atol=1e-9)
    assert measured.undefined == 21
    assert "21 undefined pixels of 1024 filled" in measured.notes


def test_pixels_that_are_not_square_are_resampled_on_the_longer_edge(tmp_path):
    x, y = np.mgrid[:48, :64]
    values = np.ma.masked_array(0.3 * x - 0.2 * y, False)  # linear: interpolation is exact
    values[20, 31] = np.ma.masked
    file = scan(tmp_path / "a.nc", values, (960.0, 640.0))  # 20 nm x 10 nm
    measured = read_measurement(file, "", "harmonic")
    assert measured.pixel_size == pytest.approx(20.0) and measured.undefined == 0
    expected = (0.3 * x - 0.2 * y)[8:40, ::2].T
    np.testing.assert_allclose(measured.heights, expected, atol=1e-9)
    assert measured.notes[0] == "resampled from pixels of 20 nm x 10 nm to 20 nm"
    turned = scan(tmp_path / "b.nc", values[:, ::2][:, :24], (480.0, 720.0))  # 10 nm x 30 nm
    measured = read_measurement(turned, "", "harmonic")
    assert (measured.pixel_size, measured.heights.shape) == (pytest.approx(30.0), (16, 16))
    # A text that was cut short looks alike, so that texts must have square pixels.
    whole = map_of(heights(64, 64))
    whole.to_matrix(str(tmp_path / "a.asc"))
    lines = (tmp_path / "a.asc").read_text().splitlines()
    (tmp_path / "a.asc").write_text("\n".join(lines[: len(lines) // 2]))
    assert_says(refusal(read_measurement, tmp_path / "a.asc"), "square pixels", "lost lines")
    flat = scan(tmp_path / "c.nc", sizes=(320.0, 3200.0))
    assert_says(refusal(read_measurement, flat), "16 to 8192 pixels", "found 3 x 32")


def test_an_offset_is_subtracted_before_heights_are_judged(tmp_path):
    values = heights(32, 32)
    measured = read_measurement(scan(tmp_path / "a.nc", values + 1e8))  # 10 cm
    np.testing.assert_allclose(measured.heights - measured.heights.mean(),
                               values.T - values.mean(), atol=1e-6)  # fmt: skip
    assert measured.notes == ("offset of 100 mm subtracted",)
    positions = np.arange(100) * 10.0
    line_scan = read_measurement(coordinates(tmp_path / "a.xyz", positions, 1e8 + positions / 10))
    assert np.ptp(line_scan.heights) == pytest.approx(99)
    for lost in (1e14, np.inf):  # no digits of a height are left
        message = refusal(read_measurement, scan(tmp_path / "b.nc", values + lost), "", "harmonic")
        assert_says(message, "b.nc: expected")


def test_a_unit_counts_for_files_that_state_none(tmp_path):
    positions, values = np.arange(100) * 0.01, 1e-3 * heights(100)
    np.savetxt(tmp_path / "a.txt", np.column_stack([positions, values]))
    assert_says(refusal(read_measurement, tmp_path / "a.txt"), "unit", "found none", "--unit")
    measured = read_measurement(tmp_path / "a.txt", unit="um")
    assert measured.pixel_size == pytest.approx(10.0) and measured.notes == ("unit um as given",)
    np.testing.assert_allclose(measured.heights, 1e3 * values)
    stated = read_measurement(scan(tmp_path / "a.nc"), unit="um")
    assert stated.pixel_size == pytest.approx(10.0) and not stated.notes


def test_gaps_beside_the_square_do_not_count(tmp_path):
    values = np.ma.masked_array(heights(48, 32), False)
    values[:8] = values[40:] = np.ma.masked
    assert read_measurement(scan(tmp_path / "a.nc", values, (480.0, 320.0))).undefined == 0


@pytest.mark.parametrize("form", MAPS_AND_LINES)
def test_line_scan(tmp_path, form):
    values = heights(40)
    profile = UniformLineScan(values, 400.0, unit="nm")
    file = written(MAPS_AND_LINES[form], tmp_path / f"a.{form}", profile)
    measured = read_measurement(*file)
    assert (measured.kind, measured.file_unit, measured.undefined) == ("profile", "nm", 0)
    assert measured.pixel_size == pytest.approx(10.0)
    np.testing.assert_allclose(measured.heights, values, atol=1e-12)
    assert not any("resampled" in note for note in measured.notes)
    message = refusal(read_scan, *file)
    assert_says(message, f"a.{form}", "expected a height map, found a line scan")


@pytest.mark.parametrize("form", UNEVEN_LINES)
def test_uneven_line_scan_is_resampled_on_its_median_spacing(tmp_path, form):
    positions = np.concatenate([np.arange(0, 300, 10), np.arange(300, 401, 20)])
    corner = np.abs(positions - 200.0) / 50  # straight between points: interpolation is exact
    file = written(UNEVEN_LINES[form], tmp_path / f"a.{form}", line(positions, corner))
    measured = read_measurement(*file)
    assert measured.pixel_size == pytest.approx(10.0)
    expected = np.abs(np.arange(0, 401, 10) - 200.0) / 50
    np.testing.assert_allclose(measured.heights, expected, atol=1e-9)
    assert measured.notes == ("resampled from spacings of 10 to 20 nm to their median of 10 nm",)


def test_gaps_of_a_line_scan_are_filled_linearly(tmp_path):
    values = np.ma.masked_array(np.linspace(0, 8, 41), False)
    values[5:9] = np.ma.masked
    UniformLineScan(values, 410.0, unit="nm").to_matrix(str(tmp_path / "a.asc"))
    assert_says(refusal(read_measurement, tmp_path / "a.asc"), "found 4", "undefined_pixels")
    measured = read_measurement(tmp_path / "a.asc", "", "harmonic")
    np.testing.assert_allclose(measured.heights, np.linspace(0, 8, 41), atol=1e-12)
    assert measured.undefined == 4 and "4 undefined pixels of 41 filled" in measured.notes


def coordinates(path, *columns, unit="nm"):
    header = f"Lateral units: {unit}\nValue units: {unit}"
    np.savetxt(path, np.column_stack(columns), fmt="%.9g", header=header)
    return path


def test_positions_in_metres_keep_their_spacing(tmp_path):
    # 1e-6 of the unit, which the reader of text takes for nothing, is 1 um here.
    positions = np.concatenate([np.arange(0, 30, 1), np.arange(30, 51, 2)]) * 1e-8
    values = np.abs(positions - 2e-7)
    measured = read_measurement(coordinates(tmp_path / "a.xyz", positions, values, unit="m"))
    assert measured.pixel_size == pytest.approx(10.0)
    np.testing.assert_allclose(measured.heights, np.abs(np.arange(51) * 10 - 200.0), atol=1e-6)
    assert "resampled" in measured.notes[0]


@pytest.mark.parametrize("step", [-4.0, 0.0])
def test_reentrant_line_scan(tmp_path, step):
    positions = np.cumsum([0.0, *[10.0] * 20, step, *[10.0] * 20])
    message = refusal(read_measurement, coordinates(tmp_path / "a.xyz", positions, heights(42)))
    last = 200 + step
    assert_says(
        message,
        "a.xyz: expected positions that increase along a line scan",
        f"found a reentrant one: point 22 is at {last:g} nm, that before it at 200 nm",
    )


@pytest.mark.parametrize(
    ("positions", "points"),
    [(np.append(np.arange(40) * 1e-2, 1e6), 100_000_000), (np.arange(9) * 10, 9)],
)
def test_points_of_a_line_scan_are_limited_also_once_resampled(tmp_path, positions, points):
    path = coordinates(tmp_path / "a.xyz", positions, heights(len(positions)))
    message = refusal(read_measurement, path)
    assert_says(message, "16 to 1048576 points along a line scan", f"found {points}")


@pytest.mark.parametrize("shape", [(40, 40), (24, 40)])
def test_nanoscope_file(tmp_path, shape):
    counts = np.round(heights(*shape) * 100)
    path = nanoscope(tmp_path / "a.001", counts, (400.0, shape[0] * 10.0))
    measured = read_measurement(path)
    assert (measured.channel, measured.file_unit, measured.kind) == ("Height", "nm", "map")
    assert measured.pixel_size == pytest.approx(10.0)
    left = (40 - shape[0]) // 2
    expected = 0.1 * counts[::-1, left : left + shape[0]]  # y grows upwards
    np.testing.assert_allclose(measured.heights, expected, atol=1e-9)


def test_the_channel_of_heights_is_read(tmp_path):
    counts = np.round(heights(40, 40) * 100)
    path = nanoscope(tmp_path / "a.001", counts, (400.0, 400.0), ["Phase", "Height Sensor"])
    measured = read_measurement(path)
    assert measured.channel == "Height Sensor"
    assert measured.notes == ("channel Height Sensor read: Phase holds no heights",)
    nanoscope(path, counts, (400.0, 400.0), ["Height", "Height Sensor", "Phase"])
    assert read_measurement(path).channel == "Height"
    chosen = read_measurement(path, "Height Sensor")
    assert (chosen.channel, chosen.notes) == ("Height Sensor", ())
    assert read_measurement(path, "2").channel == "Height Sensor"
    assert_says(refusal(read_measurement, path, "Phase"), "a channel of heights, found only")
    message = refusal(read_measurement, path, "Error")
    assert_says(message, "one of the channels Height, Height Sensor, Phase", "'Error'")
    nanoscope(path, counts, (400.0, 400.0), ["Phase"])
    message = refusal(read_measurement, path)
    assert_says(message, "a.001: expected a channel of heights, found only Phase")


def test_the_channel_that_a_container_names_is_read(tmp_path):
    counts = np.round(heights(40, 40) * 100)
    file = nanoscope(tmp_path / "a.001", counts, (400.0, 400.0), ["Height", "Height Sensor"])
    entry = {"name": "one", "datafile": {"original": "a.001"}, "data_source": 1}
    path = container(tmp_path / "a.zip", [entry | {"height_scale": 0.5}], {"a.001": file})
    measured = read_measurement(path, "one")
    assert measured.channel == "Height Sensor" and measured.notes == ()
    assert measured.heights.std() == pytest.approx(0.1 * counts.std())  # never scaled twice


@pytest.mark.parametrize("form", ["nc", "zip"])
def test_a_measurement_is_stored_whole(tmp_path, form):
    values = np.ma.masked_array(heights(48, 32), False)
    values[20, 4:9] = np.ma.masked
    profile = UniformLineScan(heights(40), 400.0, unit="nm")
    for topography in (map_of(values), profile):
        file = written(MAPS[form], tmp_path / f"a.{form}", topography)
        measured = replace(read_measurement(*file, "harmonic"), tip_radius=8.0)
        for scanned in (measured, replace(measured, tip_radius=None, notes=())):
            dataset.write(scanned.stored(), tmp_path / "stored.nc")
            again = read_stored(tmp_path / "stored.nc")
            np.testing.assert_array_equal(again.heights, scanned.heights)
            assert replace(again, heights=None) == replace(scanned, heights=None)


def test_scan_without_physical_size(tmp_path):
    np.save(tmp_path / "a.npy", heights())
    np.savetxt(tmp_path / "a.txt", heights())
    for name in ("a.npy", "a.txt"):
        message = refusal(scans.read_scan, tmp_path / name)
        assert_says(message, name, "expected", "physical size", "found none")


@pytest.mark.parametrize(("lines", "undefined"), [(32, 1024), (17, 544)])
def test_scans_that_are_more_filled_than_measured_are_refused(tmp_path, lines, undefined):
    values = np.ma.masked_array(np.random.default_rng(0).random((32, 32)), False)
    values[:lines] = np.ma.masked
    path = scan(tmp_path / "a.nc", values)
    said = refusal(scans.read_scan, path, "", "harmonic")
    assert_says(said, "a.nc", "at most 50%", f"{undefined} of 1024")


def text_entry(name, file):
    return {"name": name, "datafile": {"original": file}, "size": [320, 320], "unit": "nm"}


def instrument(value, unit):
    return {"instrument": {"parameters": {"tip_radius": {"value": value, "unit": unit}}}}


@pytest.mark.parametrize(
    ("words", "radius"),
    [
        ("Tip radius: 8 nm.", 8.0),
        ("Initial tip radii - 17 nm. \nFinal tip radii - 26 nm (no image).", 26.0),
        ("Scan sizes - 300 µm. Tip radius - ~5µm.", 5000.0),
        ("tip radius = 12.5 um", 12500.0),
    ],
)
def test_of_radii_in_words_the_largest_counts(words, radius):
    found, (note,) = stated_tip_radius({}, {"description": words})
    assert found == pytest.approx(radius)
    assert f"{radius:.4g} nm" in note and "description" in note


@pytest.mark.parametrize(
    "metadata",
    [
        {},
        {"description": None},
        {"description": "Tip radius unknown. Scan size 10 nm."},
        {"description": "Tip radius 8"},
        {"instrument": {"name": "AFM"}},
        {"instrument": None},
        instrument("sharp", "nm"),
        instrument(8, "V"),
        instrument(8, None),
        instrument(8, ["nm"]),
        instrument([8], "nm"),
        instrument(float("nan"), "nm"),
        instrument(0, "nm"),
        instrument(-8, "nm"),
        instrument(1, "km"),
    ],
)
def test_what_is_no_radius(metadata):
    assert stated_tip_radius(metadata, metadata) == (None, [])


def test_radius_in_a_stylus_file(tmp_path):
    rows = "\n".join(f"{0.1 * k:.1f},{height:.6f}," for k, height in enumerate(heights(40) / 100))
    text = "Scan Parameters,\nStylus,Radius: 2.5 um\nScan Data,\n\nLateral um,Raw Micrometer,\n"
    (tmp_path / "a.csv").write_text(text + rows + "\n")
    measured = read_measurement(tmp_path / "a.csv")
    assert (measured.kind, measured.tip_radius) == ("profile", pytest.approx(2500.0))
    assert measured.pixel_size == pytest.approx(100.0)
    np.testing.assert_allclose(measured.heights, 10 * heights(40), atol=1e-3)


def test_what_a_container_states_of_the_tip_counts_after_its_file(tmp_path):
    stated = instrument(10, "nm") | {"description": "tip radius 7 nm"}
    radius, notes = stated_tip_radius(instrument(12.5, "µm"), stated)
    assert radius == pytest.approx(12500.0) and notes[0].endswith("stated by the file")
    assert stated_tip_radius({}, stated)[0] == 10.0


def test_a_scan_of_a_container_is_named_by_its_file_or_an_unambiguous_name(tmp_path):
    np.savetxt(tmp_path / "a.txt", heights())
    entries = [text_entry("one", "1.txt"), text_entry("one", "2.txt"), text_entry("two", "3.txt")]
    path = container(tmp_path / "a.zip", entries, {"2.txt": tmp_path / "a.txt"})
    for name, parts in (
        ("one", ["expected one scan 'one'", "found 1.txt, 2.txt"]),
        ("three", ["column dataset", "one, two", "found 'three'"]),
        ("", ["column dataset", "found ''"]),
        ("two", ["the data file 3.txt"]),
    ):
        assert_says(refusal(read_scan, path, name), "a.zip", *parts)
    assert read_scan(path, "2.txt").pixel_size == pytest.approx(10.0)


def test_rounded_positions_are_uniform_and_may_run_from_right_to_left(tmp_path):
    positions, values = np.round(np.arange(200) * 0.09956, 4), heights(200)
    for name, order in (("a.xyz", slice(None)), ("b.xyz", slice(None, None, -1))):
        columns = positions[order], 1e-3 * values[order]
        measured = read_measurement(coordinates(tmp_path / name, *columns, unit="µm"))
        assert measured.pixel_size == pytest.approx(99.56, rel=1e-4)
        np.testing.assert_allclose(measured.heights, values, rtol=1e-6)
        assert measured.notes == ()
