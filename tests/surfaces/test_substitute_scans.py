"""Substitute scans: heights and skewness, the sphere, files that readers know."""

from dataclasses import fields, replace

import numpy as np
import pytest
import xarray as xr
from direct_sum import plastic_totals
from random_scans import PIXEL, uncd
from repository import ROOT
from scipy.ndimage import grey_dilation, grey_erosion, maximum_filter
from scipy.stats import pearson3, skew

from hardcontact.base import dataset
from hardcontact.base.random import generator
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import bodies
from hardcontact.contact.pull_off import pull_off_force
from hardcontact.surfaces.height_map import HeightMap, flat_map, level, mirror_stitch
from hardcontact.surfaces.scans import Measurement, level_and_stitch, read_measurement, read_scan
from hardcontact.surfaces.spectrum import Spectrum, measured_psds
from hardcontact.surfaces.substitute_scans import (
    ScanGrid,
    _open_with_paraboloid,
    _remap_heights,
    add_sphere,
    convert_to_measurement,
    cut_scan,
    skew_surface,
    synthesize_scan,
)
from hardcontact.surfaces.synthesis import random_surface

AFM = (ROOT / "../shared/scans/afm-10um-512.di").resolve()
SPHERE_RADIUS = 250e3
WINDOW = 128


def test_the_apex_of_a_sphere_lies_in_the_middle_half_of_its_scan():
    flat = HeightMap(np.zeros((64, 64)), 40.0, periodic=False, basis="substitute")
    for k in range(20):
        scan = add_sphere(generator(k), flat, SPHERE_RADIUS)
        row, column = np.unravel_index(scan.heights.argmax(), scan.heights.shape)
        assert 15 <= row <= 48 and 15 <= column <= 48
        np.testing.assert_allclose(flat_map(scan, SPHERE_RADIUS).heights, 0, atol=1e-9)


@pytest.mark.parametrize("skewness", [-0.8, 0.0, 1e-3, 0.5])
def test_remapped_heights_have_a_pearson_distribution(skewness):
    heights = np.random.default_rng(3).standard_normal((512, 512))
    remapped, shares = _remap_heights(heights, skewness, 2.0), np.linspace(0.01, 0.99, 99)
    quantiles = 2 * pearson3.ppf(shares, skewness)
    np.testing.assert_allclose(np.quantile(remapped, shares), quantiles, atol=2e-3)
    order = heights.argsort(axis=None)
    assert (np.diff(remapped.ravel()[order]) >= 0).all()


def read_back(tmp_path, synthesized):
    dataset.write(synthesized, tmp_path / "a.nc", "NETCDF3_64BIT")
    return read_scan(tmp_path / "a.nc", basis="substitute")


def test_a_synthesized_scan_is_read_like_a_measured_scan(tmp_path):
    grid = ScanGrid(64, 64 * PIXEL, 128)
    scan = read_back(tmp_path, synthesize_scan(generator(1), uncd, grid, 0.7))
    assert (scan.basis, scan.periodic) == ("substitute", False)
    assert scan.pixel_size == pytest.approx(PIXEL)
    corner = cut_scan(random_surface(generator(1), 128, PIXEL, uncd), 64, 0.7)
    np.testing.assert_array_equal(scan.heights, corner.heights)
    choices = {"sphere_radius": SPHERE_RADIUS}
    sphere = read_back(tmp_path, synthesize_scan(generator(1), uncd, grid, 0.7, **choices))
    flat = flat_map(sphere, SPHERE_RADIUS).heights
    np.testing.assert_allclose(flat, level(scan).heights, atol=1e-9)


@pytest.mark.parametrize("radius", [None, SPHERE_RADIUS])
def test_a_synthesized_scan_is_prepared_as_if_read_from_its_file(tmp_path, radius):
    grid, path = ScanGrid(48, 48 * PIXEL, 96), str(tmp_path / "a.nc")
    synthesized = synthesize_scan(generator(1), uncd, grid, 0.7, sphere_radius=radius)
    dataset.write(synthesized, path, "NETCDF3_64BIT")
    measurement, read_scan = convert_to_measurement(synthesized, path), read_measurement(path)
    for converted_map, read_map in zip(
        level_and_stitch(measurement, "substitute", radius),
        level_and_stitch(read_scan, "substitute", radius),
        strict=True,
    ):
        xr.testing.assert_identical(converted_map, read_map)
    for field in fields(Measurement):
        np.testing.assert_array_equal(
            getattr(measurement, field.name), getattr(read_scan, field.name)
        )


def scan_with(pixels=128, **choices):
    """Return a synthesized scan of 64 pixels from a surface with the given number of pixels."""
    grid = ScanGrid(64, 64 * PIXEL, pixels)
    heights = synthesize_scan(generator(1), uncd, grid, 0.7, **choices).heights.values.T
    return HeightMap(heights, PIXEL, periodic=False, basis="substitute")


@pytest.mark.parametrize("skewness", [-1.0, 1.0])
def test_a_skewed_scan_has_the_rms_height_of_the_gaussian_scan(skewness):
    plain, skewed = scan_with(256), scan_with(256, skewness=skewness)
    assert level(skewed).heights.std() == pytest.approx(level(plain).heights.std(), rel=1e-12)
    assert np.abs(skewed.heights - plain.heights).max() > 1


@pytest.fixture(scope="module")
def surface():
    return random_surface(generator(5), 512, 4 * PIXEL, uncd)


