"""Rigid and plastic (bearing area) contact: closest approach and contact pixels.

The contact pixels have the N smallest reference gaps (`geometry`). To find them without reading all
pixels, the map is cut into tiles. The highest point of a tile, or of a group of tiles, gives a
lower bound of its gaps. The N-th smallest gap of a few tiles is an upper limit of the gaps in
contact. Only tiles with a bound below the limit are read.
"""

from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats
from hardcontact.contact.geometry import Bodies, largest_contact_gap
from hardcontact.surfaces.height_map import HeightMap

#: Pixels per row of a tile. This number and the next four only change the speed.
TILE = 32
#: Tiles per row of a group.
GROUP = 16
#: Tiles that are read at once.
TILES_AT_ONCE = 256
#: Contacts that are searched at once.
CONTACTS_AT_ONCE = 50
#: Tiles that are read for a limit, relative to the fewest that have N pixels: on a smooth surface
#: fewer would lie on one slope, and set a high limit.
LIMIT_TILE_FACTOR = 2


@dataclass(frozen=True, eq=False)
class Tiles:
    """A periodic map (n, n), in nm, cut into tiles."""

    pixels: int  #: The period n.
    blocks: NDArray[np.floating]  #: (tiles, TILE, tiles, TILE), padded with minus infinity.
    maxima: NDArray[np.floating]  #: (tiles, tiles), the highest point of each.
    #: (tiles, tiles), the highest point of the group of tiles that begins at each tile.
    group_maxima: NDArray[np.floating]

    def tiles_in_window(
        self, positions: NDArray[np.int_], window: int
    ) -> tuple[NDArray[np.int_], NDArray[np.int_], NDArray[np.bool_]]:
        """Return the tiles that meet windows of pixels about positions (...), along one axis.

        Returns three arrays (..., k), padded to the largest number k of tiles in a window: the
        offset of a tile from the position, its index, and whether it meets the window.
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

    #: (..., k) nm, ascending. The apex is at minus the first one at rigid closest approach, at
    #: minus the last one at plastic closest approach.
    reference_gaps: Floats
    offsets: NDArray[np.int_]  #: (..., k, 2) pixels from the apex: row, column.

    def lowest_of_contact(self, index: tuple[int, ...], count: int) -> "ContactPixels":
        """Return the pixels of one contact with the smallest reference gaps."""
        return ContactPixels(self.reference_gaps[index][:count], self.offsets[index][:count])


class WindowTiles(NamedTuple):
    """Tiles in the windows of contacts, ordered by contact."""

    contact_numbers: NDArray[np.int_]  #: (k,) index of the contact of each tile.
    row: NDArray[np.int_]  #: (k,) row of the tile within the window.
    column: NDArray[np.int_]  #: (k,) column of the tile within the window.
    bounds: Floats  #: (k,) lower bound in nm on the reference gaps of the tile.

    def select(self, index: slice | NDArray[np.int_] | NDArray[np.bool_]) -> "WindowTiles":
        """Return some of the tiles."""
        contacts, row, column, bounds = self
        return WindowTiles(contacts[index], row[index], column[index], bounds[index])

    def tiles_within(self, limits: Floats) -> "WindowTiles":
        """Return the tiles whose bounds are at most the limits (contact,) in nm."""
        return self.select(self.bounds <= limits[self.contact_numbers])


class _Windows:
    """The tiles of the substrate in the windows of contacts, with lower bounds (nm) on their gaps.

    Tiles are numbered along each axis of the window. Bounds outside the window are infinite.
    `roughness_maxima` are the highest points of the sphere's roughness over each tile.
    """

    def __init__(
        self,
        bodies: Bodies,
        substrate: Tiles,
        roughness_maxima: NDArray[np.floating] | None,
        positions: NDArray[np.int_],
    ) -> None:
        self.substrate = substrate
        self.sphere_roughness = bodies.sphere_roughness
        self.roughness_maxima = roughness_maxima
        self.geometry = geometry = bodies.geometry
        offset, index, is_met = substrate.tiles_in_window(positions, geometry.window_pixels)
        nearest = np.maximum(np.maximum(offset, -(offset + TILE - 1)), 0)
        sphere_minima = np.where(is_met, geometry.paraboloid(nearest), np.inf)
        padding = ((0, 0), (0, 0), (0, -sphere_minima.shape[-1] % GROUP))
        # Arrays (contact, axis, tile) of offsets, indices, and lowest points of the smooth sphere,
        # padded to whole groups by tiles outside the window.
        self.offset = np.pad(offset, padding, constant_values=geometry.window_pixels)
        self.index = np.pad(index, padding)
        self.sphere_minima = np.pad(sphere_minima, padding, constant_values=np.inf)

    def group_bounds(self) -> Floats:
        """Return the bounds (contact, group), groups numbered by rows within the window."""
        contacts, axes, tiles = self.sphere_minima.shape
        minima = self.sphere_minima.reshape(contacts, axes, tiles // GROUP, GROUP).min(axis=-1)
        groups = self.index[:, :, ::GROUP]
        bounds = minima[:, 0, :, None] + minima[:, 1, None, :]
        bounds -= self.substrate.group_maxima[groups[:, 0, :, None], groups[:, 1, None, :]]
        if self.roughness_maxima is not None:
            bounds -= self.roughness_maxima.max()
        return np.asarray(bounds.reshape(contacts, -1))

    def tiles_of_groups(self, contacts: NDArray[np.int_], group: NDArray[np.int_]) -> WindowTiles:
        """Return the tiles of groups (k,), in this order; `contacts` (k,) are their contacts."""
        group_row, group_column = np.divmod(group, self.sphere_minima.shape[-1] // GROUP)
        row = (group_row[:, None] * GROUP + np.arange(GROUP))[:, :, None]
        column = (group_column[:, None] * GROUP + np.arange(GROUP))[:, None, :]
        contact = contacts[:, None, None]
        bounds = self.sphere_minima[contact, 0, row] + self.sphere_minima[contact, 1, column]
        bounds -= self.substrate.maxima[self.index[contact, 0, row], self.index[contact, 1, column]]
        if self.sphere_roughness is not None and self.roughness_maxima is not None:
            sphere_tiles = self.offset % self.sphere_roughness.pixels // TILE
            bounds -= self.roughness_maxima[
                sphere_tiles[contact, 0, row], sphere_tiles[contact, 1, column]
            ]
        contact, row, column = np.broadcast_arrays(contact, row, column)
        return WindowTiles(contact.ravel(), row.ravel(), column.ravel(), bounds.ravel())

    def tile_gaps(self, tiles: WindowTiles) -> tuple[Floats, NDArray[np.int_], NDArray[np.int_]]:
        """Return the reference gaps (k, y, x) of tiles (k,), infinite outside the window.

        Also returns the offsets of their rows (k, y) and columns (k, x) from the apex.
        """
        contact, row, column, _ = tiles
        y = self.offset[contact, 0, row][:, None] + np.arange(TILE)
        x = self.offset[contact, 1, column][:, None] + np.arange(TILE)
        tile_y, tile_x = self.index[contact, 0, row], self.index[contact, 1, column]
        gaps: Floats = self._sphere_in_window(y)[:, :, None] + self._sphere_in_window(x)[:, None, :]
        gaps -= self.substrate.blocks[tile_y, :, tile_x, :]
        if self.sphere_roughness is not None:
            period = self.sphere_roughness.pixels
            gaps -= self.sphere_roughness.heights[y[:, :, None] % period, x[:, None, :] % period]
        return gaps, y, x

    def _sphere_in_window(self, offset: NDArray[np.int_]) -> Floats:
        """Return the height (nm) of the sphere along one axis, infinite outside the window."""
        geometry = self.geometry
        return np.where(geometry.window_mask(offset), geometry.paraboloid(offset), np.inf)


def _find_contact_pixels(windows: _Windows, contact_pixel_count: int) -> list[ContactPixels]:
    """Return the contact pixels of each contact; equal gaps come in the order of their offsets."""
    group_bounds = windows.group_bounds()
    tile_count = -(-contact_pixel_count // TILE**2)
    best_groups = _lowest_columns(group_bounds, -(-tile_count // GROUP**2))
    contacts = np.repeat(np.arange(len(best_groups)), best_groups.shape[1])
    tiles = windows.tiles_of_groups(contacts, best_groups.ravel())
    limits = _limits_of_gaps(windows, tiles, contact_pixel_count)
    low_groups = np.nonzero(group_bounds <= limits[:, None])
    tiles = windows.tiles_of_groups(*low_groups).tiles_within(limits)
    # Tiles of lower bounds, from all groups, give lower limits.
    limits = np.minimum(limits, _limits_of_gaps(windows, tiles, contact_pixel_count))
    tiles = tiles.tiles_within(limits)
    batches = [
        slice(start, start + TILES_AT_ONCE)
        for start in range(0, len(tiles.contact_numbers), TILES_AT_ONCE)
    ]
    low_gaps = [_gaps_up_to(windows, tiles.select(batch), limits) for batch in batches]
    contacts, gaps, offsets = (np.concatenate(arrays) for arrays in zip(*low_gaps, strict=True))
    ends = np.searchsorted(contacts, np.arange(1, len(limits)))
    return [
        _pixels_of_smallest_gaps(*candidates, contact_pixel_count)
        for candidates in zip(np.split(gaps, ends), np.split(offsets, ends), strict=True)
    ]


def _limits_of_gaps(windows: _Windows, tiles: WindowTiles, contact_pixel_count: int) -> Floats:
    """Return the N-th smallest gap (contact,) in the tiles of lowest bounds: an upper limit."""
    ends = np.searchsorted(tiles.contact_numbers, np.arange(tiles.contact_numbers[-1] + 2))
    tile_count = LIMIT_TILE_FACTOR * -(-contact_pixel_count // TILE**2)
    tile_count = min(tile_count, np.diff(ends).min())
    best_tiles = [
        start + _lowest_columns(tiles.bounds[None, start:end], tile_count)[0]
        for start, end in pairwise(ends.tolist())
    ]
    gaps, _, _ = windows.tile_gaps(tiles.select(np.concatenate(best_tiles)))
    gaps = gaps.reshape(len(best_tiles), -1)
    if gaps.shape[1] < contact_pixel_count:
        return np.full(len(best_tiles), np.inf)
    return np.partition(gaps, contact_pixel_count - 1, axis=1)[:, contact_pixel_count - 1]


def _lowest_columns(bounds: Floats, count: int) -> NDArray[np.int_]:
    """Return the indices (row, count) of the lowest bounds (row, column)."""
    count = min(count, bounds.shape[1])
    return np.argpartition(bounds, count - 1, axis=1)[:, :count]


def _gaps_up_to(
    windows: _Windows, tiles: WindowTiles, limits: Floats
) -> tuple[NDArray[np.int_], Floats, NDArray[np.int_]]:
    """Return contact numbers, reference gaps and offsets (gap, 2) of all gaps up to the limits."""
    gaps, rows, columns = windows.tile_gaps(tiles)
    low_indices = np.flatnonzero(gaps <= limits[tiles.contact_numbers, None, None])
    tile, y, x = np.unravel_index(low_indices, gaps.shape)
    offsets = np.stack([rows[tile, y], columns[tile, x]], axis=1)
    return tiles.contact_numbers[tile], gaps.ravel()[low_indices], offsets


def _pixels_of_smallest_gaps(
    gaps: Floats, offsets: NDArray[np.int_], contact_pixel_count: int
) -> ContactPixels:
    """Return the pixels of the smallest gaps, ascending; equal gaps in the order of offsets."""
    if gaps.size > contact_pixel_count:
        # Few gaps are left to sort, with all that equal the largest one.
        is_low = gaps <= largest_contact_gap(gaps, contact_pixel_count)
        gaps, offsets = gaps[is_low], offsets[is_low]
    order = np.lexsort((offsets[:, 1], offsets[:, 0], gaps))[:contact_pixel_count]
    return ContactPixels(gaps[order], offsets[order])


def all_contact_pixels(bodies: Bodies, contact_pixel_count: int) -> ContactPixels:
    """Return the contact pixels (contact_y, contact_x, k) of every contact of the array."""
    substrate = cut_into_tiles(bodies.substrate)
    roughness_maxima = None
    if bodies.sphere_roughness is not None:
        # A tile of the substrate meets three tiles along an axis of the sphere, one of them cut.
        roughness_maxima = _maxima_of_squares(cut_into_tiles(bodies.sphere_roughness).maxima, 3)
    apexes = bodies.geometry.apexes()
    positions = apexes.reshape(-1, 2)
    pixels: list[ContactPixels] = []
    for start in range(0, len(positions), CONTACTS_AT_ONCE):
        batch = positions[start : start + CONTACTS_AT_ONCE]
        windows = _Windows(bodies, substrate, roughness_maxima, batch)
        pixels += _find_contact_pixels(windows, contact_pixel_count)
    gaps, offsets = (np.stack(arrays) for arrays in zip(*pixels, strict=True))
    shape = apexes.shape[:2]
    return ContactPixels(gaps.reshape(*shape, -1), offsets.reshape(*shape, -1, 2))
