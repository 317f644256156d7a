"""The keys of a study of your surfaces that depend on its scans, with reasons in words."""

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from hardcontact.base.formatting import format_length
from hardcontact.commands.contact_scans import all_search_sizes, select_contact_scans
from hardcontact.commands.inventory import UserScan
from hardcontact.commands.proposed_contacts import (
    MAX_CONTACT_SECONDS,
    PermittedContact,
    affordable_contacts,
    choose_contact,
    master_scans_per_row,
    short_edge_pixels,
)
from hardcontact.commands.scan_cautions import scan_cautions
from hardcontact.config.configuration import quantity_type
from hardcontact.contact.contact import Contact
from hardcontact.scans.reading import DEFAULT_OPTIONS
from hardcontact.scans.reliable_wavelengths import LIMIT_NAMES
from hardcontact.surfaces.spectrum import nearest_bin

#: The shortest wavelength that a scan keeps, in pixels. In the paper 20 nm, on pixels of 4.9 nm.
TRANSITION_PIXELS = 4
#: The longest wavelength that a scan keeps, relative to its size. In the paper 1000 of 2500 nm. As
#: there, this is more than the longest reliable wavelength, a third of the size.
TRANSITION_SHARE = 0.4
#: Factor from the study's range of adhesion down to the shortest computed range, and up to the
#: longest: 0.7 to 45 nm around the paper's 5.6 nm. More would put the 12 ranges further apart.
RANGE_SPAN = 8.0
#: The smallest ratio of neighbouring ranges up to the study's, before rounding: forces at closer
#: ranges tell nothing new beside a tolerance of 10 %.
MIN_RANGE_RATIO = 1.1
#: The shortest cutoff in pixels.
MIN_CUTOFF_PIXELS = 4
#: The size of the scan, and the interaction radius sqrt(D rho), relative to the shortest cutoff of
#: the long side: in the paper 2500 nm and 1.67 µm, relative to 100 nm.
SIZE_OVER_CUTOFF = 25
INTERACTION_RADIUS_OVER_CUTOFF = 16
#: The smallest ratio of neighbouring cutoffs. Closer ones gain nothing beside a tolerance of 10 %:
#: between cutoffs 1.1 to 1.6 apart, interpolated forces of the paper's study err by 1 to 2 %.
MIN_CUTOFF_RATIO = 1.15


class Effort(NamedTuple):
    """The size of a study, which decides its cost."""

    pixels: int  #: Most pixels per row of masters, unless mirrored scans have more.
    cutoff_count: int  #: Most cutoffs on each side.
    master_count: int  #: Masters on each side, for a single scan.
    slow_master_count: int  #: The same if contacts take long.
    contacts_per_row: int  #: Most contacts per row of the array.
    range_count: int  #: Ranges of adhesion.


#: Chosen: a minute of processor time for a scan of 512 x 512 pixels; quick effort takes a third.
FULL_EFFORT = Effort(
    pixels=4096, cutoff_count=14, master_count=5, slow_master_count=3, contacts_per_row=20,
    range_count=12,
)  # fmt: skip
QUICK_EFFORT = Effort(
    pixels=2048, cutoff_count=5, master_count=2, slow_master_count=2, contacts_per_row=8,
    range_count=5,
)  # fmt: skip
#: Most scans of a surface that make masters at quick effort.
MAX_QUICK_SCANS = 3


class Choice(NamedTuple):
    """A key with dots, its chosen value as in YAML, and a reason or an empty text."""

    key: str
    value: object
    reason: str


class Proposal(NamedTuple):
    """The keys of a study that depend on its scans, and what to tell the user."""

    contact_scans: list[UserScan]  #: Scans that make contacts; others only enter the spectrum.
    choices: list[Choice]
    quick: list[Choice]  #: Choices that differ at quick effort.
    reasons: list[str]  #: Why these scans make contacts, a line for each surface.
    cautions: list[str]  #: What the user should know before believing the answer.


