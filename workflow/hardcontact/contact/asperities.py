"""The asperities that carry the force of some contacts of one pair of scans.

Pixels that share an edge or a corner belong to one patch.
"""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy import ndimage

from hardcontact.base.job import progress
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import Bodies, flattened_gaps, gap_map

Floats = NDArray[np.float64]

ASPERITY_UNITS = {
    "largest_share": "1",
    "two_largest_share": "1",
    "patch_count": "1",
    "extent": "nm",
}
#: Share of the force that the patches of the fewest pixels carry.
SHARE = 0.9


def asperities(
    attraction: Floats, share: float, pixel_size: float
) -> tuple[float, float, int, float]:
    """Return the ASPERITY_UNITS of the fewest pixels that carry a share of the force.

    These are the shares of the force that the largest patch and the two largest patches carry, the
    number of patches, and the diameter in nm of the circle about the centre of force that holds the
    share. The attraction (n, n) is proportional to the force on each pixel.
    """
    total = attraction.sum()
    # Pixels of less attraction than the mean of the rest of the force together carry at most the
    # rest: they are not among the fewest pixels that carry the share.
    least_attraction = (1 - share) * total / attraction.size
    values = np.sort(attraction[attraction > least_attraction])[::-1]
    weakest = values[np.searchsorted(np.cumsum(values), share * total)]
    (box,) = ndimage.find_objects((attraction >= weakest).astype(np.int8))
    box_attraction = attraction[box]
    label, count = ndimage.label(box_attraction >= weakest, structure=np.ones((3, 3)))
    forces = np.sort(np.bincount(label.ravel(), box_attraction.ravel())[1:])[::-1] / total
    extent = _diameter(attraction, share, total) * pixel_size
    return forces[0], forces[:2].sum(), count, extent


def _diameter(attraction: Floats, share: float, total: float) -> int:
    """Return the diameter in pixels of the circle about the centre of force that holds a share."""
    from_y = _distance_from_centre(attraction.sum(axis=1))
    from_x = _distance_from_centre(attraction.sum(axis=0))
    half_width = 32
    carried = np.zeros(1)
    # Squares about the centre, each twice as wide, until a circle in one holds the share.
    while carried[-1] < share * total and half_width < 2 * max(attraction.shape):
        half_width *= 2
        rows = np.flatnonzero(abs(from_y) <= half_width)
        columns = np.flatnonzero(abs(from_x) <= half_width)
        near = np.s_[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
        distance = np.rint(np.hypot(from_y[near[0], None], from_x[near[1]])).astype(int)
        carried = np.cumsum(np.bincount(distance.ravel(), attraction[near].ravel())[:half_width])
    return 2 * int(np.searchsorted(carried, share * total))


def _distance_from_centre(profile: Floats) -> Floats:
    """Return the distance in pixels of each place (n,) from the centre of a profile of force."""
    place = np.arange(len(profile))
    return np.asarray(place - profile @ place / profile.sum())


def asperities_of_pair(
    bodies: Bodies,
    contact: Contact,
    contact_indices: NDArray[np.int_],
    share: float,
    ranges: Sequence[float],
) -> xr.Dataset:
    """Return which asperities carry the force of some plastic contacts.

    The indices (contact, 2) are row and column in the array of contacts; ranges of adhesion are in
    nm. Returns the variables of ASPERITY_UNITS (contact, rho).
    """
    pixel_size = bodies.geometry.pixel_size
    contact_pixel_count = contact.pixel_count(pixel_size)
    carriers = []
    for index in progress(contact_indices, len(contact_indices), "contacts"):
        gap = flattened_gaps(gap_map(bodies, index), contact_pixel_count)
        carriers.append([asperities(np.exp(-gap / rho), share, pixel_size) for rho in ranges])
    values = np.array(carriers)
    return xr.Dataset(
        {
            name: (("contact", "rho"), values[..., k], {"units": unit})
            for k, (name, unit) in enumerate(ASPERITY_UNITS.items())
        },
        {
            "rho": ("rho", ranges, {"units": "nm", "long_name": "range of adhesion"}),
            "contact_y": ("contact", contact_indices[:, 0]),
            "contact_x": ("contact", contact_indices[:, 1]),
        },
        {"share": share, "sphere_radius": bodies.geometry.radius},
    )
