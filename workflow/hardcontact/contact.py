"""Rigid and plastic (bearing area) contact: closest approach and contact pixels.

The gap of a contact is g = s - t - h: sphere s, its roughness t (growing out of the sphere) and
substrate h, all in nm. The bodies approach until as many pixels as the contact needs touch.
"""

from dataclasses import dataclass

import numpy as np

from hardcontact.sphere import paraboloid

__all__ = ["Tiles", "all_lowest_gaps", "contact_pixel_count", "gap_map", "lowest_gaps"]

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
        rows, columns = self.maxima, self.maxima
        rows = np.maximum.reduce([np.roll(self.maxima, -i, axis=0) for i in range(3)])
        columns = np.maximum.reduce([np.roll(rows, -i, axis=1) for i in range(3)])
        y, x = (offset % self.pixels // TILE for offset in (offset_y, offset_x))
        return columns[np.ix_(y, x)]


def lowest_gaps(substrate, position, pixel_size, radius, window, count, roughness=None):
    """The `count` smallest gaps of one contact, ascending, and the pixels they belong to.

    substrate: Tiles of h; position: (y, x) pixel of the apex; radius: nm; window: pixels;
    roughness: Tiles of t, or None for a smooth sphere. The last gap is minus the separation of
    plastic closest approach, the first that of rigid contact.

    Returns gaps (count,) in nm and offsets (count, 2) of the pixels from the apex. Only tiles
    whose highest point could reach into the contact are read: an order statistic, not a scan.
    """
    (origin_y, tile_y), (origin_x, tile_x) = (substrate.around(p, window) for p in position)
    bound = (
        _nearest(origin_y - position[0], pixel_size, radius)[:, None]
        + _nearest(origin_x - position[1], pixel_size, radius)
        - substrate.maxima[np.ix_(tile_y, tile_x)]
    )
    if roughness is not None:
        bound = bound - roughness.highest_from(origin_y - position[0], origin_x - position[1])
    flat = bound.ravel()

    def read(tiles):
        row, column = np.unravel_index(tiles, bound.shape)
        heights = substrate.blocks[tile_y[row], :, tile_x[column], :]
        u = (origin_y[row] - position[0])[:, None] + np.arange(TILE)
        v = (origin_x[column] - position[1])[:, None] + np.arange(TILE)
        gaps = (
            _within(u, window, pixel_size, radius)[:, :, None]
            + _within(v, window, pixel_size, radius)[:, None, :]
            - heights
        )
        if roughness is not None:
            gaps -= _periodic(roughness, u[:, :, None], v[:, None, :])
        return gaps.ravel(), tiles

    best = np.array([flat.argmin()])
    gaps = read(best)[0]
    reach = np.partition(gaps, count - 1)[count - 1] if gaps.size >= count else np.inf
    candidates = np.flatnonzero(flat <= reach)
    candidates = candidates[np.argsort(flat[candidates])]
    found, offsets, start, batch = np.empty(0), np.empty((0, 2), int), 0, 8
    while start < len(candidates) and (len(found) < count or flat[candidates[start]] <= reach):
        tiles = candidates[start : start + batch]
        gaps, _ = read(tiles)
        chosen = np.flatnonzero(gaps <= reach)
        if len(chosen) > count:
            chosen = chosen[np.argpartition(gaps[chosen], count - 1)[:count]]
        tile, y, x = np.unravel_index(chosen, (len(tiles), TILE, TILE))
        row, column = np.unravel_index(tiles[tile], bound.shape)
        places = np.stack([origin_y[row] - position[0] + y, origin_x[column] - position[1] + x], 1)
        found, offsets = np.append(found, gaps[chosen]), np.concatenate([offsets, places])
        order = np.lexsort((offsets[:, 1], offsets[:, 0], found))[:count]
        found, offsets = found[order], offsets[order]
        reach = found[-1] if len(found) == count else reach
        start, batch = start + batch, 2 * batch
    return found, offsets


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
