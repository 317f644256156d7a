"""Limits of the range of adhesion, of the window and of the size of scans.

A sphere touches summits within the search size (`theory.summits`). The force on a smaller scan is
too large, because the sphere finds the same few summits everywhere.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import erf

from hardcontact.base.formatting import format_length, round_to_three_digits
from hardcontact.contact.contact import Contact

#: Largest |x| of exp(x), by precision: exp becomes infinite or loses digits beyond 87 and 708.
EXP_LIMITS = {np.float32: 80.0, np.float64: 700.0}
#: Largest difference in height relative to the range of adhesion, with a margin to EXP_LIMITS for
#: masters, which may be higher than their scan.
RELIEF_OVER_RANGE = 500.0
#: Largest depth of a contact below the highest point, relative to the range: terms that round to
#: zero are then less than exp(-40), 4e-18, of the term of a contact pixel.
DEPTH_OVER_RANGE = {precision: limit - 40 for precision, limit in EXP_LIMITS.items()}
#: Shortest range of adhesion (nm) on whole surfaces: it permits summits 490 nm above a contact.
SHORTEST_WHOLE_RANGE = 490 / EXP_LIMITS[np.float64]
#: A range of adhesion (nm) much shorter than the published 5.6 nm.
SHORT_ADHESION_RANGE = 1.0
#: Largest penetration, relative to the range of adhesion, that a study accepts.
PENETRATION_OVER_RANGE = 25.0
#: Upper limits of scan width / search size, with the lowest and highest mean force on a mirrored
#: scan relative to the 20 µm surface from which it was cut; larger scans had 0.95 to 1.14. Source:
#: trials like those of tests/contact/test_numerical_limits.py, on scans of 0.6 to 10 µm of ten
#: Gaussian surfaces: rms height 2 to 50 nm, roll-off 300 to 2000 nm, Hurst exponent 0.5 to 0.84, 24
#: realizations, R = 20 to 250 µm, rho = 2 and 5.6 nm.
FINITE_SCAN_RATIOS = (
    (0.125, (8.0, 17.0)), (0.25, (3.0, 9.0)), (0.5, (1.5, 3.6)),
    (1.0, (1.1, 2.0)), (2.0, (1.0, 1.5)),
)  # fmt: skip
#: Scan width / search size from which a scan is large enough, and the smallest tested.
LARGE_SIZE_RATIO, _ = FINITE_SCAN_RATIOS[-1]
SMALLEST_SIZE_RATIO = 0.12
#: Smallest share of the force on a smooth sphere in a window without a caution.
MIN_WINDOW_SHARE = 0.99


class Extent(NamedTuple):
    """Pixels, width and relief of one or all scans of a surface, not mirrored."""

    pixels: int  #: Per row.
    pixel_size: float  #: Width of a pixel in nm.
    size: float  #: Width of each scan in nm.
    relief: float  #: Highest minus lowest height in nm.


def minimum_range(radius: float, window: float, extent: Extent) -> tuple[float, str]:
    """Return the shortest range of adhesion (nm, three digits) that a surface permits, and why."""
    relief = extent.relief
    if window >= 2 * extent.size:
        # Along both axes the highest pixel is within `size` of every contact: the sphere is at most
        # size²/R high there.
        relief = min(relief, extent.size**2 / radius)
    two_pixels = "an interaction radius sqrt(D rho) of two pixels needs it at R = "
    shortest, reason = max(
        (relief / RELIEF_OVER_RANGE, f"contacts lie up to some {relief:.4g} nm apart in height"),
        (2 * extent.pixel_size**2 / radius, f"{two_pixels}{format_length(radius)}"),
    )
    return round_to_three_digits(shortest, math.ceil), reason


def periods_in_window(window: float, scan_size: float) -> float:
    """Return the periods of a mirrored scan, each two scans wide, in a window: at least one."""
    return max(1.0, window / (2 * scan_size)) ** 2


def penetration_depth(contact: Contact, relief: float) -> float:
    """Return an estimate of the penetration (nm) under the preload, at most the relief.

    On slopes near one, a contact is about as deep as it is wide.
    """
    return min(math.sqrt(contact.preload / contact.hardness) * 1e9, relief)


def finite_scan_ratio(scan_size: float, search_size: float) -> tuple[float, float]:
    """Return the smallest and largest mean force on a scan relative to a large one; sizes in nm.

    Below SMALLEST_SIZE_RATIO the ratios are those of the smallest tested scans.
    """
    for limit, ratios in FINITE_SCAN_RATIOS:
        if scan_size < limit * search_size:
            return ratios
    return 1.0, 1.0


def window_share(contact: Contact, rho: ArrayLike) -> NDArray[np.float64]:
    """Return the share (...) of a smooth sphere's attraction within its window, at ranges (...).

    The attraction is proportional to exp(-r²/(2 R rho)) at the distance r from the apex (Eq. 3).
    """
    return np.asarray(erf(contact.window / np.sqrt(8 * contact.radius * np.asarray(rho))) ** 2)
