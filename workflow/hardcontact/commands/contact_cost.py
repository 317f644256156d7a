"""The time and memory of contacts, which bound their number and the pixels of masters."""

from collections.abc import Sequence

from hardcontact.commands.inventory import Entry
from hardcontact.config.limits import MAX_CONTACT_PIXELS
from hardcontact.contact.bearing_area import TILE
from hardcontact.contact.contact import Contact, periods_in_window
from hardcontact.contact.geometry import window_pixels

#: The finest pixels worth computing, in nm: half the distance of atoms.
FINEST_PIXEL_SIZE = 0.15
#: Numbers of contacts per row of the array. Even ones fall evenly on the quarters of a scan.
ARRAY_WIDTHS = (20, 16, 12, 10, 8, 6, 4)
#: Seconds that the contacts of one filtered surface may take. Chosen: the 150 filtered surfaces of
#: a scan at full effort then take at most 5 minutes of processor time, whatever the scan.
CONTACT_SECONDS = 2.0
#: Measured seconds for a contact pixel in one period of the map, and for a tile in the window.
SECONDS_A_PIXEL = 4e-7
SECONDS_A_TILE = 1e-8


def short_edge_pixels(scan: Entry, contact: Contact, max_pixels: int) -> int:
    """Return the pixels of short-edge masters of one scan: mirrored, halved repeatedly."""
    pixels = 2 * scan.pixels
    while 2 * pixels <= max_pixels:
        pixel_size = scan.size / pixels
        seconds = _contact_seconds(scan, contact, pixel_size)
        if pixel_size < FINEST_PIXEL_SIZE or ARRAY_WIDTHS[-1] ** 2 * seconds > CONTACT_SECONDS:
            break
        pixels *= 2
    return pixels


def _contact_seconds(scan: Entry, contact: Contact, pixel_size: float) -> float:
    """Return about the time (s) for one contact and all its periods on pixels of a size (nm)."""
    periods = periods_in_window(contact.window, scan.size)
    tiles = (window_pixels(contact.window, pixel_size) / TILE) ** 2
    return contact.pixel_count(pixel_size) * periods * SECONDS_A_PIXEL + tiles * SECONDS_A_TILE


def affordable_contacts(
    substrates: Sequence[Entry], contact: Contact, short_pixels: int, max_per_side: int
) -> tuple[int, bool]:
    """Return the contacts per row that time and memory permit, and whether they take long.

    The pixels of all contacts stay in memory: on masters, and on scans with all periods in the
    window.
    """
    seconds = 0.0
    kept_pixels = 0.0
    for scan in substrates:
        periods = periods_in_window(contact.window, scan.size)
        finest = 2 * scan.size / short_pixels
        for pixel_size, period_count in ((scan.pixel_size, periods), (finest, 1.0)):
            seconds = max(seconds, _contact_seconds(scan, contact, pixel_size))
            kept_pixels = max(kept_pixels, contact.pixel_count(pixel_size) * period_count)
    for contacts_per_row in ARRAY_WIDTHS:
        contacts = contacts_per_row**2
        slow = contacts * seconds > CONTACT_SECONDS
        fits = contacts_per_row <= max_per_side and contacts * kept_pixels <= MAX_CONTACT_PIXELS
        if fits and not slow:
            break
    return contacts_per_row, slow
