"""The number of places of a scan that its contacts touch.

A place is a patch of connected contact pixels. A particle on a flat scan would carry every contact:
forces then scatter little, though they may be very different away from the particle.
"""

import numpy as np

from hardcontact.contact.geometry import Bodies
from hardcontact.contact.sphere_sums import Contacts


def touched_places(bodies: Bodies, contacts: Contacts) -> int:
    """Return the number of places of a mirrored scan that hold the deepest pixel of some contact.

    The deepest pixel is that of the smallest gap. Two contacts touch the same place if
    these two pixels are the same in the scan, or if contact pixels that share an edge or a corner
    connect them.
    """
    from scipy.ndimage import label  # A slow import.

    pixels = bodies.substrate.pixels
    contact_points = [
        (bodies.geometry.positions[list(index)] + offsets) % pixels
        for index, (_, offsets) in contacts.items()
    ]
    # Fold the mirror images back onto the scan.
    scan_pixels = [tuple(np.minimum(points, pixels - 1 - points).T) for points in contact_points]
    is_touched = np.zeros((pixels, pixels), bool)
    for points in scan_pixels:
        is_touched[points] = True
    patches, _ = label(is_touched, np.ones((3, 3)))
    # The first pixel of a contact has its lowest gap.
    return len({patches[rows[0], columns[0]] for rows, columns in scan_pixels})
