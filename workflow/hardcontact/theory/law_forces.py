"""Plastic pull-off at the ranges that every law of attraction is a mixture of.

The sums at one grid of ranges are computed once. The force of any law at any range adds them up
with the shares that the exponential laws have in it. The contact pixels are flattened to the gap 0
before each sum: subtracted afterwards, they would multiply all that lies outside by
exp(penetration/rho), which exceeds any float at small ranges.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hardcontact.band.filtered_masters import Filters, forces_at_cutoffs
from hardcontact.contact.bearing_area import all_lowest_gaps, as_tiles, lowest_gaps
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import Bodies, bodies, window_pixels
from hardcontact.contact.pull_off import FORCE, WORK_OF_ADHESION, pull_off_force, range_axis
from hardcontact.contact.sphere_sums import Contacts, outside_sums
from hardcontact.surfaces.height_map import HeightMap

Floats = NDArray[np.float64]

#: The ranges that laws are mixtures of: the step of their logarithm, and both ends in nm. With the
#: anchor 5.6 nm they give the pressure of every law of 0.1 to 40 nm, at gaps up to 300 nm, to 3e-4;
#: with other anchors to 6e-3, where flats of 0.1 nm touch.
MIXED_RANGES = {"step": 0.6, "low": 0.02, "high": 1e5}
#: Exponents beyond which a sum relative to the highest point of the surface leaves the floats.
LARGEST_EXPONENT = 600.0
#: A pixel this many ranges beyond contact adds less than the rounding of the sum.
NEGLIGIBLE = 40.0


def scan_range_forces(
    substrate: HeightMap,
    sphere: HeightMap | None,
    contact: Contact,
    reach: float,
    ranges: Sequence[float],
) -> xr.Dataset:
    """Return the mean plastic ``pull_off_force`` (rho) in N at 1 J/m² on a stitched scan.

    The sphere is its roughness, or None for a smooth sphere; reach and ranges are as of
    `range_forces`.
    """
    forces = range_forces(bodies(substrate, sphere, contact), contact, reach, ranges)
    return xr.Dataset(
        {"pull_off_force": ("rho", forces.mean(axis=(1, 2)), FORCE)},
        range_axis(ranges),
        {"work_of_adhesion": WORK_OF_ADHESION},
    )


def filtered_range_forces(
    master: HeightMap,
    filters: Filters,
    contact: Contact,
    reach: float,
    ranges: Sequence[float],
) -> xr.Dataset:
    """Return `forces_at_cutoffs` of a smooth sphere, means over contacts by range."""

    def mean_forces(surface: HeightMap) -> Floats:
        forces = range_forces(bodies(surface, None, contact), contact, reach, ranges)
        return np.asarray(forces.mean(axis=(1, 2)))

    return forces_at_cutoffs(master, filters, mean_forces, range_axis(ranges))


def range_forces(pair: Bodies, contact: Contact, reach: float, ranges: Sequence[float]) -> Floats:
    """Return the plastic pull-off force (rho, contact, contact) in N at 1 J/m².

    The ranges of adhesion (nm) are evenly spaced in their logarithm. The reach is the edge (nm) of
    the window that attracts, at least that of contact: power laws reach far.
    """
    pixel_size, rhos = pair.geometry.pixel_size, np.asarray(ranges, float)
    contact_pixels = contact.pixels(pixel_size)
    contacts = all_lowest_gaps(pair, contact_pixels)
    window = max(window_pixels(reach, pixel_size), pair.geometry.window)
    totals = contact_pixels + _outside(pair, window, contacts, rhos)
    return pull_off_force(totals, rhos[:, None, None], pixel_size, WORK_OF_ADHESION)


def _outside(narrow: Bodies, window: int, contacts: Contacts, ranges: Floats) -> Floats:
    """Return the sums (rho, contact, contact) of exp(-gap/rho) outside contact, at any ranges.

    The fast sum is relative to the highest point of the surface. Where a contact lies more than
    LARGEST_EXPONENT ranges below it, the pixels near each contact are summed one by one.
    """
    pair = replace(narrow, geometry=replace(narrow.geometry, window=window))
    highest = float(pair.substrate.heights.max())
    if pair.roughness is not None:
        highest += float(pair.roughness.heights.max())
    deepest = max(gaps[-1] for gaps, _ in contacts.values()) + highest
    outside = np.empty((len(ranges), *[len(pair.geometry.positions)] * 2))
    fast = ranges * LARGEST_EXPONENT >= deepest
    if fast.any():
        outside[fast] = outside_sums(pair, contacts, ranges[fast])
    if not fast.all():
        near = _near_sums(narrow, contacts, ranges[~fast])
        outside[~fast] = np.moveaxis(near.reshape(*outside.shape[1:], -1), -1, 0)
    return outside


def _near_sums(pair: Bodies, contacts: Contacts, ranges: Floats) -> Floats:
    """Return the sums (contacts, rho) outside contact, over pixels that count at small ranges."""
    substrate = as_tiles(pair.substrate)
    roughness = None if pair.roughness is None else as_tiles(pair.roughness)
    pixels = pair.geometry.window**2
    sums = []
    for place, (touching, _) in contacts.items():
        position, count = pair.geometry.positions[list(place)], 2 * len(touching)
        enough = False
        while not enough:
            count = min(4 * count, pixels)
            gaps, _ = lowest_gaps(substrate, roughness, pair.geometry, position, count)
            above = gaps[len(touching) :] - gaps[len(touching) - 1]
            enough = above[-1] > NEGLIGIBLE * ranges.max() or count == pixels
        sums.append(np.exp(-above / ranges[:, None]).sum(axis=1))
    return np.array(sums)
