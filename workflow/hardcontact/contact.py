"""Rigid and plastic (bearing area) contact: closest approach and contact pixels.

The gap of a contact is g = s - t - h: sphere s, its roughness t (growing out of the sphere) and
substrate h, all in nm. The bodies approach until as many pixels as the contact needs touch.
"""

from dataclasses import dataclass

import numpy as np

from hardcontact.sphere import paraboloid

__all__ = [
    "Tiles",
    "all_lowest_gaps",
    "around_lowest",
    "contact_pixel_count",
    "gap_map",
    "lowest_gaps",
]

TILE = 64


def contact_pixel_count(preload, hardness, pixel_size):
    """Pixels that carry the preload: the smallest whole number >= F/(H A_pix).

    preload: N; hardness: Pa; pixel_size: nm. Source: the paper, plastic analysis.
    """
    return int(np.ceil(preload / (hardness * (pixel_size * 1e-9) ** 2) * (1 - 1e-12)))


@dataclass(frozen=True)
class Tiles:
    """A periodic map (n, n) cut into tiles, with the highest point of each.

    pixels: period n; blocks: (tiles, TILE, tiles, TILE), padded with -inf; maxima: (tiles, tiles).
    """

    pixels: int
    blocks: np.ndarray
    maxima: np.ndarray

    @classmethod
    def of(cls, heights):
        """Cut a square periodic map (n, n) in nm."""
        pixels = heights.shape[0]
        count = -(-pixels // TILE)
        extra = count * TILE - pixels
        if extra:
            heights = np.pad(heights, ((0, extra), (0, extra)), constant_values=-np.inf)
        blocks = heights.reshape(count, TILE, count, TILE)
        return cls(pixels, blocks, blocks.max(axis=1).max(axis=2))

    def around(self, position, window):
        """Unfolded indices (k,) of the first pixel of every tile that meets a window, and tiles."""
        count = self.maxima.shape[0]
        first, last = position - window // 2, position + window // 2 - 1
        periods = np.arange(first // self.pixels, last // self.pixels + 1)
        origin = (periods[:, None] * self.pixels + np.arange(count) * TILE).ravel()
        meets = (origin <= last) & (origin + TILE > first)
        return origin[meets], np.tile(np.arange(count), len(periods))[meets]

    def highest_from(self, offset_y, offset_x):
        """Upper bound of the map on TILE x TILE pixels that begin at any offsets (k,), (l,).

        Such a square meets at most three tiles along an axis where the last one is not full.
        """
        rows = np.maximum.reduce([np.roll(self.maxima, -i, axis=0) for i in range(3)])
        columns = np.maximum.reduce([np.roll(rows, -i, axis=1) for i in range(3)])
        y, x = (offset % self.pixels // TILE for offset in (offset_y, offset_x))
        return columns[np.ix_(y, x)]


class _View:
    """The tiles of the substrate that one contact sees, and how close each could come.

    bound: (tiles,) nm, no gap of the tile is smaller.
    """

    def __init__(self, substrate, position, pixel_size, radius, window, roughness):
        self.substrate, self.roughness = substrate, roughness
        self.geometry = pixel_size, radius
        self.window = window
        (first_y, self.tile_y), (first_x, self.tile_x) = (
            substrate.around(index, window) for index in position
        )
        self.offset_y, self.offset_x = first_y - position[0], first_x - position[1]
        bound = (
            _nearest(self.offset_y, *self.geometry)[:, None]
            + _nearest(self.offset_x, *self.geometry)
            - substrate.maxima[np.ix_(self.tile_y, self.tile_x)]
        )
        if roughness is not None:
            bound -= roughness.highest_from(self.offset_y, self.offset_x)
        self.shape, self.bound = bound.shape, bound.ravel()

    def offsets(self, tiles):
        """Offsets from the apex of the rows and of the columns of tiles: two (tiles, TILE)."""
        row, column = np.unravel_index(tiles, self.shape)
        place = np.arange(TILE)
        return self.offset_y[row][:, None] + place, self.offset_x[column][:, None] + place

    def gaps(self, tiles):
        """Gaps (tiles, TILE, TILE) in nm, infinite outside the window."""
        row, column = np.unravel_index(tiles, self.shape)
        y, x = self.offsets(tiles)
        gaps = (
            _within(y, self.window, *self.geometry)[:, :, None]
            + _within(x, self.window, *self.geometry)[:, None, :]
            - self.substrate.blocks[self.tile_y[row], :, self.tile_x[column], :]
        )
        if self.roughness is not None:
            gaps -= _periodic(self.roughness, y[:, :, None], x[:, None, :])
        return gaps


def lowest_gaps(substrate, position, pixel_size, radius, window, count, roughness=None):
    """The `count` smallest gaps of one contact, ascending, and the pixels they belong to.

    substrate: Tiles of h; position: (y, x) pixel of the apex; radius: nm; window: pixels;
    roughness: Tiles of t, or None for a smooth sphere. The last gap is minus the separation of
    plastic closest approach, the first that of rigid contact.

    Returns gaps (count,) in nm and offsets (count, 2) of the pixels from the apex. Only tiles
    whose highest point could reach into the contact are read: an order statistic, not a scan.
    """
    view = _View(substrate, position, pixel_size, radius, window, roughness)
    # The lowest gaps of the most promising tiles, as many as have `count` pixels, bound those of
    # all; this leaves few tiles to read.
    most = min(-(-count // TILE**2), view.bound.size)
    best = [view.bound.argmin()] if most == 1 else np.argpartition(view.bound, most - 1)[:most]
    first = view.gaps(np.array(best)).ravel()
    reach = np.partition(first, count - 1)[count - 1] if first.size >= count else np.inf
    candidates = np.flatnonzero(view.bound <= reach)
    candidates = candidates[np.argsort(view.bound[candidates])]
    gaps, offsets, batch = np.empty(0), np.empty((0, 2), int), 8
    while len(candidates) and (len(gaps) < count or view.bound[candidates[0]] <= reach):
        more = _within_reach(view, candidates[:batch], reach)
        gaps, offsets = _lowest(np.append(gaps, more[0]), np.concatenate([offsets, more[1]]), count)
        reach = gaps[-1] if len(gaps) == count else reach
        candidates, batch = candidates[batch:], 2 * batch
    return gaps, offsets


def _within_reach(view, tiles, reach):
    """Gaps (k,) of tiles that are at most `reach`, and the offsets (k, 2) of their pixels."""
    gaps = view.gaps(tiles)
    tile, y, x = np.nonzero(gaps <= reach)
    rows, columns = view.offsets(tiles)
    return gaps[tile, y, x], np.stack([rows[tile, y], columns[tile, x]], axis=1)


def _lowest(gaps, offsets, count):
    """The `count` smallest gaps, ascending; equal ones in the order of their offsets."""
    order = np.lexsort((offsets[:, 1], offsets[:, 0], gaps))[:count]
    return gaps[order], offsets[order]


def _nearest(offset, pixel_size, radius):
    """Lowest point of the paraboloid over the TILE pixels that begin at each offset."""
    nearest = np.maximum(np.maximum(offset, -(offset + TILE - 1)), 0)
    return paraboloid(nearest, pixel_size, radius)


def _within(offset, window, pixel_size, radius):
    """Paraboloid at offsets inside the window, infinite outside it."""
    inside = (offset >= -(window // 2)) & (offset < window // 2)
    return np.where(inside, paraboloid(offset, pixel_size, radius), np.inf)


def _periodic(tiles, y, x):
    """Heights of a tiled map at any offsets from its origin."""
    y, x = y % tiles.pixels, x % tiles.pixels
    return tiles.blocks[y // TILE, y % TILE, x // TILE, x % TILE]


def all_lowest_gaps(substrate, positions, pixel_size, radius, window, count, roughness=None):
    """`lowest_gaps` of a square array of contacts: dict (i, j) -> (gaps, offsets).

    substrate, roughness: periodic maps (n, n) and (m, m) in nm, or no roughness; positions:
    (contact,) pixels along either axis.
    """
    tiles = Tiles.of(substrate)
    rough = None if roughness is None else Tiles.of(roughness)
    return {
        (i, j): lowest_gaps(tiles, (y, x), pixel_size, radius, window, count, rough)
        for i, y in enumerate(positions)
        for j, x in enumerate(positions)
    }


def gap_map(substrate, position, pixel_size, radius, window, roughness):
    """Gap (window, window) in nm of one contact at zero approach.

    substrate: h (n, n) and roughness: t (m, m), both periodic; position: (y, x) of the apex.
    """
    offset = np.arange(window) - window // 2
    shape = paraboloid(offset, pixel_size, radius)
    rows, columns = ((p + offset) % substrate.shape[0] for p in position)
    around = offset % roughness.shape[0]
    return (
        shape[:, None]
        + shape
        - roughness[np.ix_(around, around)]
        - substrate[np.ix_(rows, columns)]
    )


def around_lowest(gap, pixels):
    """The square part (pixels, pixels) of a gap map (n, n) about its lowest point.

    Where the lowest point is near an edge of the map the part ends there, not about it.
    """
    lowest = np.unravel_index(gap.argmin(), gap.shape)
    rows, columns = (
        slice(first, first + pixels)
        for first in np.clip(np.array(lowest) - pixels // 2, 0, gap.shape[0] - pixels)
    )
    return gap[rows, columns]
