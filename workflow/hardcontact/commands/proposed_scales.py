"""Pixels, cutoffs and numbers of contacts and masters for scans of any size."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from hardcontact.config.grids import CONTACT_PIXELS, Grid
from hardcontact.contact.bearing_area import TILE, Load, contact_pixel_count
from hardcontact.contact.geometry import window_pixels

#: The finest pixels worth computing, in nm: half the distance of atoms.
FINEST = 0.15
#: Edge of the large-scale master over that of a scan, and over the window.
SCANS, WINDOWS = 8, 1.6
#: Numbers of contacts along an edge of the array. Even ones fall evenly on the quarters of a scan.
COUNTS = (20, 16, 12, 10, 8, 6, 4)
#: Seconds that the contacts of one filtered surface may take.
CONTACT_SECONDS = 2.0
#: Seconds a contact pixel and image of the cell in the window, and a tile in the window (measured).
SECONDS_A_PIXEL, SECONDS_A_TILE = 4e-7, 4e-8
#: The least ratio of neighbouring cutoffs: forces in between are as good interpolated.
RATIO = 1.15


class Effort(NamedTuple):
    """What a study may cost.

    Pixels along an edge of masters, if scans do not have more; cutoffs on each side; masters of
    each side, and those of contacts that take long; contacts along an edge of the array; ranges of
    adhesion.
    """

    pixels: int
    cutoffs: int
    realizations: int
    fewest: int
    contacts: int
    ranges: int


#: Ten minutes on two cores, for one scan of 512 x 512 pixels; and two.
FULL = Effort(pixels=4096, cutoffs=14, realizations=5, fewest=3, contacts=20, ranges=12)
QUICK = Effort(pixels=2048, cutoffs=5, realizations=2, fewest=2, contacts=8, ranges=5)


class Setting(NamedTuple):
    """What masters are made for: the grids of substrates, the most scans of one surface, the load.

    Radius of the sphere, range of adhesion and edge of the window are in nm.
    """

    grids: Sequence[Grid]
    scans: int
    load: Load
    radius: float
    rho: float
    window: float


class Scales(NamedTuple):
    """What is computed: contacts along an edge, masters of a side, their pixels, cutoffs in nm."""

    contacts: int
    realizations: int
    small_pixels: int
    large_pixels: int
    tiles: int
    small_cutoffs: list[float]
    large_cutoffs: list[float]


def proposed_scales(setting: Setting, effort: Effort) -> Scales:
    """Return what is computed of masters at some effort, within what the checks permit."""
    grids = setting.grids
    small_pixels = max(_small_pixels(setting, grid, effort.pixels) for grid in grids)
    tiles = proposed_tiles(grids, setting.window, effort.pixels)
    seconds = max(
        _contact_seconds(setting, grid, pixel_size)
        for grid in grids
        for pixel_size in (grid.pixel_size, 2 * grid.size / small_pixels)
    )
    count = _count(setting, small_pixels, seconds, effort.contacts)
    slow = count**2 * seconds > CONTACT_SECONDS
    masters = effort.fewest if slow else effort.realizations
    realizations = setting.scans * max(1, round(masters / setting.scans))
    finest = max(2 * grid.size / small_pixels for grid in grids)
    coarsest = max(grid.pixel_size for grid in grids)
    least_size = min(grid.size for grid in grids)
    shortest = min(least_size / 25, math.sqrt(2 * setting.radius * setting.rho) / 16)
    return Scales(
        count,
        max(masters, min(setting.scans, 3))
        if effort is QUICK
        else min(realizations, 2 * effort.realizations),
        small_pixels,
        max(2 * grid.pixels for grid in grids) * tiles,
        tiles,
        _cutoffs(4 * finest, least_size, effort.cutoffs),
        _cutoffs(max(4 * coarsest, shortest), least_size * tiles, effort.cutoffs),
    )


def proposed_tiles(grids: Sequence[Grid], window: float, pixels: int) -> int:
    """Return the stitched scans along an edge of large-scale masters of so many pixels.

    The master is eight scans long, as in the paper, and longer than the window (nm), if its pixels
    suffice.
    """
    size = min(grid.size for grid in grids)
    wanted = math.ceil(max(SCANS * size, WINDOWS * window) / (2 * size) * (1 - 1e-9))
    return max(1, min(wanted, pixels // max(2 * grid.pixels for grid in grids)))


def _small_pixels(setting: Setting, grid: Grid, most: int) -> int:
    """Return the pixels of small-scale masters of one grid: stitched scans, halved repeatedly."""
    pixels = 2 * grid.pixels
    while 2 * pixels <= most:
        pixel_size = grid.size / pixels
        slow = COUNTS[-1] ** 2 * _contact_seconds(setting, grid, pixel_size) > CONTACT_SECONDS
        if pixel_size < FINEST or slow:
            break
        pixels *= 2
    return pixels


def _contact_seconds(setting: Setting, grid: Grid, pixel_size: float) -> float:
    """Return about how long one contact takes on pixels of a size (nm), in s.

    Every image of a high place in the window is looked at for contact pixels.
    """
    images = max(1.0, setting.window / (2 * grid.size)) ** 2
    contact_pixels = contact_pixel_count(setting.load, pixel_size)
    tiles = (window_pixels(setting.window, pixel_size) / TILE) ** 2
    return contact_pixels * images * SECONDS_A_PIXEL + tiles * SECONDS_A_TILE


def _count(setting: Setting, small_pixels: int, seconds: float, most: int) -> int:
    """Return the contacts along an edge: as many as time and memory permit, or the fewest."""

    def kept(grid: Grid) -> float:
        """Pixels that are kept in memory a contact, on scans and on masters."""
        images = max(1.0, setting.window / (2 * grid.size)) ** 2
        on_scan = contact_pixel_count(setting.load, grid.pixel_size) * images
        return max(on_scan, contact_pixel_count(setting.load, 2 * grid.size / small_pixels))

    pixels = max(map(kept, setting.grids))
    for count in COUNTS:
        fits = count**2 * pixels <= CONTACT_PIXELS and count**2 * seconds <= CONTACT_SECONDS
        if count <= most and fits:
            return count
    return COUNTS[-1]


def _cutoffs(shortest: float, longest: float, most: int) -> list[float]:
    """Return wavelengths (nm) of three digits, evenly spaced in their logarithm."""
    steps = int(math.log(longest / shortest) / math.log(RATIO))
    wavelengths = np.geomspace(shortest, longest, min(most, max(steps, 1) + 1))
    return [float(f"{wavelength:.3g}") for wavelength in wavelengths]
