"""Forces on wider pixels, which show how much finer pixels may change a force."""

from dataclasses import replace

import numpy as np
import xarray as xr

from hardcontact.contact.contact import CONTACT_AXES, Contact
from hardcontact.contact.pull_off import FORCE_ATTRS, make_force_function
from hardcontact.surfaces.height_map import HeightMap

#: Pixels per row of a block with one height.
WIDE_PIXEL = 4


def widen_pixels(surface: HeightMap) -> HeightMap:
    """Return a map whose blocks of WIDE_PIXEL x WIDE_PIXEL pixels have their mean height."""
    starts = np.arange(0, surface.pixels, WIDE_PIXEL)
    counts = np.diff(starts, append=surface.pixels)
    sums = np.add.reduceat(np.add.reduceat(surface.heights.astype(float), starts, 0), starts, 1)
    means = sums / np.outer(counts, counts)
    heights = means.repeat(counts, 0).repeat(counts, 1)
    return replace(surface, heights=heights.astype(surface.heights.dtype))


def pixel_forces(surface: HeightMap, sphere: HeightMap | None, contact: Contact) -> xr.Dataset:
    """Return ``scan_force`` and ``wide_pixel_force`` (contact_y, contact_x) in N at 1 J/m²."""
    wide_sphere = None if sphere is None else widen_pixels(sphere)
    forces = {
        "scan_force": make_force_function(contact, sphere)(surface),
        "wide_pixel_force": make_force_function(contact, wide_sphere)(widen_pixels(surface)),
    }
    return xr.Dataset({name: (CONTACT_AXES, force, FORCE_ATTRS) for name, force in forces.items()})


def pixel_factor(wide_pixel_ratio: np.ndarray | float) -> np.ndarray:
    """Return the largest factor by which finer pixels may lower a force; 1 where the ratio is NaN.

    It is the factor by which wider pixels raise the force
    (tests/benchmarks/validate_random_surfaces.py).
    """
    return np.asarray(np.fmax(wide_pixel_ratio, 1.0))


def pixel_factors(force: xr.Dataset) -> xr.DataArray:
    """Return the factors (surface) by which finer pixels may lower forces, 1 for substitutes."""
    ratios = force.get("wide_pixel_ratio", xr.ones_like(force["surface"], dtype=float))
    return ratios.copy(data=pixel_factor(ratios.values))
