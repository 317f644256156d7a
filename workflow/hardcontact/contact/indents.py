"""Indents that plastic contacts leave in the sphere: the size of all, and the height map of one.

Contact pixels that share an edge or a corner belong to one indent.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.sparse.csgraph import connected_components

from hardcontact.base.dataset import stack
from hardcontact.base.job import progress
from hardcontact.contact.bearing_area import LowestGaps, all_lowest_gaps
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import Bodies, bodies
from hardcontact.surfaces.height_map import HeightMap

#: Pixels on either side of the deepest in the height map of one contact.
REACH = 32

UNITS = {"depth": "nm", "edge_length": "nm", "lateral_size": "nm", "indent_count": "1"}


def indents(contact: LowestGaps, pixel_size: float) -> tuple[float, float, float, int]:
    """Return the numbers of UNITS of one contact; a pixel is flattened by its penetration.

    They are the depth of the deepest pixel, the root of the area of the largest indent and the
    longer side of its bounding box, all in nm, and how many indents there are.
    """
    gaps, offsets = contact
    near = np.abs(offsets[:, None] - offsets).max(axis=-1) <= 1
    count, label = connected_components(near, directed=False)
    pixels = np.bincount(label)
    largest = offsets[label == pixels.argmax()]
    edge_length = np.sqrt(pixels.max()) * pixel_size
    lateral_size = (np.ptp(largest, axis=0).max() + 1) * pixel_size
    return gaps[-1] - gaps[0], edge_length, lateral_size, count


def flattening(contact: LowestGaps, reach: int) -> NDArray[np.float64]:
    """Return the penetration (nm) of pixels up to `reach` pixels from the deepest."""
    gaps, offsets = contact
    depth = np.zeros((2 * reach + 1,) * 2)
    y, x = (offsets - offsets[0] + reach).T
    inside = (abs(y - reach) <= reach) & (abs(x - reach) <= reach)
    depth[y[inside], x[inside]] = (gaps[-1] - gaps)[inside]
    return depth


def indents_of_scans(
    substrates: Mapping[int, HeightMap],
    spheres: Mapping[int, HeightMap],
    contact: Contact,
    preloads: Sequence[float],
) -> xr.Dataset:
    """Return the indents that every substrate scan leaves in every sphere scan, by number.

    The dataset has UNITS (scan, sphere_scan, preload, contact_y, contact_x), preloads in N, and of
    the contact of median depth at the largest preload ``indentation`` (preload, y, x) and
    ``sphere_height`` (y, x).
    """

    def brought_together(scan: int, sphere_scan: int) -> Bodies:
        return bodies(substrates[scan], spheres[sphere_scan], contact)

    loads = [replace(contact, preload=preload) for preload in preloads]
    keys = [(scan, sphere_scan) for scan in substrates for sphere_scan in spheres]
    pairs = {
        key: _sizes(brought_together(*key), loads)
        for key in progress(keys, len(keys), "pairs of scans")
    }
    sizes = stack(pairs, ["scan", "sphere_scan"])
    sizes = sizes.assign_coords(preload=("preload", list(preloads), {"units": "N"}))
    key, index = _median_contact(sizes)
    return _with_contact(sizes, brought_together(*key), loads, index).assign_attrs(
        hardness=contact.hardness, sphere_radius=contact.radius
    )


def _contacts(pair: Bodies, loads: Sequence[Contact]) -> list[dict[tuple[int, int], LowestGaps]]:
    """Return the contact pixels of all contacts of a pair, at each load."""
    counts = [load.pixels(pair.geometry.pixel_size) for load in loads]
    largest = all_lowest_gaps(pair, max(counts))
    return [
        {index: LowestGaps(gaps[:n], offsets[:n]) for index, (gaps, offsets) in largest.items()}
        for n in counts
    ]


def _sizes(pair: Bodies, loads: Sequence[Contact]) -> xr.Dataset:
    """Return the indents (preload, contact_y, contact_x) of one pair of scans."""
    sizes = np.array(
        [
            [
                indents(contact_pixels, pair.geometry.pixel_size)
                for contact_pixels in contacts.values()
            ]
            for contacts in _contacts(pair, loads)
        ]
    ).reshape(len(loads), *[len(pair.geometry.positions)] * 2, -1)
    dimensions = ("preload", "contact_y", "contact_x")
    return xr.Dataset(
        {
            name: (dimensions, sizes[..., k], {"units": unit})
            for k, (name, unit) in enumerate(UNITS.items())
        }
    )


def _median_contact(sizes: xr.Dataset) -> tuple[tuple[int, int], tuple[int, int]]:
    """Return scans and place of the contact whose depth at the largest preload is the median."""
    dimensions = ["scan", "sphere_scan", "contact_y", "contact_x"]
    depth = sizes.depth.sel(preload=sizes.preload.max()).transpose(*dimensions).to_numpy()
    number = np.argsort(depth, axis=None)[depth.size // 2]
    scan, sphere_scan, i, j = (int(index) for index in np.unravel_index(number, depth.shape))
    return (int(sizes.scan[scan]), int(sizes.sphere_scan[sphere_scan])), (i, j)


def _with_contact(
    sizes: xr.Dataset, pair: Bodies, loads: Sequence[Contact], index: tuple[int, int]
) -> xr.Dataset:
    """Add the indents of one contact at every preload, and the sphere there."""
    contacts = [contacts_at_load[index] for contacts_at_load in _contacts(pair, loads)]
    reach = np.arange(-REACH, REACH + 1)
    row, column = contacts[0].offsets[0]
    position = reach * pair.geometry.pixel_size
    axis = {"units": "nm", "long_name": "position from the deepest point"}
    return sizes.assign(
        indentation=(
            ("preload", "y", "x"),
            np.array([flattening(contact, REACH) for contact in contacts]),
            {"units": "nm", "long_name": "flattening of the sphere"},
        ),
        sphere_height=(
            ("y", "x"),
            pair.sphere(row + reach, column + reach),
            {"units": "nm", "long_name": "undeformed sphere, up from its apex"},
        ),
    ).assign_coords(y=("y", position, axis), x=("x", position, axis))
