"""Limits of keys that follow from the pixels of scans and masters, and from memory.

Each surface, each substrate with the sphere, and each master has a list of faults. Of each list
only the first fault is reported: limits after it may assume those before.
"""

from collections.abc import Mapping
from dataclasses import replace
from itertools import product
from typing import Any, NamedTuple

import numpy as np

from hardcontact.base.formatting import format_quantity
from hardcontact.config.configuration import get_key, master_keys, study_contact
from hardcontact.config.faults import key_fault, refuse_lines
from hardcontact.config.grids import (
    CONTACT_PIXELS,
    MAP_PIXELS,
    PENETRATION_OVER_RANGE,
    Grid,
    machine_megabytes,
    master_megabytes,
    minimum_range,
    penetration_depth,
    periods_in_window,
)
from hardcontact.config.model import PAPER
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import window_pixels
from hardcontact.surfaces.synthesis import SIDES

#: Largest number of contact pixels of one contact for indents: all pairs of them are compared.
MAX_INDENT_PIXELS = 2**12


class ContactSection(NamedTuple):
    """The contacts that a section of the configuration computes on scans or masters."""

    name: str
    count_key: str  #: The key of the contacts along a side of the array.
    contacts: dict[str, Contact]  #: The contact with the largest area, by the key of its load.
    smallest_radius: float  #: Smallest radius of a sphere in nm.


def contact_sections(config: dict[str, Any]) -> list[ContactSection]:
    """Return the sections that compute contacts.

    The first one, `contact`, computes on scans alone, `sets` on scans and masters, and all others
    on masters.
    """
    contact = study_contact(config)
    own_load = {"contact.preload": contact}
    section = ContactSection("contact", "contact.count", own_load, contact.radius)
    if config["published"] != PAPER:
        return [section, section._replace(name="scales")]
    indent_contact = replace(contact, preload=config["indent"]["preloads"][-1])
    smallest_radius = min(contact.radius, config["scaling"]["radii"][0])
    return [
        section._replace(contacts=own_load | {"indent.preloads": indent_contact}),
        section._replace(name="scales"),
        ContactSection("sets", "sets.count", own_load, smallest_radius),
    ]


def check_grids(config: dict[str, Any], grids: Mapping[str, Grid]) -> None:
    """Refuse values that the pixels of scans do not permit; `grids` maps each surface to its grid.

    Quantities in `config` are numbers in the units of the study. Raises ValueError with a line for
    each fault, which names the key.
    """
    faults = []
    for surface, grid in grids.items():
        faults += scan_faults(config, surface, grid)[:1]
    sphere_surface = config["sphere"]["surface"]
    _, *master_sections = contact_sections(config)
    for surface, grid in grids.items():
        if surface != sphere_surface:
            sphere_grid = grids.get(sphere_surface, grid)  # for a smooth sphere: the substrate's
            faults += _pair_faults(config, surface, grid, sphere_grid)[:1]
            for section, side in product(master_sections, SIDES):
                faults += _master_faults(config, section, side, surface, grid, sphere_grid)[:1]
    refuse_lines(dict.fromkeys(faults))


