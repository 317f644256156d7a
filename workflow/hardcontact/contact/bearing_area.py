"""The contact pixels of rigid and plastic (bearing area) contact: the N smallest reference gaps.

A reference gap is the gap if the apex of the sphere is at the height 0 (`geometry`). The map is cut
into square cells, and has square groups of cells. No gap in a cell is smaller than its bound: the
lowest height of the sphere above the cell, less the highest point of the cell. Groups have bounds,
too. If N gaps up to a limit are known, no gap in contact is larger than the limit, so cells with a
higher bound need not be read. For each contact,

1. the groups of lowest bounds are taken, as few as have N pixels;
2. of their cells, a few of lowest bounds are read. The N-th smallest of these gaps is the first
   limit;
3. all cells are listed whose bound, and whose group's bound, is at most the first limit;
4. of these, a few of lowest bounds are read. If the N-th smallest of these gaps is lower than the
   first limit, it is the second limit, else both are equal;
5. all listed cells whose bound is at most the second limit are read, in batches. The N smallest of
   their gaps are those of the contact.

For 1074 contact pixels on a self-affine map of 8192 x 8192 pixels, for example, steps 2, 4 and 5
read 4, 4 and about 8 of 65 536 cells.
"""

from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hardcontact.base.arrays import Floats
from hardcontact.contact.geometry import Bodies
from hardcontact.surfaces.height_map import HeightMap

#: Pixels per row of a cell. This number and the next four change only the speed.
CELL_PIXELS = 32
#: Cells per row of a group.
GROUP_CELLS = 16
#: Cells that are read at once.
CELLS_AT_ONCE = 256
#: Contacts that are searched at once.
CONTACTS_AT_ONCE = 50
#: Cells that are read for a limit, relative to the fewest that have N pixels. Fewer cells could lie
#: on one slope, and their limit would be high.
LIMIT_CELL_FACTOR = 2


