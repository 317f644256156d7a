"""The window around each contact on the user's scans, within which the force is summed."""

import math

from hardcontact.base.formatting import round_with
from hardcontact.config.limits import MAX_MAP_PIXELS

#: Height of the sphere above its apex at the border of the window, relative to the range of
#: adhesion (14 in the paper, where the attraction has fallen by exp(-14)) and to the rms height.
BORDER_HEIGHT_IN_RANGES = 14
BORDER_HEIGHT_IN_RMS = 4
#: Largest number of mirrored scans per row of the window: more only repeat the same summits.
MAX_MIRRORED_SCANS = 10


def window_on_scans(
    rms_height: float, min_pixel_size: float, min_scan_size: float, radius: float, rho: float
) -> tuple[float, str]:
    """Return the width of a window (nm), and the reason.

    All lengths are in nm: the largest rms height, the finest pixels and the smallest size of the
    scans, the radius of the sphere and the range of adhesion.
    """
    height = BORDER_HEIGHT_IN_RANGES * rho
    height_words = f"{BORDER_HEIGHT_IN_RANGES} ranges of adhesion"
    if BORDER_HEIGHT_IN_RMS * rms_height > height:
        height = BORDER_HEIGHT_IN_RMS * rms_height
        height_words = f"{BORDER_HEIGHT_IN_RMS} rms heights"
    window, reason = min(
        (
            2 * math.sqrt(2 * radius * height),
            f"at its border the sphere is {height_words} above its apex",
        ),
        (
            MAX_MAP_PIXELS * min_pixel_size,
            f"{MAX_MAP_PIXELS} pixels of the scans, the most that are computed",
        ),
        (
            2 * MAX_MIRRORED_SCANS * min_scan_size,
            f"{MAX_MIRRORED_SCANS} mirrored scans, which all have the same summits",
        ),
    )
    return round_with(math.floor, window), reason
