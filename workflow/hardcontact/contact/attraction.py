"""Attraction over the pixels of single contacts: its pressure, and the asperities that carry it.

Patches (`patches`) of the fewest pixels that carry 90 % of the force are called asperities.
"""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy import ndimage

from hardcontact.base.arrays import Floats
from hardcontact.base.dataset import variables_of_columns
from hardcontact.base.progress import progress
from hardcontact.base.units import NANOMETRE, NEWTON, NM, PASCAL
from hardcontact.contact.contact import CONTACT_AXES, Contact
from hardcontact.contact.geometry import Bodies, largest_contact_gap, reference_gap_map

#: The quantities of `asperity_sizes`, with their units.
ASPERITY_UNITS = {
    "largest_share": "1", "two_largest_share": "1", "asperity_count": "1", "extent": "nm",
}  # fmt: skip
#: Share of the force that the asperities carry together.
CARRIED_SHARE = 0.9


def trace_contact(bodies: Bodies, index: tuple[int, int], contact: Contact) -> xr.Dataset:
    """Return gap, adhesive pressure (y, x) and force (separation,) of one contact of the array.

    The contact is plastic: gaps are negative where rigid bodies would overlap. The force is
    negative, because it attracts; adhesive pressure and ``pull_off_force`` are positive.
    """
    pixel_size = bodies.geometry.pixel_size
    rho = contact.rho
    gap = reference_gap_map(bodies, index)
    gap -= largest_contact_gap(gap, contact.pixel_count(pixel_size))
    pressure = contact.work / (rho * NANOMETRE) * np.exp(-np.maximum(gap, 0) / rho)
    pull_off = float(pressure.sum()) * (pixel_size * NANOMETRE) ** 2
    # The bodies keep their deformed shape: all gaps grow by the same length.
    separation = np.linspace(0, 10 * rho, 201)
    position = bodies.geometry.offsets() * pixel_size
    return xr.Dataset(
        {
            "gap": (("y", "x"), gap.astype(np.float32), NM),
            "adhesive_pressure": (("y", "x"), pressure.astype(np.float32), PASCAL),
            "force": ("separation", -pull_off * np.exp(-separation / rho), NEWTON),
        },
        {axis: (axis, position, NM) for axis in ("y", "x")}
        | {"separation": ("separation", separation, NM)},
        {"rho": rho, "work_of_adhesion": contact.work, "pull_off_force": pull_off},
    )


def find_carrying_asperities(
    bodies: Bodies, contact: Contact, contact_indices: NDArray[np.int_], ranges: Sequence[float]
) -> xr.Dataset:
    """Return ASPERITY_UNITS (contact, rho) of plastic contacts, given by row and column (k, 2)."""
    pixel_size = bodies.geometry.pixel_size
    contact_pixel_count = contact.pixel_count(pixel_size)
    offset = bodies.geometry.offsets()
    sphere_heights = bodies.sphere_heights(offset, offset)
    sizes = []
    for index in progress(contact_indices, len(contact_indices), "contacts"):
        gap = reference_gap_map(bodies, index, sphere_heights)
        gap = np.maximum(gap - largest_contact_gap(gap, contact_pixel_count), 0)
        for rho in ranges:
            sizes.append(asperity_sizes(np.exp(gap / -rho), CARRIED_SHARE, pixel_size))
    columns = np.reshape(sizes, (len(contact_indices), len(ranges), -1))
    return xr.Dataset(
        variables_of_columns(columns, ("contact", "rho"), ASPERITY_UNITS),
        {"rho": ("rho", ranges, NM)}
        | {axis: ("contact", contact_indices[:, k]) for k, axis in enumerate(CONTACT_AXES)},
        {"share": CARRIED_SHARE, "sphere_radius": bodies.geometry.radius},
    )


def asperity_sizes(
    attraction: Floats, share: float, pixel_size: float
) -> tuple[float, float, int, float]:
    """Return the quantities of ASPERITY_UNITS for the asperities that carry a share of the force.

    The asperities are the connected groups of the fewest pixels that carry this share. Returns the
    shares that the strongest and the two strongest carry, the number of asperities, and the extent.
    The extent is the diameter (nm) of the circle about the centre of force that holds the share.
    The attraction (n, n) has any unit.
    """
    total = attraction.sum()
    is_carrier = attraction >= least_carrying_attraction(attraction, share)
    # The box around all carriers makes numbering faster.
    box = ndimage.find_objects(is_carrier.view(np.int8))[0]
    numbers, count = ndimage.label(is_carrier[box], structure=np.ones((3, 3)))
    shares = np.sort(np.bincount(numbers.ravel(), attraction[box].ravel())[1:])[::-1] / total
    extent = _diameter_in_pixels(attraction, share) * pixel_size
    return shares[0], shares[:2].sum(), count, extent


def least_carrying_attraction(attraction: Floats, share: float) -> float:
    """Return the smallest attraction of the fewest pixels that carry a share of the total.

    The fewest pixels are the strongest, added up until they carry the share.
    """
    total = attraction.sum()
    # Sorting all pixels would be slow. Those weaker than (1 - share) times the mean are not needed,
    # because even all pixels with this attraction would carry only 1 - share.
    strong = np.sort(attraction[attraction > (1 - share) * total / attraction.size])[::-1]
    weakest_index = np.searchsorted(np.cumsum(strong), share * total)
    return float(strong[min(weakest_index, len(strong) - 1)])


def _diameter_in_pixels(attraction: Floats, share: float) -> int:
    """Return the diameter of the circle about the centre of force that holds a share."""
    distance_y = _distance_from_centre(attraction.sum(axis=1))
    distance_x = _distance_from_centre(attraction.sum(axis=0))
    rings = np.rint(np.sqrt(distance_y[:, None] ** 2 + distance_x**2)).astype(np.intp)
    carried = np.cumsum(np.bincount(rings.ravel(), attraction.ravel()))
    return 2 * int(np.searchsorted(carried, share * carried[-1]))


def _distance_from_centre(profile: Floats) -> Floats:
    """Return the signed distance in pixels of each pixel (n,) from a profile's centre of force."""
    position = np.arange(len(profile))
    return np.asarray(position - profile @ position / profile.sum())
