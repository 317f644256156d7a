"""Sums over the window below a rough sphere, for all contacts of an array at once.

The substrate has the heights z, with a period of n pixels. The sphere is a paraboloid of heights y,
without a period, less the roughness u, which has a period of its own. At the contact c,

    sum over the window of exp((z(p) + u(p - c) - y(p - c))/rho)

is a correlation of two maps of n x n pixels: exp(z/rho), and the kernel exp((u - y)/rho), summed
over the images of each pixel in the window.
"""

from collections.abc import Iterator, Sequence
from itertools import product

import numpy as np
import scipy
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats
from hardcontact.contact.force_sum.touched_pixels import SphereTerms, TouchedPixels, exponential
from hardcontact.contact.geometry import Bodies, ContactGeometry

#: Rows of the kernel that are made at once: few enough for the cache.
KERNEL_ROWS = 64
#: Rows of the kernel that `_correlation_by_products` multiplies at once: few enough for the cache.
MULTIPLIED_ROWS = 4
#: Smallest sum, relative to the product of both norms, that Fourier transforms give to 1e-9.
SMALLEST_TRANSFORMED = 1e-6


def rough_sphere_terms(
    bodies: Bodies, touched_pixels: TouchedPixels, ranges: Sequence[float]
) -> Iterator[SphereTerms]:
    """Yield the `SphereTerms` of each range."""
    assert bodies.sphere_roughness is not None
    pixels = bodies.substrate.pixels
    positions = bodies.geometry.contact_positions
    heights = bodies.substrate.heights.astype(float)
    roughness = bodies.sphere_roughness.heights.astype(float)
    # (position, touched): first flat index of the kernel's row at a touched pixel, and its column.
    row_starts = (touched_pixels.row - positions[:, None]) % pixels * pixels
    columns = (touched_pixels.column - positions[:, None]) % pixels
    for rho in ranges:
        roughness_factor = exponential(roughness, float(roughness.max()), rho)
        kernel = _kernel(pixels, roughness_factor, bodies.geometry, rho)
        substrate_factor = exponential(heights, float(heights.max()), rho)
        touched_pixels.leave_out(substrate_factor)  # sets the touched pixels to zero in place

        def sphere_factor_at(index: tuple[int, int], kernel: Floats = kernel) -> Floats:
            return np.asarray(kernel.take(row_starts[index[0]] + columns[index[1]]))

        yield SphereTerms(_correlation(substrate_factor, kernel, positions), sphere_factor_at)


def _kernel(
    pixels: int, roughness_factor: NDArray[np.floating], geometry: ContactGeometry, rho: float
) -> Floats:
    """Return exp((u - max(u) - y)/rho) at offsets (n, n) from the apex, summed over images.

    Offsets that differ by a period of the substrate meet the same pixel of it: its images. As the
    roughness has another period, it is shifted from image to image.
    """
    period = len(roughness_factor)
    axis_factors = _axis_factors_by_shift(pixels, period, geometry, rho)
    kernel = np.zeros((pixels, pixels))
    offsets = np.arange(pixels)
    for start in range(0, pixels, KERNEL_ROWS):
        rows = offsets[start : start + KERNEL_ROWS]
        for (shift_y, factor_y), (shift_x, factor_x) in product(axis_factors.items(), repeat=2):
            shifted_rows = (rows + shift_y) % period
            shifted_columns = (offsets + shift_x) % period
            shifted = roughness_factor[np.ix_(shifted_rows, shifted_columns)]
            kernel[rows] += factor_y[rows, None] * factor_x * shifted
    return kernel


def _axis_factors_by_shift(
    pixels: int, period: int, geometry: ContactGeometry, rho: float
) -> dict[int, Floats]:
    """Return exp(-y/rho) (n,) along one axis, by the shift of the sphere's roughness in pixels.

    Each image of the substrate meets the roughness at a shift. Images with equal shifts are summed.
    """
    factors: dict[int, Floats] = {}
    # The periods of the substrate that half a window reaches, rounded up.
    reach = -(-geometry.window_pixels // (2 * pixels))
    for image in range(-reach, reach):
        offset = np.arange(pixels) + image * pixels
        decay = np.exp(-geometry.paraboloid(offset) / rho)
        axis_factor = np.where(geometry.window_mask(offset), decay, 0.0)
        shift = image * pixels % period
        factors[shift] = factors.get(shift, np.zeros(pixels)) + axis_factor
    return factors


def _correlation(
    substrate_factor: NDArray[np.floating], kernel: Floats, positions: NDArray[np.int_]
) -> Floats:
    """Return the sums (contact_y, contact_x) of the factor times the kernel about each contact.

    Fourier transforms are three times faster than products, but inaccurate for small sums.
    """
    sums = _correlation_by_transforms(substrate_factor, kernel, positions)
    norm = np.linalg.norm(substrate_factor) * np.linalg.norm(kernel)
    if sums.min() > SMALLEST_TRANSFORMED * norm:
        return sums
    return _correlation_by_products(substrate_factor, kernel, positions)


def _correlation_by_transforms(
    substrate_factor: NDArray[np.floating], kernel: Floats, positions: NDArray[np.int_]
) -> Floats:
    """Return the sums of `_correlation`, with an error of 1e-15 of the product of both norms."""
    transform = scipy.fft.rfft2(substrate_factor)
    transform *= np.conj(scipy.fft.rfft2(kernel))
    rows = scipy.fft.ifft(transform, axis=0, overwrite_x=True)[positions]
    return np.asarray(scipy.fft.irfft(rows, len(kernel), axis=1)[:, positions])


def _correlation_by_products(
    substrate_factor: NDArray[np.floating], kernel: Floats, positions: NDArray[np.int_]
) -> Floats:
    """Return the sums of `_correlation`, accurate if small, because no term is negative."""
    pixels = len(kernel)
    sums = np.zeros((len(positions),) * 2)
    for start in range(0, pixels, MULTIPLIED_ROWS):
        kernel_rows = kernel[start : start + MULTIPLIED_ROWS]
        two_periods = np.tile(kernel_rows, 2)
        shifted = np.lib.stride_tricks.sliding_window_view(two_periods, pixels, axis=1)
        row_indices = np.arange(start, start + len(kernel_rows))[:, None] + positions
        # For each row of the kernel, both bodies have a matrix (contact, n).
        sphere_rows = shifted[:, pixels - positions].transpose(0, 2, 1)
        sums += (substrate_factor[row_indices % pixels] @ sphere_rows).sum(axis=0)
    return sums
