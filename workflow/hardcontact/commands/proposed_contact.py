"""The scans of own surfaces that contacts are made on; what range, window and load they permit."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from hardcontact.adhesion.finite_scan import LARGE_ENOUGH, finite_scan_ratio
from hardcontact.config.faults import refuse_lines
from hardcontact.config.grids import (
    CONTACT_PIXELS,
    MAP_PIXELS,
    PENETRATION_OVER_RANGE,
    PIXEL_SIZES,
    alike,
    least_range,
)
from hardcontact.config.limits import carrying_pixels, pressed_depth, window_images
from hardcontact.contact.contact import Contact
from hardcontact.insight.summits import draw_size
from hardcontact.numbers.printing import print_length, print_quantity
from hardcontact.surfaces.spectrum import BIN_CENTRES, Spectrum

if TYPE_CHECKING:
    from hardcontact.commands.inventory import Entry

#: Edge of the large-scale master over that of a scan, and over the window.
SCANS, WINDOWS = 8, 1.6
#: The fewest contacts along an edge of the array, and the pixels of masters, of the full effort.
FEWEST_CONTACTS, PIXELS = 4, 4096
#: The sphere above its apex at the edge of the window, over the range of adhesion (14 in the paper)
#: and over the rms height.
RANGES_IN_WINDOW, RMS_IN_WINDOW = 14, 4
#: The most images of a scan, mirrored, along an edge of the window: all hold the same summits.
IMAGES = 10
#: The share of the force on a smooth sphere that the window should hold.
SHARE = 0.99
#: The longest range of adhesion that is proposed unasked, in nm: the longest of the paper's study.
LONGEST_RANGE = 40.0
#: Pixels that the interaction radius sqrt(2 R rho) spans on a scan that resolves it well.
RESOLVED = 32
#: Scans of one surface on the same pixels.
Group = list["Entry"]


class ProposedContact(NamedTuple):
    """The contact that is proposed, and why."""

    contact: Contact  #: With its range and window, the latter of three digits.
    shortest_range: float  #: That the scans permit, in nm.
    range_reason: str  #: Why the range is longer than the usual one, or nothing.
    window_reason: str


def proposed_contact(
    scans: Sequence["Entry"], substrates: Sequence["Entry"], probe: Contact, range_given: bool
) -> ProposedContact:
    """Return a window, and the range asked for or the usual one, longer if the scans need it.

    The probe has no window yet; its range is given by the user or the usual one. The scans of
    contacts are given with those of the sphere and without. A range that is too short
    and a preload that is too high are refused as a ValueError of one line each.
    """
    window, _ = _window(scans, probe.radius, probe.range)
    least, why = _least_range(scans, substrates, probe, window)
    rho = max(probe.range, least)
    # A wider window, as a longer range needs, does not raise the least range.
    window, reason = _window(scans, probe.radius, rho)
    faults = []
    if rho > probe.range and (range_given or least > LONGEST_RANGE):
        usual = "" if range_given else "the usual "
        faults.append(
            f"--range: expected at least {least:.3g} nm on these scans, where {why}, "
            f"found {usual}{probe.range:.4g} nm"
        )
    most = min(_most_load(scan, probe.hardness, window) for scan in scans)
    if probe.preload > most:
        faults.append(
            f"--preload: expected at most {print_quantity(most, 'N')}, which contacts on these "
            f"scans can carry at this hardness, found {print_quantity(probe.preload, 'N')}"
        )
    refuse_lines(faults)
    range_reason = "as given" if range_given else "the paper's"
    if rho > probe.range:
        range_reason = f"the least on these scans, where {why}"
    return ProposedContact(replace(probe, range=rho, window=window), least, range_reason, reason)


def _window(scans: Sequence["Entry"], radius: float, rho: float) -> tuple[float, str]:
    """Return the edge of the window (nm) for a range of adhesion (nm), and the reason."""
    rms_height = max(scan.rms_height for scan in scans)
    finest, least_size = min(scan.pixel_size for scan in scans), min(scan.size for scan in scans)
    height, what = RANGES_IN_WINDOW * rho, f"{RANGES_IN_WINDOW} ranges of adhesion"
    if RMS_IN_WINDOW * rms_height > height:
        height, what = RMS_IN_WINDOW * rms_height, f"{RMS_IN_WINDOW} rms heights"
    edge, reason = min(
        (2 * math.sqrt(2 * radius * height), f"at its edge the sphere is {what} above its apex"),
        (MAP_PIXELS * finest, f"{MAP_PIXELS} pixels of the scans, the most that are computed"),
        (2 * IMAGES * least_size, f"{IMAGES} mirrored scans, which all have the same summits"),
    )
    digit = 10.0 ** (math.floor(math.log10(edge)) - 2)
    return float(f"{math.floor(edge / digit) * digit:.3g}"), reason


def _least_range(
    scans: Sequence["Entry"], substrates: Sequence["Entry"], probe: Contact, window: float
) -> tuple[float, str]:
    """Return the shortest range of adhesion (nm) that scans and masters permit, and why."""
    tiles = proposed_tiles(substrates, window, PIXELS)
    limits = [least_range(probe.radius, window, scan.grid) for scan in scans]
    for scan in substrates:
        master = scan.grid._replace(size=scan.size * tiles)
        limits.append(least_range(probe.radius, window, master))
        depth = pressed_depth(probe, scan.relief)
        pressed = f"the preload presses the bodies some {depth:.3g} nm into each other"
        limits.append((float(f"{1.005 * depth / PENETRATION_OVER_RANGE:.3g}"), pressed))
    return max(limits)


def proposed_tiles(substrates: Sequence["Entry"], window: float, pixels: int) -> int:
    """Return the stitched scans along an edge of large-scale masters of so many pixels.

    The master is eight scans long, as in the paper, and longer than the window (nm), if its pixels
    suffice.
    """
    size = min(scan.size for scan in substrates)
    wanted = math.ceil(max(SCANS * size, WINDOWS * window) / (2 * size) * (1 - 1e-9))
    return max(1, min(wanted, pixels // max(2 * scan.pixels for scan in substrates)))


def _most_load(scan: "Entry", hardness: float, window: float) -> float:
    """Return the preload (N) that window, scan and memory can carry at a hardness (Pa)."""
    kept = CONTACT_PIXELS / FEWEST_CONTACTS**2 / window_images(window, scan.size)
    area = min(carrying_pixels(window, scan.grid), kept) * (scan.pixel_size * 1e-9) ** 2
    return area * hardness


def contact_cautions(
    substrates: Sequence["Entry"],
    usual_range: float,
    proposed: ProposedContact,
    draw_sizes: Mapping[str, float],
) -> Iterator[str]:
    """Yield what the user should know of contacts on these scans, in sentences.

    The usual range and the draw sizes, by surface, are in nm.
    """
    contact = proposed.contact
    if contact.range > usual_range:
        yield (
            f"the range of adhesion is {contact.range:.3g} nm, not the usual {usual_range:.3g} nm: "
            f"it is {proposed.range_reason}"
        )
    share = math.erf(contact.window / math.sqrt(8 * contact.radius * contact.range)) ** 2
    if share < SHARE:
        yield (
            f"the window holds {share:.0%} of the force on a smooth sphere: scans this small "
            "show too little of what the sphere feels, and forces come out too low"
        )
    area = contact.area
    largest = max(scan.pixel_size for scan in substrates)
    if area < largest**2:
        yield (
            f"the preload is carried by {area:.3g} nm², less than a pixel of the scans "
            f"({largest**2:.3g} nm²): one pixel touches, and hardness and preload do not matter "
            "on the scans"
        )
    for surface, drawn in draw_sizes.items():
        size = min(scan.size for scan in substrates if scan.source.surface == surface)
        least, most = finite_scan_ratio(size, drawn)
        if most > 1:
            yield (
                f"{surface}: the sphere finds its highest points within some "
                f"{print_length(LARGE_ENOUGH * drawn)}, the scans are {print_length(size)} wide: "
                f"forces on such scans come out {least:g} to {most:g} times too high"
            )


def draw_sizes(entries: Sequence["Entry"], sphere: str | None, probe: Contact) -> dict[str, float]:
    """Return within which size (nm) a contact finds its summits on each surface but the sphere's.

    It is that of the scan on which it is largest.
    """
    drawn: dict[str, float] = {}
    for entry in entries:
        surface, known = entry.source.surface, np.isfinite(entry.density)
        if surface != sphere:
            spectrum = Spectrum(BIN_CENTRES[known], entry.density[known])
            size = draw_size(spectrum, probe.radius, probe.area)
            drawn[surface] = max(size, drawn.get(surface, 0.0))
    return drawn


def contact_scans(
    entries: Sequence["Entry"], sphere: str | None, probe: Contact, draw_sizes: Mapping[str, float]
) -> tuple[list["Entry"], list[str]]:
    """Return the scans that contacts are made on, of every surface those on one grid, and reasons.

    Surfaces are compared on one grid where they have one in common. Of grids that resolve the
    interaction radius, it is the smallest that is large enough for the draw size (nm, by surface),
    or else the largest. The id of the sphere's surface is None if it is smooth. A surface without a
    height map is refused, as a ValueError of one line.
    """
    groups = _groups_by_surface(entries)
    substrates = {name: of_it for name, of_it in groups.items() if name != sphere}
    if common := _common(substrates):
        substrates = common
    chosen: list[Entry] = []
    reasons = []
    for surface, of_it in substrates.items():
        enough = LARGE_ENOUGH * (max(draw_sizes.values()) if common else draw_sizes[surface])
        group = _best(of_it, math.sqrt(2 * probe.radius * probe.range), enough)
        chosen += group
        reasons.append(f"{surface}: {_named(group)}: {_reason(group, of_it, enough)}")
    if sphere is not None:
        group = _of_sphere(groups[sphere], chosen, probe.radius)
        chosen += group
        reasons.append(f"{sphere}: {_named(group)}, subtracted from which is the sphere's shape")
    return chosen, reasons


def _groups_by_surface(entries: Sequence["Entry"]) -> dict[str, list[Group]]:
    """Return the height maps of each surface, those on the same pixels together."""
    groups: dict[str, list[Group]] = {}
    least, most = PIXEL_SIZES
    for entry in entries:
        of_it = groups.setdefault(entry.source.surface, [])
        if entry.kind == "map" and least <= entry.pixel_size <= most:
            same = next((group for group in of_it if alike(group[0].grid, entry.grid)), None)
            if same is None:
                of_it.append(same := [])
            same.append(entry)
    refuse_lines(
        f"surface {surface}: expected a height map, on which contacts are made, with pixels of "
        f"{least:g} to {most:g} nm, found none; of line scans alone `hardcontact predict` tells "
        "force and band"
        for surface, of_it in groups.items()
        if not of_it
    )
    return groups


def _common(groups: dict[str, list[Group]]) -> dict[str, list[Group]]:
    """Return the groups whose pixels all surfaces have, if there are some and two surfaces."""

    def everywhere(group: Group) -> bool:
        return all(
            any(alike(one[0].grid, group[0].grid) for one in others) for others in groups.values()
        )

    common = {surface: list(filter(everywhere, of_it)) for surface, of_it in groups.items()}
    return common if len(groups) > 1 and all(common.values()) else {}


def _best(groups: list[Group], interaction: float, enough: float) -> Group:
    """Return the group that contacts are made on, of one surface.

    Given are the interaction radius and the size (nm) from which scans have the highest points.
    """

    def rank(group: Group) -> tuple[bool, bool, bool, float, int, float]:
        size, pixel_size, count = group[0].size, group[0].pixel_size, len(group)
        blind = all(entry.band.shortest > entry.band.longest for entry in group)
        if interaction < RESOLVED * pixel_size:  # Then the finest pixels.
            return blind, True, False, pixel_size, -count, -size
        small = size < enough
        return blind, False, small, -size if small else size, -count, pixel_size

    return min(groups, key=rank)


def _reason(group: Group, groups: list[Group], enough: float) -> str:
    """Return why contacts on a surface are made on these scans, in words."""
    if len(groups) == 1:
        return "no others can be used"
    sizes = "they come nearest to" if group[0].size < enough else "the smallest of at least"
    return f"{sizes} {print_length(enough)}, four times sqrt(2 R sigma/t)"


def _named(group: Group) -> str:
    scans = "the scan" if len(group) == 1 else f"the {len(group)} scans"
    return f"{scans} of {print_length(group[0].size)} and {group[0].pixels} pixels"


def _of_sphere(groups: list[Group], substrates: Sequence["Entry"], radius: float) -> Group:
    """Return the scans of the sphere: on the pixels of the substrates, or else the most.

    Pairs are computed on the finer pixels of both, so that sizes too different make large maps.
    """

    def rank(group: Group) -> tuple[bool, bool, int, float]:
        first = group[0]
        large = any(
            2 * max(first.size, other.size) / min(first.pixel_size, other.pixel_size) > MAP_PIXELS
            for other in substrates
        )
        same = all(alike(first.grid, other.grid) for other in substrates)
        return large or first.size > radius, not same, -len(group), -first.size

    return min(groups, key=rank)
