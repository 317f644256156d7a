"""The scans of own surfaces that contacts are made on."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from hardcontact.base.printing import print_length
from hardcontact.config.faults import refuse_lines
from hardcontact.config.grids import MAP_PIXELS, PIXEL_SIZES, alike
from hardcontact.contact.contact import Contact
from hardcontact.contact.finite_scan import LARGE_ENOUGH
from hardcontact.own.inventory import Entry, by_surface
from hardcontact.surfaces.spectrum import BIN_CENTRES, Spectrum
from hardcontact.theory.summits import draw_size

#: Pixels that the interaction radius sqrt(2 R rho) spans on a scan that resolves it well.
RESOLVED = 32
#: Scans of one surface on the same pixels.
Group = list[Entry]


def draw_sizes(entries: Sequence[Entry], sphere: str | None, probe: Contact) -> dict[str, float]:
    """Return within which size (nm) a contact finds its summits on each surface but the sphere's.

    It is that of the scan on which it is largest.
    """
    sizes: dict[str, float] = {}
    for entry in entries:
        surface, measured = entry.source.surface, np.isfinite(entry.density)
        if surface != sphere:
            spectrum = Spectrum(BIN_CENTRES[measured], entry.density[measured])
            size = draw_size(spectrum, probe.radius, probe.area)
            sizes[surface] = max(size, sizes.get(surface, 0.0))
    return sizes


def contact_scans(
    entries: Sequence[Entry], sphere: str | None, probe: Contact, draw_sizes: Mapping[str, float]
) -> tuple[list[Entry], list[str]]:
    """Return the scans that contacts are made on, those of a surface on one grid, and reasons.

    Of grids that resolve the interaction radius, it is the smallest that is large enough for the
    largest draw size (nm, by surface) of all surfaces, or else the largest: so surfaces are
    compared on scans of one size where they can be. The id of the sphere's surface is None if it is
    smooth. Raises ValueError with a line for each surface without a height map.
    """
    groups = _groups(entries)
    sphere_groups = groups.pop(sphere) if sphere is not None else []
    enough = LARGE_ENOUGH * max(draw_sizes.values())
    chosen: list[Entry] = []
    reasons = []
    for surface, surface_groups in groups.items():
        group = _best_group(surface_groups, math.sqrt(2 * probe.radius * probe.range), enough)
        reason = "no others can be used"
        if len(surface_groups) > 1:
            reason = (
                "they come nearest to" if group[0].size < enough else "the smallest of at least"
            )
            reason += f" {print_length(enough)}, four times sqrt(2 R sigma/t)"
        chosen += group
        reasons.append(f"{surface}: {_described(group)}: {reason}")
    if sphere is not None:
        group = _sphere_group(sphere_groups, chosen, probe.radius)
        chosen += group
        reasons.append(
            f"{sphere}: {_described(group)}, from which the sphere's shape is subtracted"
        )
    return chosen, reasons


def _groups(entries: Sequence[Entry]) -> dict[str, list[Group]]:
    """Return the height maps of each surface, those on the same pixels together."""
    low, high = PIXEL_SIZES
    groups: dict[str, list[Group]] = {}
    for surface, scans in by_surface(entries).items():
        groups[surface] = []
        for entry in scans:
            if entry.kind == "map" and low <= entry.pixel_size <= high:
                same = (group for group in groups[surface] if _alike(group, [entry]))
                group = next(same, None)
                if group is None:
                    groups[surface].append([entry])
                else:
                    group.append(entry)
    refuse_lines(
        f"surface {surface}: expected a height map, on which contacts are made, with pixels of "
        f"{low:g} to {high:g} nm, found none; of line scans alone `hardcontact predict` tells "
        "force and band"
        for surface, surface_groups in groups.items()
        if not surface_groups
    )
    return groups


def _alike(first: Group, second: Group) -> bool:
    return alike(first[0].grid, second[0].grid)


def _best_group(groups: list[Group], interaction: float, enough: float) -> Group:
    """Return the scans that contacts are made on, of one surface.

    The interaction radius and the size from which scans have the highest points are in nm.
    """

    def rank(group: Group) -> tuple[bool, bool, bool, float, int, float]:
        size, pixel_size, count = group[0].size, group[0].pixel_size, len(group)
        blind = all(entry.is_blind for entry in group)
        if interaction < RESOLVED * pixel_size:  # Then the finest pixels.
            return blind, True, False, pixel_size, -count, -size
        small = size < enough
        return blind, False, small, -size if small else size, -count, pixel_size

    return min(groups, key=rank)


def _sphere_group(groups: list[Group], substrates: Sequence[Entry], radius: float) -> Group:
    """Return the scans of the sphere: on the pixels of the substrates, or else the most.

    Pairs are computed on the finer pixels of both, so that sizes too different make large maps.
    """

    def rank(group: Group) -> tuple[bool, bool, int, float]:
        scan = group[0]
        large = any(
            2 * max(scan.size, other.size) / min(scan.pixel_size, other.pixel_size) > MAP_PIXELS
            for other in substrates
        )
        same = all(alike(scan.grid, other.grid) for other in substrates)
        return large or scan.size > radius, not same, -len(group), -scan.size

    return min(groups, key=rank)


def _described(group: Group) -> str:
    scans = "the scan" if len(group) == 1 else f"the {len(group)} scans"
    return f"{scans} of {print_length(group[0].size)} and {group[0].pixels} pixels"
