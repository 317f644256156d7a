"""Limits of keys that follow from the pixels of scans.

Each surface, pair of surfaces and master has a list of limits, met or not. The first limit of a
list that does not hold is reported.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from itertools import islice, product
from typing import Any, NamedTuple

import numpy as np

from hardcontact.base.formatting import format_quantity
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

#: Largest number of contact pixels of one contact for indents: all pairs of them are compared.
MAX_INDENT_PIXELS = 2**12


class RangeUse(NamedTuple):
    """A range of adhesion that a section computes, with the sphere for which it is least safe."""

    key: str  #: The key that gives the range.
    rho: float  #: Shortest range of adhesion in nm.
    radius: float  #: Smallest radius of a sphere in nm.


@dataclass(frozen=True)
class Use:
    """The contacts that a section of the configuration computes on scans or masters."""

    section: str
    count_key: str  #: The key of the contacts along a side of the array.
    loads: dict[str, Contact]  #: By key: the contact with the largest load that the key gives.
    shortest_range: RangeUse


def contact_uses(config: dict[str, Any]) -> list[Use]:
    """Return the sections of a study that compute contacts: on scans (the first), on masters."""
    contact = study_contact(config)
    loads = {"contact.preload": contact}
    range_use = RangeUse("scales.range", contact.range, contact.radius)
    uses = [Use(section, "contact.count", loads, range_use) for section in ("contact", "scales")]
    if config["published"] != PAPER:
        return uses
    indented = replace(contact, preload=config["indent"]["preloads"][-1])
    robustness = config["robustness"]
    varied_loads = dict(loads)
    for preload in robustness["preloads"][-1:]:
        varied_loads["robustness.preloads"] = replace(contact, preload=preload)
    for hardness in robustness["hardnesses"][:1]:
        varied_loads["robustness.hardnesses"] = replace(contact, hardness=hardness)
    section = "insight.scaling"
    scaling = config["insight"]["scaling"]
    scaled = replace(contact, preload=scaling["preloads"][-1])
    scaling_range = RangeUse(f"{section}.ranges", scaling["ranges"][0], scaling["radii"][0])
    return [
        replace(uses[0], loads=loads | {"indent.preloads": indented}),
        uses[1],
        Use("sets", "sets.count", varied_loads, range_use),
        Use("insight", "insight.count", loads, range_use),
        Use(section, "insight.count", {f"{section}.preloads": scaled}, scaling_range),
    ]


def check_grids(config: dict[str, Any], grids: Mapping[str, Grid]) -> None:
    """Refuse values that the pixels of scans, a grid for each surface, do not permit.

    The configuration has quantities as numbers. Raises ValueError with a line for each fault, which
    names the key.
    """
    sphere_surface = config["sphere"]["surface"]
    _, *master_uses = contact_uses(config)
    limit_lists = [scan_limits(config, surface, grid) for surface, grid in grids.items()]
    for surface, grid in grids.items():
        if surface != sphere_surface:
            sphere_grid = grids.get(sphere_surface, grid)  # for a smooth sphere: the substrate's
            limit_lists.append(_pair_limits(config, surface, grid, sphere_grid))
            limit_lists += [
                _master_limits(config, use, side, surface, grid, sphere_grid)
                for use, side in product(master_uses, SIDES)
            ]
    first_messages = (islice(violation_messages(limits), 1) for limits in limit_lists)
    refuse_all(partial(refuse_lines, messages) for messages in first_messages)


def window_images(window: float, size: float) -> float:
    """Return the number of images of a stitched scan that a window holds (edges in nm)."""
    return max(1.0, window / (2 * size)) ** 2


def max_contact_pixels(window: float, grid: Grid) -> int:
    """Return how many pixels may carry a load: a quarter of a stitched scan in a window (nm)."""
    return min(window_pixels(window, grid.pixel_size), 2 * grid.pixels) ** 2 // 4


def penetration_depth(contact: Contact, relief: float) -> float:
    """Return the penetration (nm) of the bodies under a load, at most their relief (nm).

    A contact on slopes near one is about as deep as it is wide.
    """
    return min(math.sqrt(contact.preload / contact.hardness) * 1e9, relief)


def scan_limits(config: dict[str, Any], surface: str, grid: Grid) -> Iterator[Limit]:
    """Yield the limits of the scans of a surface: loads, numbers of contacts, ranges."""
    uses = contact_uses(config)
    window = config["contact"]["window"]
    radius = config["sphere"]["radius"]
    stitched_pixels = 2 * grid.pixels
    if surface == config["sphere"].get("surface"):
        accepted = f"at least the size of its scans ({grid.size:.6g} nm)"
        yield Limit(radius >= grid.size, "sphere.radius", accepted, f"{radius:.6g} nm")
    available = max_contact_pixels(window, grid)
    reason = f"which a quarter of the {4 * available} pixels of {surface} can carry"
    for use in uses:
        yield from _load_limits(use, available, grid.pixel_size, reason)
    accepted = f"at most the {stitched_pixels} pixels along the stitched scan of {surface}"
    for use in uses:
        count = get_key(config, use.count_key)
        yield Limit(count <= stitched_pixels, use.count_key, accepted, count)
    ranges = {"scales.range": config["scales"]["range"]}
    ranges["adhesion.ranges"] = config["adhesion"]["ranges"][0]
    if config["published"] == PAPER:
        ranges["insight.ranges"] = config["insight"]["ranges"][0]
    for key, rho in ranges.items():
        yield _range_limit(window, RangeUse(key, rho, radius), surface, grid)


def _pair_limits(
    config: dict[str, Any], surface: str, grid: Grid, sphere_grid: Grid
) -> Iterator[Limit]:
    """Yield the limits of a scan of a substrate and a scan of the sphere, on common pixels."""
    window = config["contact"]["window"]
    pixel_size = min(grid.pixel_size, sphere_grid.pixel_size)
    pixels = window_pixels(window, pixel_size)
    surfaces_in_words = f"{surface} and the sphere"
    accepted = f"at most {MAP_PIXELS} pixels of {pixel_size:.4g} nm, on {surfaces_in_words}"
    yield Limit(pixels <= MAP_PIXELS, "contact.window", accepted, pixels)
    yield _map_limit(surfaces_in_words, pixel_size, grid, sphere_grid)
    images = window_images(window, grid.size)
    for use in contact_uses(config):
        if use.section in ("contact", "sets"):
            yield from _contact_pixel_limits(config, use, surface, pixel_size, images)
        if "indent.preloads" in use.loads and surface == config["indent"]["surface"]:
            pixels = use.loads["indent.preloads"].pixels(pixel_size)
            fits = 2 <= pixels <= MAX_INDENT_PIXELS
            accepted = (
                f"2 to {MAX_INDENT_PIXELS} contact pixels of {pixel_size:.4g} nm at the largest"
            )
            yield Limit(fits, "indent.preloads", accepted, pixels)


def _master_limits(
    config: dict[str, Any], use: Use, side: str, surface: str, grid: Grid, sphere_grid: Grid
) -> Iterator[Limit]:
    """Yield the limits of the masters of one side that are built on a surface."""
    keys = master_keys(config, use.section, side)
    values = {name: get_key(config, key) for name, key in keys.items()}
    pixels = values["pixels"]
    tiles = values.get("tiles", 1)
    size = 2 * grid.size * tiles
    min_pixels = 2 * grid.pixels * tiles
    master_pixel_size = size / pixels
    # A grid describes a scan, half as large as its periodic map; the pixels of this one are unused.
    master_grid = grid._replace(size=size / 2)
    accepted = f"at least the {min_pixels} of {tiles} x {tiles} stitched scans of {surface}"
    yield Limit(pixels >= min_pixels, keys["pixels"], accepted, pixels)
    yield memory_limit(keys["pixels"], pixels, machine_megabytes())
    yield _range_limit(config["contact"]["window"], use.shortest_range, surface, master_grid)
    if use.section in ("scales", "sets"):  # These sections compute at `scales.range` alone.
        for key, contact in use.loads.items():
            depth = penetration_depth(contact, grid.relief)
            allowed_rho = depth / PENETRATION_OVER_RANGE
            depth_reason = f"as {key} presses the bodies some {depth:.3g} nm into each other"
            accepted = f"at least {allowed_rho:.3g} nm, {depth_reason}"
            is_long = contact.range >= allowed_rho
            yield Limit(is_long, use.shortest_range.key, accepted, f"{contact.range:.4g} nm")
    cutoff_pixel_size = master_pixel_size if side == "small" else grid.pixel_size
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
    pixel_size = master_pixel_size
    if use.section == "sets" or config["scales"]["sphere_roughness"]:
        pixel_size = min(master_pixel_size, sphere_grid.pixel_size)
        surfaces_in_words = f"the {side}-scale masters of {surface} and the sphere"
        yield _map_limit(surfaces_in_words, pixel_size, master_grid, sphere_grid)
    yield from _contact_pixel_limits(config, use, surface, pixel_size, 1)


def _range_limit(window: float, range_use: RangeUse, surface: str, grid: Grid) -> Limit:
    """Return the limit of a range of adhesion for the pixels and the relief of a surface."""
    key, rho, radius = range_use
    allowed_rho, reason = minimum_range(radius, window, grid)
    accepted = f"at least {allowed_rho:g} nm on {surface}, where {reason}"
    return Limit(rho >= allowed_rho, key, accepted, f"{rho:.4g} nm")


def _map_limit(surfaces_in_words: str, pixel_size: float, *grids: Grid) -> Limit:
    """Return the limit of stitched maps on the pixels (nm) of the finest map."""
    pixels = round(max(2 * grid.size for grid in grids) / pixel_size)
    accepted = (
        f"at most {MAP_PIXELS} pixels along a side of {surfaces_in_words} on common pixels of "
        f"{pixel_size:.4g} nm"
    )
    return Limit(pixels <= MAP_PIXELS, "surfaces and scan", accepted, pixels)


def _contact_pixel_limits(
    config: dict[str, Any], use: Use, surface: str, pixel_size: float, images: float
) -> Iterator[Limit]:
    """Yield the limits of loads for the contact pixels that are in memory at once.

    Each pixel (edge in nm) has `images` periodic images in the window.
    """
    count = get_key(config, use.count_key)
    window = config["contact"]["window"]
    reason = (
        f"with which the contact pixels of {pixel_size:.4g} nm on {surface} fit into memory at "
        f"{use.count_key} = {count} and contact.window = {window:.6g} nm"
    )
    yield from _load_limits(use, int(CONTACT_PIXELS / count**2 / images), pixel_size, reason)


def _load_limits(use: Use, available: int, pixel_size: float, reason: str) -> Iterator[Limit]:
    """Yield the limit of every load to the contact pixels (edge in nm) that are available."""
    for key, contact in use.loads.items():
        largest = available * (pixel_size * 1e-9) ** 2 * contact.hardness
        accepted = (
            f"at most {format_quantity(largest, 'N')} of load at a hardness of "
            f"{contact.hardness / 1e9:.4g} GPa, {reason}"
        )
        holds = contact.pixels(pixel_size) <= available
        yield Limit(holds, key, accepted, format_quantity(contact.preload, "N"))
