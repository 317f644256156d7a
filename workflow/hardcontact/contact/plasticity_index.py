"""Which contacts yield: elastic contact area and plasticity index from the slope of the gap.

Where bodies touch over an area A on which their gap has the rms slope h', the mean pressure of
elastic contact is E* h'/k. Of a smooth sphere k = 1.67, exactly: h' is a/(sqrt(2) R) on a disc of
radius a (Hertz). Of a rough flat k is 1.6 (Persson, J. Chem. Phys. 115 (2001) 3840) to 2.5 (Bush,
Gibson and Thomas, Wear 35 (1975) 87). The first is taken here. The elastic area is that of the
lowest gaps, as the bearing area is, on which E* h' A/k reaches the preload; h' depends on A.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hardcontact.contact.bearing_area import Load, LowestGaps, contact_pixel_count, lowest_gaps
from hardcontact.contact.geometry import Bodies
from hardcontact.contact.pixel_gaps import gaps_at
from hardcontact.contact.tiles import as_tiles

__all__ = ["SLOPE_OVER_PRESSURE", "ElasticEstimate", "elastic_estimates", "squared_slopes"]

Floats = NDArray[np.float64]

#: E* h' over the mean pressure of a smooth sphere: 3 pi/(4 sqrt(2)).
SLOPE_OVER_PRESSURE = 3 * np.pi / (4 * np.sqrt(2))

#: By how much the number of lowest gaps grows until they carry the preload.
GROWTH = 4

NEIGHBOURS = np.array([(0, 1), (0, -1), (1, 0), (-1, 0)])


class ElasticEstimate(NamedTuple):
    """Elastic contact beside the bearing area of one contact.

    Attributes
    ----------
    plasticity_index : float
        Mean pressure of elastic contact on the bearing area F/H, over the hardness H. From 1 on
        the bodies yield and the bearing area holds; below, elastic contact carries the preload on
        a larger area with a smaller pressure.
    contact : LowestGaps
        The pixels of the larger of both areas.
    elastic_pixels : int
        Of elastic contact, at most as many as the window has.
    """

    plasticity_index: float
    contact: LowestGaps
    elastic_pixels: int


def squared_slopes(bodies: Bodies, position: NDArray[np.int_], offsets: NDArray[np.int_]) -> Floats:
    """Return the squared slope (k,) of the gap at offsets (k, 2) in pixels from an apex.

    Along each axis it is the mean of the squares of both one-sided slopes, which a pixel between
    two lower or two higher ones does not lose.
    """
    around = gaps_at(bodies, position, offsets[:, None] + NEIGHBOURS)
    rise = around - gaps_at(bodies, position, offsets)[:, None]
    return np.asarray((rise**2).sum(axis=1) / (2 * bodies.geometry.pixel_size**2))


def elastic_estimates(
    bodies: Bodies, load: Load, modulus: float
) -> dict[tuple[int, int], ElasticEstimate]:
    """Return elastic contact beside the bearing area at every contact of an array.

    Parameters
    ----------
    bodies : Bodies
        With a smooth or a rough sphere.
    load : Load
        Preload and hardness.
    modulus : float
        Effective modulus E* in Pa.

    Returns
    -------
    dict
        Place (i, j) in the array -> `ElasticEstimate`.
    """
    geometry = bodies.geometry
    bearing = contact_pixel_count(load, geometry.pixel_size)
    # Force in N that one pixel of unit slope carries.
    stiffness = modulus * (geometry.pixel_size * 1e-9) ** 2 / SLOPE_OVER_PRESSURE
    substrate = as_tiles(bodies.substrate)
    roughness = None if bodies.roughness is None else as_tiles(bodies.roughness)
    estimates = {}
    for place in np.ndindex(*[len(geometry.positions)] * 2):
        position, pixels = geometry.positions[list(place)], bearing
        carried = np.zeros(1)
        while carried[-1] < load["preload"] and pixels < geometry.window**2:
            pixels = min(GROWTH * pixels, geometry.window**2)
            contact = lowest_gaps(substrate, roughness, geometry, position, pixels)
            slopes = np.cumsum(squared_slopes(bodies, position, contact.offsets))
            carried = stiffness * np.sqrt(np.arange(1, pixels + 1) * slopes)
        elastic = min(int(np.searchsorted(carried, load["preload"])) + 1, pixels)
        kept = max(bearing, elastic)
        of_bearing = modulus * np.sqrt(slopes[bearing - 1] / bearing) / SLOPE_OVER_PRESSURE
        estimates[place] = ElasticEstimate(
            float(of_bearing / load["hardness"]),
            LowestGaps(contact.gaps[:kept], contact.offsets[:kept]),
            elastic,
        )
    return estimates
