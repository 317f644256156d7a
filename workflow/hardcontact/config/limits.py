"""The pixels that the scans of a surface have.

Limits that the grids of scans and of masters have in common.
"""

import math
from collections.abc import Iterator
from functools import reduce
from operator import getitem
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from hardcontact.config.configuration import PAPER
from hardcontact.contact.bearing_area import Load, contact_pixel_count
from hardcontact.numbers.printing import print_length, print_quantity
from hardcontact.surfaces.scans import read_scan
from hardcontact.surfaces.substitute_spectra import described_rms_height, is_calibrated

__all__ = [
    "Attraction",
    "CONTACT_PIXELS",
    "Grid",
    "MAP_PIXELS",
    "PIXEL_SIZES",
    "least_range",
    "loads",
    "refuse_contact_pixels",
    "refuse_large_map",
    "refuse_load",
    "refuse_short_range",
    "sections_of_contacts",
    "sections_of_loads",
    "settings_of",
    "surface_grid",
]

#: Pixel sizes in nm at which spectra are known: tables and bins end at 0.1 nm and 100 um.
PIXEL_SIZES = (0.05, 1e4)
#: Upper bound on the differences in height between contacts on a substitute for a surface of the
#: paper, in nm: five times the rms height of the roughest.
SUBSTITUTE_RELIEF = 500.0
#: The same bound over the rms height of all waves of a domain: 3.7 was found at most on 24 random
#: surfaces of 10 to 40 um, from descriptions of 18 to 850 nm rms; a fifth more for others.
RELIEF_OVER_RMS = 4.5


class Grid(NamedTuple):
    """What all scans of a surface share.

    Attributes
    ----------
    pixels : int
        Pixels along an edge.
    pixel_size : float
        Edge of a pixel in nm.
    size : float
        Edge of the scan in nm.
    relief : float
        Largest difference in height in nm.
    """

    pixels: int
    pixel_size: float
    size: float
    relief: float


def surface_grid(config: dict[str, Any], surface: str, rows: pd.DataFrame) -> Grid:
    """Return the grid of the scans of a surface; measured scans are read.

    Parameters
    ----------
    config : dict
        Numbers, as `configuration.configuration` returns it.
    surface : str
        Id of the surface.
    rows : pandas.DataFrame
        Its rows in the table of surfaces.

    Returns
    -------
    Grid
        Relief of measured scans: the largest of them; of substitutes that of their largest master.

    Raises
    ------
    ValueError
        In one line, if a scan cannot be used or has other pixels than the first.
    """
    if rows.source.iloc[0] == "substitute":
        pixels, size = config["scan"]["pixels"], config["scan"]["size"]
        relief = _substitute_relief(config, rows.path.iloc[0])
        grid, where = Grid(pixels, size / pixels, size, relief), "config key scan.size"
    else:
        grid, where = _measured_grid(config, surface, rows), rows.path.iloc[0]
    least, most = PIXEL_SIZES
    if not least <= grid.pixel_size <= most:
        raise ValueError(
            f"{where}: expected pixels of {least:g} to {most:g} nm, where spectra are known, "
            f"found {grid.pixel_size:.6g} nm"
        )
    return grid


def _substitute_relief(config: dict[str, Any], path: str) -> float:
    """Return a bound on the differences in height (nm) of contacts on the largest master."""
    if is_calibrated(pd.read_csv(path)):
        return SUBSTITUTE_RELIEF
    period = 2 * config["scan"]["size"] * config["scales"]["large"]["tiles"]
    return RELIEF_OVER_RMS * described_rms_height(path, period)


def _measured_grid(config: dict[str, Any], surface: str, rows: pd.DataFrame) -> Grid:
    grids: list[Grid] = []
    for path, dataset in zip(rows.path, rows.dataset, strict=True):
        scan = read_scan(path, dataset, config["scan"]["undefined_pixels"])
        relief = float(np.ptp(scan.heights))
        if relief == 0:
            raise ValueError(f"{path}: expected a rough surface, found constant height")
        grids.append(Grid(scan.pixels, scan.pixel_size, scan.size, relief))
        first, last = grids[0], grids[-1]
        same_size = math.isclose(last.pixel_size, first.pixel_size, rel_tol=1e-3)
        if last.pixels != first.pixels or not same_size:
            raise ValueError(
                f"{path}: expected, as in the first scan of {surface}, "
                f"{first.pixels} pixels of {first.pixel_size:.4g} nm; "
                f"found {last.pixels} of {last.pixel_size:.4g} nm"
            )
    return grids[0]._replace(relief=max(grid.relief for grid in grids))


