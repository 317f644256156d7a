"""Gaps and forces pixel by pixel from their definitions, without the library that they test."""

import numpy as np


def mirror(heights):
    """Return a periodic map (2n, 2n): heights (n, n) beside their mirror images."""
    return np.pad(np.asarray(heights, float), [(0, len(heights))] * 2, mode="symmetric")


def gap_to_sphere(heights, position, pixels, pixel_size, radius, roughness=None):
    """Return the gap (pixels, pixels) in nm under a sphere, its apex in the plane of zero height.

    The apex is above the position (y, x) of periodic heights and above the middle of the gap. The
    roughness of the sphere is periodic, too, with the origin at the apex.
    """
    offsets = np.arange(pixels) - pixels // 2
    squares = (offsets * pixel_size) ** 2
    gap = (squares[:, None] + squares) / (2 * radius)
    gap -= heights[np.ix_(*((index + offsets) % len(heights) for index in position))]
    if roughness is not None:
        gap -= roughness[np.ix_(*[offsets % len(roughness)] * 2)]
    return gap


def gap_of_bodies(bodies, index):
    """Return the gap (nm) in the window of the contact at an index (row, column) of the array."""
    geometry, sphere = bodies.geometry, bodies.sphere_roughness
    return gap_to_sphere(
        bodies.substrate.heights,
        geometry.contact_positions[list(index)],
        geometry.window_pixels,
        geometry.pixel_size,
        geometry.radius,
        None if sphere is None else sphere.heights,
    )


def direct_total(gap, contact_pixel_count, rho):
    """Return the sum of exp(-gap/rho) over a gap (nm) closed until a number of pixels touch."""
    largest_contact_gap = np.partition(gap, contact_pixel_count - 1, None)[contact_pixel_count - 1]
    return np.exp(-np.maximum(gap - largest_contact_gap, 0) / rho).sum()


def direct_force(gap, contact_pixel_count, rho, pixel_size, work=1.0):
    """Return the force in N at a work of adhesion in J/m², from a gap and a pixel size in nm."""
    pressure = work / (rho * 1e-9)
    return pressure * (pixel_size * 1e-9) ** 2 * direct_total(gap, contact_pixel_count, rho)
