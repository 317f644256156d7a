"""One place of the sphere pressed onto many places of a substrate: indents accumulate.

The sphere is the softer body and yields: at each contact its pixels that penetrate the substrate
are flattened to it, until as many are in contact as carry the preload at the hardness of the
sphere. What is flattened stays so in the next contact. The substrate, harder, keeps its shape. Not
modelled: elastic recovery, hardening, material that piles up beside an indent (what penetrates
vanishes), wear and transfer, and that the sphere comes back to the same place by less than a pixel.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import ndimage

from hardcontact.contact.bearing_area import TILE, LowestGaps, Tiles, as_tiles, lowest_gaps
from hardcontact.contact.geometry import Bodies
from hardcontact.surfaces.height_map import HeightMap

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Indentation:
    """One contact of a sequence."""

    contact: LowestGaps  #: With the gaps before they were flattened.
    #: (window, window) in nm, what the sphere is flattened by after it, the apex at the pixel
    #: (window/2, window/2). It is the same array at every contact and changes with the next.
    depth: Floats


class IndentSizes(NamedTuple):
    """The indents in a sphere, one value an indent, in nm."""

    depth: Floats  #: Of the deepest pixel.
    edge_length: Floats  #: Root of the area.
    lateral_size: Floats  #: Longer side of the bounding box.


def over_window(bodies: Bodies) -> Bodies:
    """Return the same bodies with the sphere's roughness over its whole window as one period.

    The roughness of a scan is continued periodically, indents in it must not be. A smooth sphere
    gets a roughness of zero.
    """
    geometry, substrate = bodies.geometry, bodies.substrate
    offset = np.fft.ifftshift(geometry.offsets())
    heights = np.zeros((geometry.window,) * 2)
    if bodies.roughness is not None:
        around = offset % bodies.roughness.pixels
        heights[:] = bodies.roughness.heights[np.ix_(around, around)]
    roughness = HeightMap(heights, geometry.pixel_size, True, substrate.basis)
    return replace(bodies, roughness=roughness)


def repeated_contacts(
    bodies: Bodies, positions: ArrayLike, contact_pixels: int
) -> Iterator[Indentation]:
    """Press one place of a sphere onto places of a substrate, and yield each indentation in order.

    The positions (contacts, 2) are pixels (row, column) of the substrate under the apex; the
    contact pixels are those of each contact, the bodies those before the first.
    """
    substrate, whole = as_tiles(bodies.substrate), over_window(bodies)
    assert whole.roughness is not None
    roughness = as_tiles(whole.roughness)
    depth = np.zeros((bodies.geometry.window,) * 2)
    for position in np.asarray(positions):
        contact = lowest_gaps(substrate, roughness, bodies.geometry, position, contact_pixels)
        penetration = contact.gaps[-1] - contact.gaps
        _flatten(roughness, contact.offsets, penetration)
        row, column = (contact.offsets + bodies.geometry.window // 2).T
        depth[row, column] += penetration
        yield Indentation(contact, depth)


def _flatten(roughness: Tiles, offsets: NDArray[np.int_], penetration: Floats) -> None:
    """Lower a roughness, in place, at offsets (k, 2) from its origin by a penetration (k,) in nm.

    No two offsets are the same pixel, because the period of the roughness is the window.
    """
    y, x = (offsets % roughness.pixels).T
    roughness.blocks[y // TILE, y % TILE, x // TILE, x % TILE] -= penetration
    for row, column in np.unique(np.stack([y, x], axis=1) // TILE, axis=0):
        roughness.maxima[row, column] = roughness.blocks[row, :, column, :].max()


def indent_sizes(depth: Floats, pixel_size: float) -> IndentSizes:
    """Return the sizes of the connected indents in a map (n, n) of depths in nm."""
    # Pixels that share an edge or a corner belong to one indent, as in the indents of one contact.
    label, _ = ndimage.label(depth > 0, np.ones((3, 3)))
    boxes = ndimage.find_objects(label)
    deepest = [depth[box][label[box] == k].max() for k, box in enumerate(boxes, 1)]
    longest = [max(side.stop - side.start for side in box) for box in boxes]
    pixels = np.bincount(label.ravel())[1:]
    return IndentSizes(
        np.array(deepest), np.sqrt(pixels) * pixel_size, np.array(longest) * pixel_size
    )
