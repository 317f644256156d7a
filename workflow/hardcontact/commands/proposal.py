"""Every key of a study of own surfaces that depends on its scans, with reasons in words."""

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from hardcontact.commands.inventory import FILLING, Entry, contradicting
from hardcontact.commands.proposed_contact import (
    FEWEST_CONTACTS,
    PIXELS,
    ProposedContact,
    contact_cautions,
    contact_scans,
    draw_sizes,
    proposed_contact,
    proposed_tiles,
)
from hardcontact.config.faults import refuse_lines
from hardcontact.config.grids import CONTACT_PIXELS
from hardcontact.config.limits import window_images
from hardcontact.contact.bearing_area import TILE
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import window_pixels
from hardcontact.numbers.printing import print_length
from hardcontact.surfaces.extrapolated_spectrum import FEWEST
from hardcontact.surfaces.reliable_band import LIMITS

#: Pixels of the shortest wave that is kept of a scan, and the longest one over its size, as in the
#: paper: 20 nm and 1000 nm of scans of 2500 nm with 512 pixels.
TRANSITION_PIXELS, TRANSITION_SHARE = 4, 0.4
#: The range of adhesion over the shortest, and the longest over it, that forces are computed at.
RANGE_SPAN = 8.0
#: Ranges of adhesion (nm) that the configuration accepts.
RANGES = (0.01, 1000.0)
#: The finest pixels worth computing, in nm: half the distance of atoms.
FINEST = 0.15
#: Numbers of contacts along an edge of the array. Even ones fall evenly on the quarters of a scan.
COUNTS = (20, 16, 12, 10, 8, 6, FEWEST_CONTACTS)
#: Seconds that the contacts of one filtered surface may take.
CONTACT_SECONDS = 2.0
#: Seconds a contact pixel and image of the cell in the window, and a tile in the window (measured).
SECONDS_A_PIXEL, SECONDS_A_TILE = 4e-7, 4e-8
#: The least ratio of neighbouring cutoffs: forces in between are as good interpolated.
RATIO = 1.15
#: Share of undefined pixels from which what fills them is told: a few change hardly anything.
MANY_UNDEFINED = 0.05


class Effort(NamedTuple):
    """What a study may cost.

    Pixels along an edge of masters, if scans do not have more; cutoffs on each side; masters of
    each side, and those of contacts that take long; contacts along an edge of the array; ranges of
    adhesion.
    """

    pixels: int
    cutoffs: int
    realizations: int
    fewest: int
    contacts: int
    ranges: int


#: Ten minutes on two cores, for one scan of 512 x 512 pixels; and two.
FULL = Effort(pixels=PIXELS, cutoffs=14, realizations=5, fewest=3, contacts=20, ranges=12)
QUICK = Effort(pixels=2048, cutoffs=5, realizations=2, fewest=2, contacts=8, ranges=5)


class Choice(NamedTuple):
    """A value that is chosen, as YAML has it: its key with dots, and a reason or nothing."""

    key: str
    value: object
    reason: str


class Proposal(NamedTuple):
    """The scans that contacts are made on (all others only enter the spectrum), and what is chosen.

    Quick is what differs at quick effort, reasons are those for the scans of each surface, and
    cautions what the user should know before believing the answer.
    """

    contact: list[Entry]
    choices: list[Choice]
    quick: list[Choice]
    reasons: list[str]
    cautions: list[str]


