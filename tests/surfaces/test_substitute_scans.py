"""Substitute scans: the sphere, files that readers know."""

from dataclasses import fields

import numpy as np
import pytest
import xarray as xr
from random_scans import PIXEL, uncd

from hardcontact.base import dataset
from hardcontact.base.random import generator
from hardcontact.surfaces.height_map import HeightMap, flat_map, level
from hardcontact.surfaces.scans import Measurement, level_and_stitch, read_measurement, read_scan
from hardcontact.surfaces.substitute_scans import (
    ScanGrid,
    add_sphere,
    convert_to_measurement,
    cut_scan,
    synthesize_scan,
)
from hardcontact.surfaces.synthesis import random_surface

SPHERE_RADIUS = 250e3


def test_the_apex_of_a_sphere_lies_in_the_middle_half_of_its_scan():
    flat = HeightMap(np.zeros((64, 64)), 40.0, periodic=False, basis="substitute")
    for k in range(20):
        scan = add_sphere(generator(k), flat, SPHERE_RADIUS)
        row, column = np.unravel_index(scan.heights.argmax(), scan.heights.shape)
        assert 15 <= row <= 48 and 15 <= column <= 48
        np.testing.assert_allclose(flat_map(scan, SPHERE_RADIUS).heights, 0, atol=1e-9)


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
