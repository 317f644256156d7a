"""How short a range of adhesion, how narrow a window and how small a scan a force permits.

A sphere finds the summits that it touches within the search size (`theory.summits`). A smaller
scan, mirrored, shows the same summits everywhere, and the force on it is too large.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hardcontact.base.formatting import format_length, round_with
from hardcontact.contact.contact import Contact

#: Largest |x| of exp(x), by precision. It becomes infinite or loses digits beyond 87 and 708.
EXP_LIMITS = {np.float32: 80.0, np.float64: 700.0}
#: Largest difference in height relative to the range of adhesion, on the scan for which it is
#: checked. The margin to EXP_LIMITS is for other scans and for masters, which may be higher.
RELIEF_OVER_RANGE = 500.0
#: Largest depth of a contact below the highest point of the surface, relative to the range. A term
#: that rounds to zero is then less than exp(-40), 4e-18, of the term of a contact pixel.
DEPTH_OVER_RANGE = {precision: limit - 40 for precision, limit in EXP_LIMITS.items()}
#: Shortest range of adhesion (nm) on whole surfaces: it permits peaks 490 nm above a contact.
SHORTEST_WHOLE_RANGE = 490 / EXP_LIMITS[np.float64]
#: A range of adhesion (nm) that is much shorter than the published range.
SHORT_ADHESION_RANGE = 1.0
#: Largest penetration relative to the range of adhesion, for a smooth sphere: its force sums lose
#: 11 of 16 digits, because exp(25) is 7e10.
PENETRATION_OVER_RANGE = 25.0
#: Lowest and highest mean force on a mirrored scan, relative to the 20 µm surface it was cut from.
#: Before both: upper limit of scan width / search size. On larger scans the force was 0.95 to 1.14.
#: Source: scans of 0.6 to 10 µm on 24 realizations each of ten Gaussian surfaces (rms height 2 to
#: 50 nm, roll-off 300 to 2000 nm, H = 0.5 to 0.84); R = 20 to 250 µm, rho = 2 and 5.6 nm. Each
#: ratio is known to 1 to 10 %.
FINITE_SCAN_RATIOS = (
    (0.125, (8.0, 17.0)), (0.25, (3.0, 9.0)), (0.5, (1.5, 3.6)),
    (1.0, (1.1, 2.0)), (2.0, (1.0, 1.5)),
)  # fmt: skip
#: Size relative to the search size from which a scan is large enough, and the smallest tested one.
LARGE_SIZE_RATIO = FINITE_SCAN_RATIOS[-1][0]
SMALLEST_SIZE_RATIO = 0.12
#: Smallest share of the force on a smooth sphere in a window without a caution.
MIN_WINDOW_SHARE = 0.99


class Grid(NamedTuple):
    """The grid of all scans of a surface, before mirroring doubles its size."""

    pixels: int  #: Per row.
    pixel_size: float  #: Width of a pixel in nm.
    size: float  #: Width of the scans in nm.
    relief: float  #: Highest minus lowest height in nm.


def minimum_range(radius: float, window: float, grid: Grid) -> tuple[float, str]:
    """Return the shortest range of adhesion (nm, three digits) that a surface permits, and why.

    The radius of the sphere and the width of the window are in nm.
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
    wide. It is at most the relief (nm).
    """
    return min(math.sqrt(contact.preload / contact.hardness) * 1e9, relief)


def finite_scan_ratio(size: float, search_size: float) -> tuple[float, float]:
    """Return the smallest and largest force on a scan relative to the force on a large scan.

    The sizes (nm) are the width of the scan and the search size.
    """
    candidates = (ratios for limit, ratios in FINITE_SCAN_RATIOS if size < limit * search_size)
    return next(candidates, (1.0, 1.0))


def window_share(contact: Contact, rho: ArrayLike) -> NDArray[np.float64]:
    """Return the share of the attraction of a smooth sphere within the window, at ranges (nm).

    The attraction is proportional to exp(-r²/(2 R rho)) at the distance r from its apex (Eq. 3 of
    the paper). A square window of width L therefore holds the share erf(L/sqrt(8 R rho))² of it.
    """
    from scipy.special import erf

    return np.asarray(erf(contact.window / np.sqrt(8 * contact.radius * np.asarray(rho))) ** 2)