def propose(
    entries: Sequence[Entry], sphere: str | None, probe: Contact, range_given: bool = False
) -> Proposal:
    """Choose every key that depends on the scans of surfaces, and of the sphere if it is rough.

    The probe has the radius and the load, and the range of adhesion, given by the user or usual.

    A ValueError tells in one line a problem: no height map, surfaces with scans too different for
    one study, a range of adhesion that is too short, a preload that is too high.
    """
    drawn = draw_sizes(entries, sphere, probe)
    scans, reasons = contact_scans(entries, sphere, probe, drawn)
    substrates = [scan for scan in scans if scan.source.surface != sphere]
    coarsest = max(substrates, key=lambda scan: scan.pixel_size)
    smallest = min(substrates, key=lambda scan: scan.size)
    if TRANSITION_PIXELS * coarsest.pixel_size > TRANSITION_SHARE * smallest.size:
        raise ValueError(
            "--surface: expected scans of similar size on all surfaces, found "
            f"{print_length(smallest.size)} on {smallest.source.surface} and pixels of "
            f"{print_length(coarsest.pixel_size)} on {coarsest.source.surface}: "
            "make a study of each"
        )
    proposed = proposed_contact(scans, substrates, probe, range_given)
    full, quick = (list(_choices(substrates, proposed, effort)) for effort in (FULL, QUICK))
    usual = {choice.key: choice.value for choice in full}
    blind = (
        f"{scan.name}: no wavelength is reliable, {scan.band}"
        for scan in substrates
        if scan.band.shortest > scan.band.longest
    )
    filled = (
        f"{entry.name}: {entry.undefined_share:.0%} of its pixels are undefined, and filled with "
        "what is smoother than the surface"
        for entry in entries
        if entry.undefined_share > MANY_UNDEFINED
    )
    if gaps := sum(entry.undefined > 0 for entry in entries):
        reason = f"{gaps} of the files have undefined pixels"
        full.insert(0, Choice("scan.undefined_pixels", FILLING, reason))
    return Proposal(
        scans,
        full,
        [choice._replace(reason="") for choice in quick if choice.value != usual[choice.key]],
        reasons,
        [
            *contact_cautions(substrates, probe.range, proposed, drawn),
            *blind,
            *contradicting(entries),
            *filled,
        ],
    )


def refuse_unreliable(entries: Sequence[Entry]) -> None:
    """Refuse surfaces of which too few wavelengths are reliable for a spectrum, a line each."""
    faults = []
    for surface in dict.fromkeys(entry.source.surface for entry in entries):
        scans = [entry for entry in entries if entry.source.surface == surface]
        count = int(np.any([scan.band.bins for scan in scans], axis=0).sum())
        if count < FEWEST:
            found = "; ".join(f"{scan.name} {scan.band}" for scan in scans)
            faults.append(
                f"{surface}: expected scans that are reliable in at least {FEWEST} bins of "
                f"wavelengths (ten a decade), found {count}: {found}; add one of another size"
            )
    refuse_lines(faults)


def _choices(
    substrates: Sequence[Entry], proposed: ProposedContact, effort: Effort
) -> Iterator[Choice]:
    """Yield what is computed at some effort, within what the checks permit."""
    contact = proposed.contact
    small_pixels = max(_small_pixels(scan, contact, effort.pixels) for scan in substrates)
    count, slow = _count(substrates, contact, small_pixels, effort.contacts)
    masters = effort.fewest if slow else effort.realizations
    surfaces = [scan.source.surface for scan in substrates]
    most_scans = max(map(surfaces.count, surfaces))
    if effort is QUICK:
        realizations = max(masters, min(most_scans, 3))
    else:
        of_each = max(1, round(masters / most_scans))
        realizations = min(most_scans * of_each, 2 * effort.realizations)
    ranges = list(map(quantity, _ranges(proposed, effort.ranges)))
    permitted = f"these scans permit {proposed.shortest_range:.3g} nm or more"
    yield Choice("contact.window", quantity(contact.window), proposed.window_reason)
    yield Choice("contact.count", count, "contacts along an edge of their array")
    yield Choice("adhesion.ranges", ranges, f"for the force as a function of it; {permitted}")
    yield Choice("scales.range", quantity(contact.range), proposed.range_reason)
    yield Choice("scales.realizations", realizations, "masters on each side")
    yield from _master_choices(substrates, contact, effort, small_pixels)


def _master_choices(
    substrates: Sequence[Entry], contact: Contact, effort: Effort, small_pixels: int
) -> Iterator[Choice]:
    """Yield what masters and their filters are."""
    tiles = proposed_tiles(substrates, contact.window, effort.pixels)
    large_pixels = max(2 * scan.pixels for scan in substrates) * tiles
    size = min(scan.size for scan in substrates)
    finest = max(2 * scan.size / small_pixels for scan in substrates)
    coarsest = max(scan.pixel_size for scan in substrates)
    shortest = min(size / 25, math.sqrt(2 * contact.radius * contact.range) / 16)
    small = _cutoffs(4 * finest, size, effort.cutoffs)
    large = _cutoffs(max(4 * coarsest, shortest), size * tiles, effort.cutoffs)
    least, most, reason = _transitions(substrates)
    above = f"{TRANSITION_SHARE:g} of the size of the scan; above, roughness is artificial"
    edge = f"mirrored scans along an edge, {print_length(2 * size * tiles)}"
    yield Choice("scales.small.pixels", small_pixels, f"{print_length(finest)} a pixel")
    yield Choice("scales.small.transition", quantity(least), reason)
    yield Choice("scales.small.cutoffs", small, "from four pixels to the size of the scan")
    yield Choice("scales.large.pixels", large_pixels, "those of the scans")
    yield Choice("scales.large.tiles", tiles, edge)
    yield Choice("scales.large.transition", quantity(most), above)
    yield Choice("scales.large.cutoffs", large, "to half the size of the master")