#: Pixels along an edge of any map: arrays of more than 2 GiB have not been tried.
MAP_PIXELS = 16384
#: Contact pixels of all contacts on a scan, with their images in the window: all are kept in memory
#: at once, in some 24 bytes each.
CONTACT_PIXELS = 2**26
#: Largest difference in height over the range of adhesion: exponentials overflow beyond 700.
RELIEF_OVER_RANGE = 500.0
#: Sections whose contacts are as many as those of another.
COUNTED = {"scales": "contact"}


class Attraction(NamedTuple):
    """A range of adhesion and the radius of the sphere, both in nm."""

    rho: float
    radius: float


def settings_of(config: dict[str, Any], section: str) -> dict[str, Any]:
    """Return the keys of a section, with dots between the parts of its name."""
    found: dict[str, Any] = reduce(getitem, section.split("."), config)
    return found


def sections_of_contacts(config: dict[str, Any]) -> list[str]:
    """Return the sections that contacts on scans come from; own surfaces have no sets."""
    return ["contact", "sets"] if config["published"] == PAPER else ["contact"]


def sections_of_loads(config: dict[str, Any]) -> list[str]:
    """Return the sections that name loads; own surfaces have no sets and no insight."""
    of_paper = ["insight.scaling"] if config["published"] == PAPER else []
    return [*sections_of_contacts(config), *of_paper]


def loads(config: dict[str, Any], section: str) -> Iterator[tuple[str, Load]]:
    """Give the loads on the contacts of a section, each with the key that it comes from.

    Parameters
    ----------
    config : dict
        Numbers, as `configuration.configuration` returns it.
    section : {"contact", "scales", "sets", "insight", "insight.scaling"}
        The section; robustness is computed at the size of the sets, at loads of its own.

    Yields
    ------
    key, load : str, Load
        First those of the study itself, unless all loads are the section's own; the largest of
        several.
    """
    preload, hardness = (config["contact"][key] for key in ("preload", "hardness"))
    if section == "insight.scaling":
        largest = max(settings_of(config, section)["preloads"])
        yield "insight.scaling.preloads", Load(preload=largest, hardness=hardness)
        return
    yield "contact.preload", Load(preload=preload, hardness=hardness)
    if section == "contact" and config["published"] == PAPER:
        largest = max(config["indent"]["preloads"])
        yield "indent.preloads", Load(preload=largest, hardness=hardness)
    if section == "sets":
        for other in config["robustness"]["preloads"]:
            yield "robustness.preloads", Load(preload=other, hardness=hardness)
        for other in config["robustness"]["hardnesses"]:
            yield "robustness.hardnesses", Load(preload=preload, hardness=other)


def least_range(radius: float, window: float, grid: Grid) -> tuple[float, str]:
    """Return the shortest range of adhesion that the pixels and the relief of a surface permit.

    The interaction radius sqrt(2 R rho) must span two pixels, and exponentials of height over range
    must not overflow. Where the window holds a period of the surface, every contact has the highest
    pixel of the map within half a period of it, and cannot be farther from it than the sphere's
    curvature says.

    Parameters
    ----------
    radius : float
        Of the sphere, in nm.
    window : float
        Edge of the analysis window in nm.
    grid : Grid
        Of the surface before stitching, which doubles its size to the period.

    Returns
    -------
    least : float
        In nm, rounded up to three digits.
    reason : str
        In words.
    """
    relief = grid.relief
    if window >= 2 * grid.size:
        relief = min(relief, grid.size**2 / radius)
    two_pixels = "an interaction radius sqrt(2 R rho) of two pixels needs it"
    reasons = {
        f"contacts lie up to some {relief:.4g} nm apart in height": relief / RELIEF_OVER_RANGE,
        f"{two_pixels} at R = {print_length(radius)}": 2 * grid.pixel_size**2 / radius,
    }
    reason, least = max(reasons.items(), key=lambda item: item[1])
    return _rounded_up(least), reason


