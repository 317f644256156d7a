"""The gap map of one contact over its whole window, before and after plastic flattening."""

import numpy as np
from numpy.typing import NDArray

from hardcontact.contact.geometry import Bodies

__all__ = ["flattened_gaps", "gap_map", "part_around_lowest", "plastic_approach"]

Floats = NDArray[np.float64]


def gap_map(bodies: Bodies, place: tuple[int, int] | NDArray[np.int_]) -> Floats:
    """Return the gap (window, window) in nm of one contact at zero approach.

    Parameters
    ----------
    bodies : Bodies
        Substrate and sphere.
    place : tuple of int
        Of the contact in the array.

    Returns
    -------
    numpy.ndarray
        The apex stands at the pixel (window/2, window/2).
    """
    geometry, offset = bodies.geometry, bodies.geometry.offsets()
    shape = geometry.paraboloid(offset)
    rows, columns = (
        (geometry.positions[index] + offset) % bodies.substrate.pixels for index in place
    )
    gap = shape[:, None] + shape
    if bodies.roughness is not None:
        around = offset % bodies.roughness.pixels
        gap -= bodies.roughness.heights[np.ix_(around, around)]
    gap -= bodies.substrate.heights[np.ix_(rows, columns)]
    return gap


def plastic_approach(gap: Floats, contact_pixels: int) -> float:
    """Return the largest gap (nm) of the contact pixels: minus that of closest approach."""
    return float(np.partition(gap.ravel(), contact_pixels - 1)[contact_pixels - 1])


def flattened_gaps(gap: Floats, contact_pixels: int) -> Floats:
    """Return the gap (n, n) in nm at plastic closest approach, zero at the contact pixels."""
    return np.maximum(gap - plastic_approach(gap, contact_pixels), 0)


def part_around_lowest(gap: Floats, pixels: int) -> Floats:
    """Return the square part (pixels, pixels) of a gap map (n, n) about its lowest point.

    Where the lowest point is near an edge of the map the part ends at that edge.
    """
    lowest = np.unravel_index(gap.argmin(), gap.shape)
    rows, columns = (
        slice(first, first + pixels)
        for first in np.clip(np.array(lowest) - pixels // 2, 0, gap.shape[0] - pixels)
    )
    return gap[rows, columns]