def _small_pixels(scan: Entry, contact: Contact, most: int) -> int:
    """Return the pixels of small-scale masters of one scan: stitched, halved repeatedly."""
    pixels = 2 * scan.pixels
    while 2 * pixels <= most:
        pixel_size = scan.size / pixels
        seconds = _contact_seconds(scan, contact, pixel_size)
        if pixel_size < FINEST or FEWEST_CONTACTS**2 * seconds > CONTACT_SECONDS:
            break
        pixels *= 2
    return pixels


def _contact_seconds(scan: Entry, contact: Contact, pixel_size: float) -> float:
    """Return about how long (s) one contact, and all its images, take on pixels of a size (nm)."""
    images = window_images(contact.window, scan.size)
    tiles = (window_pixels(contact.window, pixel_size) / TILE) ** 2
    contact_pixels = contact.pixels(pixel_size)
    return contact_pixels * images * SECONDS_A_PIXEL + tiles * SECONDS_A_TILE


def _count(
    substrates: Sequence[Entry], contact: Contact, small_pixels: int, most: int
) -> tuple[int, bool]:
    """Return the contacts along an edge, as many as time and memory permit, and if they take long.

    Pixels are kept in memory on scans, with their images, and on masters.
    """
    seconds, kept = 0.0, 0.0
    for scan in substrates:
        images, finest = window_images(contact.window, scan.size), 2 * scan.size / small_pixels
        for pixel_size, repeated in ((scan.pixel_size, images), (finest, 1.0)):
            seconds = max(seconds, _contact_seconds(scan, contact, pixel_size))
            kept = max(kept, contact.pixels(pixel_size) * repeated)
    for count in COUNTS:
        slow = count**2 * seconds > CONTACT_SECONDS
        if count <= most and count**2 * kept <= CONTACT_PIXELS and not slow:
            break
    return count, slow


def _cutoffs(shortest: float, longest: float, most: int) -> list[str]:
    """Return wavelengths (nm) of three digits, evenly spaced in their logarithm, as quantities."""
    steps = int(math.log(longest / shortest) / math.log(RATIO))
    wavelengths = np.geomspace(shortest, longest, min(most, max(steps, 1) + 1))
    return [quantity(float(f"{wavelength:.3g}")) for wavelength in wavelengths]


def _transitions(substrates: Sequence[Entry]) -> tuple[float, float, str]:
    """Return the wavelengths (nm) beyond which roughness is artificial, and why the shorter one."""
    longest = TRANSITION_SHARE * min(scan.size for scan in substrates)
    ends = [(TRANSITION_PIXELS * scan.pixel_size, "four pixels") for scan in substrates]
    ends += [(scan.band.shortest, LIMITS[scan.band.limited_by]) for scan in substrates]
    shortest, reason = max(ends)
    longest, shortest = (float(f"{wavelength:.3g}") for wavelength in (longest, shortest))
    if shortest > longest:
        return longest, longest, f"no wave of the scan is reliable ({reason})"
    return shortest, longest, f"{reason}; below, roughness is artificial"


def _ranges(proposed: ProposedContact, count: int) -> list[float]:
    """Return ranges of adhesion (nm) about that of the masters, which is one of them."""
    rho, (least, most) = proposed.contact.range, RANGES
    shortest = max(proposed.shortest_range, rho / RANGE_SPAN, least)
    longest = min(rho * RANGE_SPAN, most)
    below = np.geomspace(shortest, rho, count // 2 + 1)[:-1]
    above = np.geomspace(rho, longest, count - count // 2)[1:]
    rounded = {float(f"{length:.2g}") for length in (*below[1:], *above)}
    others = {length for length in rounded if length > shortest}
    return sorted({shortest, rho, *others})


def quantity(length: float) -> str:
    """Return a length (nm) as the configuration has it."""
    return f"{length:.12g} nm"
