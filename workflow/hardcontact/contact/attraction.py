"""Attraction over the pixels of single contacts: its pressure, and the asperities that carry it.

Of the fewest pixels that carry a share of the force, those that share an edge or a corner form one
asperity.
"""

import math
from collections.abc import Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy import ndimage

from hardcontact.base.arrays import Floats
from hardcontact.base.dataset import variables_of_columns
from hardcontact.base.units import NANOMETRE, NEWTON, NM, PASCAL
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import Bodies, flattened_gaps, gap_map, largest_contact_gap
from hardcontact.records.job import progress

ASPERITY_UNITS = {
    "largest_share": "1",
    "two_largest_share": "1",
    "asperity_count": "1",
    "extent": "nm",
}
#: Share of the force that the asperities carry together.
CARRIED_SHARE = 0.9
#: Bins of the histogram of attractions: one bin then holds few attractions to sort.
BIN_COUNT = 4096


def trace_contact(bodies: Bodies, index: tuple[int, int], contact: Contact) -> xr.Dataset:
    """Return the gap, adhesive pressure and force of one plastic contact of the array.

    The index is row and column in the array. Returns ``gap`` (y, x) in nm, negative where the rigid
    bodies would overlap, ``adhesive_pressure`` (y, x) in Pa and ``force`` (separation) in N.
    """
    pixel_size = bodies.geometry.pixel_size
    rho = contact.rho
    gap = gap_map(bodies, index)
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
        {
            "y": ("y", position, NM),
            "x": ("x", position, NM),
            "separation": ("separation", separation, NM),
        },
        {"rho": rho, "work_of_adhesion": contact.work, "pull_off_force": pull_off},
    )


def find_carrying_asperities(
    bodies: Bodies,
    contact: Contact,
    contact_indices: NDArray[np.int_],
    share: float,
    ranges: Sequence[float],
) -> xr.Dataset:
    """Return the sizes of the asperities that carry the force of some plastic contacts.

    The indices (contact, 2) are row and column in the array of contacts; ranges of adhesion are in
    nm. Returns the variables of ASPERITY_UNITS (contact, rho).
    """
    pixel_size = bodies.geometry.pixel_size
    contact_pixel_count = contact.pixel_count(pixel_size)
    offset = bodies.geometry.offsets()
    sphere = bodies.sphere(offset, offset)
    attraction = np.empty_like(sphere)
    asperity_values = []
    for index in progress(contact_indices, len(contact_indices), "contacts"):
        gap = flattened_gaps(gap_map(bodies, index, sphere), contact_pixel_count)
        for rho in ranges:
            np.exp(np.divide(gap, -rho, out=attraction), out=attraction)
            asperity_values.append(asperity_sizes(attraction, share, pixel_size))
    values = np.reshape(asperity_values, (len(contact_indices), len(ranges), -1))
    return xr.Dataset(
        variables_of_columns(values, ("contact", "rho"), ASPERITY_UNITS),
        {
            "rho": ("rho", ranges, NM),
            "contact_y": ("contact", contact_indices[:, 0]),
            "contact_x": ("contact", contact_indices[:, 1]),
        },
        {"share": share, "sphere_radius": bodies.geometry.radius},
    )


def asperity_sizes(
    attraction: Floats, share: float, pixel_size: float
) -> tuple[float, float, int, float]:
    """Return the ASPERITY_UNITS of the asperities that together carry a share of the force.

    The shares are those of the strongest asperity and of the two strongest. The extent (nm) is the
    diameter of the circle about the centre of force that holds the share of the force. The
    attraction (n, n) is proportional to the force on each pixel.
    """
    total = attraction.sum()
    is_carrier = attraction >= least_carrying_attraction(attraction, share, total)
    rows = np.flatnonzero(is_carrier.any(axis=1))
    columns = np.flatnonzero(is_carrier.any(axis=0))
    box = np.s_[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    label, count = ndimage.label(is_carrier[box], structure=np.ones((3, 3)))
    forces = np.sort(np.bincount(label.ravel(), attraction[box].ravel())[1:])[::-1] / total
    extent = _diameter(attraction, share, total) * pixel_size
    return forces[0], forces[:2].sum(), count, extent


def least_carrying_attraction(attraction: Floats, share: float, total: float) -> float:
    """Return the smallest attraction of the fewest pixels that carry a share of the total.

    A histogram finds the few attractions to sort: those of the bin in which the share is reached.
    """
    # All pixels of less than (1 - share) of the mean attraction carry together less than 1 - share
    # of the force: they are not among the fewest pixels that carry the share.
    minimum = (1 - share) * total / attraction.size
    strong = attraction[attraction > minimum]
    bins = (strong * (BIN_COUNT / strong.max())).astype(np.intp)
    carried = np.cumsum(np.bincount(bins, strong)[::-1])  # from the strongest bin on
    rank = int(np.searchsorted(carried, share * total))
    candidates = np.sort(strong[bins == len(carried) - 1 - rank])[::-1]
    carried_by_stronger = carried[rank - 1] if rank else 0.0
    weakest = int(np.searchsorted(carried_by_stronger + np.cumsum(candidates), share * total))
    return float(candidates[min(weakest, len(candidates) - 1)])


def _diameter(attraction: Floats, share: float, total: float) -> int:
    """Return the diameter in pixels of the circle about the centre of force that holds a share."""
    profile_y, profile_x = attraction.sum(axis=1), attraction.sum(axis=0)
    from_y, from_x = _distance_from_centre(profile_y), _distance_from_centre(profile_x)
    half_width = max(_half_width(from_y, profile_y, share), _half_width(from_x, profile_x, share))
    carried = np.zeros(1)
    # Widen a square about the centre until a circle in it holds the share.
    while carried[-1] < share * total and half_width < 2 * max(attraction.shape):
        half_width = math.ceil(1.5 * half_width)
        rows = np.flatnonzero(abs(from_y) <= half_width)
        columns = np.flatnonzero(abs(from_x) <= half_width)
        near = np.s_[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
        distance = np.sqrt(from_y[near[0], None] ** 2 + from_x[near[1]] ** 2)
        rings = np.rint(distance, out=distance).astype(np.intp)
        carried = np.cumsum(np.bincount(rings.ravel(), attraction[near].ravel())[:half_width])
    return 2 * int(np.searchsorted(carried, share * total))


def _half_width(distance: Floats, profile: Floats, share: float) -> int:
    """Return half the width in pixels of the strip that holds a share of a profile of force (n,).

    The circle that holds the share is at least as wide.
    """
    carried = np.cumsum(np.bincount(abs(distance).astype(np.intp), profile))
    return 1 + int(np.searchsorted(carried, share * carried[-1]))


def _distance_from_centre(profile: Floats) -> Floats:
    """Return the distance in pixels of each pixel (n,) from the centre of a profile of force."""
    position = np.arange(len(profile))
    return np.asarray(position - profile @ position / profile.sum())
