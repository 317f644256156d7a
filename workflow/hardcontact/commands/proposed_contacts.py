"""The contacts of a proposal, with their window, range and number, and the pixels of masters."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

from hardcontact.commands.inventory import UserScan
from hardcontact.config.limits import MAX_CONTACT_PIXELS
from hardcontact.contact.bearing_area import CELL_PIXELS
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import count_window_pixels
from hardcontact.contact.numerical_limits import (
    PENETRATION_OVER_RANGE,
    minimum_range,
    penetration_depth,
    periods_in_window,
)
from hardcontact.own.scan_contact import choose_window

#: The longest range of adhesion (nm) that is proposed if none is given, as in the paper's study.
#: Scans that permit only longer ranges are refused before any reason is printed.
LONGEST_RANGE = 40.0
#: Width of the long-edge master relative to a scan, as in the paper.
MASTER_OVER_SCAN = 8
#: Width of the long-edge master relative to the window.
MASTER_OVER_WINDOW = 1.6
#: The finest pixels worth computing, in nm: half of some 0.3 nm between atoms.
FINEST_PIXEL_SIZE = 0.15
#: Numbers of contacts per row of the array. Even ones fall evenly on the quarters of a scan.
CONTACTS_PER_ROW_CHOICES = (20, 16, 12, 10, 8, 6, 4)
#: Seconds that the contacts of one filtered surface may take, unless the fewest take longer: 5
#: minutes of processor time for the 150 filtered surfaces of a single scan at full effort.
MAX_CONTACT_SECONDS = 2.0
#: Measured seconds for a contact pixel in one period of the map.
SECONDS_A_PIXEL = 4e-7
#: Measured seconds for a cell of the map in the window.
SECONDS_A_CELL = 1e-8


class PermittedContact(NamedTuple):
    """A contact with a window and a range of adhesion for some scans, with reasons in words."""

    contact: Contact
    shortest_range: float  #: The shortest range (nm) that the scans permit.
    window_reason: str
    range_reason: str


def choose_contact(
    scans: Sequence[UserScan],
    substrates: Sequence[UserScan],
    contact: Contact,
    range_given: bool,
    max_pixels: int,
) -> PermittedContact:
    """Return a contact with the window and, if none was given, the range that the scans need.

    `scans` includes the scans of the sphere.
    """
    window, window_reason = _window_on_scans(scans, contact)
    shortest, reason = _shortest_range(scans, substrates, contact, window, max_pixels)
    range_reason = "as given" if range_given else "the paper's; --range changes it"
    if shortest > contact.rho and not range_given:
        contact = replace(contact, rho=min(shortest, LONGEST_RANGE))
        range_reason = f"the least on these scans, where {reason}"
        # A longer range needs a wider window, which does not raise the shortest range.
        window, window_reason = _window_on_scans(scans, contact)
    return PermittedContact(replace(contact, window=window), shortest, window_reason, range_reason)


def _window_on_scans(scans: Sequence[UserScan], contact: Contact) -> tuple[float, str]:
    """Return the width of the window (nm) that a contact on scans needs, and the reason."""
    return choose_window(
        max(scan.rms_height for scan in scans),
        min(scan.pixel_size for scan in scans),
        min(scan.size for scan in scans),
        contact.radius,
        contact.rho,
    )


def _shortest_range(
    scans: Sequence[UserScan],
    substrates: Sequence[UserScan],
    contact: Contact,
    window: float,
    max_pixels: int,
) -> tuple[float, str]:
    """Return the shortest range of adhesion (nm) that scans and masters permit, and the reason."""
    scans_per_row = master_scans_per_row(substrates, window, max_pixels)
    limits_and_reasons = [minimum_range(contact.radius, window, scan.extent) for scan in scans]
    for scan in substrates:
        master = scan.extent._replace(size=scan.size * scans_per_row)
        limits_and_reasons.append(minimum_range(contact.radius, window, master))
        depth = penetration_depth(contact, scan.relief)
        depth_reason = f"the preload presses the bodies some {depth:.3g} nm into each other"
        # Half a per cent more, so that rounding to three digits gives no shorter range.
        shortest = float(f"{1.005 * depth / PENETRATION_OVER_RANGE:.3g}")
        limits_and_reasons.append((shortest, depth_reason))
    return max(limits_and_reasons)


def master_scans_per_row(substrates: Sequence[UserScan], window: float, max_pixels: int) -> int:
    """Return the number of mirrored scans per row of long-edge masters: key band.long.tiles."""
    size = min(scan.size for scan in substrates)
    master_size = max(MASTER_OVER_SCAN * size, MASTER_OVER_WINDOW * window)
    # The margin keeps rounding from adding a scan.
    scans_per_row = math.ceil(master_size / (2 * size) * (1 - 1e-9))
    return max(1, min(scans_per_row, max_pixels // max(2 * scan.pixels for scan in substrates)))


def short_edge_pixels(scan: UserScan, contact: Contact, max_pixels: int) -> int:
    """Return the pixels per row of a scan's short-edge masters, twice those of the scan or more."""
    pixels = 2 * scan.pixels
    while (finer_pixels := 2 * pixels) <= max_pixels:
        pixel_size = 2 * scan.size / finer_pixels  # A master is two scans wide.
        seconds = CONTACTS_PER_ROW_CHOICES[-1] ** 2 * _contact_seconds(scan, contact, pixel_size)
        if pixel_size < FINEST_PIXEL_SIZE or seconds > MAX_CONTACT_SECONDS:
            break
        pixels = finer_pixels
    return pixels


def _contact_seconds(scan: UserScan, contact: Contact, pixel_size: float) -> float:
    """Estimate the seconds for a contact with all periods in its window; `pixel_size` is in nm."""
    periods = periods_in_window(contact.window, scan.size)
    cell_count = (count_window_pixels(contact.window, pixel_size) / CELL_PIXELS) ** 2
    pixel_count = contact.pixel_count(pixel_size) * periods
    return pixel_count * SECONDS_A_PIXEL + cell_count * SECONDS_A_CELL


def affordable_contacts(
    substrates: Sequence[UserScan], contact: Contact, short_pixels: int, max_contacts_per_row: int
) -> tuple[int, float]:
    """Return the contacts per row that time and memory permit, and their seconds on one surface.

    If even the fewest do not fit, these are returned: the study is slow, or refuses them.
    """
    seconds = 0.0
    contact_pixels = 0.0
    for scan in substrates:
        periods = periods_in_window(contact.window, scan.size)
        master_pixel_size = 2 * scan.size / short_pixels
        # `config.limits` counts the contact pixels of masters in one period.
        for pixel_size, period_count in ((scan.pixel_size, periods), (master_pixel_size, 1.0)):
            seconds = max(seconds, _contact_seconds(scan, contact, pixel_size))
            contact_pixels = max(contact_pixels, contact.pixel_count(pixel_size) * period_count)
    for contacts_per_row in CONTACTS_PER_ROW_CHOICES:
        contact_count = contacts_per_row**2
        is_fast = contact_count * seconds <= MAX_CONTACT_SECONDS
        fits = contact_count * contact_pixels <= MAX_CONTACT_PIXELS
        if fits and is_fast and contacts_per_row <= max_contacts_per_row:
            break
    return contacts_per_row, contact_count * seconds
