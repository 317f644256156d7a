"""Height maps: planes, spheres, mirrors, metrics with known answers, scans as they are stored."""

import numpy as np
import pytest

from hardcontact.surfaces.height_map import (
    DEFINITIONS,
    METRICS,
    HeightMap,
    flat_map,
    level,
    level_lines,
    library_map,
    metrics,
    mirror_stitch,
    prepared_scan,
    table1_variables,
)

RADIUS = 250e3


def scan_of(heights, pixel_size=10.0):
    return HeightMap(heights, pixel_size, periodic=False, basis="measured")


@pytest.fixture
def roughness():
    """A wave of eight periods, on pixels of 40 nm."""
    return scan_of(np.cos(2 * np.pi * np.arange(64) * 8 / 64) * np.ones((64, 1)), 40.0)


@pytest.fixture
def sphere(roughness):
    """The wave on a sphere whose apex is off the middle."""
    y, x = (np.mgrid[:64, :64] - 20.3) * 40.0
    return scan_of(roughness.heights - (x**2 + (y - 500) ** 2) / (2 * RADIUS), 40.0)


def test_levelling_removes_a_plane_and_only_that():
    y, x = np.mgrid[:32, :32]
    wave = np.sin(2 * np.pi * 4 * x / 32) * np.sin(2 * np.pi * 3 * y / 32)
    levelled = level(scan_of(wave + 3 * x - 2 * y + 7)).heights
    assert abs(levelled.mean()) < 1e-9
    assert np.polyfit(x[0], levelled.mean(axis=0), 1)[0] == pytest.approx(0, abs=1e-9)
    assert levelled.std() == pytest.approx(wave.std(), rel=0.1)


def test_levelling_is_the_least_squares_plane():
    heights = np.random.default_rng(0).standard_normal((9, 12))
    y, x = np.mgrid[:9, :12]
    basis = np.stack([np.ones(heights.size), x.ravel(), y.ravel()], axis=1)
    coefficients = np.linalg.lstsq(basis, heights.ravel(), rcond=None)[0]
    expected = heights - (basis @ coefficients).reshape(heights.shape)
    np.testing.assert_allclose(level(scan_of(heights)).heights, expected, atol=1e-12)


def level_waves(pixels=64):
    """Waves along x, of a phase of its own in every line; no line of them has a median or tilt."""
    phases = np.pi * np.arange(pixels) / 7
    x = np.arange(pixels) - (pixels - 1) / 2
    waves = np.cos(2 * np.pi * 8 * np.arange(pixels) / pixels + phases[:, None])
    tilts = (waves @ x) / (x @ x)
    return waves - tilts[:, None] * x


def test_levelling_by_lines_takes_offsets_and_tilts_of_lines():
    waves, rng = level_waves(), np.random.default_rng(3)
    waves = waves - np.median(waves, axis=1, keepdims=True)
    drift = rng.normal(0, 5, (64, 1)) + rng.normal(0, 0.1, (64, 1)) * np.arange(64)
    levelled = level_lines(scan_of(waves + drift)).heights
    np.testing.assert_allclose(levelled, level(scan_of(waves)).heights, atol=1e-9)
    assert np.abs(level(scan_of(waves + drift)).heights - waves).max() > 1  # a plane does not


def test_lines_run_along_x():
    along_x = np.sin(2 * np.pi * 5 * np.arange(64) / 64) * np.ones((64, 1))
    np.testing.assert_allclose(level_lines(scan_of(along_x.T)).heights, 0, atol=1e-9)
    assert level_lines(scan_of(along_x)).heights.std() > 0.9 * along_x.std()


def test_levelling_by_lines_is_a_fit_and_a_median_of_each():
    heights = np.random.default_rng(4).standard_normal((24, 24)).cumsum(axis=0).cumsum(axis=1)
    x = np.arange(24)
    lines = [line - np.polyval(np.polyfit(x, line, 1), x) for line in heights]
    aligned = np.array([line - np.median(line) for line in lines])
    expected = level(scan_of(aligned)).heights
    np.testing.assert_allclose(level_lines(scan_of(heights)).heights, expected, atol=1e-9)


def test_sphere_is_removed_wherever_its_apex_lies(sphere, roughness):
    subtracted = flat_map(sphere, RADIUS)
    np.testing.assert_allclose(subtracted.heights, level(roughness).heights, atol=1e-8)


def test_mirrored_edges_match():
    scan = scan_of(np.random.default_rng(0).standard_normal((7, 7)))
    stitched = mirror_stitch(scan)
    assert stitched.heights.shape == (14, 14)
    assert stitched.periodic and not scan.periodic
    np.testing.assert_array_equal(stitched.heights[:7, :7], scan.heights)
    for axis in (0, 1):
        edges = np.take(stitched.heights, [0, -1, 6, 7], axis=axis)
        first, last, middle, next_ = np.split(edges, 4, axis=axis)
        np.testing.assert_array_equal(first, last)
        np.testing.assert_array_equal(middle, next_)


