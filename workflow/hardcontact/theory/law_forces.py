"""Plastic pull-off forces for exponential laws, from which every law of attraction is mixed.

The sums are computed once, on a grid of ranges. The force of any law at any range is the sum of
these forces, weighted by the shares of the exponential laws. Contact pixels are flattened to the
gap 0 before each sum. Flattened afterwards, they would multiply the sum over the other pixels by
exp(penetration/rho), which overflows at small ranges.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hardcontact.contact.bearing_area import all_lowest_gaps, as_tiles, lowest_gaps
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import Bodies, bodies, window_pixels
from hardcontact.contact.pull_off import FORCE, WORK_OF_ADHESION, pull_off_force, range_axis
from hardcontact.contact.sphere_sums import Contacts, outside_sums
from hardcontact.inference.filtered_masters import Filters, forces_at_cutoffs
from hardcontact.surfaces.height_map import HeightMap

Floats = NDArray[np.float64]

#: Grid of ranges of the exponential laws: step of their logarithm, and both ends in nm. With the
#: anchor 5.6 nm the mixture gives the pressure of every law of range 0.1 to 40 nm, at gaps up to
#: 300 nm, within 3e-4. With other anchors the error is at most 6e-3, where flats of 0.1 nm touch.
MIXED_RANGES = {"step": 0.6, "low": 0.02, "high": 1e5}
#: Largest exponent of a sum relative to the highest point of the surface: larger ones overflow.
LARGEST_EXPONENT = 600.0
#: Gap, in ranges beyond contact, from which a pixel adds less than the rounding error of the sum.
NEGLIGIBLE_RANGES = 40.0


def scan_range_forces(
    substrate: HeightMap,
    sphere: HeightMap | None,
    contact: Contact,
    law_window: float,
    ranges: Sequence[float],
) -> xr.Dataset:
    """Return the mean plastic pull-off force on a stitched scan by range of adhesion.

    substrate: stitched scan.
    sphere: roughness of the sphere; None for a smooth sphere.
    contact: the sphere, its load and the contacts.
    law_window: edge in nm of the window that attracts, as for `range_forces`.
    ranges: ranges of adhesion in nm.
    Returns ``pull_off_force`` (rho) in N at 1 J/m².
    """
    forces = range_forces(bodies(substrate, sphere, contact), contact, law_window, ranges)
    return xr.Dataset(
        {"pull_off_force": ("rho", forces.mean(axis=(1, 2)), FORCE)},
        range_axis(ranges),
        {"work_of_adhesion": WORK_OF_ADHESION},
    )


def filtered_range_forces(
    master: HeightMap,
    filters: Filters,
    contact: Contact,
    law_window: float,
    ranges: Sequence[float],
) -> xr.Dataset:
    """Return the mean plastic pull-off forces of a smooth sphere by cutoff and range.

    filters: the cutoffs of one side.
    contact, law_window, ranges: as for `scan_range_forces`.
    Returns as from `forces_at_cutoffs`, with the axis rho.
    """

    def mean_forces(surface: HeightMap) -> Floats:
        forces = range_forces(bodies(surface, None, contact), contact, law_window, ranges)
        return np.asarray(forces.mean(axis=(1, 2)))

    return forces_at_cutoffs(master, filters, mean_forces, range_axis(ranges))


def range_forces(
    contact_bodies: Bodies, contact: Contact, law_window: float, ranges: Sequence[float]
) -> Floats:
    """Return the plastic pull-off force of every contact by range of adhesion.

    contact_bodies: substrate and sphere.
    contact: its load gives the number of contact pixels.
    law_window: edge in nm of the window that attracts; the window is at least that of the contact.
        Power laws reach far.
    ranges: ranges of adhesion in nm, evenly spaced in their logarithm.
    Returns forces (rho, contact, contact) in N at 1 J/m².
    """
    pixel_size = contact_bodies.geometry.pixel_size
    rhos = np.asarray(ranges, float)
    contact_pixel_count = contact.pixel_count(pixel_size)
    contacts = all_lowest_gaps(contact_bodies, contact_pixel_count)
    window = max(window_pixels(law_window, pixel_size), contact_bodies.geometry.window)
    totals = contact_pixel_count + _sums_outside_contact(contact_bodies, window, contacts, rhos)
    return pull_off_force(totals, rhos[:, None, None], pixel_size, WORK_OF_ADHESION)


def _sums_outside_contact(
    narrow: Bodies, window: int, contacts: Contacts, ranges: Floats
) -> Floats:
    """Return the sums (rho, contact, contact) of exp(-gap/rho) outside contact, at any ranges.

    The fast sum is relative to the highest point of the surface. If a contact is deeper than
    LARGEST_EXPONENT ranges, the pixels near each contact are summed one by one.
    """
    contact_bodies = replace(narrow, geometry=replace(narrow.geometry, window=window))
    highest = float(contact_bodies.substrate.heights.max())
    if contact_bodies.roughness is not None:
        highest += float(contact_bodies.roughness.heights.max())
    deepest = max(gaps[-1] for gaps, _ in contacts.values()) + highest
    sums = np.empty((len(ranges), *[len(contact_bodies.geometry.positions)] * 2))
    is_fast = ranges * LARGEST_EXPONENT >= deepest
    if is_fast.any():
        sums[is_fast] = outside_sums(contact_bodies, contacts, ranges[is_fast])
    if not is_fast.all():
        near = _near_sums(narrow, contacts, ranges[~is_fast])
        sums[~is_fast] = np.moveaxis(near.reshape(*sums.shape[1:], -1), -1, 0)
    return sums


def _near_sums(contact_bodies: Bodies, contacts: Contacts, ranges: Floats) -> Floats:
    """Return the sums (contacts, rho) outside contact over the pixels that count at small ranges.

    The number of pixels grows until the farthest one is negligible.
    """
    substrate = as_tiles(contact_bodies.substrate)
    roughness = None if contact_bodies.roughness is None else as_tiles(contact_bodies.roughness)
    pixels = contact_bodies.geometry.window**2
    sums = []
    for indices, (touching, _) in contacts.items():
        position = contact_bodies.geometry.positions[[indices]]
        count = 2 * len(touching)
        enough = False
        while not enough:
            count = min(4 * count, pixels)
            ((gaps, _),) = lowest_gaps(
                substrate, roughness, contact_bodies.geometry, position, count
            )
            gaps_beyond_contact = gaps[len(touching) :] - gaps[len(touching) - 1]
            enough = gaps_beyond_contact[-1] > NEGLIGIBLE_RANGES * ranges.max() or count == pixels
        sums.append(np.exp(-gaps_beyond_contact / ranges[:, None]).sum(axis=1))
    return np.array(sums)
