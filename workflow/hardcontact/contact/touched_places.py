"""The number of places of a scan that its contacts touch.

A particle on a flat scan carries every contact. Forces then scatter little, though they may differ
much where the particle is not.
"""

import numpy as np

from hardcontact.contact.geometry import Bodies
from hardcontact.contact.sphere_sums import Contacts


def touched_places(bodies: Bodies, contacts: Contacts) -> int:
    """Return the number of places of a mirrored scan that contacts touch.

    A contact touches where its gap is least. Contacts touch the same place if these pixels are the
    same in the scan, or are joined by contact pixels, corner to corner.
    """
    from scipy.ndimage import label  # A slow import.

    pixels = bodies.substrate.pixels
    touching = [
        (bodies.geometry.positions[list(index)] + offsets) % pixels
        for index, (_, offsets) in contacts.items()
    ]
    in_scan = [tuple(np.minimum(points, pixels - 1 - points).T) for points in touching]
    is_touched = np.zeros((pixels, pixels), bool)
    for points in in_scan:
        is_touched[points] = True
    patches, _ = label(is_touched, np.ones((3, 3)))
    return len({patches[rows[0], columns[0]] for rows, columns in in_scan})
