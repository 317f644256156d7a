"""Substitute scans: skewed heights, the spread of scans, the sphere, files that readers know."""

import numpy as np
import pytest
from random_scans import PIXEL, UNCD, uncd
from scipy.stats import skew

from hardcontact.random import generator
from hardcontact.records import dataset
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.scans import read_scan
from hardcontact.surfaces.spectrum import spectrum_dataset
from hardcontact.surfaces.substitute_scans import (
    scan_to_scan_spread,
    skewed_surface,
    sphere_scan,
    substitute_scan,
    synthesized_scan,
)
from hardcontact.surfaces.synthesis import random_surface
from hardcontact.surfaces.topography import level, subtract_sphere

RADIUS = 250e3


@pytest.fixture(scope="module")
def surface():
    return random_surface(generator(5), 512, PIXEL, uncd)


def test_skewed_heights_keep_their_spectrum(surface):
    remapped = skewed_surface(surface, 0.54)
    np.testing.assert_allclose(
        np.abs(np.fft.rfft2(remapped.heights))[0, 1:],
        np.abs(np.fft.rfft2(surface.heights))[0, 1:],
        rtol=1e-3,
    )
    assert skew(remapped.heights, axis=None) == pytest.approx(0.54, abs=0.1)


def test_scan_to_scan_spread_fills_up_to_the_published_one():
    arguments = (256, PIXEL, 64, uncd)
    natural = scan_to_scan_spread(generator(3), *arguments, 1e-6)
    wide = scan_to_scan_spread(generator(3), *arguments, 0.5)
    assert natural == 0
    assert 0 < wide < np.sqrt(np.log1p(0.25))


def test_a_scan_is_a_corner_of_its_surface_times_a_factor_of_mean_one(surface):
    scan = substitute_scan(generator(1), surface, 100)
    np.testing.assert_array_equal(scan.heights, surface.heights[:100, :100])
    assert (scan.pixel_size, scan.periodic, scan.basis) == (PIXEL, False, "substitute")
    rng = generator(2)
    factors = np.array(
        [substitute_scan(rng, surface, 1, spread=0.3).heights[0, 0] for _ in range(2000)]
    ) / float(surface.heights[0, 0])
    assert np.log(factors).std() == pytest.approx(0.3, rel=0.1)
    assert factors.mean() == pytest.approx(1, abs=4 * 0.3 / np.sqrt(2000))


def test_the_sphere_is_seen_with_its_apex_in_the_middle_half():
    flat = HeightMap(np.zeros((64, 64)), 40.0, periodic=False, basis="substitute")
    for k in range(20):
        scan = sphere_scan(generator(k), flat, RADIUS)
        row, column = np.unravel_index(scan.heights.argmax(), scan.heights.shape)
        assert 15 <= row <= 48 and 15 <= column <= 48
        np.testing.assert_allclose(subtract_sphere(scan, RADIUS).heights, 0, atol=1e-9)


@pytest.fixture
def description():
    return spectrum_dataset(UNCD.density).assign_attrs(skewness=0.54, spread=0.2)


def read_back(tmp_path, synthesized):
    dataset.write(synthesized, tmp_path / "a.nc", "NETCDF3_64BIT")
    return read_scan(tmp_path / "a.nc", basis="substitute")


def test_a_synthesized_scan_is_read_as_any_other(tmp_path, description):
    synthesized = synthesized_scan(generator(1), description, 64, 64 * PIXEL, 128)
    scan = read_back(tmp_path, synthesized)
    assert (scan.basis, scan.periodic) == ("substitute", False)
    assert scan.pixel_size == pytest.approx(PIXEL)
    rng = generator(1)
    expected = substitute_scan(rng, random_surface(rng, 128, PIXEL, UNCD), 64, 0.54, 0.2)
    np.testing.assert_array_equal(scan.heights, expected.heights)
    assert synthesized.attrs["basis"].startswith("substitute")


def test_a_synthesized_scan_of_the_sphere_has_its_shape(tmp_path, description):
    arguments = (description, 64, 2500.0, 128)
    flat = read_back(tmp_path, synthesized_scan(generator(1), *arguments))
    sphere = read_back(tmp_path, synthesized_scan(generator(1), *arguments, RADIUS))
    np.testing.assert_allclose(
        subtract_sphere(sphere, RADIUS).heights, level(flat).heights, atol=1e-9
    )
