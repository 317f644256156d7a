"""Substitute scans: corners of random surfaces, and the sphere."""

import numpy as np
import pytest
from measurements import PIXEL, cut_scan, uncd_density

from hardcontact.base.arrays import generator
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.levelling import remove_form
from hardcontact.surfaces.synthesis import ScanGrid, add_sphere_shape, random_surface, sample_scan

SPHERE_RADIUS = 250e3


def test_the_apex_of_a_sphere_lies_in_the_middle_half_of_its_scan():
    flat = HeightMap(np.zeros((64, 64)), 40.0, periodic=False, source="substitute")
    for k in range(20):
        scan = add_sphere_shape(generator(k), flat, SPHERE_RADIUS)
        row, column = np.unravel_index(scan.heights.argmax(), scan.heights.shape)
        assert 15 <= row <= 48 and 15 <= column <= 48
        np.testing.assert_allclose(remove_form(scan, SPHERE_RADIUS).heights, 0, atol=1e-9)


def test_a_scan_is_the_corner_of_a_random_surface():
    scan = sample_scan(generator(1), uncd_density, ScanGrid(64, 64 * PIXEL, 128), 0.7)
    assert not scan.periodic
    assert scan.pixel_size == pytest.approx(PIXEL)
    corner = cut_scan(random_surface(generator(1), 128, PIXEL, uncd_density), 64)
    np.testing.assert_array_equal(scan.heights, 0.7 * corner.heights)
