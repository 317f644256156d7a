"""Rigid and plastic (bearing area) contact: closest approach and contact pixels.

The gap of a contact is g = s - t - h: sphere s, its roughness t (growing out of the sphere) and
substrate h, all in nm. The bodies approach until the contact pixels carry the preload. The highest
points of the tiles of a map bound its gaps, so that most tiles are never read.
"""

from dataclasses import dataclass
from typing import NamedTuple, TypedDict

import numpy as np
from numpy.typing import NDArray

from hardcontact.contact.geometry import Bodies, ContactArray, ContactGeometry
from hardcontact.surfaces.height_map import HeightMap

#: Pixels along an edge of a tile.
TILE = 64


@dataclass(frozen=True, eq=False)
class Tiles:
    """A periodic map (n, n) cut into tiles.

    `pixels` is the period n. The blocks (tiles, TILE, tiles, TILE), in nm, are padded with minus
    infinity; the maxima (tiles, tiles), in nm, are the highest point of each tile.
    """

    pixels: int
    blocks: NDArray[np.floating]
    maxima: NDArray[np.floating]

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


Floats = NDArray[np.float64]


class Load(TypedDict):
    """The preload in N and the hardness of the softer body in Pa, which set the contact pixels."""

    preload: float
    hardness: float


class NamedLoad(Load):
    """A load with its name as it stands in paths, e.g. ``"H25GPa-F10uN"``."""

    name: str


class ContactSettings(ContactArray, Load):
    """The array of contacts and the load on each, as the configuration has them."""


class LowestGaps(NamedTuple):
    """The contact pixels of one contact.

    Attributes
    ----------
    gaps : numpy.ndarray
        (contact_pixels,) nm, ascending. The first is minus the separation of rigid closest
        approach, the last that of plastic closest approach.
    offsets : numpy.ndarray
        (contact_pixels, 2) pixels from the apex: row, column.
    """

    gaps: Floats
    offsets: NDArray[np.int_]


def contact_pixel_count(load: Load, pixel_size: float) -> int:
    """Return the contact pixels (size in nm) of a load: the smallest whole number >= F/(H A_pix).

    Source: the paper, plastic analysis.
    """
    pixel_area = (pixel_size * 1e-9) ** 2
    return int(np.ceil(load["preload"] / (load["hardness"] * pixel_area) * (1 - 1e-12)))


class _Window:
    """The tiles of the substrate in the window of one contact.

    The bound (tiles,), in nm, is a lower one on the gaps of each tile.
    """

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
        bound = _sphere_lowest_in_tile(self.offset_y, geometry)[:, None] + _sphere_lowest_in_tile(
            self.offset_x, geometry
        )
        bound -= substrate.maxima[self.tile_y].take(self.tile_x, axis=1)
        if roughness is not None:
            bound -= roughness.upper_bound(self.offset_y, self.offset_x)
        self.shape, self.bound = bound.shape, bound.ravel()

    def offsets(self, tiles: NDArray[np.int_]) -> tuple[NDArray[np.int_], NDArray[np.int_]]:
        """Return the offsets from the apex of the rows and columns of tiles: two (tiles, TILE)."""
        row, column = np.unravel_index(tiles, self.shape)
        place = np.arange(TILE)
        return self.offset_y[row][:, None] + place, self.offset_x[column][:, None] + place

    def gaps(self, tiles: NDArray[np.int_]) -> Floats:
        """Return the gaps (tiles, TILE, TILE) in nm, infinite outside the window."""
        row, column = np.unravel_index(tiles, self.shape)
        y, x = self.offsets(tiles)
        gaps: Floats = (
            _sphere_in_window(y, self.geometry)[:, :, None]
            + _sphere_in_window(x, self.geometry)[:, None, :]
            - self.substrate.blocks[self.tile_y[row], :, self.tile_x[column], :]
        )
        if self.roughness is not None:
            gaps -= self.roughness.heights_at(y[:, :, None], x[:, None, :])
        return gaps


def _sphere_lowest_in_tile(offset: NDArray[np.int_], geometry: ContactGeometry) -> Floats:
    """Return the lowest point of the sphere over the TILE pixels that begin at each offset."""
    return geometry.paraboloid(np.maximum(np.maximum(offset, -(offset + TILE - 1)), 0))


def _sphere_in_window(offset: NDArray[np.int_], geometry: ContactGeometry) -> Floats:
    """Return the sphere at offsets inside the window, infinity outside it."""
    return np.where(geometry.inside(offset), geometry.paraboloid(offset), np.inf)


def lowest_gaps(
    substrate: Tiles,
    roughness: Tiles | None,
    geometry: ContactGeometry,
    position: NDArray[np.int_],
    contact_pixels: int,
) -> LowestGaps:
    """Return the smallest gaps of one contact and the pixels that they belong to.

    Only tiles with a lower bound on their gaps below the largest gap of the contact are read: tiles
    of the heights h of the substrate and of the roughness t of the sphere, None of a smooth one.
    The position (2,) is the pixel of the apex: row, column. Gaps are as many as contact pixels;
    equal ones come in the order of their offsets.
    """
    window = _Window(substrate, roughness, geometry, position)
    limit = _limit_of_gaps(window, contact_pixels)
    tiles = np.flatnonzero(window.bound <= limit)
    tiles = tiles[np.argsort(window.bound[tiles])]
    lowest, batch = LowestGaps(np.empty(0), np.empty((0, 2), int)), 8
    while len(tiles) and (len(lowest.gaps) < contact_pixels or window.bound[tiles[0]] <= limit):
        more = _gaps_up_to(window, tiles[:batch], limit)
        lowest = _lowest(lowest, more, contact_pixels)
        limit = lowest.gaps[-1] if len(lowest.gaps) == contact_pixels else limit
        tiles, batch = tiles[batch:], 2 * batch
    return lowest


def _limit_of_gaps(window: _Window, contact_pixels: int) -> float:
    """Return an upper bound on the N-th smallest gap (nm), N the contact pixels.

    It is the N-th smallest gap of the tiles with the lowest bounds, as many as have N pixels.
    """
    most = min(-(-contact_pixels // TILE**2), window.bound.size)
    if most == 1:
        tiles = np.array([window.bound.argmin()])
    else:
        tiles = np.argpartition(window.bound, most - 1)[:most]
    gaps = window.gaps(tiles).ravel()
    if gaps.size < contact_pixels:
        return float("inf")
    return float(np.partition(gaps, contact_pixels - 1)[contact_pixels - 1])


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
        low = gaps <= np.partition(gaps, contact_pixels - 1)[contact_pixels - 1]
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


def stacked_gaps(contacts: dict[tuple[int, int], LowestGaps], geometry: ContactGeometry) -> Floats:
    """Return the gaps (contact, contact, contact_pixels) of `all_lowest_gaps` as one array."""
    gaps = np.array([one.gaps for one in contacts.values()])
    return gaps.reshape(*[len(geometry.positions)] * 2, -1)