@dataclass(frozen=True, eq=False)
class Cells:
    """A periodic map (n, n) of heights in nm, cut into cells."""

    pixels: int  #: The period n.
    #: (cells, CELL_PIXELS, cells, CELL_PIXELS), padded with minus infinity.
    heights: NDArray[np.floating]
    maxima: NDArray[np.floating]  #: (cells, cells), the highest point of each cell.
    #: (cells, cells), the highest point of the group of cells that begins at each cell.
    group_maxima: NDArray[np.floating]

    def cells_in_window(
        self, positions: NDArray[np.int_], window_pixels: int
    ) -> tuple[NDArray[np.int_], NDArray[np.int_], NDArray[np.bool_]]:
        """Return, along one axis, the cells that meet the windows about positions (...), in pixels.

        Returns three arrays (..., k), padded to the largest number k of cells in a window: the
        offset of a cell's corner from the position, its index, and whether it meets the window.
        """
        count = self.maxima.shape[0]
        start = positions - window_pixels // 2
        first_cell = self._cell_number(start)
        last_cell = self._cell_number(start + window_pixels - 1)
        numbers = first_cell[..., None] + np.arange((last_cell - first_cell).max() + 1)
        index = numbers % count
        offset = numbers // count * self.pixels + index * CELL_PIXELS - positions[..., None]
        return offset, index, numbers <= last_cell[..., None]

    def _cell_number(self, pixel: NDArray[np.int_]) -> NDArray[np.int_]:
        """Return the cell number of a pixel along either axis; numbers go on over periods."""
        period, pixel_in_period = np.divmod(pixel, self.pixels)
        return np.asarray(period * len(self.maxima) + pixel_in_period // CELL_PIXELS)


def _maxima_of_squares(maxima: NDArray[np.floating], count: int) -> NDArray[np.floating]:
    """Return the maxima (cells, cells) of the count x count cells from each cell on, periodic."""
    rows = np.maximum.reduce([np.roll(maxima, -i, axis=0) for i in range(count)])
    return np.asarray(np.maximum.reduce([np.roll(rows, -i, axis=1) for i in range(count)]))


def cut_into_cells(height_map: HeightMap) -> Cells:
    """Cut a square periodic map into cells."""
    heights = height_map.heights
    count = -(-height_map.pixels // CELL_PIXELS)
    extra = count * CELL_PIXELS - height_map.pixels
    if extra:
        heights = np.pad(heights, ((0, extra), (0, extra)), constant_values=-np.inf)
    heights = heights.reshape(count, CELL_PIXELS, count, CELL_PIXELS)
    maxima = heights.max(axis=1).max(axis=2)
    return Cells(height_map.pixels, heights, maxima, _maxima_of_squares(maxima, GROUP_CELLS))


class ContactPixels(NamedTuple):
    """The contact pixels of contacts (...): k of each."""

    #: (..., k) nm, ascending. At rigid closest approach the apex is at minus the first gap, at
    #: plastic closest approach at minus the last gap.
    reference_gaps: Floats
    offsets: NDArray[np.int_]  #: (..., k, 2) pixels from the apex: row, column.


class WindowCells(NamedTuple):
    """Cells in the windows of contacts, ordered by contact."""

    contact_numbers: NDArray[np.int_]  #: (k,) index of the contact of each cell.
    cell_row: NDArray[np.int_]  #: (k,) row of cells within the window.
    cell_column: NDArray[np.int_]  #: (k,) column of cells within the window.
    bounds: Floats  #: (k,) lower bound in nm on the reference gaps of the cell.

    def select(self, index: slice | NDArray[np.int_] | NDArray[np.bool_]) -> "WindowCells":
        """Return the cells at an index."""
        number, cell_row, cell_column, bounds = self
        return WindowCells(number[index], cell_row[index], cell_column[index], bounds[index])

    def cells_within(self, gap_limits: Floats) -> "WindowCells":
        """Return the cells whose bounds are at most the limits (contact,) in nm."""
        return self.select(self.bounds <= gap_limits[self.contact_numbers])


class _Windows:
    """The cells of the substrate in the windows of contacts, with lower bounds (nm) on their gaps.

    `roughness_maxima` is by cell of the sphere: the highest roughness on the 3 x 3 cells that begin
    there, which are all that a cell of the substrate may meet; None for a smooth sphere. Bounds
    outside the window are infinite.
    """

    def __init__(
        self,
        bodies: Bodies,
        substrate_cells: Cells,
        roughness_maxima: NDArray[np.floating] | None,
        apexes: NDArray[np.int_],
    ) -> None:
        self.substrate_cells = substrate_cells
        self.sphere_roughness = bodies.sphere_roughness
        self.roughness_maxima = roughness_maxima
        self.geometry = geometry = bodies.geometry
        offset, index, is_met = substrate_cells.cells_in_window(apexes, geometry.window_pixels)
        nearest_offset = np.maximum(np.maximum(offset, -(offset + CELL_PIXELS - 1)), 0)
        sphere_minima = np.where(is_met, geometry.paraboloid(nearest_offset), np.inf)
        padding = ((0, 0), (0, 0), (0, -sphere_minima.shape[-1] % GROUP_CELLS))
        # Arrays (contact, axis, cell), padded to whole groups by cells outside the window.
        self.offset = np.pad(offset, padding, constant_values=geometry.window_pixels)
        self.index = np.pad(index, padding)
        self.sphere_minima = np.pad(sphere_minima, padding, constant_values=np.inf)

    def group_bounds(self) -> Floats:
        """Return the bounds (contact, group), groups numbered by rows within the window."""
        contact_count, axis_count, _ = self.sphere_minima.shape
        minima = self.sphere_minima.reshape(contact_count, axis_count, -1, GROUP_CELLS).min(axis=-1)
        groups = self.index[:, :, ::GROUP_CELLS]
        bounds = minima[:, 0, :, None] + minima[:, 1, None, :]
        bounds -= self.substrate_cells.group_maxima[groups[:, 0, :, None], groups[:, 1, None, :]]
        if self.roughness_maxima is not None:
            bounds -= self.roughness_maxima.max()
        return np.asarray(bounds.reshape(contact_count, -1))

    def cells_of_groups(
        self, contact_numbers: NDArray[np.int_], groups: NDArray[np.int_]
    ) -> WindowCells:
        """Return the cells of groups, given by the numbers (k,) of contact and group."""
        group_row, group_column = np.divmod(groups, self.sphere_minima.shape[-1] // GROUP_CELLS)
        cell_row = (group_row[:, None] * GROUP_CELLS + np.arange(GROUP_CELLS))[:, :, None]
        cell_column = (group_column[:, None] * GROUP_CELLS + np.arange(GROUP_CELLS))[:, None, :]
        number = contact_numbers[:, None, None]
        along_y, along_x = (number, 0, cell_row), (number, 1, cell_column)
        bounds = self.sphere_minima[along_y] + self.sphere_minima[along_x]
        bounds -= self.substrate_cells.maxima[self.index[along_y], self.index[along_x]]
        if self.sphere_roughness is not None and self.roughness_maxima is not None:
            sphere_cells = self.offset % self.sphere_roughness.pixels // CELL_PIXELS
            bounds -= self.roughness_maxima[sphere_cells[along_y], sphere_cells[along_x]]
        number, cell_row, cell_column = np.broadcast_arrays(number, cell_row, cell_column)
        return WindowCells(number.ravel(), cell_row.ravel(), cell_column.ravel(), bounds.ravel())

    def cell_gaps(self, cells: WindowCells) -> tuple[Floats, NDArray[np.int_], NDArray[np.int_]]:
        """Return the reference gaps (k, y, x) of cells (k,), infinite outside the window.

        Also returns the offsets of their rows (k, y) and columns (k, x) from the apex.
        """
        number, cell_row, cell_column, _ = cells
        y = self.offset[number, 0, cell_row][:, None] + np.arange(CELL_PIXELS)
        x = self.offset[number, 1, cell_column][:, None] + np.arange(CELL_PIXELS)
        cell_y, cell_x = self.index[number, 0, cell_row], self.index[number, 1, cell_column]
        gaps: Floats = self._sphere_in_window(y)[:, :, None] + self._sphere_in_window(x)[:, None, :]
        gaps -= self.substrate_cells.heights[cell_y, :, cell_x, :]
        if self.sphere_roughness is not None:
            period = self.sphere_roughness.pixels
            gaps -= self.sphere_roughness.heights[y[:, :, None] % period, x[:, None, :] % period]
        return gaps, y, x

    def _sphere_in_window(self, offset: NDArray[np.int_]) -> Floats:
        """Return the height (nm) of the smooth sphere along one axis, infinite outside windows."""
        geometry = self.geometry
        return np.where(geometry.window_mask(offset), geometry.paraboloid(offset), np.inf)


def _find_contact_pixels(windows: _Windows, contact_pixel_count: int) -> list[ContactPixels]:
    """Return the contact pixels of each contact; equal gaps come in the order of their offsets.

    The numbered steps are those of the module's docstring.
    """
    # 1. The groups of lowest bounds together have enough pixels.
    group_bounds = windows.group_bounds()
    cell_count = -(-contact_pixel_count // CELL_PIXELS**2)
    best_groups = _lowest_bounds(group_bounds, -(-cell_count // GROUP_CELLS**2))
    group_contacts = np.repeat(np.arange(len(best_groups)), best_groups.shape[1])
    cells_of_best_groups = windows.cells_of_groups(group_contacts, best_groups.ravel())
    # 2. Of their cells, those of lowest bounds give the first limits.
    first_limits = _limits_of_gaps(windows, cells_of_best_groups, contact_pixel_count)
    # 3. All groups up to the first limits are listed, and of these all such cells.
    listed_groups = np.nonzero(group_bounds <= first_limits[:, None])
    listed_cells = windows.cells_of_groups(*listed_groups).cells_within(first_limits)
    # 4. The listed cells of lowest bounds give the second limits.
    second_limits = _limits_of_gaps(windows, listed_cells, contact_pixel_count)
    second_limits = np.minimum(first_limits, second_limits)
    # 5. The listed cells up to the second limits are read in batches.
    cells = listed_cells.cells_within(second_limits)
    gaps_of_batches = [
        _gaps_up_to(windows, cells.select(slice(start, start + CELLS_AT_ONCE)), second_limits)
        for start in range(0, len(cells.contact_numbers), CELLS_AT_ONCE)
    ]
    contact_numbers, gaps, offsets = (
        np.concatenate(arrays) for arrays in zip(*gaps_of_batches, strict=True)
    )
    ends = np.searchsorted(contact_numbers, np.arange(1, len(second_limits)))
    contact_pixels = []
    for low_gaps, low_offsets in zip(np.split(gaps, ends), np.split(offsets, ends), strict=True):
        order = np.lexsort((low_offsets[:, 1], low_offsets[:, 0], low_gaps))[:contact_pixel_count]
        contact_pixels.append(ContactPixels(low_gaps[order], low_offsets[order]))
    return contact_pixels


def _limits_of_gaps(windows: _Windows, cells: WindowCells, contact_pixel_count: int) -> Floats:
    """Return the N-th smallest gap (contact,) in the cells of lowest bounds, infinity if too few.

    The cells are ordered by contact; each contact has at least one.
    """
    ends = np.searchsorted(cells.contact_numbers, np.arange(cells.contact_numbers[-1] + 2))
    cell_count = LIMIT_CELL_FACTOR * -(-contact_pixel_count // CELL_PIXELS**2)
    cell_count = min(cell_count, np.diff(ends).min())
    best_cells = [
        start + _lowest_bounds(cells.bounds[None, start:end], cell_count)[0]
        for start, end in pairwise(ends.tolist())
    ]
    gaps, _, _ = windows.cell_gaps(cells.select(np.concatenate(best_cells)))
    gaps = gaps.reshape(len(best_cells), -1)
    if gaps.shape[1] < contact_pixel_count:
        return np.full(len(best_cells), np.inf)
    return np.partition(gaps, contact_pixel_count - 1, axis=1)[:, contact_pixel_count - 1]


def _lowest_bounds(bounds: Floats, count: int) -> NDArray[np.int_]:
    """Return the indices (contact, count or all) of the lowest of bounds (contact, k)."""
    count = min(count, bounds.shape[1])
    return np.argpartition(bounds, count - 1, axis=1)[:, :count]


def _gaps_up_to(
    windows: _Windows, cells: WindowCells, gap_limits: Floats
) -> tuple[NDArray[np.int_], Floats, NDArray[np.int_]]:
    """Return contact numbers, reference gaps and offsets (gap, 2) up to the limits (contact,)."""
    gaps, rows, columns = windows.cell_gaps(cells)
    low_indices = np.flatnonzero(gaps <= gap_limits[cells.contact_numbers, None, None])
    cell, y, x = np.unravel_index(low_indices, gaps.shape)
    offsets = np.stack([rows[cell, y], columns[cell, x]], axis=1)
    return cells.contact_numbers[cell], gaps.ravel()[low_indices], offsets


def all_contact_pixels(bodies: Bodies, contact_pixel_count: int) -> ContactPixels:
    """Return the contact pixels (contact_y, contact_x, k) of every contact of the array."""
    substrate_cells = cut_into_cells(bodies.substrate)
    roughness_maxima = None
    if bodies.sphere_roughness is not None:
        # Per axis, a cell meets up to three of the sphere, because the last may be narrower.
        roughness_maxima = _maxima_of_squares(cut_into_cells(bodies.sphere_roughness).maxima, 3)
    apexes = bodies.geometry.apexes()
    flat_apexes = apexes.reshape(-1, 2)
    contact_pixels: list[ContactPixels] = []
    for start in range(0, len(flat_apexes), CONTACTS_AT_ONCE):
        batch = flat_apexes[start : start + CONTACTS_AT_ONCE]
        windows = _Windows(bodies, substrate_cells, roughness_maxima, batch)
        contact_pixels += _find_contact_pixels(windows, contact_pixel_count)
    gaps, offsets = (np.stack(arrays) for arrays in zip(*contact_pixels, strict=True))
    shape = apexes.shape[:2]
    return ContactPixels(gaps.reshape(*shape, -1), offsets.reshape(*shape, -1, 2))
