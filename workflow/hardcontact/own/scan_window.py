"""The window of contacts on the user's scans."""

import math

from hardcontact.base.formatting import round_with
from hardcontact.config.grids import MAX_MAP_PIXELS

#: Height of the sphere above its apex at the border of the window, relative to the range of
#: adhesion (14 in the paper) and to the rms height.
RANGES_IN_WINDOW = 14
RMS_IN_WINDOW = 4
#: Largest number of mirrored scans per row of the window: more only repeat the same summits.
MAX_IMAGES = 10


def window_on_scans(
    rms_height: float, min_pixel_size: float, min_scan_size: float, radius: float, rho: float
) -> tuple[float, str]:
    """Return the width of a window (nm), and the reason.

    All lengths are in nm: the largest rms height, the finest pixels and the smallest size of the
    scans, the radius of the sphere and the range of adhesion.
    """
    height = RANGES_IN_WINDOW * rho
    height_words = f"{RANGES_IN_WINDOW} ranges of adhesion"
    if RMS_IN_WINDOW * rms_height > height:
        height = RMS_IN_WINDOW * rms_height
        height_words = f"{RMS_IN_WINDOW} rms heights"
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
            2 * MAX_IMAGES * min_scan_size,
            f"{MAX_IMAGES} mirrored scans, which all have the same summits",
        ),
    )
    return round_with(math.floor, window), reason
