"""What a levelled scan of a spectrum would show: its expected rms height, slope and curvature.

`scipy` is imported where it is used.
"""

import numpy as np
from numpy.typing import NDArray

from hardcontact.surfaces.spectrum import Density

__all__ = ["Weights", "expected_moments", "transfer_weights"]

#: Wavevectors (bins,) in rad/nm, and the weights (3, bins) of C_iso at them.
Weights = tuple[NDArray[np.float64], NDArray[np.float64]]

#: Bins of wavevectors in which weights are added up.
BINS = 4000

#: Rows of wavevectors that weights are computed of at a time.
ROWS = 512


def transfer_weights(pixels: int, pixel_size: float, window_pixels: int) -> Weights:
    """Return weights that turn C_iso into the expected squared moments of a scan.

    The scan is cut out of a larger periodic surface and levelled. Levelling takes from its
    height variance what a plane fits (Legendre functions of degree 0 and 1, whose transforms are
    spherical Bessel functions); its derivatives are differences of neighbouring pixels.

    Parameters
    ----------
    pixels, window_pixels : int
        Along an edge of the surface, and of the scan.
    pixel_size : float
        In nm.

    Returns
    -------
    wavevector : numpy.ndarray
        (bins,) in rad/nm.
    weights : numpy.ndarray
        (3, bins) for rms height², gradient² and half-Laplacian²:
        moments = weights @ C_iso(wavevector).
    """
    wave = 2 * np.pi * np.abs(np.fft.fftfreq(pixels, pixel_size))
    half = wave[: pixels // 2 + 1]
    count = np.where((half == 0) | (half == half.max()), 1.0, 2.0)
    shortest = np.hypot(wave.max(), half.max())
    edges = np.geomspace(half[1] * 0.999, shortest * 1.001, BINS + 1)
    mean, tilt, difference = _axis_factors(wave, pixel_size, window_pixels)
    along = slice(0, len(half))
    weights = np.zeros((3, BINS))
    for start in range(0, pixels, ROWS):
        rows = slice(start, start + ROWS)
        mean_y, tilt_y, difference_y = (factor[rows, None] for factor in (mean, tilt, difference))
        fitted = mean_y * mean[along] + tilt_y * mean[along] + mean_y * tilt[along]
        laplacian = difference_y + difference[along]
        radius = np.hypot(wave[rows, None], half)
        if start == 0:
            radius[0, 0] = half[1]  # the mean carries no weight, and log 0 no bin
        index = np.searchsorted(edges, radius.ravel()) - 1
        for k, factor in enumerate((1 - fitted, laplacian, laplacian**2 / 4)):
            weights[k] += np.bincount(index, (count * factor).ravel(), BINS)
    return np.sqrt(edges[1:] * edges[:-1]), weights / (pixels * pixel_size) ** 2


def _axis_factors(
    wave: NDArray[np.float64], pixel_size: float, window_pixels: int
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Return along one axis the shares that mean and tilt fit, and the squared difference."""
    from scipy.special import spherical_jn

    phase = wave * window_pixels * pixel_size / 2
    difference = (2 * np.sin(wave * pixel_size / 2) / pixel_size) ** 2
    return spherical_jn(0, phase) ** 2, 3 * spherical_jn(1, phase) ** 2, difference


def expected_moments(density: Density, weights: Weights) -> NDArray[np.float64]:
    """Return the expected rms height (nm), gradient and half-Laplacian (1/nm) of a scan: (3,)."""
    wavevector, factors = weights
    return np.sqrt(factors @ density(wavevector))
