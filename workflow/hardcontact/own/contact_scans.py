"""The scans of own surfaces on which contacts are made."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from hardcontact.base.formatting import format_length
from hardcontact.config.faults import refuse_lines
from hardcontact.config.grids import MAP_PIXELS, PIXEL_SIZES, same_grid
from hardcontact.contact.contact import Contact
from hardcontact.contact.finite_scan import LARGE_ENOUGH
from hardcontact.own.inventory import Entry, entries_by_surface
from hardcontact.surfaces.spectrum import BIN_CENTRES, Spectrum
from hardcontact.theory.summits import search_size

#: Fewest pixels that the interaction radius sqrt(2 R rho) spans on a scan that resolves it well.
MIN_RADIUS_PIXELS = 32
#: Scans of one surface on the same pixels.
Group = list[Entry]


def search_sizes(entries: Sequence[Entry], sphere: str | None, probe: Contact) -> dict[str, float]:
    """Return the search size (nm) of each surface but the sphere's.

    A contact finds its summits within the search size. The largest of a surface's scans counts.
    """
    sizes: dict[str, float] = {}
    for entry in entries:
        surface = entry.source.surface
        is_measured = np.isfinite(entry.density)
        if surface != sphere:
            spectrum = Spectrum(BIN_CENTRES[is_measured], entry.density[is_measured])
            size = search_size(spectrum, probe.radius, probe.area)
            sizes[surface] = max(size, sizes.get(surface, 0.0))
    return sizes


def contact_scans(
    entries: Sequence[Entry], sphere: str | None, probe: Contact, search_sizes: Mapping[str, float]
) -> tuple[list[Entry], list[str]]:
    """Return the scans that contacts are made on, those of a surface on one grid, and reasons.

    Grids that resolve the interaction radius come first. Among these, the smallest grid that is
    large enough for the largest search size of all surfaces is taken, or else the largest grid.
    Surfaces are therefore compared on scans of one size where possible.

    entries: the topographies of all surfaces.
    sphere: id of the sphere's surface; None for a smooth sphere.
    probe: the sphere, with its radius and range of adhesion in nm.
    search_sizes: the search size (nm) of each surface, from `search_sizes`.
    Returns the scans, and one reason in words for each surface.
    Raises ValueError if a surface has no height map, with a line for each.
    """
    groups = _groups(entries)
    sphere_groups = groups.pop(sphere) if sphere is not None else []
    large_enough = LARGE_ENOUGH * max(search_sizes.values())
    selected: list[Entry] = []
    reasons = []
    for surface, surface_groups in groups.items():
        interaction_radius = math.sqrt(2 * probe.radius * probe.range)
        group = _best_group(surface_groups, interaction_radius, large_enough)
        reason = "no others can be used"
        if len(surface_groups) > 1:
            is_small = group[0].size < large_enough
            reason = "they come nearest to" if is_small else "the smallest of at least"
            reason += f" {format_length(large_enough)}, twice the search size 2 sqrt(2 R sigma/t)"
        selected += group
        reasons.append(f"{surface}: {_group_in_words(group)}: {reason}")
    if sphere is not None:
        group = _sphere_group(sphere_groups, selected, probe.radius)
        selected += group
        reasons.append(
            f"{sphere}: {_group_in_words(group)}, from which the sphere's shape is subtracted"
        )
    return selected, reasons


def _groups(entries: Sequence[Entry]) -> dict[str, list[Group]]:
    """Return the height maps of each surface, those on the same pixels together."""
    low, high = PIXEL_SIZES
    groups: dict[str, list[Group]] = {}
    for surface, scans in entries_by_surface(entries).items():
        groups[surface] = []
        for entry in scans:
            if entry.kind == "map" and low <= entry.pixel_size <= high:
                matching_groups = (
                    group for group in groups[surface] if same_grid(group[0].grid, entry.grid)
                )
                group = next(matching_groups, None)
                if group is None:
                    groups[surface].append([entry])
                else:
                    group.append(entry)
    refuse_lines(
        f"surface {surface}: expected a height map, on which contacts are made, with pixels of "
        f"{low:g} to {high:g} nm, found none; for line scans alone, `hardcontact predict` gives "
        "force and band"
        for surface, surface_groups in groups.items()
        if not surface_groups
    )
    return groups


def _best_group(groups: list[Group], interaction_radius: float, large_enough: float) -> Group:
    """Return the group of scans of one surface on which contacts are made.

    The interaction radius, and the size at which a scan is large enough, are in nm.
    """

    def rank(group: Group) -> tuple[bool, bool, bool, float, int, float]:
        size = group[0].size
        pixel_size = group[0].pixel_size
        count = len(group)
        blind = all(entry.is_blind for entry in group)
        if interaction_radius < MIN_RADIUS_PIXELS * pixel_size:  # Then the finest pixels.
            return blind, True, False, pixel_size, -count, -size
        is_small = size < large_enough
        return blind, False, is_small, -size if is_small else size, -count, pixel_size

    return min(groups, key=rank)


def _sphere_group(groups: list[Group], substrates: Sequence[Entry], radius: float) -> Group:
    """Return the scans of the sphere: those on the pixels of the substrates, or the largest group.

    Pairs are computed on the finer pixels of both, so that different sizes make large maps.
    """

    def rank(group: Group) -> tuple[bool, bool, int, float]:
        scan = group[0]
        is_too_large = any(
            2 * max(scan.size, substrate.size) / min(scan.pixel_size, substrate.pixel_size)
            > MAP_PIXELS
            for substrate in substrates
        )
        matches = all(same_grid(scan.grid, substrate.grid) for substrate in substrates)
        return is_too_large or scan.size > radius, not matches, -len(group), -scan.size

    return min(groups, key=rank)


def _group_in_words(group: Group) -> str:
    scans = "the scan" if len(group) == 1 else f"the {len(group)} scans"
    return f"{scans} of {format_length(group[0].size)} and {group[0].pixels} pixels"
