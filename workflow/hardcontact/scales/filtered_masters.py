"""Forces on a master, whole and filtered below or above every cutoff wavelength.

The side ``"small"`` removes wavelengths below the cutoffs, ``"large"`` those above.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hardcontact.adhesion.pull_off import (
    CONTACT_AXES,
    FORCE,
    WORK_OF_ADHESION,
    Axis,
    load_axis,
    mean_pull_off_of_pair,
    plastic_totals,
    pull_off_force,
)
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import bodies
from hardcontact.records.job import progress
from hardcontact.surfaces.filters import filtered_series
from hardcontact.surfaces.height_map import HeightMap


class Filters(NamedTuple):
    """The cutoffs of one side that a master is filtered at, one at a time."""

    side: str  #: "small": wavelengths below the cutoff are removed; "large": those above.
    pixels: int  #: Along an edge of the filtered surfaces.
    cutoffs: Sequence[float]  #: In nm.


def forces_at_cutoffs(
    master: HeightMap,
    filters: Filters,
    forces: Callable[[HeightMap], NDArray[np.float64]],
    axes: Mapping[str, Axis],
) -> xr.Dataset:
    """Return the forces on a periodic master, whole and filtered at every cutoff of a side.

    `forces` takes a filtered surface and returns its forces (...) in N at 1 J/m², whose dimensions
    and coordinates, in their order, are the axes. No surface is kept while the next one is
    filtered. ``pull_off_force`` (cutoff_wavelength, ...) and ``unfiltered_pull_off_force`` (...)
    stand beside ``unfiltered_wavelength``, the end of the unfiltered spectrum in nm.
    """
    side, pixels, cutoffs = filters
    surfaces = filtered_series(master, side, [None, *cutoffs], pixels)
    each = (forces(surface) for surface in surfaces)
    unfiltered, *filtered = progress(each, 1 + len(cutoffs), "cutoffs")
    end = 2 * master.size / pixels if side == "small" else master.size
    nanometres = {"units": "nm", "long_name": "end of the unfiltered spectrum"}
    cutoff_axis = (("cutoff_wavelength",), np.asarray(cutoffs, float), {"units": "nm"})
    return xr.Dataset(
        {
            "unfiltered_pull_off_force": (tuple(axes), unfiltered, FORCE),
            "pull_off_force": (("cutoff_wavelength", *axes), np.array(filtered), FORCE),
            "unfiltered_wavelength": ((), end, nanometres),
        },
        {"cutoff_wavelength": cutoff_axis, **axes},
        {"work_of_adhesion": WORK_OF_ADHESION},
    )


def filtered_pull_off(
    master: HeightMap,
    filters: Filters,
    contacts: Sequence[Contact],
    sphere: HeightMap | None = None,
) -> xr.Dataset:
    """Return `forces_at_cutoffs` of plastic contact, by load, contact_y and contact_x.

    The contacts differ in their load alone. The sphere is its roughness, or None for a smooth
    sphere. Contacts of the array are numbered.
    """
    contact = contacts[0]

    def forces(surface: HeightMap) -> np.ndarray:
        pair = bodies(surface, sphere, contact)
        pixel_size = pair.geometry.pixel_size
        contact_pixels = [load.pixels(pixel_size) for load in contacts]
        totals = plastic_totals(pair, contact_pixels, contact.range)
        return pull_off_force(totals, contact.range, pixel_size, WORK_OF_ADHESION)

    axes = load_axis(contacts)
    axes |= {axis: ((axis,), np.arange(contact.count), {}) for axis in CONTACT_AXES}
    filtered = forces_at_cutoffs(master, filters, forces, axes)
    return filtered.assign_attrs(rho=contact.range)


def scaled_pull_off(
    master: HeightMap,
    filters: Filters,
    contacts: Sequence[Contact],
    radii: Sequence[float],
    ranges: Sequence[float],
) -> xr.Dataset:
    """Return `forces_at_cutoffs` of plastic contact, averaged over contacts, by radius, area, rho.

    The contacts differ in their load alone; the spheres are smooth, radii and ranges in nm. Where a
    pixel is not small against the contact area, the area is that of the pixels that touch: the
    smallest whole number of them that carries the preload. ``contact_area`` (area), in nm², is that
    of the pixels that touch, and the coordinate area the preload over the hardness in nm².
    """
    spheres = [replace(contacts[0], radius=radius) for radius in radii]

    def forces(surface: HeightMap) -> np.ndarray:
        pairs = (bodies(surface, None, contact) for contact in spheres)
        means = (mean_pull_off_of_pair(pair, contacts, ranges)["pull_off_force"] for pair in pairs)
        return np.array([mean.values for mean in means])

    areas = [contact.area for contact in contacts]
    axes: dict[str, Axis] = {
        "radius": (("radius",), np.array(radii), {"units": "nm"}),
        "area": (("area",), areas, {"units": "nm2", "long_name": "preload over hardness"}),
        "rho": (("rho",), np.array(ranges), {"units": "nm"}),
    }
    pixel_size = master.size / filters.pixels
    touching = [contact.pixels(pixel_size) * pixel_size**2 for contact in contacts]
    contact_area = ("area", touching, {"units": "nm2", "long_name": "touching pixels"})
    filtered = forces_at_cutoffs(master, filters, forces, axes)
    return filtered.assign(contact_area=contact_area)
