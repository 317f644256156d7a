"""The indents that contacts leave in the sphere: patches of contact pixels."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats
from hardcontact.base.dataset import stack, variables_of_columns
from hardcontact.base.progress import progress
from hardcontact.base.units import NEWTON, NM
from hardcontact.contact.bearing_area import all_contact_pixels
from hardcontact.contact.contact import CONTACT_AXES, Contact
from hardcontact.contact.geometry import Bodies, join_bodies, reference_gaps
from hardcontact.contact.patches import number_patches
from hardcontact.contact.pull_off import count_contact_pixels
from hardcontact.surfaces.height_map import HeightMap

#: Pixels on either side of the deepest pixel in the maps of one contact.
MAP_HALF_WIDTH = 32
#: The quantities of `indent_sizes`, with their units: depth of the deepest pixel, side of a square
#: with the area of the largest indent, longer side of its bounding box, and number of indents.
INDENT_UNITS = {"depth": "nm", "equal_area_side": "nm", "longer_side": "nm", "indent_count": "1"}


def indent_sizes(
    gaps: Floats, offsets: NDArray[np.int_], pixel_size: float
) -> tuple[float, float, float, int]:
    """Return INDENT_UNITS of one contact from its `ContactPixels`: gaps (k,), offsets (k, 2)."""
    numbers, count = number_patches(offsets)
    indent_pixel_counts = np.bincount(numbers)[numbers]  # by pixel, the deepest pixel first
    # Of equally large indents, this is the deepest one.
    largest_indent = offsets[numbers == numbers[indent_pixel_counts.argmax()]]
    equal_area_side = np.sqrt(len(largest_indent)) * pixel_size
    longer_side = (np.ptp(largest_indent, axis=0).max() + 1) * pixel_size
    return gaps[-1] - gaps[0], equal_area_side, longer_side, count


def indents_of_scans(
    substrates: Mapping[int, HeightMap],
    spheres: Mapping[int, HeightMap],
    contact: Contact,
    preloads: Sequence[float],
) -> xr.Dataset:
    """Return the indents that every substrate scan leaves in every sphere scan, at preloads in N.

    INDENT_UNITS are (scan, sphere_scan, preload, contact_y, contact_x). ``indentation`` (preload,
    y, x) and ``sphere_height`` (y, x) in nm are maps of the contact of median depth at the largest
    preload.
    """

    def make_bodies(scan: int, sphere_scan: int) -> Bodies:
        return join_bodies(substrates[scan], spheres[sphere_scan], contact)

    contacts_by_loading = [replace(contact, preload=preload) for preload in preloads]
    keys = [(scan, sphere_scan) for scan in substrates for sphere_scan in spheres]
    sizes_by_scans = {
        key: _sizes_of_bodies(make_bodies(*key), contacts_by_loading)
        for key in progress(keys, len(keys), "sphere scans on substrate scans")
    }
    sizes = stack(sizes_by_scans, ["scan", "sphere_scan"])
    sizes = sizes.assign_coords(preload=("preload", list(preloads), NEWTON))
    key, index = _median_contact(sizes)
    return _add_height_maps(sizes, make_bodies(*key), contacts_by_loading, index).assign_attrs(
        hardness=contact.hardness, sphere_radius=contact.radius
    )


def _sizes_of_bodies(bodies: Bodies, contacts_by_loading: Sequence[Contact]) -> xr.Dataset:
    """Return the sizes of indents (preload, contact_y, contact_x) of two bodies."""
    counts = count_contact_pixels(bodies, contacts_by_loading)
    gaps, offsets = all_contact_pixels(bodies, max(counts))
    array_shape = gaps.shape[:2]
    pixel_size = bodies.geometry.pixel_size
    sizes = [
        indent_sizes(gaps[index][:count], offsets[index][:count], pixel_size)
        for count in counts
        for index in np.ndindex(*array_shape)
    ]
    columns = np.reshape(sizes, (len(counts), *array_shape, -1))
    return xr.Dataset(variables_of_columns(columns, ("preload", *CONTACT_AXES), INDENT_UNITS))


def _median_contact(sizes: xr.Dataset) -> tuple[tuple[int, int], tuple[int, int]]:
    """Return scans and indices (i, j) of the contact of median depth at the largest preload."""
    dimensions = ["scan", "sphere_scan", *CONTACT_AXES]
    depth = sizes.depth.sel(preload=sizes.preload.max()).transpose(*dimensions).to_numpy()
    flat_index = np.argsort(depth, axis=None)[depth.size // 2]
    scan, sphere_scan, i, j = (int(index) for index in np.unravel_index(flat_index, depth.shape))
    return (int(sizes.scan[scan]), int(sizes.sphere_scan[sphere_scan])), (i, j)


def _add_height_maps(
    sizes: xr.Dataset,
    bodies: Bodies,
    contacts_by_loading: Sequence[Contact],
    index: tuple[int, int],
) -> xr.Dataset:
    """Add maps about one contact: its indentation at every preload, and the sphere's height."""
    counts = np.array(count_contact_pixels(bodies, contacts_by_loading))
    contact_pixels = all_contact_pixels(bodies, int(counts.max()))
    steps = np.arange(-MAP_HALF_WIDTH, MAP_HALF_WIDTH + 1)
    deepest = contact_pixels.offsets[index][0]
    offsets = deepest + np.stack(np.meshgrid(steps, steps, indexing="ij"), axis=-1)
    gaps = reference_gaps(bodies, bodies.geometry.apexes()[index], offsets)
    largest_gaps = contact_pixels.reference_gaps[index][counts - 1]
    indentation = np.maximum(largest_gaps[:, None, None] - gaps, 0)
    sphere_heights = bodies.sphere_heights(*(deepest[:, None] + steps))
    position = steps * bodies.geometry.pixel_size
    return sizes.assign(
        indentation=(("preload", "y", "x"), indentation, NM),
        sphere_height=(("y", "x"), sphere_heights, NM),
    ).assign_coords(y=("y", position, NM), x=("x", position, NM))
