"""Eq. 3 summed over every pixel: what the fast sums are checked against."""

import numpy as np

from hardcontact.contact.geometry import flattened_gaps


def direct_total(gap, contact_pixels, rho):
    """Sum of exp(-gap/rho) at plastic contact, of a gap (window, window) at any approach, in nm."""
    return float(np.exp(-flattened_gaps(gap, contact_pixels) / rho).sum())
