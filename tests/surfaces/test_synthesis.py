"""Random surfaces have their spectrum, scans are corners of them, masters keep part of a scan."""

import numpy as np
import pytest
from measurements import PIXEL, UNCD, cut_scan, levelled_scan, uncd_density

from hardcontact.base.arrays import generator
from hardcontact.surfaces.filters import interpolate, lowpass
from hardcontact.surfaces.height_map import HeightMap, mirror_scan
from hardcontact.surfaces.levelling import remove_form
from hardcontact.surfaces.synthesis import (
    ScanGrid,
    add_sphere_shape,
    long_edge_master,
    random_surface,
    sample_scan,
    short_edge_master,
)


def wavevectors(pixels, pixel_size):
    """Return the magnitudes (rad/nm) of the wavevectors (y, x) of a Fourier transform."""
    q = 2 * np.pi * np.fft.fftfreq(pixels, pixel_size)
    return np.hypot(q[:, None], q)


def test_random_surfaces_have_the_spectrum_that_they_are_made_from():
    pixels, pixel_size = 256, 20.0
    mean_density = np.zeros((pixels, pixels))
    for k in range(60):
        heights = random_surface(generator(2, k), pixels, pixel_size, uncd_density).heights
        mean_density += np.abs(np.fft.fft2(heights)) ** 2 * (pixel_size / pixels) ** 2 / 60
    q = wavevectors(pixels, pixel_size)
    for low, high in ((0.003, 0.01), (0.01, 0.03), (0.03, 0.1), (0.1, 0.15)):
        ring = (q > low) & (q < high)
        assert (mean_density[ring] / uncd_density(q[ring])).mean() == pytest.approx(1, abs=0.05)


def test_the_apex_of_a_sphere_lies_in_the_middle_half_of_its_scan():
    flat = HeightMap(np.zeros((64, 64)), 40.0)
    for k in range(20):
        scan = add_sphere_shape(generator(k), flat, 250e3)
        row, column = np.unravel_index(scan.heights.argmax(), scan.heights.shape)
        assert 15 <= row <= 48 and 15 <= column <= 48  # 64 pixels, rounded outwards
        np.testing.assert_allclose(remove_form(scan, 250e3).heights, 0, atol=1e-9)


def test_a_scan_is_the_corner_of_a_random_surface():
    scan = sample_scan(
        generator(1), uncd_density, ScanGrid(pixels=64, size=64 * PIXEL, surface_pixels=128), 0.7
    )
    assert not scan.periodic
    assert scan.pixel_size == pytest.approx(PIXEL)
    corner = cut_scan(random_surface(generator(1), 128, PIXEL, uncd_density), 64)
    np.testing.assert_array_equal(scan.heights, 0.7 * corner.heights)


@pytest.fixture(scope="module")
def mirrored():
    """A mirrored scan of UNCD: 128 pixels of 20 nm per row."""
    return mirror_scan(levelled_scan(generator(6), 64, 20.0))


def band(surface, low, high):
    """The heights of waves between two wavelengths (nm)."""
    wavevector = wavevectors(surface.pixels, surface.pixel_size)
    is_kept = (wavevector < 2 * np.pi / low * 0.999) & (wavevector > 2 * np.pi / high * 1.001)
    return np.fft.ifft2(np.fft.fft2(surface.heights) * is_kept).real


def test_short_edge_master_keeps_the_scan_above_the_transition(mirrored):
    master = short_edge_master(generator(1), mirrored, 512, 100.0, np.zeros_like)
    assert master.pixel_size == 5.0
    long_waves = interpolate(lowpass(mirrored, 100.0), 512)
    np.testing.assert_allclose(master.heights, long_waves.heights, atol=1e-4)


def test_short_edge_master_adds_the_spectrum_below_and_a_plateau_above(mirrored):
    # On a flat scan, only the added roughness remains.
    flat = HeightMap(np.zeros_like(mirrored.heights), 20.0, periodic=True)
    masters = [short_edge_master(generator(9, k), flat, 512, 100.0, UNCD) for k in range(8)]
    powers = [np.abs(np.fft.fft2(master.heights)) ** 2 for master in masters]
    density = np.mean(powers, axis=0) * (5 / 512) ** 2
    wavevector = wavevectors(512, 5.0)
    transition_q = 2 * np.pi / 100.0
    is_long = (wavevector < transition_q) & (wavevector > 0)
    is_short = (wavevector > transition_q) & (wavevector < 0.5)
    assert density[is_long].mean() == pytest.approx(uncd_density(transition_q), rel=0.02)
    assert (density[is_short] / uncd_density(wavevector[is_short])).mean() == pytest.approx(
        1, abs=0.05
    )


def test_long_edge_master_keeps_the_scan_below_the_transition(mirrored):
    master = long_edge_master(generator(2), mirrored, 2, 500.0, UNCD)
    repeated = HeightMap(np.tile(mirrored.heights, (2, 2)), 20.0, periodic=True)
    assert master.pixels == 2 * mirrored.pixels and master.pixel_size == 20.0
    np.testing.assert_allclose(band(master, 40, 499), band(repeated, 40, 499), atol=1e-3)
    assert np.std(band(master, 501, 5120) - band(repeated, 501, 5120)) > 1


def test_long_edge_master_adds_the_spectrum_above_the_transition(mirrored):
    flat = HeightMap(np.zeros_like(mirrored.heights), 20.0, periodic=True)
    masters = [long_edge_master(generator(3, k), flat, 2, 500.0, UNCD) for k in range(12)]
    pixels, wavevector = masters[0].pixels, wavevectors(masters[0].pixels, 20.0)
    powers = [np.abs(np.fft.fft2(master.heights)) ** 2 for master in masters]
    density = np.mean(powers, axis=0) * (20.0 / pixels) ** 2
    is_long = (wavevector < 2 * np.pi / 500) & (wavevector > 0)
    assert (density[is_long] / uncd_density(wavevector[is_long])).mean() == pytest.approx(
        1, abs=1e-4
    )
    assert density[wavevector > 2 * np.pi / 499].max() < 1e-6 * density[is_long].mean()
