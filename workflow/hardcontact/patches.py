"""Connected patches of a contact: the indents it leaves, the asperities that carry its force.

Pixels that share an edge or a corner belong to one patch.
"""

from typing import NamedTuple

import numpy as np
from scipy import ndimage
from scipy.sparse.csgraph import connected_components

__all__ = ["Asperities", "Indents", "asperities", "flattening", "indents"]


class Indents(NamedTuple):
    """depth: nm, of the deepest pixel; edge_length: nm, root of the area of the largest indent;
    lateral_size: nm, longer side of its bounding box; count: connected indents."""

    depth: float
    edge_length: float
    lateral_size: float
    count: int


def indents(gaps, offsets, pixel_size):
    """What one plastic contact leaves behind: `Indents`.

    gaps: (count,) nm of the touching pixels, ascending, offsets: (count, 2) their pixels, both
    from `contact.lowest_gaps`; pixel_size: nm. A touching pixel is flattened by its penetration.
    """
    near = np.abs(offsets[:, None] - offsets).max(axis=-1) <= 1
    count, label = connected_components(near, directed=False)
    pixels = np.bincount(label)
    largest = offsets[label == pixels.argmax()]
    return Indents(
        depth=gaps[-1] - gaps[0],
        edge_length=np.sqrt(pixels.max()) * pixel_size,
        lateral_size=(np.ptp(largest, axis=0).max() + 1) * pixel_size,
        count=count,
    )


def flattening(gaps, offsets, reach):
    """Penetration (nm) of touching pixels, zero elsewhere, within `reach` pixels of the deepest.

    gaps, offsets: as in `indents`. Returns (2 reach + 1, 2 reach + 1).
    """
    depth = np.zeros((2 * reach + 1,) * 2)
    y, x = (offsets - offsets[0] + reach).T
    seen = (abs(y - reach) <= reach) & (abs(x - reach) <= reach)
    depth[y[seen], x[seen]] = (gaps[-1] - gaps)[seen]
    return depth


class Asperities(NamedTuple):
    """largest_share, two_largest_share: of the force, carried by the largest patches; patches:
    their number; extent: nm, diameter of the circle about the centre of force that holds the
    share asked for."""

    largest_share: float
    two_largest_share: float
    patches: int
    extent: float


def asperities(attraction, share, pixel_size):
    """Which `Asperities` carry the force of one contact.

    attraction: (n, n), proportional to the force on each pixel; share: of the force. Patches are
    those of the fewest pixels that carry this share together.
    """
    total = attraction.sum()
    # Pixels below this cannot carry what the share leaves, were all of them at it.
    rest = (1 - share) * total / attraction.size
    values = np.sort(attraction[attraction > rest])[::-1]
    weakest = values[np.searchsorted(np.cumsum(values), share * total)]
    label, count = ndimage.label(attraction >= weakest, structure=np.ones((3, 3)))
    forces = np.sort(np.bincount(label.ravel(), attraction.ravel())[1:])[::-1] / total
    return Asperities(
        forces[0], forces[:2].sum(), count, _diameter(attraction, share, total) * pixel_size
    )


def _diameter(attraction, share, total):
    """Diameter in pixels of the circle about the centre of force that holds a share of it."""
    y, x = (np.arange(pixels) for pixels in attraction.shape)
    centre_y, centre_x = attraction.sum(axis=1) @ y / total, attraction.sum(axis=0) @ x / total
    distance = np.hypot((y - centre_y)[:, None], x - centre_x)
    held = np.cumsum(np.bincount(np.rint(distance).astype(int).ravel(), attraction.ravel()))
    return 2 * np.searchsorted(held, share * total)
