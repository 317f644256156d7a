"""Substitute scans: their heights, the sphere, files that readers know."""

import numpy as np
import pytest
from random_scans import PIXEL, uncd

from hardcontact.numbers.random import generator
from hardcontact.records import dataset
from hardcontact.surfaces.height_map import HeightMap, flat_map, level
from hardcontact.surfaces.scans import read_scan
from hardcontact.surfaces.substitute_scans import (
    ScanGrid,
    sphere_scan,
    substitute_scan,
    synthesized_scan,
)
from hardcontact.surfaces.synthesis import random_surface

RADIUS = 250e3


def test_the_sphere_is_seen_with_its_apex_in_the_middle_half():
    flat = HeightMap(np.zeros((64, 64)), 40.0, periodic=False, basis="substitute")
    for k in range(20):
        scan = sphere_scan(generator(k), flat, RADIUS)
        row, column = np.unravel_index(scan.heights.argmax(), scan.heights.shape)
        assert 15 <= row <= 48 and 15 <= column <= 48
        np.testing.assert_allclose(flat_map(scan, RADIUS).heights, 0, atol=1e-9)


def heights_of(synthesized):
    """The map in a dataset of `synthesized_scan`."""
    return HeightMap(synthesized.heights.values.T, PIXEL, periodic=False, basis="substitute")


def read_back(tmp_path, synthesized):
    dataset.write(synthesized, tmp_path / "a.nc", "NETCDF3_64BIT")
    return read_scan(tmp_path / "a.nc", basis="substitute")


def test_a_synthesized_scan_is_read_as_any_other(tmp_path):
    grid = ScanGrid(64, 64 * PIXEL, 128)
    synthesized = synthesized_scan(generator(1), uncd, grid, 0.7)
    scan = read_back(tmp_path, synthesized)
    assert (scan.basis, scan.periodic) == ("substitute", False)
    assert scan.pixel_size == pytest.approx(PIXEL)
    expected = substitute_scan(random_surface(generator(1), 128, PIXEL, uncd), 64, 0.7)
    np.testing.assert_array_equal(scan.heights, expected.heights)
    assert synthesized.attrs["basis"].startswith("substitute")


def test_a_synthesized_scan_of_the_sphere_has_its_shape(tmp_path):
    arguments = (uncd, ScanGrid(64, 2500.0, 128), 1.0)
    flat = read_back(tmp_path, synthesized_scan(generator(1), *arguments))
    sphere = read_back(tmp_path, synthesized_scan(generator(1), *arguments, sphere_radius=RADIUS))
    np.testing.assert_allclose(flat_map(sphere, RADIUS).heights, level(flat).heights, atol=1e-9)


@pytest.mark.parametrize("skewness", [-1.0, 1.0])
def test_a_skewed_scan_is_as_high_as_the_gaussian_one(skewness):
    arguments = (uncd, ScanGrid(64, 64 * PIXEL, 256), 0.7)
    plain, skewed = (
        heights_of(synthesized_scan(generator(1), *arguments, **choices))
        for choices in ({}, {"skewness": skewness})
    )
    assert level(skewed).heights.std() == pytest.approx(level(plain).heights.std(), rel=1e-12)
    assert np.abs(skewed.heights - plain.heights).max() > 1


def test_a_scan_of_a_tip_is_of_the_same_surface_and_smoother():
    arguments = (uncd, ScanGrid(64, 64 * PIXEL, 128), 0.7)
    plain, imaged = (
        heights_of(synthesized_scan(generator(1), *arguments, **choices))
        for choices in ({}, {"tip_radius": 26.0})
    )
    correlation = np.corrcoef(plain.heights.ravel(), imaged.heights.ravel())[0, 1]
    assert correlation > 0.95
    rough, smooth = (np.diff(one.heights, 2).std() for one in (plain, imaged))
    assert smooth < 0.8 * rough
    assert imaged.heights.mean() > plain.heights.mean()
