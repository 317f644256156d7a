"""Surfaces as a tip images them: closed forms of spheres, and scans on coarser pixels."""

from dataclasses import replace

import numpy as np
import pytest
from random_scans import PIXEL, uncd

from hardcontact.numbers.random import generator
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.substitute_scans import FINENESS, imaged_by_tip, imaged_scan
from hardcontact.surfaces.synthesis import random_surface, refined

RADIUS = 10.0


def cap(radius, pixels, pixel_size, height=0.0):
    """A sphere's cap in the middle of a flat map, and the distances from its axis."""
    place = (np.arange(pixels) - pixels // 2) * pixel_size
    distance = np.hypot(place[:, None], place)
    sphere = np.sqrt(np.maximum(radius**2 - distance**2, 0)) - radius + height
    return HeightMap(sphere, pixel_size, periodic=False, basis="substitute"), distance


def test_a_spike_is_imaged_as_the_tip():
    heights = np.zeros((65, 65))
    heights[32, 32] = 4.0
    spike = HeightMap(heights, 0.5, periodic=False, basis="substitute")
    tip, _ = cap(RADIUS, 65, 0.5, height=4.0)
    expected = np.maximum(tip.heights, 0)
    np.testing.assert_allclose(imaged_by_tip(spike, RADIUS).heights, expected, atol=1e-12)


def test_a_sphere_is_imaged_as_a_sphere_of_both_radii():
    body, distance = cap(20.0, 201, 0.2)
    image = imaged_by_tip(body, RADIUS)
    both, _ = cap(20.0 + RADIUS, 201, 0.2)
    near = distance < 10.0
    np.testing.assert_allclose(image.heights[near], both.heights[near], atol=0.003)


def test_no_image_lies_below_its_surface_and_flat_ones_are_unchanged():
    surface = random_surface(generator(1), 128, PIXEL / 2, uncd)
    small, large = (imaged_by_tip(surface, radius).heights for radius in (10.0, 26.0))
    assert (small >= surface.heights).all() and (large >= small - 1e-4).all()
    flat = replace(surface, heights=np.full((32, 32), 3.0))
    np.testing.assert_array_equal(imaged_by_tip(flat, RADIUS).heights, 3.0)


def test_a_refined_surface_has_its_own_orders_and_random_ones_below():
    surface = random_surface(generator(2), 64, PIXEL, uncd)
    fine = refined(generator(3), surface, 2, uncd)
    assert fine.heights.shape == (128, 128) and fine.pixel_size == PIXEL / 2
    own, orders = np.fft.rfft2(surface.heights), np.fft.rfft2(fine.heights) / 4
    np.testing.assert_allclose(orders[:32, 1:32], own[:32, 1:32], atol=1e-2)
    np.testing.assert_allclose(orders[-31:, 1:32], own[-31:, 1:32], atol=1e-2)
    wave = (
        2
        * np.pi
        * np.hypot(np.fft.fftfreq(128, PIXEL / 2)[:, None], np.fft.rfftfreq(128, PIXEL / 2))
    )
    beyond = (wave > np.pi / PIXEL * np.sqrt(2)) & (wave < 2 * np.pi / PIXEL)
    density = np.abs(4 * orders) ** 2 * (PIXEL / 2) ** 2 / 128**2
    assert (density[beyond] / uncd(wave[beyond])).mean() == pytest.approx(1, abs=0.05)


def test_a_scan_of_a_tip_as_small_as_a_pixel_shows_the_surface():
    surface = random_surface(generator(4), 64, PIXEL / FINENESS, uncd)
    scan = imaged_scan(surface, 20, 0.1)
    np.testing.assert_array_equal(scan.heights, surface.heights[:40:FINENESS, :40:FINENESS])
    assert (scan.pixel_size, scan.periodic) == (PIXEL, False)


def test_a_scan_is_touched_by_what_lies_beyond_its_edges():
    surface = random_surface(generator(4), 64, PIXEL / FINENESS, uncd)
    tall = replace(surface, heights=surface.heights.copy())
    tall.heights[-1, 10] += 50.0  # beside the first row, across the edge of the period
    plain, touched = (imaged_scan(one, 20, 10.0).heights for one in (surface, tall))
    assert touched[0, 5] > plain[0, 5] + 20