def propose_keys(
    scans: Sequence[UserScan],
    sphere_surface: str | None,
    contact: Contact,
    range_given: bool = False,
) -> Proposal:
    """Choose every key that depends on the scans.

    `sphere_surface` is the id of the sphere's surface, None for a smooth sphere.
    """
    search_sizes = all_search_sizes(scans, sphere_surface, contact)
    contact_scans, reasons = select_contact_scans(scans, sphere_surface, contact, search_sizes)
    substrates = [scan for scan in contact_scans if scan.scan_file.surface != sphere_surface]
    _refuse_unlike_scans(substrates)
    permitted = choose_contact(contact_scans, substrates, contact, range_given, FULL_EFFORT.pixels)
    sphere_scans = [scan for scan in contact_scans if scan.scan_file.surface == sphere_surface]
    transitions = _transition_choices(substrates, sphere_scans)
    full = _effort_choices(substrates, permitted, transitions, FULL_EFFORT)
    full_values = values_by_key(full)
    quick = [
        choice._replace(reason="")
        for choice in _effort_choices(substrates, permitted, transitions, QUICK_EFFORT)
        if choice.value != full_values[choice.key]
    ]
    if incomplete_count := sum(scan.undefined_count > 0 for scan in scans):
        reason = f"{incomplete_count} of the files have undefined pixels"
        filling = DEFAULT_OPTIONS.undefined_pixels
        full.insert(0, Choice("scan.undefined_pixels", filling, reason))
    cautions = [*scan_cautions(scans, substrates, contact.rho, permitted, search_sizes)]
    return Proposal(contact_scans, full, quick, reasons, cautions)


def values_by_key(choices: Sequence[Choice]) -> dict[str, Any]:
    """Return the values of choices by their keys."""
    return {choice.key: choice.value for choice in choices}


def _refuse_unlike_scans(substrates: Sequence[UserScan]) -> None:
    """Refuse scans if the coarsest resolves no wavelength that the smallest holds."""
    coarsest = max(substrates, key=lambda scan: scan.pixel_size)
    smallest = min(substrates, key=lambda scan: scan.size)
    if TRANSITION_PIXELS * coarsest.pixel_size > TRANSITION_SHARE * smallest.size:
        raise ValueError(
            "--surface: expected scans of similar size on all surfaces, found "
            f"{format_length(smallest.size)} on {smallest.scan_file.surface} and pixels of "
            f"{format_length(coarsest.pixel_size)} on {coarsest.scan_file.surface}: "
            "make a study of each"
        )


def _effort_choices(
    substrates: Sequence[UserScan],
    permitted: PermittedContact,
    transitions: Sequence[Choice],
    effort: Effort,
) -> list[Choice]:
    """Return the choices of one effort."""
    contact = permitted.contact
    short_pixels = max(short_edge_pixels(scan, contact, effort.pixels) for scan in substrates)
    contacts_per_row, seconds = affordable_contacts(
        substrates, contact, short_pixels, effort.contacts_per_row
    )
    is_slow = seconds > MAX_CONTACT_SECONDS
    contacts_reason = "contacts per row of their array"
    if is_slow:
        contacts_reason += f": the fewest, and yet each filtered surface takes {seconds:.2g} s"
    shortest_range = permitted.shortest_range
    ranges = _adhesion_ranges(contact.rho, shortest_range, effort.range_count)
    limit = f"these scans permit {shortest_range:.3g} nm or more"
    master_count = _master_count(substrates, effort, is_slow)
    return [
        Choice("contact.window", _format_nm(contact.window), permitted.window_reason),
        Choice("contact.contacts_per_row", contacts_per_row, contacts_reason),
        Choice("adhesion.range", _format_nm(contact.rho), permitted.range_reason),
        Choice("adhesion.ranges", ranges, f"for the force as a function of it; {limit}"),
        Choice("band.masters", master_count, "masters on each side"),
        *_master_choices(substrates, contact, transitions, effort, short_pixels),
    ]


def _master_count(substrates: Sequence[UserScan], effort: Effort, is_slow: bool) -> int:
    """Return the number of masters on each side.

    At full effort each scan of the surface with most scans makes equally many, unless these are
    more than twice the masters of a single scan.
    """
    masters = effort.slow_master_count if is_slow else effort.master_count
    scan_counts = Counter(scan.scan_file.surface for scan in substrates)
    most_scans = max(scan_counts.values())
    if effort is QUICK_EFFORT:
        return max(masters, min(most_scans, MAX_QUICK_SCANS))
    masters_a_scan = max(1, round(masters / most_scans))
    return min(most_scans * masters_a_scan, 2 * effort.master_count)


