"""The numbers of pixels that a study may have, and the memory of masters."""

import math

from hardcontact.contact.contact import Grid

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
#: Bytes per pixel of a master at the peak of its synthesis and of its filters: three maps in
#: float32, or the transform of one in single precision and two maps. 13.2 were measured at 8192²
#: without the writing of the file, which may hold one more map.
BYTES_A_PIXEL = 17.0
#: Megabytes of Python, its packages, the scan, and blocks of rows in double precision.
BASE_MEGABYTES = 500
#: Megabytes of a job on small masters, with those of Snakemake beside it.
MINIMUM_MEGABYTES = 3000


def random_surface_pixels(pixels: int) -> int:
    """Return the pixels per row of the random surface from which a substitute is cut."""
    return min(RANDOM_SURFACE_OVER_SCAN * pixels, MAX_MAP_PIXELS)


def same_grid(grid: Grid, reference: Grid) -> bool:
    """Return whether two grids have the same number and size of pixels."""
    same_size = math.isclose(reference.pixel_size, grid.pixel_size, rel_tol=1e-3)
    return grid.pixels == reference.pixels and same_size


def master_megabytes(pixels: int) -> int:
    """Return the memory (10^6 bytes) of a job that makes a master, or computes forces on it.

    It depends on the pixels per row of the master.
    """
    return max(MINIMUM_MEGABYTES, BASE_MEGABYTES + math.ceil(BYTES_A_PIXEL * pixels**2 / 1e6))