def scan_faults(config: dict[str, Any], surface: str, grid: Grid) -> list[str]:
    """Return the faults on the scans of a surface: loads, numbers of contacts, ranges."""
    faults = []
    radius = config["sphere"]["radius"]
    if surface == config["sphere"].get("surface") and radius < grid.size:
        accepted = f"at least the size of its scans ({grid.size:.6g} nm)"
        faults.append(key_fault("sphere.radius", accepted, f"{radius:.6g} nm"))
    window = config["contact"]["window"]
    stitched_pixels = 2 * grid.pixels
    seen_pixels = min(window_pixels(window, grid.pixel_size), stitched_pixels) ** 2
    reason = f"which a quarter of the {seen_pixels // 4 * 4} pixels of {surface} can carry"
    sections = contact_sections(config)
    for section in sections:
        faults += _load_faults(section, seen_pixels // 4, grid.pixel_size, reason)
    for section in sections:
        contacts_per_side = get_key(config, section.count_key)
        if contacts_per_side > stitched_pixels:
            accepted = f"at most the {stitched_pixels} pixels along the stitched scan of {surface}"
            faults.append(key_fault(section.count_key, accepted, contacts_per_side))
    faults += _range_faults(
        "scales.range", config["scales"]["range"], radius, window, surface, grid
    )
    shortest = config["adhesion"]["ranges"][0]
    return faults + _range_faults("adhesion.ranges", shortest, radius, window, surface, grid)


def _pair_faults(config: dict[str, Any], surface: str, grid: Grid, sphere_grid: Grid) -> list[str]:
    """Return the faults on a scan of a substrate and a scan of the sphere, on common pixels."""
    faults = []
    window = config["contact"]["window"]
    pixel_size = min(grid.pixel_size, sphere_grid.pixel_size)
    pixels_along_window = window_pixels(window, pixel_size)
    bodies = f"{surface} and the sphere"
    if pixels_along_window > MAP_PIXELS:
        accepted = f"at most {MAP_PIXELS} pixels of {pixel_size:.4g} nm, on {bodies}"
        faults.append(key_fault("contact.window", accepted, pixels_along_window))
    faults += _map_faults(bodies, pixel_size, grid, sphere_grid)
    periods = periods_in_window(window, grid.size)
    for section in contact_sections(config):
        if section.name in ("contact", "sets"):
            faults += _contact_pixel_faults(config, section, surface, pixel_size, periods)
        if "indent.preloads" in section.contacts and surface == config["indent"]["surface"]:
            pixels = section.contacts["indent.preloads"].pixel_count(pixel_size)
            if not 2 <= pixels <= MAX_INDENT_PIXELS:
                accepted = (
                    f"2 to {MAX_INDENT_PIXELS} contact pixels of {pixel_size:.4g} nm at the largest"
                )
                faults.append(key_fault("indent.preloads", accepted, pixels))
    return faults


def _master_faults(
    config: dict[str, Any],
    section: ContactSection,
    side: str,
    surface: str,
    grid: Grid,
    sphere_grid: Grid,
) -> list[str]:
    """Return the faults on the masters of one side that are built on a surface."""
    keys = master_keys(config, section.name, side)
    pixels = get_key(config, keys["pixels"])
    tiles = get_key(config, keys["tiles"]) if "tiles" in keys else 1
    size = 2 * grid.size * tiles
    pixel_size = size / pixels
    # Only the size is that of the master, halved as in every Grid; pixels are those of the scan.
    master_grid = grid._replace(size=size / 2)
    faults = _master_pixel_faults(keys["pixels"], pixels, tiles, surface, grid)
    faults += _range_faults(
        "scales.range",
        config["scales"]["range"],
        section.smallest_radius,
        config["contact"]["window"],
        surface,
        master_grid,
    )
    faults += _penetration_faults(section, grid.relief)
    master = f"a master of {section.name}.{side} on {surface}"
    filtered_pixel_size = pixel_size if side == "small" else grid.pixel_size
    shortest_wavelengths = {"transition": grid.pixel_size, "cutoffs": filtered_pixel_size}
    for name, shortest in shortest_wavelengths.items():
        wavelengths = get_key(config, keys[name])
        faults += _wavelength_faults(keys[name], wavelengths, shortest, size, master)
    if section.name == "sets" or config["scales"]["sphere_roughness"]:
        pixel_size = min(pixel_size, sphere_grid.pixel_size)
        bodies = f"the {side}-scale masters of {surface} and the sphere"
        faults += _map_faults(bodies, pixel_size, master_grid, sphere_grid)
    return faults + _contact_pixel_faults(config, section, surface, pixel_size, 1)


def _master_pixel_faults(key: str, pixels: int, tiles: int, surface: str, grid: Grid) -> list[str]:
    """Return the faults of a master's pixels: fewer than its scans have, or beyond the memory."""
    faults = []
    min_pixels = 2 * grid.pixels * tiles
    if pixels < min_pixels:
        accepted = f"at least the {min_pixels} of {tiles} x {tiles} stitched scans of {surface}"
        faults.append(key_fault(key, accepted, pixels))
    return faults + memory_faults(key, pixels, machine_megabytes())


def memory_faults(key: str, pixels: int, available: int) -> list[str]:
    """Return the fault of a master larger than any map and than the memory (megabytes)."""
    needed = master_megabytes(pixels, 0)
    if pixels <= MAP_PIXELS or needed <= available:
        return []
    accepted = f"at most {MAP_PIXELS} on this machine of {available / 1e3:.3g} GB"
    return [key_fault(key, accepted, f"{pixels}, which take {needed / 1e3:.3g} GB")]


def _penetration_faults(section: ContactSection, relief: float) -> list[str]:
    """Return the faults of a range that is short relative to the penetration under each load."""
    faults = []
    for key, contact in section.contacts.items():
        depth = penetration_depth(contact, relief)
        min_rho = depth / PENETRATION_OVER_RANGE
        if contact.range < min_rho:
            accepted = (
                f"at least {min_rho:.3g} nm, as {key} presses the bodies some {depth:.3g} nm into "
                "each other"
            )
            faults.append(key_fault("scales.range", accepted, f"{contact.range:.4g} nm"))
    return faults


def _wavelength_faults(
    key: str, wavelengths: float | list[float], pixel_size: float, size: float, master: str
) -> list[str]:
    """Return the faults of wavelengths (nm) that a master, named in words, does not have."""
    faults = []
    accepted = (
        f"wavelengths of more than two pixels ({2 * pixel_size:.4g} nm) and at most the "
        f"{size:.6g} nm of {master}"
    )
    for wavelength in np.atleast_1d(wavelengths):
        # Exactly two pixels is refused with some margin, as `filters.lowpass` does.
        if not 2 * pixel_size * (1 + 1e-9) < wavelength <= size:
            faults.append(key_fault(key, accepted, f"{wavelength:.4g} nm"))
    return faults


def _range_faults(
    key: str, rho: float, radius: float, window: float, surface: str, grid: Grid
) -> list[str]:
    """Return the fault of a range of adhesion that pixels and relief of a surface forbid."""
    min_rho, reason = minimum_range(radius, window, grid)
    if rho >= min_rho:
        return []
    return [
        key_fault(key, f"at least {min_rho:g} nm on {surface}, where {reason}", f"{rho:.4g} nm")
    ]


def _map_faults(bodies: str, pixel_size: float, *grids: Grid) -> list[str]:
    """Return the fault of stitched maps that are too large on the pixels (nm) of the finest map."""
    pixels = round(max(2 * grid.size for grid in grids) / pixel_size)
    if pixels <= MAP_PIXELS:
        return []
    accepted = (
        f"at most {MAP_PIXELS} pixels along a side of {bodies} on common pixels of "
        f"{pixel_size:.4g} nm"
    )
    return [key_fault("surfaces and scan", accepted, pixels)]


def _contact_pixel_faults(
    config: dict[str, Any], section: ContactSection, surface: str, pixel_size: float, periods: float
) -> list[str]:
    """Return the faults of loads whose contact pixels do not fit into memory at once.

    Each pixel (side in nm) lies `periods` times in the window.
    """
    contacts_per_side = get_key(config, section.count_key)
    reason = (
        f"with which the contact pixels of {pixel_size:.4g} nm on {surface} fit into memory at "
        f"{section.count_key} = {contacts_per_side} and contact.window = "
        f"{config['contact']['window']:.6g} nm"
    )
    available_pixels = int(CONTACT_PIXELS / contacts_per_side**2 / periods)
    return _load_faults(section, available_pixels, pixel_size, reason)


def _load_faults(
    section: ContactSection, available_pixels: int, pixel_size: float, reason: str
) -> list[str]:
    """Return the fault of each load with more contact pixels (side in nm) than are available."""
    faults = []
    for key, contact in section.contacts.items():
        if contact.pixel_count(pixel_size) > available_pixels:
            max_load = available_pixels * (pixel_size * 1e-9) ** 2 * contact.hardness
            accepted = (
                f"at most {format_quantity(max_load, 'N')} of load at a hardness of "
                f"{contact.hardness / 1e9:.4g} GPa, {reason}"
            )
            faults.append(key_fault(key, accepted, format_quantity(contact.preload, "N")))
    return faults
