"""Limits of keys that follow from the pixels of scans.

Each surface, pair of surfaces and master has a list of limits. The first unmet one is reported.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from itertools import islice, product
from typing import Any

import numpy as np

from hardcontact.base.printing import print_quantity
from hardcontact.config.configuration import get_key, master_keys
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
from hardcontact.config.variants import study_contact
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import window_pixels
from hardcontact.surfaces.synthesis import SIDES

#: Contact pixels of one indent, which are compared with each other.
INDENT_PIXELS = 2**12


@dataclass(frozen=True)
class Use:
    """One use of scans and masters by a section of the configuration."""

    section: str
    count: str  #: The key of the contacts along an edge of the array.
    loads: dict[str, Contact]  #: The contact with the largest load of each key.
    range: tuple[str, float, float]  #: Key, shortest range and smallest radius of spheres in nm.


def scan_uses(config: dict[str, Any]) -> list[Use]:
    """Return the uses of scans and masters by a study: scans first, then masters."""
    contact = study_contact(config)
    loads, ranges = {"contact.preload": contact}, ("scales.range", contact.range, contact.radius)
    uses = [Use(section, "contact.count", loads, ranges) for section in ("contact", "scales")]
    if config["published"] != PAPER:
        return uses
    indented = replace(contact, preload=config["indent"]["preloads"][-1])
    varied_loads, robustness = dict(loads), config["robustness"]
    for preload in robustness["preloads"][-1:]:
        varied_loads["robustness.preloads"] = replace(contact, preload=preload)
    for hardness in robustness["hardnesses"][:1]:
        varied_loads["robustness.hardnesses"] = replace(contact, hardness=hardness)
    scaling, section = config["insight"]["scaling"], "insight.scaling"
    scaled = replace(contact, preload=scaling["preloads"][-1])
    shortest = (f"{section}.ranges", scaling["ranges"][0], scaling["radii"][0])
    return [
        replace(uses[0], loads=loads | {"indent.preloads": indented}),
        uses[1],
        Use("sets", "sets.count", varied_loads, ranges),
        Use("insight", "insight.count", loads, ranges),
        Use(section, "insight.count", {f"{section}.preloads": scaled}, shortest),
    ]


def check_grids(config: dict[str, Any], grids: Mapping[str, Grid]) -> None:
    """Refuse values that the pixels of scans, a grid for each surface, do not permit.

    The configuration has quantities as numbers. Raises ValueError with a line for each fault, which
    names the key.
    """
    name, uses = config["sphere"]["surface"], scan_uses(config)
    tables = [scan_limits(config, surface, grid) for surface, grid in grids.items()]
    for surface, grid in grids.items():
        if surface != name:
            sphere = grids.get(name, grid)  # A smooth sphere has the pixels of what it meets.
            tables.append(_pair_limits(config, surface, grid, sphere))
            tables += [
                _master_limits(config, use, side, surface, grid, sphere)
                for use, side in product(uses[1:], SIDES)
            ]
    refuse_all(partial(refuse_lines, islice(violation_messages(limits), 1)) for limits in tables)


def window_images(window: float, size: float) -> float:
    """Return the number of images of a stitched scan that a window holds (edges in nm)."""
    return max(1.0, window / (2 * size)) ** 2


def carrying_pixels(window: float, grid: Grid) -> int:
    """Return the pixels of a stitched scan in a window (nm) that may carry a load: a quarter."""
    return min(window_pixels(window, grid.pixel_size), 2 * grid.pixels) ** 2 // 4


def penetration_depth(contact: Contact, relief: float) -> float:
    """Return the penetration (nm) of the bodies under a load, at most their relief (nm).

    A contact on slopes near one is about as deep as it is wide.
    """
    return min(math.sqrt(contact.preload / contact.hardness) * 1e9, relief)


def scan_limits(config: dict[str, Any], surface: str, grid: Grid) -> Iterator[Limit]:
    """Yield the limits of the scans of a surface: loads, numbers of contacts, ranges."""
    uses, window, stitched = scan_uses(config), config["contact"]["window"], 2 * grid.pixels
    radius = config["sphere"]["radius"]
    if surface == config["sphere"].get("surface"):
        accepted = f"at least the size of its scans ({grid.size:.6g} nm)"
        yield Limit(radius >= grid.size, "sphere.radius", accepted, f"{radius:.6g} nm")
    available = carrying_pixels(window, grid)
    reason = f"which a quarter of the {4 * available} pixels of {surface} can carry"
    for use in uses:
        yield from _load_limits(use, available, grid.pixel_size, reason)
    accepted = f"at most the {stitched} pixels along the stitched scan of {surface}"
    for use in uses:
        count = get_key(config, use.count)
        yield Limit(count <= stitched, use.count, accepted, count)
    ranges = {"scales.range": config["scales"]["range"]}
    ranges["adhesion.ranges"] = config["adhesion"]["ranges"][0]
    if config["published"] == PAPER:
        ranges["insight.ranges"] = config["insight"]["ranges"][0]
    for key, rho in ranges.items():
        yield _range_limit(window, (key, rho, radius), surface, grid)


def _pair_limits(config: dict[str, Any], surface: str, grid: Grid, sphere: Grid) -> Iterator[Limit]:
    """Yield the limits of a scan of a substrate and a scan of the sphere, on common pixels."""
    edge, pixel_size = config["contact"]["window"], min(grid.pixel_size, sphere.pixel_size)
    window, surfaces_in_words = window_pixels(edge, pixel_size), f"{surface} and the sphere"
    accepted = f"at most {MAP_PIXELS} pixels of {pixel_size:.4g} nm, on {surfaces_in_words}"
    yield Limit(window <= MAP_PIXELS, "contact.window", accepted, window)
    yield _map_limit(surfaces_in_words, pixel_size, grid, sphere)
    images = window_images(edge, grid.size)
    for use in scan_uses(config):
        if use.section in ("contact", "sets"):
            yield from _contact_pixel_limits(config, use, surface, pixel_size, images)
        if "indent.preloads" in use.loads and surface == config["indent"]["surface"]:
            pixels = use.loads["indent.preloads"].pixels(pixel_size)
            accepted = f"2 to {INDENT_PIXELS} contact pixels of {pixel_size:.4g} nm at the largest"
            yield Limit(2 <= pixels <= INDENT_PIXELS, "indent.preloads", accepted, pixels)


def _master_limits(
    config: dict[str, Any], use: Use, side: str, surface: str, grid: Grid, sphere: Grid
) -> Iterator[Limit]:
    """Yield the limits of the masters of one side that are built on a surface."""
    keys = master_keys(config, use.section, side)
    values = {name: get_key(config, key) for name, key in keys.items()}
    pixels, tiles = values["pixels"], values.get("tiles", 1)
    size, needed = 2 * grid.size * tiles, 2 * grid.pixels * tiles
    master, finest = grid._replace(size=size / 2), size / pixels
    accepted = f"at least the {needed} of {tiles} x {tiles} stitched scans of {surface}"
    yield Limit(pixels >= needed, keys["pixels"], accepted, pixels)
    yield memory_limit(keys["pixels"], pixels, machine_megabytes())
    yield _range_limit(config["contact"]["window"], use.range, surface, master)
    if use.section in ("scales", "sets"):  # Those that are computed at `scales.range` alone.
        for key, contact in use.loads.items():
            depth = penetration_depth(contact, grid.relief)
            shortest = depth / PENETRATION_OVER_RANGE
            depth_reason = f"as {key} presses the bodies some {depth:.3g} nm into each other"
            accepted = f"at least {shortest:.3g} nm, {depth_reason}"
            yield Limit(
                contact.range >= shortest, use.range[0], accepted, f"{contact.range:.4g} nm"
            )
    cutoff_pixel_size = finest if side == "small" else grid.pixel_size
    for name, pixel_size in (("transition", grid.pixel_size), ("cutoffs", cutoff_pixel_size)):
        # Exactly two pixels is refused with some margin, as `filters.lowpass` does.
        wavelengths = np.atleast_1d(values[name])
        accepted = (
            f"wavelengths of more than two pixels ({2 * pixel_size:.4g} nm) and at most the "
            f"{size:.6g} nm of a master of {use.section}.{side} on {surface}"
        )
        for wavelength in wavelengths:
            fits = 2 * pixel_size * (1 + 1e-9) < wavelength <= size
            yield Limit(fits, keys[name], accepted, f"{wavelength:.4g} nm")
    if use.section == "sets" or config["scales"]["sphere_roughness"]:
        finest = min(finest, sphere.pixel_size)
        surfaces_in_words = f"the {side}-scale masters of {surface} and the sphere"
        yield _map_limit(surfaces_in_words, finest, master, sphere)
    yield from _contact_pixel_limits(config, use, surface, finest, 1)


def _range_limit(
    window: float, shortest: tuple[str, float, float], surface: str, grid: Grid
) -> Limit:
    """Return the limit of a range of adhesion for the pixels and the relief of a surface."""
    key, rho, radius = shortest
    shortest_rho, reason = minimum_range(radius, window, grid)
    accepted = f"at least {shortest_rho:g} nm on {surface}, where {reason}"
    return Limit(rho >= shortest_rho, key, accepted, f"{rho:.4g} nm")


def _map_limit(surfaces_in_words: str, pixel_size: float, *grids: Grid) -> Limit:
    """Return the limit of stitched maps on the pixels (nm) of the finest map."""
    pixels = round(max(2 * grid.size for grid in grids) / pixel_size)
    accepted = (
        f"at most {MAP_PIXELS} pixels along an edge of {surfaces_in_words} on common pixels of "
        f"{pixel_size:.4g} nm"
    )
    return Limit(pixels <= MAP_PIXELS, "surfaces and scan", accepted, pixels)


def _contact_pixel_limits(
    config: dict[str, Any], use: Use, surface: str, pixel_size: float, images: float
) -> Iterator[Limit]:
    """Yield the limits of loads for the contact pixels that are in memory at once.

    Each pixel (edge in nm) has `images` periodic images in the window.
    """
    count, window = get_key(config, use.count), config["contact"]["window"]
    reason = (
        f"with which the contact pixels of {pixel_size:.4g} nm on {surface} fit into memory at "
        f"{use.count} = {count} and contact.window = {window:.6g} nm"
    )
    yield from _load_limits(use, int(CONTACT_PIXELS / count**2 / images), pixel_size, reason)


def _load_limits(use: Use, available: int, pixel_size: float, reason: str) -> Iterator[Limit]:
    """Yield the limit of every load to the contact pixels (edge in nm) that are available."""
    for key, contact in use.loads.items():
        largest = available * (pixel_size * 1e-9) ** 2 * contact.hardness
        accepted = (
            f"at most {print_quantity(largest, 'N')} of load at a hardness of "
            f"{contact.hardness / 1e9:.4g} GPa, {reason}"
        )
        holds = contact.pixels(pixel_size) <= available
        yield Limit(holds, key, accepted, print_quantity(contact.preload, "N"))