def _master_choices(
    substrates: Sequence[UserScan],
    contact: Contact,
    transitions: Sequence[Choice],
    effort: Effort,
    short_pixels: int,
) -> Iterator[Choice]:
    """Yield the choices of masters and of their cutoffs."""
    scans_per_row = master_scans_per_row(substrates, contact.window, effort.pixels)
    long_pixels = max(2 * scan.pixels for scan in substrates) * scans_per_row
    size = min(scan.size for scan in substrates)
    short_pixel_size = max(2 * scan.size / short_pixels for scan in substrates)
    long_pixel_size = max(scan.pixel_size for scan in substrates)
    interaction_radius = math.sqrt(2 * contact.radius * contact.rho)
    min_cutoff = min(size / SIZE_OVER_CUTOFF, interaction_radius / INTERACTION_RADIUS_OVER_CUTOFF)
    shortest_long_cutoff = max(MIN_CUTOFF_PIXELS * long_pixel_size, min_cutoff)
    short_cutoffs = _spaced_cutoffs(MIN_CUTOFF_PIXELS * short_pixel_size, size, effort.cutoff_count)
    long_cutoffs = _spaced_cutoffs(shortest_long_cutoff, size * scans_per_row, effort.cutoff_count)
    short_transition, long_transition = transitions
    tiles_reason = f"mirrored scans per row, {format_length(2 * size * scans_per_row)}"
    yield Choice("band.short.pixels", short_pixels, f"{format_length(short_pixel_size)} a pixel")
    yield short_transition
    yield Choice("band.short.cutoffs", short_cutoffs, "from four pixels to the size of the scan")
    yield Choice("band.long.pixels", long_pixels, "with the pixel size of the scans")
    yield Choice("band.long.tiles", scans_per_row, tiles_reason)
    yield long_transition
    yield Choice("band.long.cutoffs", long_cutoffs, "to half the size of the master")


def _spaced_cutoffs(shortest: float, longest: float, max_count: int) -> list[str]:
    """Return wavelengths (nm) as quantities of three digits, evenly spaced in their logarithm."""
    steps = int(math.log(longest / shortest) / math.log(MIN_CUTOFF_RATIO))
    wavelengths = np.geomspace(shortest, longest, min(max_count, max(steps, 1) + 1))
    return [_format_nm(float(f"{wavelength:.3g}")) for wavelength in wavelengths]


def _transition_choices(
    substrates: Sequence[UserScan], sphere_scans: Sequence[UserScan]
) -> tuple[Choice, Choice]:
    """Choose the wavelengths below and above which roughness is artificial."""
    short_scans = _decisive_scans(substrates, sphere_scans, "shortest")
    long_scans = _decisive_scans(substrates, sphere_scans, "longest")
    limits = [
        (TRANSITION_PIXELS * scan.pixel_size, "four pixels") for scan in (*substrates, *short_scans)
    ]
    scan_wavelengths = [scan.reliable_wavelengths for scan in short_scans]
    limits += [(waves.shortest, LIMIT_NAMES[waves.limited_by]) for waves in scan_wavelengths]
    limit, reason = max(limits)
    longest = float(f"{TRANSITION_SHARE * min(scan.size for scan in long_scans):.3g}")
    shortest = min(float(f"{limit:.3g}"), longest)
    short_reason = f"{reason}; below, roughness is artificial"
    long_reason = f"{TRANSITION_SHARE:g} of the size of the scan; above, roughness is artificial"
    return (
        Choice("band.short.transition", _format_nm(shortest), short_reason),
        Choice("band.long.transition", _format_nm(longest), long_reason),
    )


def _decisive_scans(
    substrates: Sequence[UserScan], sphere_scans: Sequence[UserScan], end: str
) -> list[UserScan]:
    """Return the scans that are rougher than the other body at an end of their reliable waves.

    `end` is ``"shortest"`` or ``"longest"``. Without such scans all are returned.
    """
    bodies = [(scan, sphere_scans) for scan in substrates]
    bodies += [(scan, substrates) for scan in sphere_scans]
    rough_scans = [scan for scan, partners in bodies if _is_rougher(scan, partners, end)]
    return rough_scans or [*substrates, *sphere_scans]


def _is_rougher(scan: UserScan, partners: Sequence[UserScan], end: str) -> bool:
    """Return False if all scans of the other body have more power at this end."""
    index = nearest_bin(getattr(scan.reliable_wavelengths, end))
    are_rougher = [partner.density[index] > scan.density[index] for partner in partners]
    return not (partners and all(are_rougher))


def _adhesion_ranges(rho: float, shortest_range: float, count: int) -> list[str]:
    """Return ranges of adhesion as quantities, around the range rho (nm) of the study."""
    accepted = quantity_type("adhesion.range")
    shortest = min(max(shortest_range, rho / RANGE_SPAN, accepted.low), rho)
    longest = min(rho * RANGE_SPAN, accepted.high)
    shorter_count = min(count // 2, int(math.log(rho / shortest) / math.log(MIN_RANGE_RATIO)))
    shorter = np.geomspace(shortest, rho, shorter_count + 1)[:-1]
    longer = np.geomspace(rho, longest, count - shorter_count)[1:]
    # The shortest is not rounded, because scans may not permit a shorter one.
    rounded = {float(f"{length:.2g}") for length in (*shorter[1:], *longer)}
    ranges = {*shorter[:1], rho, *(length for length in rounded if length > shortest)}
    return [_format_nm(length) for length in sorted(ranges)]


def _format_nm(length: float) -> str:
    """Return a length (nm) as the configuration has it."""
    return f"{length:.12g} nm"
