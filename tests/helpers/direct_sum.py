"""Eq. 3 summed over every pixel: the oracle of the fast sums."""

import numpy as np

from hardcontact.contact.bearing_area import all_contact_pixels
from hardcontact.contact.geometry import flattened_gaps
from hardcontact.contact.pull_off import attraction_totals


def gap_to_sphere(heights, position, pixels, pixel_size, radius):
    """Return the gap (pixels, pixels) between periodic heights and a smooth sphere above them.

    The gap (nm) is that at an apex in the plane of zero height, above the position (y, x).
    """
    offsets = np.arange(pixels) - pixels // 2
    shape = (offsets * pixel_size) ** 2 / (2 * radius)
    rows, columns = ((index + offsets) % len(heights) for index in position)
    return shape[:, None] + shape - heights[np.ix_(rows, columns)]


def direct_total(gap, contact_pixel_count, rho):
    """Return the sum of exp(-gap/rho) at plastic contact, of a gap (window, window) in nm."""
    return float(np.exp(-flattened_gaps(gap, contact_pixel_count) / rho).sum())


def direct_force(gap, contact_pixel_count, rho, pixel_size, work=1.0):
    """Return the force in N at a work of adhesion in J/m², from a gap and a pixel size in nm."""
    pressure = work / (rho * 1e-9)
    return pressure * (pixel_size * 1e-9) ** 2 * direct_total(gap, contact_pixel_count, rho)


def plastic_totals(bodies, pixel_counts, rho):
    """Return the sums of exp(-gap/rho) of plastic contacts: (loading, contact_y, contact_x)."""
    contacts = all_contact_pixels(bodies, max(pixel_counts))
    return attraction_totals(bodies, contacts, pixel_counts, [rho])[:, 0]
