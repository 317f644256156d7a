"""What the pixels of scans permit a study to compute, as limits of its keys.

Scans of a surface, their pairs with those of the sphere, and masters of one side and section each
have a table of limits, of which the first that does not hold is told.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import partial
from itertools import islice, product
from typing import Any

import numpy as np

from hardcontact.config.configuration import at
from hardcontact.config.faults import Limit, refuse_all, refuse_lines, unmet
from hardcontact.config.grids import (
    CONTACT_PIXELS,
    MAP_PIXELS,
    PENETRATION_OVER_RANGE,
    Grid,
    least_range,
    machine_megabytes,
    refuse_beyond_memory,
)
from hardcontact.config.model import PAPER
from hardcontact.config.variants import study_contact
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import window_pixels
from hardcontact.contact.smooth_sphere import effective_modulus
from hardcontact.numbers.printing import print_quantity
from hardcontact.surfaces.synthesis import SIDES

#: Contact pixels of one indent, which are compared with each other.
INDENT_PIXELS = 2**12
#: Upper bound on the mean pressure of an elastic contact over the effective modulus: peaks of the
#: pressure are a hundred times higher, and the solver assumes small strains.
PRESSURE_OVER_MODULUS = 0.01


def check_grids(config: dict[str, Any], grids: Mapping[str, Grid]) -> None:
    """Refuse what the pixels of scans, a grid for each surface, do not permit.

    A ValueError has one line a fault, naming the key of the configuration, which is of numbers.
    """
    name, radius = config["sphere"]["surface"], config["sphere"]["radius"]
    if name in grids and radius < grids[name].size:
        raise ValueError(
            "config key sphere.radius: expected at least the size of its scans "
            f"({grids[name].size:.6g} nm), found {radius:.6g} nm"
        )
    on_pair, sections = [_of_pair], ["scales"]
    if config["published"] == PAPER:
        on_pair = [_of_pair, _of_elastic_pair]
        sections = ["scales", "sets", "insight", "insight.scaling"]
    scopes = [limits_of_scan(config, surface, grid) for surface, grid in grids.items()]
    for surface, grid in grids.items():
        if surface != name:
            sphere = grids.get(name, grid)  # A smooth sphere has the pixels of what it meets.
            scopes += [table(config, surface, grid, sphere) for table in on_pair]
            scopes += [
                _of_master(config, section, side, surface, grid, sphere)
                for section, side in product(sections, SIDES)
            ]
    refuse_all(partial(refuse_lines, islice(unmet(limits), 1)) for limits in scopes)


def window_images(window: float, size: float) -> float:
    """Return how many images of a scan of a size, stitched, a window holds (edges in nm)."""
    return max(1.0, window / (2 * size)) ** 2


def carrying_pixels(window: float, grid: Grid) -> int:
    """Return how many pixels of a stitched scan in a window (nm) may carry a load: a quarter."""
    return min(window_pixels(window, grid.pixel_size), 2 * grid.pixels) ** 2 // 4


def pressed_depth(contact: Contact, relief: float) -> float:
    """Return how deep (nm) a load presses bodies into each other, at most their relief (nm).

    On slopes near one a contact is about as deep as it is wide.
    """
    return min(math.sqrt(contact.preload / contact.hardness) * 1e9, relief)


def limits_of_scan(config: dict[str, Any], surface: str, grid: Grid) -> Iterator[Limit]:
    """Give the limits of the scans of a surface: loads, numbers of contacts, ranges."""
    of_paper, stitched = config["published"] == PAPER, 2 * grid.pixels
    sections = ["contact", "sets"] if of_paper else ["contact"]
    available = carrying_pixels(config["contact"]["window"], grid)
    why = f"which a quarter of the {4 * available} pixels of {surface} can carry"
    for section in [*sections, "insight.scaling"] if of_paper else sections:
        yield from _of_loads(config, section, available, grid.pixel_size, why)
    expected = f"at most the {stitched} pixels along the stitched scan of {surface}"
    for section in sections:
        count = config[section]["count"]
        yield Limit(count <= stitched, f"{section}.count", expected, count)
    ranges = {"adhesion.ranges": config["adhesion"]["ranges"][0]}
    if of_paper:
        ranges["insight.ranges"] = config["insight"]["ranges"][0]
    ranges["scales.range"] = config["scales"]["range"]
    for key, rho in ranges.items():
        yield _of_range(config, key, rho, config["sphere"]["radius"], surface, grid)


def _of_pair(config: dict[str, Any], surface: str, grid: Grid, sphere: Grid) -> Iterator[Limit]:
    """Give the limits of a scan of a substrate and one of the sphere, on common pixels."""
    edge, pixel_size = config["contact"]["window"], min(grid.pixel_size, sphere.pixel_size)
    window, both = window_pixels(edge, pixel_size), f"{surface} and the sphere"
    expected = f"at most {MAP_PIXELS} pixels of {pixel_size:.4g} nm, on {both}"
    yield Limit(window <= MAP_PIXELS, "contact.window", expected, window)
    yield _of_map(both, pixel_size, grid, sphere)
    for section in ("contact", "sets") if config["published"] == PAPER else ("contact",):
        images = window_images(edge, grid.size)
        yield from _of_contact_pixels(config, section, surface, pixel_size, images)


def _of_elastic_pair(
    config: dict[str, Any], surface: str, grid: Grid, sphere: Grid
) -> Iterator[Limit]:
    """Give the limits of loads on elastic contacts and on indents of a pair."""
    contact, pixel_size = config["contact"], min(grid.pixel_size, sphere.pixel_size)
    modulus = effective_modulus(config["elastic"]["sphere"], config["elastic"]["substrate"])
    edge = min(contact["window"], 2 * grid.size)
    most = PRESSURE_OVER_MODULUS * modulus * (edge * 1e-9) ** 2
    yield Limit(
        contact["preload"] <= most,
        "contact.preload",
        f"at most {print_quantity(most, 'N')} on {surface}, where elastic contact is solved on "
        f"{edge:.4g} nm",
        print_quantity(contact["preload"], "N"),
    )
    if surface == config["indent"]["surface"]:
        largest = replace(study_contact(config), preload=max(config["indent"]["preloads"]))
        pixels = largest.pixels(pixel_size)
        within = f"2 to {INDENT_PIXELS} contact pixels of {pixel_size:.4g} nm at the largest"
        yield Limit(2 <= pixels <= INDENT_PIXELS, "indent.preloads", within, pixels)


def _of_master(
    config: dict[str, Any], section: str, side: str, surface: str, grid: Grid, sphere: Grid
) -> Iterator[Limit]:
    """Give the limits of the masters of one side in a section that are built on a surface."""
    settings = at(config, section)
    own = settings[side]
    chapter = config["insight"][side] if section == "insight.scaling" else {}
    of_side = config["scales"][side] | chapter | own
    pixels, tiles = of_side["pixels"], of_side.get("tiles", 1)
    size, needed = 2 * grid.size * tiles, 2 * grid.pixels * tiles
    key = f"{section if 'pixels' in own else 'insight'}.{side}.pixels"
    master = grid._replace(size=size / 2)
    expected = f"at least the {needed} of {tiles} x {tiles} stitched scans of {surface}"
    yield Limit(pixels >= needed, key, expected, pixels)
    refuse_beyond_memory(key, pixels, machine_megabytes())
    key, rho, radius = "scales.range", config["scales"]["range"], config["sphere"]["radius"]
    if section == "insight.scaling":  # The shortest range, on the smallest sphere.
        key, rho, radius = f"{section}.ranges", min(settings["ranges"]), min(settings["radii"])
    yield _of_range(config, key, rho, radius, surface, master)
    if section in ("scales", "sets"):  # Those that are computed at `scales.range` alone.
        yield from _of_depth(config, section, rho, grid)
    finest = size / pixels
    cutoff_pixel_size = finest if side == "small" else grid.pixel_size
    for name, pixel_size in (("transition", grid.pixel_size), ("cutoffs", cutoff_pixel_size)):
        key = f"{section if name in own else 'scales'}.{side}.{name}"
        # Exactly two pixels is refused with some margin, as `filters.lowpass` does.
        expected = f"on {surface} more than two pixels ({2 * pixel_size:.4g} nm)"
        for wavelength in np.atleast_1d(of_side[name]):
            enough = 2 * pixel_size * (1 + 1e-9) < wavelength
            yield Limit(enough, key, expected, f"{wavelength:.4g} nm")
        longest = np.max(of_side[name], initial=0.0)
        expected = f"on {surface} at most the {size:.6g} nm of a master of {section}.{side}"
        yield Limit(longest <= size, key, expected, f"{longest:.4g} nm")
    if section == "sets" or config["scales"]["sphere_roughness"]:
        finest = min(finest, sphere.pixel_size)
        yield _of_map(
            f"the {side}-scale masters of {surface} and the sphere", finest, master, sphere
        )
    yield from _of_contact_pixels(config, section, surface, finest, 1)


def _of_range(
    config: dict[str, Any], key: str, rho: float, radius: float, surface: str, grid: Grid
) -> Limit:
    """Return the limit of a range of adhesion (nm) for the pixels and the relief of a surface."""
    least, reason = least_range(radius, config["contact"]["window"], grid)
    expected = f"at least {least:g} nm on {surface}, where {reason}"
    return Limit(rho >= least, key, expected, f"{rho:.4g} nm")


def _of_map(what: str, pixel_size: float, *grids: Grid) -> Limit:
    """Return the limit of maps that are stitched and brought to the pixels (nm) of the finest."""
    pixels = round(max(2 * grid.size for grid in grids) / pixel_size)
    expected = (
        f"at most {MAP_PIXELS} pixels along an edge of {what} on common pixels of "
        f"{pixel_size:.4g} nm"
    )
    return Limit(pixels <= MAP_PIXELS, "surfaces and scan", expected, pixels)


def _of_contact_pixels(
    config: dict[str, Any], section: str, surface: str, pixel_size: float, images: float
) -> Iterator[Limit]:
    """Give the limits of loads for the contact pixels that are kept in memory at once.

    Each pixel (edge in nm) has so many periodic images in the window.
    """
    counted = {"scales": "contact", "insight.scaling": "insight"}.get(section, section)
    count = at(config, counted)["count"]
    most, window = int(CONTACT_PIXELS / count**2 / images), config["contact"]["window"]
    why = (
        f"with which the contact pixels of {pixel_size:.4g} nm on {surface} fit into memory at "
        f"{counted}.count = {count} and contact.window = {window:.6g} nm"
    )
    yield from _of_loads(config, section, most, pixel_size, why)


def _of_loads(
    config: dict[str, Any], section: str, most: int, pixel_size: float, why: str
) -> Iterator[Limit]:
    """Give the limit of every load of a section to so many contact pixels (edge in nm)."""
    area = most * (pixel_size * 1e-9) ** 2
    for key, contact in _loads(config, section):
        preload, hardness = contact.preload, contact.hardness
        if contact.pixels(pixel_size) <= most:
            continue
        if key == "robustness.hardnesses":
            least, found = f"{preload / area / 1e9:.3g} GPa", f"{hardness / 1e9:.4g} GPa"
            yield Limit(False, key, f"at least {least}, {why}", found)
        else:
            expected, found = (print_quantity(force, "N") for force in (area * hardness, preload))
            yield Limit(False, key, f"at most {expected}, {why}", found)


def _of_depth(config: dict[str, Any], section: str, rho: float, grid: Grid) -> Iterator[Limit]:
    """Give the limits of a range of adhesion (nm) beside the depth of contacts at each load."""
    for key, contact in _loads(config, section):
        depth = pressed_depth(contact, grid.relief)
        least = depth / PENETRATION_OVER_RANGE
        pressed = f"as {key} presses the bodies some {depth:.3g} nm into each other"
        expected = f"at least {least:.3g} nm, {pressed}"
        yield Limit(rho >= least, "scales.range", expected, f"{rho:.4g} nm")


def _loads(config: dict[str, Any], section: str) -> Iterator[tuple[str, Contact]]:
    """Give the contacts of a section at each load, with the key that it comes from.

    Those of the study come first, unless all are the section's own; of several it is the largest.
    Robustness is computed at the size of the sets, at loads of its own.
    """
    contact = study_contact(config)
    if section == "insight.scaling":
        largest = max(at(config, section)["preloads"])
        yield f"{section}.preloads", replace(contact, preload=largest)
        return
    yield "contact.preload", contact
    if section == "contact" and config["published"] == PAPER:
        yield "indent.preloads", replace(contact, preload=max(config["indent"]["preloads"]))
    if section != "sets":
        return
    for value in config["robustness"]["preloads"]:
        yield "robustness.preloads", replace(contact, preload=value)
    for value in config["robustness"]["hardnesses"]:
        yield "robustness.hardnesses", replace(contact, hardness=value)
