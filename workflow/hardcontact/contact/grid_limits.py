"""Limits of contacts that follow from the grid of scans: range of adhesion, window, penetration."""

import math
from typing import NamedTuple

from hardcontact.base.formatting import format_length, round_with
from hardcontact.contact.contact import Contact

#: Largest difference in height relative to the range of adhesion: exponentials overflow beyond 700.
RELIEF_OVER_RANGE = 500.0
#: Largest penetration relative to the range of adhesion, for a smooth sphere: its force sums lose
#: as many digits as the exponential of this has.
PENETRATION_OVER_RANGE = 25.0


class Grid(NamedTuple):
    """The grid of all scans of a surface: pixels per row, and lengths in nm.

    These are the widths of a pixel and of the scan, and the relief: highest minus lowest height.
    """

    pixels: int
    pixel_size: float
    size: float
    relief: float


def minimum_range(radius: float, window: float, grid: Grid) -> tuple[float, str]:
    """Return the shortest range of adhesion (nm, three digits) that a surface permits, and why.

    radius and window in nm; `grid` describes the surface before mirroring, which doubles its size.
    """
    relief = grid.relief
    if window >= 2 * grid.size:
        # The highest pixel is within half a period of every contact; the sphere curves above it.
        relief = min(relief, grid.size**2 / radius)
    reasons = {
        relief / RELIEF_OVER_RANGE: f"contacts lie up to some {relief:.4g} nm apart in height",
        2 * grid.pixel_size**2 / radius: "an interaction radius sqrt(D rho) of two pixels needs it "
        f"at R = {format_length(radius)}",
    }
    shortest = max(reasons)
    return round_with(math.ceil, shortest), reasons[shortest]


def periods_in_window(window: float, scan_size: float) -> float:
    """Return the number of periods of a mirrored scan within a window.

    The widths of the window and of the scan before mirroring are in nm.
    """
    return max(1.0, window / (2 * scan_size)) ** 2


def penetration_depth(contact: Contact, relief: float) -> float:
    """Return an estimate of the penetration (nm) of the bodies under a load.

    It is the width of the contact area: on slopes near one, a contact is about as deep as it is
    wide. It is at most the relief, the highest minus the lowest height (nm).
    """
    return min(math.sqrt(contact.preload / contact.hardness) * 1e9, relief)
