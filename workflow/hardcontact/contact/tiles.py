"""A periodic map cut into tiles with the highest point of each, which bounds the gaps there."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hardcontact.surfaces.height_map import HeightMap

__all__ = ["TILE", "Tiles", "as_tiles"]

#: Pixels along an edge of a tile.
TILE = 64


@dataclass(frozen=True, eq=False)
class Tiles:
    """A periodic map (n, n) cut into tiles.

    Attributes
    ----------
    pixels : int
        Period n.
    blocks : numpy.ndarray
        (tiles, TILE, tiles, TILE) nm, padded with minus infinity.
    maxima : numpy.ndarray
        (tiles, tiles) nm, highest point of each tile.
    """

    pixels: int
    blocks: NDArray[np.floating]
    maxima: NDArray[np.floating]

    def in_window(self, position: int, window: int) -> tuple[NDArray[np.int_], NDArray[np.int_]]:
        """Return the tiles that meet a window along one axis.

        Parameters
        ----------
        position : int
            Pixel of the apex.
        window : int
            Pixels.

        Returns
        -------
        first : numpy.ndarray
            (k,) unfolded index of the first pixel of each of them.
        tile : numpy.ndarray
            (k,) index of the tile in the map.
        """
        count = self.maxima.shape[0]
        first, last = position - window // 2, position + window // 2 - 1
        periods = np.arange(first // self.pixels, last // self.pixels + 1)
        origin = (periods[:, None] * self.pixels + np.arange(count) * TILE).ravel()
        meets = (origin <= last) & (origin + TILE > first)
        return origin[meets], np.tile(np.arange(count), len(periods))[meets]

    def upper_bound(
        self, offset_y: NDArray[np.int_], offset_x: NDArray[np.int_]
    ) -> NDArray[np.floating]:
        """Return an upper bound (k, l) of the map on TILE x TILE pixels from offsets (k,), (l,).

        Such a square meets at most three tiles along an axis where the last one is not full.
        """
        rows = np.maximum.reduce([np.roll(self.maxima, -i, axis=0) for i in range(3)])
        columns = np.maximum.reduce([np.roll(rows, -i, axis=1) for i in range(3)])
        y, x = (offset % self.pixels // TILE for offset in (offset_y, offset_x))
        bound: NDArray[np.floating] = columns[np.ix_(y, x)]
        return bound

    def heights_at(self, y: NDArray[np.int_], x: NDArray[np.int_]) -> NDArray[np.floating]:
        """Return the heights (nm) at any offsets from the origin of the map."""
        y, x = y % self.pixels, x % self.pixels
        heights: NDArray[np.floating] = self.blocks[y // TILE, y % TILE, x // TILE, x % TILE]
        return heights


def as_tiles(surface: HeightMap) -> Tiles:
    """Cut a square periodic map into tiles."""
    heights, count = surface.heights, -(-surface.pixels // TILE)
    extra = count * TILE - surface.pixels
    if extra:
        heights = np.pad(heights, ((0, extra), (0, extra)), constant_values=-np.inf)
    blocks = heights.reshape(count, TILE, count, TILE)
    return Tiles(surface.pixels, blocks, blocks.max(axis=1).max(axis=2))
