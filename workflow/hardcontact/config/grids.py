"""The pixels of scans, the limits that follow from them, and the memory of masters."""

import math
from typing import NamedTuple

from hardcontact.base.formatting import format_length, round_with
from hardcontact.contact.contact import Contact

#: Pixel sizes in nm at which spectra are known: tables and bins end at 0.1 nm and 100 um.
PIXEL_SIZES = (0.05, 1e4)
#: Largest number of pixels per row of a map: arrays of more than 2 GiB are not validated.
MAX_MAP_PIXELS = 16384
#: Width of the periodic random surface from which a substitute is cut, in widths of the substitute.
#: A real scan has waves longer than itself and does not continue at its borders; a larger surface
#: would imitate this better, but takes more memory.
RANDOM_SURFACE_OVER_SCAN = 4
#: Contact pixels of all contacts on a scan, with their images in the window: all are kept in memory
#: at once, in some 24 bytes each, 1.6 GB together.
MAX_CONTACT_PIXELS = 2**26
#: Largest difference in height relative to the range of adhesion: exponentials overflow beyond 700.
RELIEF_OVER_RANGE = 500.0
#: Largest penetration relative to the range of adhesion, for a smooth sphere: its force sums lose
#: as many digits as the exponential of this has.
PENETRATION_OVER_RANGE = 25.0
#: Bytes per pixel of a master at the peak of its synthesis and of its filters: three maps in
#: float32, or the transform of one in single precision and two maps. 13.2 were measured at 8192²
#: without the writing of the file, which may hold one more map.
BYTES_A_PIXEL = 17.0
#: Megabytes of Python, its packages, the scan, and blocks of rows in double precision.
BASE_MEGABYTES = 500
#: Megabytes of a job on small masters, with those of Snakemake beside it.
MINIMUM_MEGABYTES = 3000


class Grid(NamedTuple):
    """The grid of all scans of a surface: pixels per row, and lengths in nm.

    These are the widths of a pixel and of the scan, and the relief: highest minus lowest height.
    """

    pixels: int
    pixel_size: float
    size: float
    relief: float


def random_surface_pixels(pixels: int) -> int:
    """Return the pixels per row of the random surface from which a substitute is cut."""
    return min(RANDOM_SURFACE_OVER_SCAN * pixels, MAX_MAP_PIXELS)


def same_grid(grid: Grid, reference: Grid) -> bool:
    """Return whether two grids have the same number and size of pixels."""
    same_size = math.isclose(reference.pixel_size, grid.pixel_size, rel_tol=1e-3)
    return grid.pixels == reference.pixels and same_size


def minimum_range(radius: float, window: float, grid: Grid) -> tuple[float, str]:
    """Return the shortest range of adhesion (nm, three digits) that a surface permits, and why.

    radius and window in nm; `grid` describes the surface before stitching, which doubles its size.
    """
    relief = grid.relief
    if window >= 2 * grid.size:
        # The highest pixel is within half a period of every contact; the sphere curves above it.
        relief = min(relief, grid.size**2 / radius)
    shortest = relief / RELIEF_OVER_RANGE
    reason = f"contacts lie up to some {relief:.4g} nm apart in height"
    two_pixels = 2 * grid.pixel_size**2 / radius
    if two_pixels > shortest:
        shortest = two_pixels
        reason = (
            "an interaction radius sqrt(D rho) of two pixels needs it at R = "
            f"{format_length(radius)}"
        )
    return round_with(math.ceil, shortest), reason


def master_megabytes(pixels: int) -> int:
    """Return the memory (10^6 bytes) of a job that makes a master, or filters and presses it.

    It depends on the pixels per row of the master.
    """
    return max(MINIMUM_MEGABYTES, BASE_MEGABYTES + math.ceil(BYTES_A_PIXEL * pixels**2 / 1e6))


def periods_in_window(window: float, scan_size: float) -> float:
    """Return the number of periods of a stitched scan within a window.

    The widths of the window and of the scan before stitching are in nm.
    """
    return max(1.0, window / (2 * scan_size)) ** 2


def penetration_depth(contact: Contact, relief: float) -> float:
    """Return an estimate of the penetration (nm) of the bodies under a load.

    It is the width of the contact area: on slopes near one, a contact is about as deep as it is
    wide. It is at most the relief, the highest minus the lowest height (nm).
    """
    return min(math.sqrt(contact.preload / contact.hardness) * 1e9, relief)
