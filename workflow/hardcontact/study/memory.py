"""Memory that a master takes, and that the machine has."""

import math
import os

__all__ = ["machine_megabytes", "master_megabytes"]

#: Bytes a pixel of a master at the peak of its synthesis and of its filters: three maps in float32,
#: or the transform of one in single precision and two maps. 13.2 were measured at 8192²
#: without the writing of the file, which may hold one more map.
BYTES_A_PIXEL = 17.0
#: Megabytes besides: Python, its packages, the scan, blocks of rows in double precision.
BESIDES = 500


def master_megabytes(pixels: int, least: int) -> int:
    """Return what a job needs that makes a master, or filters it and presses a smooth sphere on it.

    Parameters
    ----------
    pixels : int
        Along an edge.
    least : int
        Megabytes that the job is given for any smaller master.

    Returns
    -------
    int
        In units of 10^6 bytes.
    """
    return max(least, BESIDES + math.ceil(BYTES_A_PIXEL * pixels**2 / 1e6))


def machine_megabytes() -> int:
    """Return the memory of this machine in units of 10^6 bytes."""
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") // 10**6
