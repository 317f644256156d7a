"""Limits of keys that follow from the pixels of scans.

Each surface, each substrate with the sphere, and each master has a list of limits. Of each list
only the first limit that does not hold is reported: later limits may assume the earlier ones.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from itertools import islice, product
from typing import Any, NamedTuple

import numpy as np

from hardcontact.base.formatting import format_quantity
from hardcontact.config.configuration import get_key, master_keys, study_contact
from hardcontact.config.faults import Limit, refuse_all, refuse_lines, violation_messages
from hardcontact.config.grids import (
    CONTACT_PIXELS,
    MAP_PIXELS,
    PENETRATION_OVER_RANGE,
    Grid,
    machine_megabytes,
    memory_limit,
    minimum_range,
)
from hardcontact.config.model import PAPER
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import window_pixels
from hardcontact.surfaces.synthesis import SIDES

#: Largest number of contact pixels of one contact for indents: all pairs of them are compared.
MAX_INDENT_PIXELS = 2**12


class SmallestCase(NamedTuple):
    """The shortest range of adhesion and the smallest sphere that a section computes."""

    key: str  #: The key that gives the range.
    rho: float  #: Shortest range of adhesion in nm.
    radius: float  #: Smallest radius of a sphere in nm.


@dataclass(frozen=True)
class ContactSection:
    """The contacts that a section of the configuration computes on scans or masters."""

    name: str
    count_key: str  #: The key of the contacts along a side of the array.
    #: The contact with the largest area, for each key that varies contacts.
    largest_contacts: dict[str, Contact]
    smallest_case: SmallestCase


def contact_sections(config: dict[str, Any]) -> list[ContactSection]:
    """Return the sections that compute contacts.

    The first one, `contact`, computes on scans alone, `sets` on scans and masters, and all others
    on masters.
    """
    contact = study_contact(config)
    largest_contacts = {"contact.preload": contact}
    smallest_case = SmallestCase("scales.range", contact.range, contact.radius)
    sections = [
        ContactSection(section, "contact.count", largest_contacts, smallest_case)
        for section in ("contact", "scales")
    ]
    if config["published"] != PAPER:
        return sections
    indent_contact = replace(contact, preload=config["indent"]["preloads"][-1])
    scaling = config["scaling"]
    scaling_contact = replace(contact, preload=scaling["preloads"][-1])
    smallest_scaling_case = SmallestCase(
        "scaling.ranges", scaling["ranges"][0], scaling["radii"][0]
    )
    return [
        replace(
            sections[0], largest_contacts=largest_contacts | {"indent.preloads": indent_contact}
        ),
        sections[1],
        ContactSection("sets", "sets.count", largest_contacts, smallest_case),
        ContactSection(
            "scaling",
            "scaling.count",
            {"scaling.preloads": scaling_contact},
            smallest_scaling_case,
        ),
    ]


def check_grids(config: dict[str, Any], grids: Mapping[str, Grid]) -> None:
    """Refuse values that the pixels of scans do not permit; `grids` maps each surface to its grid.

    Quantities in `config` are numbers in the units of the study. Raises ValueError with a line for
    each fault, which names the key.
    """
    sphere_surface = config["sphere"]["surface"]
    _, *master_sections = contact_sections(config)
    limit_lists = [scan_limits(config, surface, grid) for surface, grid in grids.items()]
    for surface, grid in grids.items():
        if surface != sphere_surface:
            sphere_grid = grids.get(sphere_surface, grid)  # for a smooth sphere: the substrate's
            limit_lists.append(_substrate_and_sphere_limits(config, surface, grid, sphere_grid))
            limit_lists += [
                _master_limits(config, section, side, surface, grid, sphere_grid)
                for section, side in product(master_sections, SIDES)
            ]
    refuse_all(partial(_refuse_first_violation, limits) for limits in limit_lists)


def _refuse_first_violation(limits: Iterator[Limit]) -> None:
    """Raise ValueError with the first limit of a list that does not hold."""
    refuse_lines(islice(violation_messages(limits), 1))


def periods_in_window(window: float, scan_size: float) -> float:
    """Return the number of periods of a stitched scan within a window.

    The sides of the window and of the scan before stitching are in nm.
    """
    return max(1.0, window / (2 * scan_size)) ** 2


def max_contact_pixel_count(window: float, grid: Grid) -> int:
    """Return the largest number of contact pixels.

    It is a quarter of the pixels of the window (nm), or of the stitched scan if it is smaller.
    """
    return min(window_pixels(window, grid.pixel_size), 2 * grid.pixels) ** 2 // 4


def penetration_depth(contact: Contact, relief: float) -> float:
    """Return an estimate of the penetration (nm) of the bodies under a load.

    It is the side of the contact area: on slopes near one, a contact is about as deep as it is
    wide. It is at most the relief, the highest minus the lowest height (nm).
    """
    return min(math.sqrt(contact.preload / contact.hardness) * 1e9, relief)


def scan_limits(config: dict[str, Any], surface: str, grid: Grid) -> Iterator[Limit]:
    """Yield the limits of the scans of a surface: loads, numbers of contacts, ranges."""
    sections = contact_sections(config)
    window = config["contact"]["window"]
    radius = config["sphere"]["radius"]
    stitched_pixels = 2 * grid.pixels
    if surface == config["sphere"].get("surface"):
        accepted = f"at least the size of its scans ({grid.size:.6g} nm)"
        yield Limit(radius >= grid.size, "sphere.radius", accepted, f"{radius:.6g} nm")
    available_pixels = max_contact_pixel_count(window, grid)
    reason = f"which a quarter of the {4 * available_pixels} pixels of {surface} can carry"
    for section in sections:
        yield from _load_limits(section, available_pixels, grid.pixel_size, reason)
    accepted = f"at most the {stitched_pixels} pixels along the stitched scan of {surface}"
    for section in sections:
        contacts_per_side = get_key(config, section.count_key)
        holds = contacts_per_side <= stitched_pixels
        yield Limit(holds, section.count_key, accepted, contacts_per_side)
    ranges = {"scales.range": config["scales"]["range"]}
    ranges["adhesion.ranges"] = config["adhesion"]["ranges"][0]
    for key, rho in ranges.items():
        yield _range_limit(window, SmallestCase(key, rho, radius), surface, grid)


def _substrate_and_sphere_limits(
    config: dict[str, Any], surface: str, grid: Grid, sphere_grid: Grid
) -> Iterator[Limit]:
    """Yield the limits of a scan of a substrate and a scan of the sphere, on common pixels."""
    window = config["contact"]["window"]
    pixel_size = min(grid.pixel_size, sphere_grid.pixel_size)
    pixels_along_window = window_pixels(window, pixel_size)
    surfaces_in_words = f"{surface} and the sphere"
    accepted = f"at most {MAP_PIXELS} pixels of {pixel_size:.4g} nm, on {surfaces_in_words}"
    yield Limit(pixels_along_window <= MAP_PIXELS, "contact.window", accepted, pixels_along_window)
    yield _map_limit(surfaces_in_words, pixel_size, grid, sphere_grid)
    periods = periods_in_window(window, grid.size)
    for section in contact_sections(config):
        if section.name in ("contact", "sets"):
            yield from _contact_pixel_limits(config, section, surface, pixel_size, periods)
        if "indent.preloads" in section.largest_contacts and surface == config["indent"]["surface"]:
            contact_pixel_count = section.largest_contacts["indent.preloads"].pixel_count(
                pixel_size
            )
            fits = 2 <= contact_pixel_count <= MAX_INDENT_PIXELS
            accepted = (
                f"2 to {MAX_INDENT_PIXELS} contact pixels of {pixel_size:.4g} nm at the largest"
            )
            yield Limit(fits, "indent.preloads", accepted, contact_pixel_count)


def _master_limits(
    config: dict[str, Any],
    section: ContactSection,
    side: str,
    surface: str,
    grid: Grid,
    sphere_grid: Grid,
) -> Iterator[Limit]:
    """Yield the limits of the masters of one side that are built on a surface."""
    keys = master_keys(config, section.name, side)
    values = {name: get_key(config, key) for name, key in keys.items()}
    pixels = values["pixels"]
    tiles = values.get("tiles", 1)
    size = 2 * grid.size * tiles
    min_pixels = 2 * grid.pixels * tiles
    master_pixel_size = size / pixels
    # Only the size is that of the master, halved as in every Grid; pixels are those of the scan.
    master_grid = grid._replace(size=size / 2)
    accepted = f"at least the {min_pixels} of {tiles} x {tiles} stitched scans of {surface}"
    yield Limit(pixels >= min_pixels, keys["pixels"], accepted, pixels)
    yield memory_limit(keys["pixels"], pixels, machine_megabytes())
    yield _range_limit(config["contact"]["window"], section.smallest_case, surface, master_grid)
    if section.name in ("scales", "sets"):  # These sections compute at `scales.range` alone.
        for key, contact in section.largest_contacts.items():
            depth = penetration_depth(contact, grid.relief)
            min_rho = depth / PENETRATION_OVER_RANGE
            depth_reason = f"as {key} presses the bodies some {depth:.3g} nm into each other"
            accepted = f"at least {min_rho:.3g} nm, {depth_reason}"
            is_long_enough = contact.range >= min_rho
            yield Limit(
                is_long_enough, section.smallest_case.key, accepted, f"{contact.range:.4g} nm"
            )
    cutoff_pixel_size = master_pixel_size if side == "small" else grid.pixel_size
    for name, pixel_size in (("transition", grid.pixel_size), ("cutoffs", cutoff_pixel_size)):
        # Exactly two pixels is refused with some margin, as `filters.lowpass` does.
        wavelengths = np.atleast_1d(values.get(name, []))
        accepted = (
            f"wavelengths of more than two pixels ({2 * pixel_size:.4g} nm) and at most the "
            f"{size:.6g} nm of a master of {section.name}.{side} on {surface}"
        )
        for wavelength in wavelengths:
            fits = 2 * pixel_size * (1 + 1e-9) < wavelength <= size
            yield Limit(fits, keys[name], accepted, f"{wavelength:.4g} nm")
    pixel_size = master_pixel_size
    if section.name == "sets" or config["scales"]["sphere_roughness"]:
        pixel_size = min(master_pixel_size, sphere_grid.pixel_size)
        surfaces_in_words = f"the {side}-scale masters of {surface} and the sphere"
        yield _map_limit(surfaces_in_words, pixel_size, master_grid, sphere_grid)
    yield from _contact_pixel_limits(config, section, surface, pixel_size, 1)


def _range_limit(window: float, smallest_case: SmallestCase, surface: str, grid: Grid) -> Limit:
    """Return the limit of a range of adhesion for the pixels and the relief of a surface."""
    key, rho, radius = smallest_case
    min_rho, reason = minimum_range(radius, window, grid)
    accepted = f"at least {min_rho:g} nm on {surface}, where {reason}"
    return Limit(rho >= min_rho, key, accepted, f"{rho:.4g} nm")


def _map_limit(surfaces_in_words: str, pixel_size: float, *grids: Grid) -> Limit:
    """Return the limit of stitched maps on the pixels (nm) of the finest map."""
    pixels = round(max(2 * grid.size for grid in grids) / pixel_size)
    accepted = (
        f"at most {MAP_PIXELS} pixels along a side of {surfaces_in_words} on common pixels of "
        f"{pixel_size:.4g} nm"
    )
    return Limit(pixels <= MAP_PIXELS, "surfaces and scan", accepted, pixels)


def _contact_pixel_limits(
    config: dict[str, Any], section: ContactSection, surface: str, pixel_size: float, periods: float
) -> Iterator[Limit]:
    """Yield the limits of loads for the contact pixels that are in memory at once.

    Each pixel (side in nm) lies `periods` times in the window.
    """
    contacts_per_side = get_key(config, section.count_key)
    window = config["contact"]["window"]
    reason = (
        f"with which the contact pixels of {pixel_size:.4g} nm on {surface} fit into memory at "
        f"{section.count_key} = {contacts_per_side} and contact.window = {window:.6g} nm"
    )
    available_pixels = int(CONTACT_PIXELS / contacts_per_side**2 / periods)
    yield from _load_limits(section, available_pixels, pixel_size, reason)


def _load_limits(
    section: ContactSection, available_pixels: int, pixel_size: float, reason: str
) -> Iterator[Limit]:
    """Yield the limit of each contact: as many contact pixels (side in nm) as are available."""
    for key, contact in section.largest_contacts.items():
        max_load = available_pixels * (pixel_size * 1e-9) ** 2 * contact.hardness
        accepted = (
            f"at most {format_quantity(max_load, 'N')} of load at a hardness of "
            f"{contact.hardness / 1e9:.4g} GPa, {reason}"
        )
        holds = contact.pixel_count(pixel_size) <= available_pixels
        yield Limit(holds, key, accepted, format_quantity(contact.preload, "N"))