def summit_curvature(scan):
    """Mean half-Laplacian at the summits above two rms heights, downwards, in 1/nm."""
    heights = scan.heights
    inner = heights[1:-1, 1:-1]
    neighbours = heights[2:, 1:-1] + heights[:-2, 1:-1] + heights[1:-1, 2:] + heights[1:-1, :-2]
    summit = (maximum_filter(heights, 3)[1:-1, 1:-1] == inner) & (inner > 2 * heights.std())
    return ((4 * inner - neighbours)[summit] / (2 * scan.pixel_size**2)).mean()


@pytest.mark.parametrize("skewness", [-1.0, -0.5, 0.0, 0.5, 1.0])
def test_heights_have_the_skewness_and_keep_their_spectrum(surface, skewness):
    skewed = skew_surface(surface, skewness)
    np.testing.assert_allclose(
        np.abs(np.fft.rfft2(skewed.heights))[1:, 1:],
        np.abs(np.fft.rfft2(surface.heights))[1:, 1:],
        rtol=2e-3,
    )
    assert skew(skewed.heights, axis=None) == pytest.approx(skewness, rel=0.07, abs=0.01)


@pytest.mark.parametrize("skewness", [-0.5, 0.5])
def test_rounding_errors_do_not_grow(surface, skewness):
    heights = surface.heights.astype(float)
    errors = 1e-13 * np.random.default_rng(2).standard_normal(heights.shape)
    exact = skew_surface(replace(surface, heights=heights), skewness).heights
    perturbed = skew_surface(replace(surface, heights=heights + errors), skewness).heights
    assert (perturbed - exact).std() < 1e-8 * exact.std()


def test_tops_are_blunter_than_those_of_a_gaussian_surface(surface):
    gaussian = summit_curvature(replace(surface, heights=surface.heights.astype(float)))
    for skewness in (-0.5, 0.5):
        assert summit_curvature(skew_surface(surface, skewness)) < 0.7 * gaussian


def windows(heights, pixel_size):
    """All levelled windows of 2.5 µm, of whole scans side by side."""
    for row, column in np.ndindex(heights.shape[0] // WINDOW, heights.shape[1] // WINDOW):
        y = slice(WINDOW * row, WINDOW * (row + 1))
        x = slice(WINDOW * column, WINDOW * (column + 1))
        yield level(HeightMap(heights[y, x], pixel_size, periodic=False, basis="substitute"))


def forces(scan):
    """Mean plastic forces in µN of 10 x 10 contacts at ranges of 2, 5.6 and 10 nm."""
    contact = Contact(radius=250e3, preload=1e-5, hardness=25e9, window=12500.0, count=10)
    pair = bodies(mirror_stitch(scan), None, contact)
    pixels = contact.pixel_count(scan.pixel_size)
    ranges = (2.0, 5.6, 10.0)
    totals = [plastic_totals(pair, [pixels], rho)[0].mean() for rho in ranges]
    return 1e6 * pull_off_force(totals, np.array(ranges), scan.pixel_size, 0.0463)


def window_forces(scan):
    """Forces (window, range) in µN on all windows of a scan."""
    heights = scan.heights.astype(float)
    return np.array([forces(window) for window in windows(heights, scan.pixel_size)])


def standard_error(values):
    return values.std(axis=0, ddof=1) / np.sqrt(len(values))


@pytest.mark.study
@pytest.mark.skipif(not AFM.is_file(), reason="no folder ../shared/scans")
def test_the_model_of_skewness_reproduces_its_scan():
    """A check of the fit, no test of it: forces within two errors of their mean, summits in 20 %.

    Windows of a surface with skewness 0.65 have a mean skewness of 0.53, as windows of the scan.
    """
    scan = level(read_scan(AFM))
    wave, _, isotropic = measured_psds(scan)
    is_finite = np.isfinite(isotropic)
    density = Spectrum(wave[is_finite], isotropic[is_finite])
    model = skew_surface(random_surface(generator(1), 1024, scan.pixel_size, density), 0.65)
    scan_forces = window_forces(scan)
    model_forces = window_forces(model)
    error = np.hypot(standard_error(scan_forces), standard_error(model_forces))
    assert (np.abs(model_forces.mean(axis=0) - scan_forces.mean(axis=0)) < 2 * error).all()
    assert summit_curvature(model) == pytest.approx(summit_curvature(scan), rel=0.2)


@pytest.mark.parametrize("reach", [0, 1, 7])
def test_tops_are_rounded_as_by_grey_morphology(reach):
    heights = np.random.default_rng(reach).standard_normal((90, 90))
    depth = np.arange(reach + 1.0) ** 2 / 5
    opened, parabola = heights, -np.concatenate([depth[:0:-1], depth])
    for morphology in (grey_erosion, grey_dilation):
        for structure in (parabola[None], parabola[:, None]):
            opened = morphology(opened, structure=structure, mode="wrap")
    np.testing.assert_array_equal(_open_with_paraboloid(heights, depth), opened)


def test_skewing_has_no_scale_of_height_or_length(surface):
    skewed = skew_surface(surface, 0.5).heights
    larger = replace(surface, heights=4 * surface.heights, pixel_size=2 * surface.pixel_size)
    np.testing.assert_allclose(skew_surface(larger, 0.5).heights, 4 * skewed, rtol=1e-9)
