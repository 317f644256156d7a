"""Substitute scans: the sphere, files that readers know."""

from dataclasses import fields, replace

import numpy as np
import pytest
import xarray as xr
from measurements import PIXEL, uncd

from hardcontact.base import dataset
from hardcontact.base.random import generator
from hardcontact.surfaces.height_map import HeightMap, flatten, level, level_and_stitch
from hardcontact.surfaces.scans import read_scan
from hardcontact.surfaces.substitute_scans import (
    ScanGrid,
    add_sphere,
    cut_scan,
    sample_scan,
    scan_file,
    synthesized_map,
)
from hardcontact.surfaces.synthesis import random_surface

SPHERE_RADIUS = 250e3


def test_the_apex_of_a_sphere_lies_in_the_middle_half_of_its_scan():
    flat = HeightMap(np.zeros((64, 64)), 40.0, periodic=False, basis="substitute")
    for k in range(20):
        scan = add_sphere(generator(k), flat, SPHERE_RADIUS)
        row, column = np.unravel_index(scan.heights.argmax(), scan.heights.shape)
        assert 15 <= row <= 48 and 15 <= column <= 48
        np.testing.assert_allclose(flatten(scan, SPHERE_RADIUS).heights, 0, atol=1e-9)


def read_back(tmp_path, synthesized):
    dataset.write(synthesized, tmp_path / "a.nc", "NETCDF3_64BIT")
    return read_scan(tmp_path / "a.nc")


def synthesized_scan(grid, sphere_radius=None):
    rng = generator(1)
    scan = sample_scan(rng, uncd, grid, 0.7)
    return scan_file(scan if sphere_radius is None else add_sphere(rng, scan, sphere_radius))


def test_a_synthesized_scan_is_read_like_a_measured_scan(tmp_path):
    grid = ScanGrid(64, 64 * PIXEL, 128)
    scan = read_back(tmp_path, synthesized_scan(grid))
    assert not scan.periodic
    assert scan.pixel_size == pytest.approx(PIXEL)
    corner = cut_scan(random_surface(generator(1), 128, PIXEL, uncd), 64, 0.7)
    np.testing.assert_array_equal(scan.heights, corner.heights)
    sphere = read_back(tmp_path, synthesized_scan(grid, SPHERE_RADIUS))
    flat = flatten(sphere, SPHERE_RADIUS).heights
    np.testing.assert_allclose(flat, level(scan).heights, atol=1e-9)


@pytest.mark.parametrize("radius", [None, SPHERE_RADIUS])
def test_a_synthesized_scan_is_prepared_as_if_read_from_its_file(tmp_path, radius):
    grid, path = ScanGrid(48, 48 * PIXEL, 96), str(tmp_path / "a.nc")
    synthesized = synthesized_scan(grid, radius)
    dataset.write(synthesized, path, "NETCDF3_64BIT")
    scan, file_scan = synthesized_map(synthesized, path), read_scan(path)
    for field in fields(HeightMap):
        if field.name != "basis":  # which a file does not state
            np.testing.assert_array_equal(getattr(scan, field.name), getattr(file_scan, field.name))
    file_maps = level_and_stitch(replace(file_scan, basis="substitute"), radius)
    for scan_map, file_map in zip(level_and_stitch(scan, radius), file_maps, strict=True):
        xr.testing.assert_identical(scan_map, file_map)