def test_metrics_of_a_wave():
    pixels, pixel_size, amplitude, order = 256, 3.0, 2.0, 16
    x = np.arange(pixels) * pixel_size
    wave = amplitude * np.cos(2 * np.pi * order * x / (pixels * pixel_size))
    values = metrics(scan_of(wave[None] * np.ones((pixels, 1)), pixel_size))
    assert list(values) == list(METRICS)
    q = 2 * np.pi * order / (pixels * pixel_size)
    difference = 2 * np.sin(q * pixel_size / 2) / pixel_size
    rms = amplitude / np.sqrt(2)
    assert values["rms_height"] == pytest.approx(rms)
    assert values["rms_gradient"] == pytest.approx(rms * difference, rel=0.01)
    assert values["rms_profile_slope"] == pytest.approx(rms * difference, rel=0.01)
    assert values["rms_laplacian"] == pytest.approx(rms * difference**2, rel=0.01)
    assert values["rms_half_laplacian"] == pytest.approx(values["rms_laplacian"] / 2)
    assert values["kurtosis"] == pytest.approx(1.5) and values["skewness"] == pytest.approx(0)
    assert values["peak_to_valley"] == pytest.approx(2 * amplitude)


@pytest.mark.parametrize("shape", [(64, 64), (30, 47)])
def test_metrics_are_those_of_the_library(shape):
    scan = scan_of(np.random.default_rng(3).standard_normal(shape).cumsum(axis=0), 4.9)
    values, expected = metrics(scan), library_map(scan)
    for name, value in (
        ("rms_height", expected.Sq()),
        ("rms_gradient", expected.rms_gradient()),
        ("rms_profile_slope", expected.Rdq()),
        ("rms_half_laplacian", expected.rms_curvature_from_area()),
    ):
        assert values[name] == pytest.approx(value, rel=1e-13)


def test_a_prepared_scan_is_levelled_and_stitched():
    y, x = np.mgrid[:16, :16]
    scan = scan_of(np.random.default_rng(1).standard_normal((16, 16)) + 3 * x - y)
    levelled, stitched = prepared_scan(scan)
    expected = level(scan).heights.astype(np.float32)
    np.testing.assert_array_equal(levelled["heights"].values, expected)
    np.testing.assert_array_equal(stitched["heights"].values[16:, 16:], expected[::-1, ::-1])
    assert levelled.attrs == {"periodic": 0, "basis": "measured"}
    assert stitched.attrs == {"periodic": 1, "basis": "measured"}
    assert list(levelled.data_vars) == list(stitched.data_vars) == ["heights"]


def test_a_prepared_scan_of_the_sphere_keeps_what_was_scanned(sphere):
    levelled, stitched = prepared_scan(sphere, RADIUS)
    as_scanned = levelled["as_scanned"]
    assert as_scanned.dims == ("y", "x") and as_scanned.attrs["units"] == "nm"
    np.testing.assert_array_equal(as_scanned, sphere.heights.astype(np.float32))
    expected = flat_map(sphere, RADIUS).heights
    np.testing.assert_allclose(levelled["heights"].values, expected, atol=1e-6)
    assert list(stitched.data_vars) == ["heights"]


@pytest.mark.parametrize("radius", [None, RADIUS])
def test_a_prepared_scan_keeps_how_it_was_levelled_and_what_its_file_says(sphere, radius):
    said = {"channel": "Height", "file_unit": "µm", "notes": "cropped; 3 undefined pixels"}
    levelled, stitched = prepared_scan(sphere, radius, "lines", said)
    bare = sphere if radius is None else flat_map(sphere, radius)
    expected = level_lines(bare).heights
    np.testing.assert_allclose(levelled["heights"].values, expected, atol=1e-5)
    np.testing.assert_allclose(stitched["heights"].values[:64, :64], expected, atol=1e-5)
    for arrays, periodic in ((levelled, 0), (stitched, 1)):
        assert arrays.attrs == {"periodic": periodic, "basis": "measured"} | said


def test_rows_of_table1_are_variables_of_the_topography():
    for slope in ("gradient", "profile"):
        for curvature in ("half_laplacian", "laplacian"):
            named = table1_variables(slope, curvature)
            metric = named["afm_rms_slope"].removesuffix("_mean")
            assert metric == DEFINITIONS[slope] and metric in METRICS
            assert named["all_rms_slope"] == f"all_scales_{metric}"
            assert named["all_rms_curvature"] == f"all_scales_{DEFINITIONS[curvature]}"
            assert len(named) == 6
