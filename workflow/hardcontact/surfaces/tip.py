"""A surface as the tip of an AFM images it."""

from dataclasses import replace
from typing import Any

import numpy as np

from hardcontact.surfaces.height_map import HeightMap

__all__ = ["FINENESS", "imaged_by_tip", "imaged_scan"]

#: Pixels of the surface under the tip, along an edge of a pixel of the scan. Four times as many
#: change slope and half-Laplacian of UNCD by 0.5 to 1 %, and its forces by as much.
FINENESS = 2


def imaged_by_tip(surface: HeightMap, radius: float) -> HeightMap:
    """Return the image of a surface by a spherical tip: the path of its lowest point.

    The tip is half a sphere that goes up vertically beyond; what lies beyond the edges of the map
    does not touch it.

    Parameters
    ----------
    surface : HeightMap
        On pixels that are small beside the tip.
    radius : float
        Of the tip in nm.

    Returns
    -------
    HeightMap
        On the same pixels, nowhere below the surface.
    """
    from scipy.ndimage import grey_dilation

    reach = int(radius / surface.pixel_size)
    squares = (np.arange(-reach, reach + 1) * surface.pixel_size) ** 2
    distance = squares[:, None] + squares
    cap: Any = np.sqrt(np.maximum(radius**2 - distance, 0)) - radius
    heights = grey_dilation(
        surface.heights, footprint=distance <= radius**2, structure=cap, mode="nearest"
    )
    return replace(surface, heights=heights)


def imaged_scan(surface: HeightMap, pixels: int, radius: float) -> HeightMap:
    """Return a scan: the corner of a surface as a tip images it, sampled at every FINENESS pixels.

    Parameters
    ----------
    surface : HeightMap
        Periodic, on FINENESS times as many pixels a length as the scan.
    pixels : int
        Along an edge of the scan.
    radius : float
        Of the tip in nm.

    Returns
    -------
    HeightMap
        Not periodic; heights (pixels, pixels) in float64.
    """
    margin = int(radius / surface.pixel_size)
    place = np.arange(-margin, FINENESS * pixels + margin) % surface.pixels
    seen = replace(surface, heights=surface.heights[np.ix_(place, place)], periodic=False)
    sampled = slice(margin, margin + FINENESS * pixels, FINENESS)
    heights = imaged_by_tip(seen, radius).heights[sampled, sampled].astype(float)
    return replace(seen, heights=heights, pixel_size=FINENESS * surface.pixel_size)
