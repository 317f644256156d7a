"""Rigid and plastic (bearing area) contact: closest approach and contact pixels.

The gap of a pixel is g = y - u - z in nm: sphere y, its roughness u (positive towards the
substrate) and substrate z. The contact pixels have the N smallest gaps. A branch and bound over
tiles finds them: the highest point of a tile, or of a group of tiles, bounds all gaps in it from
below. Only tiles whose bound is below the N-th smallest gap known so far are read.
"""

from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats
from hardcontact.contact.geometry import Bodies, ContactGeometry, largest_contact_gap
from hardcontact.surfaces.height_map import HeightMap

#: Pixels per row of a tile, tiles per row of a group, tiles that are read at once, and
#: contacts that are searched at once. They change the speed only.
TILE = 32
GROUP = 16
BATCH = 256
CONTACT_BATCH = 50


@dataclass(frozen=True, eq=False)
class Tiles:
    """A periodic map (n, n), in nm, cut into tiles."""

    pixels: int  #: The period n.
    blocks: NDArray[np.floating]  #: (tiles, TILE, tiles, TILE), padded with minus infinity.
    maxima: NDArray[np.floating]  #: (tiles, tiles), the highest point of each.
    #: (tiles, tiles), the highest point of the GROUP x GROUP tiles that begin at each tile.
    group_maxima: NDArray[np.floating]

    def tiles_in_window(
        self, positions: NDArray[np.int_], window: int
    ) -> tuple[NDArray[np.int_], NDArray[np.int_], NDArray[np.bool_]]:
        """Return the tiles that meet windows of pixels about positions (...), along one axis.

        Three arrays (..., k), padded to the largest number k of tiles in a window: the offset of
        the first pixel of a tile from the position, its index, and whether it meets the window.
        """
        count = self.maxima.shape[0]
        start = positions - window // 2
        first_tile = self._tile_number(start)
        last_tile = self._tile_number(start + window - 1)
        tiles = first_tile[..., None] + np.arange((last_tile - first_tile).max() + 1)
        index = tiles % count
        offset = tiles // count * self.pixels + index * TILE - positions[..., None]
        return offset, index, tiles <= last_tile[..., None]

    def _tile_number(self, pixel: NDArray[np.int_]) -> NDArray[np.int_]:
        """Return the number of the tile of a pixel along one axis, counted on over periods."""
        return np.asarray(pixel // self.pixels * len(self.maxima) + pixel % self.pixels // TILE)

    def upper_bound(self, y: NDArray[np.int_], x: NDArray[np.int_]) -> NDArray[np.floating]:
        """Return an upper bound of the map on TILE x TILE pixels from offsets, which broadcast.

        Such a square meets at most three tiles along an axis where the last one is not full.
        """
        highest = _maxima_of_squares(self.maxima, 3)
        return np.asarray(highest[y % self.pixels // TILE, x % self.pixels // TILE])

    def heights_at(self, y: NDArray[np.int_], x: NDArray[np.int_]) -> NDArray[np.floating]:
        """Return the heights (nm) at any offsets from the origin of the map."""
        width = self.maxima.shape[1] * TILE
        return np.asarray(self.blocks.ravel().take(y % self.pixels * width + x % self.pixels))


def _maxima_of_squares(maxima: NDArray[np.floating], count: int) -> NDArray[np.floating]:
    """Return the maxima (tiles, tiles) of the count x count tiles that begin at each, periodic."""
    rows = np.maximum.reduce([np.roll(maxima, -i, axis=0) for i in range(count)])
    return np.asarray(np.maximum.reduce([np.roll(rows, -i, axis=1) for i in range(count)]))


def cut_into_tiles(surface: HeightMap) -> Tiles:
    """Cut a square periodic map into tiles."""
    heights = surface.heights
    count = -(-surface.pixels // TILE)
    extra = count * TILE - surface.pixels
    if extra:
        heights = np.pad(heights, ((0, extra), (0, extra)), constant_values=-np.inf)
    blocks = heights.reshape(count, TILE, count, TILE)
    maxima = blocks.max(axis=1).max(axis=2)
    return Tiles(surface.pixels, blocks, maxima, _maxima_of_squares(maxima, GROUP))


class ContactPixels(NamedTuple):
    """The contact pixels of contacts (...): k of each."""

    #: (..., k) nm, ascending. The first is minus the height of the apex at rigid closest approach,
    #: the last minus that at plastic closest approach.
    gaps: Floats
    offsets: NDArray[np.int_]  #: (..., k, 2) pixels from the apex: row, column.

    def lowest(self, count: int) -> "ContactPixels":
        """Return as many of the pixels of each contact, those with the smallest gaps."""
        return ContactPixels(self.gaps[..., :count], self.offsets[..., :count, :])

    def pixels_of_contact(self, index: tuple[int, ...]) -> "ContactPixels":
        """Return the pixels of one contact."""
        return ContactPixels(self.gaps[index], self.offsets[index])


class WindowTiles(NamedTuple):
    """Tiles in the windows of contacts, ordered by contact."""

    contact_numbers: NDArray[np.int_]  #: (k,) index of the contact of each tile.
    row: NDArray[np.int_]  #: (k,) row of the tile within the window.
    column: NDArray[np.int_]  #: (k,) column of the tile within the window.
    bounds: Floats  #: (k,) lower bound in nm on the gaps of the tile.

    def select(self, index: slice | NDArray[np.int_] | NDArray[np.bool_]) -> "WindowTiles":
        """Return some of the tiles."""
        contacts, row, column, bounds = self
        return WindowTiles(contacts[index], row[index], column[index], bounds[index])

    def tiles_within(self, limits: Floats) -> "WindowTiles":
        """Return the tiles whose bounds are at most the limits (contact,) in nm."""
        return self.select(self.bounds <= limits[self.contact_numbers])


class _Windows:
    """The tiles of the substrate in the windows of contacts, with lower bounds on their gaps.

    Tiles are numbered along each axis of the window of their contact. Bounds in nm are infinite for
    tiles outside it.
    """

    def __init__(
        self,
        substrate: Tiles,
        sphere_roughness: Tiles | None,
        geometry: ContactGeometry,
        positions: NDArray[np.int_],
    ) -> None:
        self.substrate = substrate
        self.sphere_roughness = sphere_roughness
        self.geometry = geometry
        offset, index, meets = substrate.tiles_in_window(positions, geometry.window_pixels)
        # The lowest point of the sphere over the TILE pixels that begin at each offset.
        nearest = np.maximum(np.maximum(offset, -(offset + TILE - 1)), 0)
        low = np.where(meets, geometry.paraboloid(nearest), np.inf)
        padding = ((0, 0), (0, 0), (0, -low.shape[-1] % GROUP))
        #: (contact, axis, tiles along the axis), whole groups.
        self.offset = np.pad(offset, padding, constant_values=geometry.window_pixels)  # outside it
        self.index = np.pad(index, padding)
        self.low = np.pad(low, padding, constant_values=np.inf)

    def group_bounds(self) -> Floats:
        """Return the bounds (contact, group), groups numbered by rows within the window."""
        contacts, axes, tiles = self.low.shape
        low = self.low.reshape(contacts, axes, tiles // GROUP, GROUP).min(axis=-1)
        groups = self.index[:, :, ::GROUP]
        bounds = low[:, 0, :, None] + low[:, 1, None, :]
        bounds -= self.substrate.group_maxima[groups[:, 0, :, None], groups[:, 1, None, :]]
        if self.sphere_roughness is not None:
            bounds -= self.sphere_roughness.maxima.max()
        return np.asarray(bounds.reshape(contacts, -1))

    def tiles_of_groups(self, contacts: NDArray[np.int_], group: NDArray[np.int_]) -> WindowTiles:
        """Return the tiles of groups (k,), in this order; `contacts` (k,) are their contacts."""
        group_row, group_column = np.divmod(group, self.low.shape[-1] // GROUP)
        row = (group_row[:, None] * GROUP + np.arange(GROUP))[:, :, None]
        column = (group_column[:, None] * GROUP + np.arange(GROUP))[:, None, :]
        contact = contacts[:, None, None]
        bounds = self.low[contact, 0, row] + self.low[contact, 1, column]
        bounds -= self.substrate.maxima[self.index[contact, 0, row], self.index[contact, 1, column]]
        if self.sphere_roughness is not None:
            bounds -= self.sphere_roughness.upper_bound(
                self.offset[contact, 0, row], self.offset[contact, 1, column]
            )
        contact, row, column = np.broadcast_arrays(contact, row, column)
        return WindowTiles(contact.ravel(), row.ravel(), column.ravel(), bounds.ravel())

    def gaps(self, tiles: WindowTiles) -> tuple[Floats, NDArray[np.int_], NDArray[np.int_]]:
        """Return the gaps (k, TILE, TILE) in nm of tiles (k,), infinite outside the window.

        Also returns the offsets (k, TILE) of their rows, and of their columns, from the apex.
        """
        contact, row, column, _ = tiles
        y = self.offset[contact, 0, row][:, None] + np.arange(TILE)
        x = self.offset[contact, 1, column][:, None] + np.arange(TILE)
        tile_y, tile_x = self.index[contact, 0, row], self.index[contact, 1, column]
        gaps: Floats = self._sphere_in_window(y)[:, :, None] + self._sphere_in_window(x)[:, None, :]
        gaps -= self.substrate.blocks[tile_y, :, tile_x, :]
        if self.sphere_roughness is not None:
            gaps -= self.sphere_roughness.heights_at(y[:, :, None], x[:, None, :])
        return gaps, y, x

    def _sphere_in_window(self, offset: NDArray[np.int_]) -> Floats:
        """Return the height (nm) of the sphere along one axis, infinite outside the window."""
        geometry = self.geometry
        return np.where(geometry.window_mask(offset), geometry.paraboloid(offset), np.inf)


def find_contact_pixels(
    substrate: Tiles,
    sphere_roughness: Tiles | None,
    geometry: ContactGeometry,
    positions: NDArray[np.int_],
    contact_pixel_count: int,
) -> list[ContactPixels]:
    """Return the smallest gaps of each contact and the pixels that they belong to.

    Only tiles with a lower bound on their gaps below the largest gap of the contact are read. The
    positions (contact, 2) are the pixels of the apex: row, column. Equal gaps come in the order of
    their offsets.
    """
    windows = _Windows(substrate, sphere_roughness, geometry, positions)
    group_bounds = windows.group_bounds()
    tile_count = -(-contact_pixel_count // TILE**2)
    best_groups = _lowest_columns(group_bounds, -(-tile_count // GROUP**2))
    contacts = np.repeat(np.arange(len(positions)), best_groups.shape[1])
    tiles = windows.tiles_of_groups(contacts, best_groups.ravel())
    limits = _limits_of_gaps(windows, tiles, contact_pixel_count)
    low_groups = np.nonzero(group_bounds <= limits[:, None])
    tiles = windows.tiles_of_groups(*low_groups).tiles_within(limits)
    # The remaining tiles of lowest bounds, from all groups, give lower limits.
    limits = _limits_of_gaps(windows, tiles, contact_pixel_count)
    tiles = tiles.tiles_within(limits)
    batches = [slice(start, start + BATCH) for start in range(0, len(tiles.contact_numbers), BATCH)]
    low_gaps = [_gaps_up_to(windows, tiles.select(batch), limits) for batch in batches]
    contacts, gaps, offsets = (np.concatenate(arrays) for arrays in zip(*low_gaps, strict=True))
    ends = np.searchsorted(contacts, np.arange(1, len(positions)))
    return [
        _lowest(*candidates, contact_pixel_count)
        for candidates in zip(np.split(gaps, ends), np.split(offsets, ends), strict=True)
    ]


def _limits_of_gaps(windows: _Windows, tiles: WindowTiles, contact_pixel_count: int) -> Floats:
    """Return an upper bound (contact,) on the N-th smallest gap (nm), N the contact pixels.

    It is the N-th smallest gap in the tiles of lowest bounds, as few as have N pixels.
    """
    tile_count = -(-contact_pixel_count // TILE**2)
    ends = np.searchsorted(tiles.contact_numbers, np.arange(tiles.contact_numbers[-1] + 2))
    best = [
        start + _lowest_columns(tiles.bounds[None, start:end], tile_count)[0]
        for start, end in pairwise(ends.tolist())
    ]
    gaps, _, _ = windows.gaps(tiles.select(np.concatenate(best)))
    gaps = gaps.reshape(len(best), -1)
    if gaps.shape[1] < contact_pixel_count:
        return np.full(len(best), np.inf)
    if contact_pixel_count == 1:
        return np.asarray(gaps.min(axis=1))
    return np.partition(gaps, contact_pixel_count - 1, axis=1)[:, contact_pixel_count - 1]


def _lowest_columns(bounds: Floats, count: int) -> NDArray[np.int_]:
    """Return the indices (row, count) of the lowest bounds (row, column), at most all."""
    if count == 1:
        return np.asarray(bounds.argmin(axis=1)[:, None])
    count = min(count, bounds.shape[1])
    return np.argpartition(bounds, count - 1, axis=1)[:, :count]


def _gaps_up_to(
    windows: _Windows, tiles: WindowTiles, limits: Floats
) -> tuple[NDArray[np.int_], Floats, NDArray[np.int_]]:
    """Return the gaps (nm) in tiles that do not exceed the limit of their contact.

    Returns three arrays: the number of the contact of each gap, the gaps, their offsets (gap, 2).
    """
    gaps, rows, columns = windows.gaps(tiles)
    low = np.flatnonzero(gaps <= limits[tiles.contact_numbers, None, None])
    tile, y, x = np.unravel_index(low, gaps.shape)
    offsets = np.stack([rows[tile, y], columns[tile, x]], axis=1)
    return tiles.contact_numbers[tile], gaps.ravel()[low], offsets


def _lowest(gaps: Floats, offsets: NDArray[np.int_], contact_pixel_count: int) -> ContactPixels:
    """Return the pixels of the smallest gaps, ascending; equal gaps in the order of offsets."""
    if gaps.size > contact_pixel_count:
        # Few gaps are left to sort, with all that equal the largest one.
        low = gaps <= largest_contact_gap(gaps, contact_pixel_count)
        gaps, offsets = gaps[low], offsets[low]
    order = np.lexsort((offsets[:, 1], offsets[:, 0], gaps))[:contact_pixel_count]
    return ContactPixels(gaps[order], offsets[order])


def all_contact_pixels(bodies: Bodies, contact_pixel_count: int) -> ContactPixels:
    """Return the contact pixels (contact_y, contact_x, k) of every contact of the array."""
    substrate = cut_into_tiles(bodies.substrate)
    sphere = bodies.sphere_roughness
    rough_tiles = None if sphere is None else cut_into_tiles(sphere)
    geometry = bodies.geometry
    apexes = geometry.apexes()
    positions = apexes.reshape(-1, 2)
    pixels: list[ContactPixels] = []
    for start in range(0, len(positions), CONTACT_BATCH):
        batch = positions[start : start + CONTACT_BATCH]
        pixels += find_contact_pixels(substrate, rough_tiles, geometry, batch, contact_pixel_count)
    gaps, offsets = (np.stack(arrays) for arrays in zip(*pixels, strict=True))
    shape = apexes.shape[:2]
    return ContactPixels(gaps.reshape(*shape, -1), offsets.reshape(*shape, -1, 2))
