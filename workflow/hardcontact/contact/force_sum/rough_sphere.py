"""Sums over a rough sphere: the correlation of exp(z/rho) with the kernel exp((u - y)/rho)."""

from collections.abc import Iterator, Sequence
from itertools import product

import numpy as np
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats
from hardcontact.contact.force_sum.touched_pixels import SphereTerms, TouchedPixels, exponential
from hardcontact.contact.geometry import Bodies, ContactGeometry

#: Rows of the kernel that are made at once: few enough for the cache.
KERNEL_ROWS = 64
#: Smallest sum, relative to the norms of its factors, that Fourier transforms give to 1e-9.
SMALLEST_TRANSFORMED = 1e-6


def rough_sphere_terms(
    bodies: Bodies, touched_pixels: TouchedPixels, ranges: Sequence[float]
) -> Iterator[SphereTerms]:
    """Yield the `SphereTerms` of each range, relative to the highest u of the rough sphere."""
    assert bodies.sphere_roughness is not None
    pixels = bodies.substrate.pixels
    positions = bodies.geometry.positions
    heights = bodies.substrate.heights.astype(float)
    roughness = bodies.sphere_roughness.heights.astype(float)
    # Rows, as flat indices, and columns of contact pixels from each position: (position, pixels).
    rows = (touched_pixels.row - positions[:, None]) % pixels * pixels
    columns = (touched_pixels.column - positions[:, None]) % pixels
    for rho in ranges:
        sphere_factor = exponential(roughness, float(roughness.max()), rho)
        kernel = _kernel(pixels, sphere_factor, bodies.geometry, rho)
        substrate_factor = exponential(heights, float(heights.max()), rho)
        touched_pixels.leave_out(substrate_factor)

        def factor(index: tuple[int, int], kernel: Floats = kernel) -> Floats:
            return np.asarray(kernel.take(rows[index[0]] + columns[index[1]]))

        yield SphereTerms(_correlation(substrate_factor, kernel, positions), factor)


def _kernel(
    pixels: int, sphere_factor: NDArray[np.floating], geometry: ContactGeometry, rho: float
) -> Floats:
    """Return exp((u - max(u) - y)/rho) on (n, n) offsets from the apex, summed over images.

    `sphere_factor` is exp((u - max(u))/rho) on one period of the sphere.
    """
    period = len(sphere_factor)
    weights = _axis_factors_by_shift(pixels, period, geometry, rho)
    kernel = np.zeros((pixels, pixels))
    columns = np.arange(pixels)
    for start in range(0, pixels, KERNEL_ROWS):
        rows = columns[start : start + KERNEL_ROWS]
        for (shift_y, weight_y), (shift_x, weight_x) in product(weights.items(), repeat=2):
            shifted = sphere_factor[np.ix_((rows + shift_y) % period, (columns + shift_x) % period)]
            kernel[rows] += weight_y[rows, None] * weight_x * shifted
    return kernel


def _axis_factors_by_shift(
    pixels: int, period: int, geometry: ContactGeometry, rho: float
) -> dict[int, Floats]:
    """Return exp(-y/rho) along one axis, summed over images of the same shift of the roughness."""
    weights: dict[int, Floats] = {}
    reach = -(-geometry.window_pixels // (2 * pixels))
    for image in range(-reach, reach):
        offset = np.arange(pixels) + image * pixels
        decay = np.exp(-geometry.paraboloid(offset) / rho)
        weight = np.where(geometry.window_mask(offset), decay, 0.0)
        shift = image * pixels % period
        weights[shift] = weights.get(shift, np.zeros(pixels)) + weight
    return weights


def _correlation(
    substrate_factor: NDArray[np.floating], kernel: Floats, positions: NDArray[np.int_]
) -> Floats:
    """Return the sum (contact_y, contact_x) of factor times kernel, shifted to each contact.

    Fourier transforms are three times faster than products, but inaccurate for small sums.
    """
    total = _correlation_by_transforms(substrate_factor, kernel, positions)
    norm = np.linalg.norm(substrate_factor) * np.linalg.norm(kernel)
    if total.min() > SMALLEST_TRANSFORMED * norm:
        return total
    return _correlation_by_products(substrate_factor, kernel, positions)


def _correlation_by_transforms(
    substrate_factor: NDArray[np.floating], kernel: Floats, positions: NDArray[np.int_]
) -> Floats:
    """Return `_correlation` with an error of 1e-16 of the norms of both factors."""
    from scipy import fft

    transform = fft.rfft2(substrate_factor)
    transform *= np.conj(fft.rfft2(kernel))
    rows = fft.ifft(transform, axis=0, overwrite_x=True)[positions]
    return np.asarray(fft.irfft(rows, len(kernel), axis=1)[:, positions])


def _correlation_by_products(
    substrate_factor: NDArray[np.floating], kernel: Floats, positions: NDArray[np.int_]
) -> Floats:
    """Return `_correlation` with an error relative to each sum."""
    # Each row of the kernel times one row of the factor for every contact: matrices again.
    pixels = len(kernel)
    step = 4
    total = np.zeros((len(positions),) * 2)
    for start in range(0, pixels, step):
        rows = kernel[start : start + step]
        two_periods = np.concatenate([rows, rows], axis=1)
        shifted = np.lib.stride_tricks.sliding_window_view(two_periods, pixels, axis=1)
        shifted_rows = np.arange(start, start + len(rows))[:, None] + positions
        columns = shifted[:, pixels - positions]
        total += (substrate_factor[shifted_rows % pixels] @ columns.transpose(0, 2, 1)).sum(axis=0)
    return total
