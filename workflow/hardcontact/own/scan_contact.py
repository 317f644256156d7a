"""Windows of contacts on your scans, and whether forces can be summed quickly."""

import math
from collections.abc import Sequence
from dataclasses import replace
from enum import StrEnum

import numpy as np

from hardcontact.base.formatting import round_to_three_digits
from hardcontact.config.limits import MAX_MAP_PIXELS
from hardcontact.contact.contact import Contact
from hardcontact.contact.numerical_limits import Extent, minimum_range, periods_in_window
from hardcontact.surfaces.height_map import HeightMap

#: Height of the sphere above its apex at the border of the window, relative to the range of
#: adhesion, as in the paper: there the attraction has fallen to exp(-14).
BORDER_HEIGHT_IN_RANGES = 14
#: Another such height, relative to the rms height. The larger of both counts.
BORDER_HEIGHT_IN_RMS = 4
#: Largest number of mirrored scans per row of the window: more only repeat the same summits.
MAX_MIRRORED_SCANS = 10
#: Largest number of pixels per row of a scan: it keeps the time below a few seconds.
MAX_QUICK_PIXELS = 2048
#: Largest number of pixels in contact, summed over contacts and mirrored scans in the window,
#: for the same reason.
MAX_QUICK_CONTACT_PIXELS = 2**23


class Obstacle(StrEnum):
    """Why scans give no force; SHORT_RANGE: the range is too short for pixels or relief."""

    NONE = ""
    NO_MAP, SEVERAL_SCANS = "no_map", "several_scans"
    TOO_LARGE, SHORT_RANGE = "too_large", "short_range"


def choose_window(
    rms_height: float, min_pixel_size: float, min_scan_size: float, radius: float, rho: float
) -> tuple[float, str]:
    """Return the width of the window on scans, and what decides it; all lengths are in nm.

    At the border of the window the sphere is so high that points beyond attract little. Pixels and
    scans may permit only a narrower window.
    """
    height, height_words = max(
        (BORDER_HEIGHT_IN_RANGES * rho, f"{BORDER_HEIGHT_IN_RANGES} ranges of adhesion"),
        (BORDER_HEIGHT_IN_RMS * rms_height, f"{BORDER_HEIGHT_IN_RMS} rms heights"),
    )
    width_at_height = 2 * math.sqrt(2 * radius * height)
    height_reason = f"at its border the sphere is {height_words} above its apex"
    pixel_reason = f"{MAX_MAP_PIXELS} pixels of the scans, the most that are computed"
    scan_reason = f"{MAX_MIRRORED_SCANS} mirrored scans, which all have the same summits"
    window, reason = min(
        (width_at_height, height_reason),
        (MAX_MAP_PIXELS * min_pixel_size, pixel_reason),
        (2 * MAX_MIRRORED_SCANS * min_scan_size, scan_reason),
    )
    return round_to_three_digits(window, math.floor), reason


def contact_on_scan(scan: HeightMap, contact: Contact) -> Contact:
    """Return a contact with the window that a study of a scan would have."""
    window, _ = choose_window(
        float(scan.heights.std()), scan.pixel_size, scan.size, contact.radius, contact.rho
    )
    return replace(contact, window=window)


def find_obstacle(scans: Sequence[HeightMap], contact: Contact) -> tuple[Obstacle, float]:
    """Return why levelled scans give no force, and the shortest range (nm) that a map permits.

    The range is NaN if another obstacle than SHORT_RANGE is found.
    """
    if not any(scan.kind == "map" for scan in scans):
        return Obstacle.NO_MAP, math.nan
    if len(scans) > 1:
        return Obstacle.SEVERAL_SCANS, math.nan
    (scan,) = scans
    window = contact_on_scan(scan, contact).window
    pixels_per_contact = contact.pixel_count(scan.pixel_size) * periods_in_window(window, scan.size)
    contact_pixels = pixels_per_contact * contact.contacts_per_row**2
    if scan.pixels > MAX_QUICK_PIXELS or contact_pixels > MAX_QUICK_CONTACT_PIXELS:
        return Obstacle.TOO_LARGE, math.nan
    extent = Extent(scan.pixels, scan.pixel_size, scan.size, float(np.ptp(scan.heights)))
    shortest_range, _ = minimum_range(contact.radius, window, extent)
    obstacle = Obstacle.SHORT_RANGE if contact.rho < shortest_range else Obstacle.NONE
    return obstacle, shortest_range
