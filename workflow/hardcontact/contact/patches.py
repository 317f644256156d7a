"""Patches: groups of pixels that share edges or corners."""

import numpy as np
import scipy
from numpy.typing import NDArray

from hardcontact.contact.bearing_area import ContactPixels
from hardcontact.contact.geometry import Bodies


def number_patches(points: NDArray[np.int_]) -> tuple[NDArray[np.int_], int]:
    """Return the number (...) of the patch of each point (..., 2), from 1, and the patch count."""
    corner = points.reshape(-1, 2).min(axis=0)
    rows, columns = np.moveaxis(points - corner, -1, 0)
    is_set = np.zeros((rows.max() + 1, columns.max() + 1), bool)
    is_set[rows, columns] = True
    patch_numbers, count = scipy.ndimage.label(is_set, np.ones((3, 3)))
    return patch_numbers[rows, columns], count


def count_touched_patches(bodies: Bodies, contact_pixels: ContactPixels) -> int:
    """Return the number of patches of a mirrored scan that hold the deepest pixel of a contact.

    The contact pixels of all contacts form the patches. A small number is a warning: if one
    particle carries every contact, forces on the scan scatter little, although other scans may give
    quite different ones.
    """
    pixels = bodies.substrate.pixels
    points = (bodies.geometry.apexes()[:, :, None] + contact_pixels.offsets) % pixels
    # Fold the mirror images back onto the scan, a quarter of the map.
    patches, _ = number_patches(np.minimum(points, pixels - 1 - points))
    # The first pixel of a contact is the deepest.
    return len(np.unique(patches[..., 0]))
