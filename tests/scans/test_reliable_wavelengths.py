"""The reliable wavelengths of known surfaces end at pixels, tip, noise, smoothing or size."""

import numpy as np
import pytest
from measurements import measurement, random_line, random_map, uncd_density
from scipy.ndimage import gaussian_filter, gaussian_filter1d, grey_dilation

from hardcontact.base.arrays import generator
from hardcontact.scans.measured_spectrum import isotropic_psd
from hardcontact.scans.reliable_wavelengths import reliable_wavelengths
from hardcontact.surfaces.height_map import to_surface_topography
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.spectral_models import smooth_rolloff
from hardcontact.surfaces.spectrum import BIN_CENTRES
from hardcontact.surfaces.synthesis import random_surface

PIXEL = 10.0  # nm


def band_of(scan, tip_radius=None):
    return reliable_wavelengths(scan, tip_radius, isotropic_psd(scan))


def steep(q):
    """C_iso ~ q^-4.5: facets, or polished UNCD after Table 1."""
    return smooth_rolloff(q, plateau=1e6, rolloff=740.0, hurst=1.25)


@pytest.mark.parametrize("make", [random_map, random_line])
@pytest.mark.parametrize("density", [uncd_density, steep])
def test_a_faithful_scan_is_limited_by_its_pixels_and_its_size(make, density):
    for k in range(3):
        band = band_of(make(generator(1, k), 256, PIXEL, density))
        assert band.shortest == 4 * PIXEL and band.limited_by == "pixels"
        assert band.longest == pytest.approx(256 * PIXEL / 3)


def imaged_by_tip(heights, pixel, radius):
    """Return the path of the lowest point of a spherical tip that slides over heights."""
    reach = int(radius / pixel)
    squares = (np.arange(-reach, reach + 1) * pixel) ** 2
    distance = squares[:, None] + squares
    cap = np.sqrt(np.maximum(radius**2 - distance, 0)) - radius
    return grey_dilation(heights, footprint=distance <= radius**2, structure=cap, mode="nearest")


def test_a_tip_limits_the_band_where_its_image_leaves_the_surface():
    pixel, radius = 2.5, 40.0
    heights = random_surface(generator(2), 384, pixel, uncd_density).heights
    image = imaged_by_tip(heights, pixel, radius)
    true = measurement(heights[32:-32, 32:-32].astype(float), pixel)
    imaged = measurement(image[32:-32, 32:-32].astype(float), pixel)
    band = band_of(imaged, radius)
    cutoff = to_surface_topography(level_plane(imaged)).scanning_probe_reliability_cutoff(radius)
    assert band.shortest == pytest.approx(cutoff, rel=1e-3)
    assert band.limited_by == "tip"
    ratio = isotropic_psd(imaged) / isotropic_psd(true)
    wavelength = 2 * np.pi / BIN_CENTRES
    is_in_band = (wavelength > band.shortest) & (wavelength < band.longest)
    is_short = (wavelength > 4 * pixel) & (wavelength < band.shortest / 3)
    assert is_in_band.sum() >= 3 and is_short.sum() >= 3
    assert (np.abs(np.log(ratio[is_in_band])) < 0.35).all() and (ratio[is_short] < 0.6).all()


@pytest.mark.parametrize(("make", "pixels"), [(random_map, 256), (random_line, 2000)])
def test_a_floor_of_white_noise_is_cut_above_where_it_passes_the_surface(make, pixels):
    scan = make(generator(4), pixels, PIXEL)
    noisy = measurement(scan.heights + generator(5).normal(0, 10.0, scan.heights.shape), PIXEL)
    band = band_of(noisy)
    wavelength = 2 * np.pi / BIN_CENTRES
    excess = isotropic_psd(noisy) / isotropic_psd(scan)
    assert band.limited_by == "noise"
    is_in_band = (wavelength > band.shortest) & (wavelength < band.longest)
    assert (excess[is_in_band & np.isfinite(excess)] < 2).all()
    # At most half a decade of wavelengths with less noise than surface is lost.
    longest_noisy = wavelength[np.argmax(excess > 2)]
    assert longest_noisy < band.shortest < 3.2 * longest_noisy


def test_a_plateau_before_the_rolloff_is_no_floor():
    early = random_map(
        generator(6), 256, PIXEL, lambda q: smooth_rolloff(q, plateau=1e6, rolloff=150.0, hurst=0.9)
    )
    assert band_of(early).shortest == 4 * PIXEL


def test_white_noise_alone_is_nowhere_reliable():
    band = band_of(measurement(generator(7).normal(size=(128, 128)), PIXEL))
    assert band.shortest > band.longest and band.limited_by == "noise"


@pytest.mark.parametrize("is_along_lines", [True, False])
def test_smoothing_limits_the_band(is_along_lines):
    surface = random_surface(generator(8), 512, PIXEL, uncd_density).heights.astype(float)
    if is_along_lines:  # a feedback that lags
        smoothed = gaussian_filter1d(surface, 3.0, axis=1, mode="wrap")
    else:
        smoothed = gaussian_filter(surface, 3.0, mode="wrap")
    true = measurement(surface[:256, :256], PIXEL)
    scan = measurement(smoothed[:256, :256], PIXEL)
    band = band_of(scan)
    assert band.limited_by == "smoothing"
    transfer = isotropic_psd(scan) / isotropic_psd(true)
    wavelength = 2 * np.pi / BIN_CENTRES
    is_in_band = (wavelength > band.shortest) & (wavelength < band.longest)
    assert is_in_band.sum() >= 5 and (transfer[is_in_band] > 0.4).all()
    assert (transfer[(wavelength > 4 * PIXEL) & (wavelength < band.shortest / 2)] < 0.4).all()


def test_noise_does_not_hide_smoothing():
    surface = random_surface(generator(9), 512, PIXEL, uncd_density).heights.astype(float)
    smoothed = gaussian_filter(surface, 4.0, mode="wrap")[:256, :256]
    noisy = measurement(smoothed + generator(10).normal(0, 0.3, smoothed.shape), PIXEL)
    clean = band_of(measurement(smoothed, PIXEL))
    assert band_of(noisy).shortest == pytest.approx(clean.shortest, rel=0.3)
