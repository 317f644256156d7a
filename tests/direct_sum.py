"""Eq. 3 summed over every pixel: the oracle of the fast sums."""

import numpy as np

from hardcontact.contact.geometry import flattened_gaps
from hardcontact.contact.pull_off import contacts_and_totals


def direct_total(gap, contact_pixel_count, rho):
    """Sum of exp(-gap/rho) at plastic contact, of a gap (window, window) at any approach, in nm."""
    return float(np.exp(-flattened_gaps(gap, contact_pixel_count) / rho).sum())


def plastic_totals(bodies, contact_pixel_count, rho):
    """Sums of exp(-gap/rho) of an array of plastic contacts: (load, contact, contact)."""
    return contacts_and_totals(bodies, contact_pixel_count, [rho])[1][:, 0]
