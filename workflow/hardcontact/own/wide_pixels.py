"""Forces on pixels four times as wide, which estimate how much finer pixels would lower forces.

Wide pixels blunt narrow summits, so the bodies come closer and attract more strongly. The pixels of
the scan themselves blunt summits that finer pixels would show. So finer pixels would lower the
force, but a scan cannot show how much. It is assumed that they lower it at most by the factor by
which wide pixels raise it:

- ``wide_pixel_ratio``: the force on wide pixels relative to the force on the scan.
- Pixel divisor: the larger of this ratio and 1. The force on finer pixels is assumed to be at least
  the force on the scan divided by it. So only the low end of an interval is divided.

For example, a force of 100 nN on the scan and 125 nN on wide pixels give a divisor of 1.25 and at
least 80 nN on finer pixels. The assumption is tested on random surfaces of six families, with
pixels four times finer (tests/own/test_random_surfaces.py).
"""

from dataclasses import replace

import numpy as np
import xarray as xr

from hardcontact.contact.contact import CONTACT_AXES, Contact
from hardcontact.contact.pull_off import FORCE_ATTRS, make_force_function
from hardcontact.surfaces.height_map import HeightMap

#: Width of a wide pixel in pixels of the scan.
WIDE_PIXEL_WIDTH = 4


def widen_pixels(height_map: HeightMap) -> HeightMap:
    """Return a map whose square blocks of WIDE_PIXEL_WIDTH pixels a side have their mean height."""
    # The last block of a row is narrower if the pixels are no multiple of the width.
    starts = np.arange(0, height_map.pixels, WIDE_PIXEL_WIDTH)
    counts = np.diff(starts, append=height_map.pixels)
    sums = np.add.reduceat(np.add.reduceat(height_map.heights.astype(float), starts, 0), starts, 1)
    means = sums / np.outer(counts, counts)
    heights = means.repeat(counts, 0).repeat(counts, 1)
    return replace(height_map, heights=heights.astype(height_map.heights.dtype))


def forces_by_pixel_width(
    substrate: HeightMap, sphere: HeightMap | None, contact: Contact
) -> xr.Dataset:
    """Return ``scan_force`` and ``wide_pixel_force`` (contact_y, contact_x) in N at 1 J/m²."""
    wide_sphere = None if sphere is None else widen_pixels(sphere)
    forces = {
        "scan_force": make_force_function(contact, sphere)(substrate),
        "wide_pixel_force": make_force_function(contact, wide_sphere)(widen_pixels(substrate)),
    }
    return xr.Dataset({name: (CONTACT_AXES, force, FORCE_ATTRS) for name, force in forces.items()})


def pixel_divisors(force_dataset: xr.Dataset) -> xr.DataArray:
    """Return the pixel divisors (surface), 1 for substitutes, which have no ratio."""
    ratios = force_dataset.get("wide_pixel_ratio", xr.ones_like(force_dataset["surface"], float))
    return ratios.copy(data=np.fmax(ratios.values, 1.0))