def refuse_short_range(
    config: dict[str, Any], key: str, attraction: Attraction, surface: str, grid: Grid
) -> None:
    """Refuse a range of adhesion too short for the pixels or for the relief of a surface.

    Parameters
    ----------
    config : dict
        Numbers, as `configuration.configuration` returns it.
    key : str
        Key of the range, for the message.
    attraction : Attraction
        The shortest range, on the smallest sphere.
    surface : str
        Id of the surface, for the message.
    grid : Grid
        Of the surface before stitching.

    Raises
    ------
    ValueError
        In one line, naming the key and the least range that the surface permits.
    """
    least, reason = least_range(attraction.radius, config["contact"]["window"], grid)
    if attraction.rho < least:
        raise ValueError(
            f"config key {key}: expected at least {least:g} nm on {surface}, "
            f"where {reason}, found {attraction.rho:.4g} nm"
        )


def _rounded_up(number: float) -> float:
    """Return the next number of three digits."""
    step = 10.0 ** (math.floor(math.log10(number)) - 2)
    return float(f"{math.ceil(number / step) * step:.3g}")


def refuse_large_map(what: str, pixel_size: float, *grids: Grid) -> None:
    """Refuse maps that are too large when stitched and brought to the pixels of the finest.

    Parameters
    ----------
    what : str
        The maps, for the message.
    pixel_size : float
        Of the finest, in nm.
    *grids : Grid
        One a map, before stitching.

    Raises
    ------
    ValueError
        In one line, naming the maps.
    """
    pixels = round(max(2 * grid.size for grid in grids) / pixel_size)
    if pixels > MAP_PIXELS:
        raise ValueError(
            f"config keys surfaces and scan: expected at most {MAP_PIXELS} pixels along an edge of "
            f"{what} on common pixels of {pixel_size:.4g} nm, found {pixels}"
        )


def refuse_contact_pixels(
    config: dict[str, Any], section: str, surface: str, pixel_size: float, images: float = 1
) -> None:
    """Refuse loads that need more contact pixels than can be kept in memory at once.

    Parameters
    ----------
    config : dict
        Numbers, as `configuration.configuration` returns it.
    section : {"contact", "scales", "sets", "insight", "insight.scaling"}
        The section whose loads are checked, at its own number of contacts.
    surface : str
        Id of the substrate, for the message.
    pixel_size : float
        In nm.
    images : float
        Periodic images of each pixel in the window.

    Raises
    ------
    ValueError
        In one line, naming the key.
    """
    counted = COUNTED.get(section, section)
    count = settings_of(config, counted)["count"]
    most = int(CONTACT_PIXELS / count**2 / images)
    window = config["contact"]["window"]
    why = (
        f"with which the contact pixels of {pixel_size:.4g} nm on {surface} fit into memory at "
        f"{counted}.count = {count} and contact.window = {window:.6g} nm"
    )
    for key, load in loads(config, section):
        refuse_load(key, load, most, pixel_size, why)


def refuse_load(key: str, load: Load, most: int, pixel_size: float, why: str) -> None:
    """Refuse a load that needs too many contact pixels.

    Parameters
    ----------
    key : str
        That the load comes from.
    load : Load
        Preload and hardness.
    most : int
        Contact pixels that there may be.
    pixel_size : float
        In nm.
    why : str
        What the limit is, in words.

    Raises
    ------
    ValueError
        In one line, in the unit of the key.
    """
    if contact_pixel_count(load, pixel_size) <= most:
        return
    preload, hardness = load["preload"], load["hardness"]
    area = most * (pixel_size * 1e-9) ** 2
    expected, found = (print_quantity(force, "N") for force in (area * hardness, preload))
    limit = f"at most {expected}"
    if key == "robustness.hardnesses":
        limit, found = f"at least {preload / area / 1e9:.3g} GPa", f"{hardness / 1e9:.4g} GPa"
    raise ValueError(f"config key {key}: expected {limit}, {why}, found {found}")
