"""Rigid and plastic (bearing area) contact: closest approach and contact pixels.

The gap of a contact is g = s - t - h in nm: sphere s, its roughness t (growing out of the sphere)
and substrate h. The highest points of the tiles of a map bound its gaps, so that most tiles are
never read.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hardcontact.contact.geometry import Bodies, ContactGeometry, plastic_approach
from hardcontact.surfaces.height_map import HeightMap

Floats = NDArray[np.float64]

#: Pixels along an edge of a tile.
TILE = 64


@dataclass(frozen=True, eq=False)
class Tiles:
    """A periodic map (n, n), in nm, cut into tiles."""

    pixels: int  #: The period n.
    blocks: NDArray[np.floating]  #: (tiles, TILE, tiles, TILE), padded with minus infinity.
    maxima: NDArray[np.floating]  #: (tiles, tiles), the highest point of each.

    def in_window(self, position: int, window: int) -> tuple[NDArray[np.int_], NDArray[np.int_]]:
        """Return the tiles that meet a window of pixels about the apex, along one axis.

        Of each of them, (k,): the unfolded index of its first pixel, and its index in the map.
        """
        count = self.maxima.shape[0]
        first, last = position - window // 2, position + window // 2 - 1
        periods = np.arange(first // self.pixels, last // self.pixels + 1)
        origin = (periods[:, None] * self.pixels + np.arange(count) * TILE).ravel()
        meets = (origin <= last) & (origin + TILE > first)
        return origin[meets], np.tile(np.arange(count), len(periods))[meets]

    def upper_bound(self, y: NDArray[np.int_], x: NDArray[np.int_]) -> NDArray[np.floating]:
        """Return an upper bound (k, l) of the map on TILE x TILE pixels from offsets (k,), (l,).

        Such a square meets at most three tiles along an axis where the last one is not full.
        """
        rows = np.maximum.reduce([np.roll(self.maxima, -i, axis=0) for i in range(3)])
        columns = np.maximum.reduce([np.roll(rows, -i, axis=1) for i in range(3)])
        return np.asarray(columns[np.ix_(y % self.pixels // TILE, x % self.pixels // TILE)])

    def heights_at(self, y: NDArray[np.int_], x: NDArray[np.int_]) -> NDArray[np.floating]:
        """Return the heights (nm) at any offsets from the origin of the map."""
        y, x = y % self.pixels, x % self.pixels
        return np.asarray(self.blocks[y // TILE, y % TILE, x // TILE, x % TILE])


def as_tiles(surface: HeightMap) -> Tiles:
    """Cut a square periodic map into tiles."""
    heights, count = surface.heights, -(-surface.pixels // TILE)
    extra = count * TILE - surface.pixels
    if extra:
        heights = np.pad(heights, ((0, extra), (0, extra)), constant_values=-np.inf)
    blocks = heights.reshape(count, TILE, count, TILE)
    return Tiles(surface.pixels, blocks, blocks.max(axis=1).max(axis=2))


class LowestGaps(NamedTuple):
    """The contact pixels of one contact."""

    #: (contact_pixels,) nm, ascending. The first is minus the separation of rigid closest approach,
    #: the last that of plastic closest approach.
    gaps: Floats
    offsets: NDArray[np.int_]  #: (contact_pixels, 2) pixels from the apex: row, column.


class _Window:
    """The tiles of the substrate in the window of a contact, with bounds below their gaps."""

    def __init__(
        self,
        substrate: Tiles,
        roughness: Tiles | None,
        geometry: ContactGeometry,
        position: NDArray[np.int_],
    ) -> None:
        self.substrate, self.roughness, self.geometry = substrate, roughness, geometry
        (first_y, self.tile_y), (first_x, self.tile_x) = (
            substrate.in_window(index, geometry.window) for index in position
        )
        self.offset_y, self.offset_x = first_y - position[0], first_x - position[1]
        # The lowest point of the sphere over the TILE pixels that begin at each offset.
        low_y, low_x = (
            geometry.paraboloid(np.maximum(np.maximum(offset, -(offset + TILE - 1)), 0))
            for offset in (self.offset_y, self.offset_x)
        )
        bound = low_y[:, None] + low_x
        bound -= substrate.maxima[self.tile_y].take(self.tile_x, axis=1)
        if roughness is not None:
            bound -= roughness.upper_bound(self.offset_y, self.offset_x)
        self.shape, self.bound = bound.shape, bound.ravel()

    def offsets(self, tiles: NDArray[np.int_]) -> tuple[NDArray[np.int_], NDArray[np.int_]]:
        """Return the offsets from the apex of the rows and columns of tiles: two (tiles, TILE)."""
        row, column = np.unravel_index(tiles, self.shape)
        pixels = np.arange(TILE)
        return self.offset_y[row][:, None] + pixels, self.offset_x[column][:, None] + pixels

    def gaps(self, tiles: NDArray[np.int_]) -> Floats:
        """Return the gaps (tiles, TILE, TILE) in nm, infinite outside the window."""
        row, column = np.unravel_index(tiles, self.shape)
        y, x = self.offsets(tiles)
        sphere_y, sphere_x = (
            np.where(self.geometry.inside(offset), self.geometry.paraboloid(offset), np.inf)
            for offset in (y, x)
        )
        blocks = self.substrate.blocks[self.tile_y[row], :, self.tile_x[column], :]
        gaps: Floats = sphere_y[:, :, None] + sphere_x[:, None, :] - blocks
        if self.roughness is not None:
            gaps -= self.roughness.heights_at(y[:, :, None], x[:, None, :])
        return gaps


def lowest_gaps(
    substrate: Tiles,
    roughness: Tiles | None,
    geometry: ContactGeometry,
    position: NDArray[np.int_],
    contact_pixels: int,
) -> LowestGaps:
    """Return the smallest gaps of one contact and the pixels that they belong to.

    Only tiles with a lower bound on their gaps below the largest gap of the contact are read. The
    position (2,) is the pixel of the apex: row, column. Equal gaps come in the order of their
    offsets.
    """
    window = _Window(substrate, roughness, geometry, position)
    limit = _limit_of_gaps(window, contact_pixels)
    tiles = np.flatnonzero(window.bound <= limit)
    tiles = tiles[np.argsort(window.bound[tiles])]
    lowest, batch = LowestGaps(np.empty(0), np.empty((0, 2), int)), 8
    while len(tiles) and (len(lowest.gaps) < contact_pixels or window.bound[tiles[0]] <= limit):
        candidates = _gaps_up_to(window, tiles[:batch], limit)
        lowest = _lowest(lowest, candidates, contact_pixels)
        limit = lowest.gaps[-1] if len(lowest.gaps) == contact_pixels else limit
        tiles, batch = tiles[batch:], 2 * batch
    return lowest


def _limit_of_gaps(window: _Window, contact_pixels: int) -> float:
    """Return an upper bound on the N-th smallest gap (nm), N the contact pixels."""
    # The N-th smallest gap of the tiles with the lowest bounds, as many as have N pixels.
    tiles = min(-(-contact_pixels // TILE**2), window.bound.size)
    gaps = window.gaps(np.argpartition(window.bound, tiles - 1)[:tiles])
    return plastic_approach(gaps, contact_pixels) if gaps.size >= contact_pixels else np.inf


def _gaps_up_to(window: _Window, tiles: NDArray[np.int_], limit: float) -> LowestGaps:
    """Return the gaps of tiles that are at most `limit` (nm), in any order."""
    gaps = window.gaps(tiles)
    tile, y, x = np.nonzero(gaps <= limit)
    rows, columns = window.offsets(tiles)
    return LowestGaps(gaps[tile, y, x], np.stack([rows[tile, y], columns[tile, x]], axis=1))


def _lowest(first: LowestGaps, second: LowestGaps, contact_pixels: int) -> LowestGaps:
    """Return the smallest gaps of two sets, ascending; equal ones in the order of offsets."""
    gaps = np.append(first.gaps, second.gaps)
    offsets = np.concatenate([first.offsets, second.offsets])
    if gaps.size > contact_pixels:
        # Few are left to sort, and equal gaps at the end are all among them.
        low = gaps <= plastic_approach(gaps, contact_pixels)
        gaps, offsets = gaps[low], offsets[low]
    order = np.lexsort((offsets[:, 1], offsets[:, 0], gaps))[:contact_pixels]
    return LowestGaps(gaps[order], offsets[order])


def all_lowest_gaps(bodies: Bodies, contact_pixels: int) -> dict[tuple[int, int], LowestGaps]:
    """Return `lowest_gaps` of every contact, by its place (i, j) in the array."""
    substrate = as_tiles(bodies.substrate)
    roughness = None if bodies.roughness is None else as_tiles(bodies.roughness)
    geometry = bodies.geometry
    return {
        (i, j): lowest_gaps(substrate, roughness, geometry, np.array([y, x]), contact_pixels)
        for i, y in enumerate(geometry.positions)
        for j, x in enumerate(geometry.positions)
    }
