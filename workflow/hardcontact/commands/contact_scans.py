"""The scans of each surface on which contacts are made, and the reasons for them."""

import math
from collections.abc import Sequence

import numpy as np

from hardcontact.base.formatting import format_length
from hardcontact.commands.inventory import UserScan, scans_by_surface
from hardcontact.config.faults import raise_faults
from hardcontact.config.limits import MAX_MAP_PIXELS, PIXEL_SIZES, same_pixels
from hardcontact.contact.contact import Contact
from hardcontact.contact.numerical_limits import LARGE_SIZE_RATIO
from hardcontact.surfaces.spectrum import BIN_CENTRES, Spectrum
from hardcontact.theory.summits import search_size

#: Fewest pixels that the interaction radius sqrt(D rho) spans on a scan that resolves it well: a
#: tenth of some 343 pixels in the paper (1.7 µm at 5.6 nm, on pixels of 4.9 nm).
MIN_RADIUS_PIXELS = 32
#: Scans of one surface with equal numbers and sizes of pixels.
Group = list[UserScan]


def all_search_sizes(
    scans: Sequence[UserScan], sphere_surface: str | None, contact: Contact
) -> dict[str, float]:
    """Estimate the search size (nm) of each substrate, within which the sphere finds its summits.

    The estimate is the largest of the scans, each from its own spectrum. The search size of the
    study differs, because it is from the joined, extrapolated spectrum.
    """
    sizes: dict[str, float] = {}
    sphere_densities = [scan.density for scan in scans if scan.scan_file.surface == sphere_surface]
    # In each bin the roughest scan of the sphere; zero where no scan has waves.
    sphere_density = np.fmax.reduce([np.zeros_like(BIN_CENTRES), *sphere_densities])
    for scan in scans:
        surface = scan.scan_file.surface
        if surface != sphere_surface:
            is_measured = np.isfinite(scan.density)
            density = scan.density + sphere_density
            spectrum = Spectrum(BIN_CENTRES[is_measured], density[is_measured])
            size = search_size(spectrum, contact.radius, contact.area)
            sizes[surface] = max(size, sizes.get(surface, 0.0))
    return sizes


def select_contact_scans(
    scans: Sequence[UserScan],
    sphere_surface: str | None,
    contact: Contact,
    search_sizes: dict[str, float],
) -> tuple[list[UserScan], list[str]]:
    """Return the scans that contacts are made on, on one grid a surface, and the reasons.

    The largest search size serves all surfaces, so that they are compared on one size if possible.
    """
    groups = _group_by_grid(scans)
    sphere_groups = groups.pop(sphere_surface) if sphere_surface is not None else []
    sufficient_size = LARGE_SIZE_RATIO * max(search_sizes.values())
    interaction_radius = math.sqrt(2 * contact.radius * contact.rho)
    selected: list[UserScan] = []
    reasons = []
    for surface, surface_groups in groups.items():
        group, reason = _best_group(surface_groups, interaction_radius, sufficient_size)
        selected += group
        reasons.append(f"{surface}: {_describe_group(group)}: {reason}")
    if sphere_surface is not None:
        group = _sphere_group(sphere_groups, selected, contact.radius)
        selected += group
        reasons.append(
            f"{sphere_surface}: {_describe_group(group)}, "
            "from which the sphere's shape is subtracted"
        )
    return selected, reasons


def _group_by_grid(scans: Sequence[UserScan]) -> dict[str, list[Group]]:
    """Return the usable height maps of each surface, those on the same pixels together."""
    low, high = PIXEL_SIZES
    groups: dict[str, list[Group]] = {}
    for surface, surface_scans in scans_by_surface(scans).items():
        groups[surface] = []
        for scan in surface_scans:
            if scan.kind == "map" and low <= scan.pixel_size <= high:
                matching_groups = (
                    group for group in groups[surface] if same_pixels(group[0].extent, scan.extent)
                )
                group = next(matching_groups, [])
                if not group:
                    groups[surface].append(group)
                group.append(scan)
    raise_faults(
        f"surface {surface}: expected a height map, on which contacts are made, with pixels of "
        f"{low:g} to {high:g} nm, found none; for line scans alone, `hardcontact predict` gives "
        "force and band"
        for surface, surface_groups in groups.items()
        if not surface_groups
    )
    return groups


def _best_group(
    groups: list[Group], interaction_radius: float, sufficient_size: float
) -> tuple[Group, str]:
    """Return the scans of a surface that contacts are made on, and the reason; lengths in nm."""
    reliable = [group for group in groups if any(scan.has_reliable_wavelengths for scan in group)]
    usable = reliable or groups
    max_pixel_size = interaction_radius / MIN_RADIUS_PIXELS
    resolved = [group for group in usable if group[0].pixel_size <= max_pixel_size]
    large = [group for group in resolved if group[0].size >= sufficient_size]
    size = format_length(sufficient_size)
    goal = f"{size}, twice the search size 2 sqrt(2 R sigma²/m) of single scans"
    if large:
        group = min(large, key=lambda group: (group[0].size, -len(group), group[0].pixel_size))
        reason = f"the smallest of at least {goal}"
    elif resolved:
        group = min(resolved, key=lambda group: (-group[0].size, -len(group), group[0].pixel_size))
        reason = f"they come nearest to {goal}"
    else:
        group = min(usable, key=lambda group: (group[0].pixel_size, -len(group), -group[0].size))
        reason = "they have the finest pixels"
    is_only_choice = len(resolved or usable) == 1
    return group, ("no others can be used" if is_only_choice else reason)


def _sphere_group(groups: list[Group], substrates: Sequence[UserScan], radius: float) -> Group:
    """Return the sphere's group of the best size, then the best grid, then the most scans."""

    def rank(group: Group) -> tuple[bool, bool, int, float]:
        scan = group[0]
        # Both bodies are computed on the finer pixels of the two.
        is_too_large = scan.size > radius or any(
            2 * max(scan.size, substrate.size) / min(scan.pixel_size, substrate.pixel_size)
            > MAX_MAP_PIXELS
            for substrate in substrates
        )
        matches = all(same_pixels(scan.extent, substrate.extent) for substrate in substrates)
        return is_too_large, not matches, -len(group), -scan.size

    return min(groups, key=rank)


def _describe_group(group: Group) -> str:
    scans = "the scan" if len(group) == 1 else f"the {len(group)} scans"
    return f"{scans} of {format_length(group[0].size)} and {group[0].pixels} pixels"
