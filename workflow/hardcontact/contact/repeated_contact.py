"""One place of the sphere pressed onto many places of a substrate: indents accumulate.

At each contact, pixels of the softer sphere that penetrate the substrate are flattened, and stay
flat. The model has no elastic recovery, hardening, pile-up beside an indent, wear or transfer.
Places are sampled at random on a large random surface: in a mirrored scan every summit would press
its indent into the points of a lattice.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from hardcontact.base.statistics import student_interval
from hardcontact.contact.bearing_area import (
    TILE,
    LowestGaps,
    Tiles,
    as_tiles,
    lowest_gaps,
)
from hardcontact.contact.geometry import Bodies, window_pixels
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.spectrum import Spectrum
from hardcontact.surfaces.synthesis import random_surface

Floats = NDArray[np.float64]
#: Largest number of pixels along a side of a large surface.
MAX_PIXELS = 4096


def over_window(bodies: Bodies) -> Bodies:
    """Return the same bodies, with a period of the sphere's roughness that fills the window.

    The roughness of a scan repeats itself; indents must not.
    """
    geometry = bodies.geometry
    substrate = bodies.substrate
    offset = np.fft.ifftshift(geometry.offsets())
    heights = np.zeros((geometry.window,) * 2)
    if bodies.roughness is not None:
        around = offset % bodies.roughness.pixels
        heights[:] = bodies.roughness.heights[np.ix_(around, around)]
    roughness = HeightMap(heights, geometry.pixel_size, True, substrate.basis)
    return replace(bodies, roughness=roughness)


def repeated_contacts(
    bodies: Bodies, positions: ArrayLike, contact_pixel_count: int
) -> Iterator[tuple[LowestGaps, Floats]]:
    """Press one place of a sphere onto places of a substrate, and yield contacts and depths.

    The positions (contacts, 2) are pixels (row, column) of the substrate under the apex. A contact
    has the gaps before flattening. The depth (window, window) in nm is the total flattening of the
    sphere around the apex after the contact; the next contact changes the same array.
    """
    substrate = as_tiles(bodies.substrate)
    wide = over_window(bodies)
    assert wide.roughness is not None
    roughness = as_tiles(wide.roughness)
    depth = np.zeros((bodies.geometry.window,) * 2)
    for position in np.asarray(positions):
        (contact,) = lowest_gaps(
            substrate, roughness, bodies.geometry, position[None], contact_pixel_count
        )
        penetration = contact.gaps[-1] - contact.gaps
        _flatten(roughness, contact.offsets, penetration)
        row, column = (contact.offsets + bodies.geometry.window // 2).T
        depth[row, column] += penetration
        yield contact, depth


def _flatten(roughness: Tiles, offsets: NDArray[np.int_], penetration: Floats) -> None:
    """Lower a roughness, in place, at offsets (k, 2) by a penetration (k,) in nm."""
    y, x = (offsets % roughness.pixels).T
    roughness.blocks[y // TILE, y % TILE, x // TILE, x % TILE] -= penetration
    for row, column in np.unique(np.stack([y, x], axis=1) // TILE, axis=0):
        roughness.maxima[row, column] = roughness.blocks[row, :, column, :].max()


def large_surface(
    rng: np.random.Generator, spectrum: Spectrum, size: float, pixel_size: float
) -> HeightMap:
    """Return a random surface, as large as its pixels permit.

    spectrum: c_iso of the surface.
    size, pixel_size: largest size and size of a pixel in nm.
    Returns periodic, with at most MAX_PIXELS pixels along a side.
    """
    pixels = min(window_pixels(size, pixel_size), MAX_PIXELS)
    return random_surface(rng, pixels, pixel_size, spectrum)


def indented_area_ratio(
    bodies: Bodies, contact_pixel_count: int, rng: np.random.Generator, contacts: int
) -> float:
    """Return the area of the indents of many contacts relative to as many separate contacts.

    One place of the sphere meets random places of the substrate.

    bodies: substrate and sphere on common pixels.
    Returns one if no indents overlap.
    """
    places = rng.integers(0, bodies.substrate.pixels, (contacts, 2))
    indented_pixels = [
        np.count_nonzero(depth)
        for _, depth in repeated_contacts(bodies, places, contact_pixel_count)
    ]
    # Separate contacts are all like the first one, on a sphere without indents.
    return indented_pixels[-1] / (contacts * indented_pixels[0])


def mean_over_surfaces(ratios: Sequence[float], confidence: float) -> xr.Dataset:
    """Return the mean of `indented_area_ratio` over surfaces, with its interval.

    ratios: ratio of each surface.
    confidence: confidence of the interval, by Student's t; it does not reach below 0.
    Returns ``indented_area_ratio`` and its interval.
    """
    ratio = xr.DataArray(list(ratios), dims="scan", attrs={"units": "1"})
    interval = student_interval(ratio, confidence, "scan").clip(0, keep_attrs=True)
    return xr.Dataset(
        {
            "indented_area_ratio": ratio.mean("scan", keep_attrs=True),
            "indented_area_ratio_interval": interval,
        },
        attrs={"confidence": confidence},
    )
