"""What the scans of a surface permit, alone and in a pair with those of the sphere.

Checks that the pixels of scans permit what a study computes on them.
"""

from collections.abc import Mapping
from functools import partial
from itertools import chain, product
from typing import Any

import pandas as pd

from hardcontact.config.configuration import PAPER, refuse_all
from hardcontact.config.limits import (
    MAP_PIXELS,
    Attraction,
    Grid,
    loads,
    refuse_contact_pixels,
    refuse_large_map,
    refuse_load,
    refuse_short_range,
    sections_of_contacts,
    sections_of_loads,
    surface_grid,
)
from hardcontact.config.master_limits import refuse_on_master
from hardcontact.contact.bearing_area import Load, contact_pixel_count
from hardcontact.contact.geometry import window_pixels
from hardcontact.contact.hertz import effective_modulus
from hardcontact.numbers.printing import print_quantity
from hardcontact.surfaces.synthesis import SIDES

__all__ = [
    "check_grids",
    "check_scans",
    "refuse_on_elastic_pair",
    "refuse_on_elastic_scan",
    "refuse_on_pair",
    "refuse_on_scan",
]

#: Contact pixels of one indent, which are compared with each other.
INDENT_PIXELS = 2**12
#: Least pixels along an edge of the window of elastic contacts.
ELASTIC_PIXELS = 16
#: Upper bound on the mean pressure of an elastic contact over the effective modulus: peaks of the
#: pressure are a hundred times higher, and the solver assumes small strains.
PRESSURE_OVER_MODULUS = 0.01


def refuse_on_scan(config: dict[str, Any], surface: str, grid: Grid) -> None:
    """Refuse what the scans of a surface do not permit by themselves.

    Parameters
    ----------
    config : dict
        Numbers, as `configuration.configuration` returns it.
    surface : str
        Id of the surface.
    grid : Grid
        Of its scans.

    Raises
    ------
    ValueError
        In one line, naming the key.
    """
    _refuse_loads(config, surface, grid)
    for section in sections_of_contacts(config):
        if config[section]["count"] > 2 * grid.pixels:
            raise ValueError(
                f"config key {section}.count: expected at most the {2 * grid.pixels} pixels along "
                f"the stitched scan of {surface}, found {config[section]['count']}"
            )
    ranges = {"adhesion.ranges": config["adhesion"]["ranges"][0]}
    if config["published"] == PAPER:
        ranges["insight.ranges"] = config["insight"]["ranges"][0]
    ranges["scales.range"] = config["scales"]["range"]
    for key, rho in ranges.items():
        attraction = Attraction(rho, config["sphere"]["radius"])
        refuse_short_range(config, key, attraction, surface, grid)


def refuse_on_elastic_scan(config: dict[str, Any], surface: str, grid: Grid) -> None:
    """Refuse a window of elastic contacts that has too few pixels of a surface, as a ValueError."""
    window = config["elastic"]["window"]
    if int(window / grid.pixel_size) < ELASTIC_PIXELS:
        raise ValueError(
            f"config key elastic.window: expected at least {ELASTIC_PIXELS} pixels of "
            f"{surface} ({ELASTIC_PIXELS * grid.pixel_size:.4g} nm), found {window:.4g} nm"
        )


def _refuse_loads(config: dict[str, Any], surface: str, grid: Grid) -> None:
    """Refuse loads that need more than a quarter of the pixels in the window."""
    window = window_pixels(config["contact"]["window"], grid.pixel_size)
    available = min(window, 2 * grid.pixels) ** 2 // 4
    sections = sections_of_loads(config)
    for key, load in chain.from_iterable(loads(config, section) for section in sections):
        why = f"which a quarter of the {4 * available} pixels of {surface} can carry"
        refuse_load(key, load, available, grid.pixel_size, why)


def refuse_on_pair(config: dict[str, Any], surface: str, grid: Grid, sphere: Grid) -> None:
    """Refuse what a scan of a substrate and one of the sphere, on common pixels, do not permit.

    Parameters
    ----------
    config : dict
        Numbers, as `configuration.configuration` returns it.
    surface : str
        Id of the substrate.
    grid, sphere : Grid
        Of the scans of the substrate and of the sphere.

    Raises
    ------
    ValueError
        In one line, naming the key.
    """
    contact, pixel_size = config["contact"], min(grid.pixel_size, sphere.pixel_size)
    window = window_pixels(contact["window"], pixel_size)
    if window > MAP_PIXELS:
        raise ValueError(
            f"config key contact.window: expected at most {MAP_PIXELS} pixels of "
            f"{pixel_size:.4g} nm, on {surface} and the sphere, found {window}"
        )
    refuse_large_map(f"{surface} and the sphere", pixel_size, grid, sphere)
    images = max(1, contact["window"] / (2 * grid.size)) ** 2
    for section in sections_of_contacts(config):
        refuse_contact_pixels(config, section, surface, pixel_size, images)


def refuse_on_elastic_pair(config: dict[str, Any], surface: str, grid: Grid, sphere: Grid) -> None:
    """Refuse loads that elastic contacts and indents of a pair do not permit, as a ValueError."""
    contact, pixel_size = config["contact"], min(grid.pixel_size, sphere.pixel_size)
    _refuse_pressure(config, surface, min(contact["window"], 2 * grid.size))
    largest = Load(preload=max(config["indent"]["preloads"]), hardness=contact["hardness"])
    contact_pixels = contact_pixel_count(largest, pixel_size)
    if surface == config["indent"]["surface"] and not 2 <= contact_pixels <= INDENT_PIXELS:
        raise ValueError(
            f"config key indent.preloads: expected 2 to {INDENT_PIXELS} contact pixels of "
            f"{pixel_size:.4g} nm at the largest, found {contact_pixels}"
        )


def _refuse_pressure(config: dict[str, Any], surface: str, edge: float) -> None:
    """Refuse a preload too high for elastic contact on a square of this edge (nm)."""
    modulus = effective_modulus(
        *(
            config["elastic"][body][key]
            for body in ("sphere", "substrate")
            for key in ("modulus", "poisson_ratio")
        )
    )
    most = PRESSURE_OVER_MODULUS * modulus * (edge * 1e-9) ** 2
    if config["contact"]["preload"] > most:
        expected, found = (
            print_quantity(force, "N") for force in (most, config["contact"]["preload"])
        )
        raise ValueError(
            f"config key contact.preload: expected at most {expected} on {surface}, where elastic "
            f"contact is solved on {edge:.4g} nm, found {found}"
        )


def check_scans(config: dict[str, Any], table: pd.DataFrame) -> None:
    """Refuse what the pixels of the scans do not permit; measured scans are read.

    Parameters
    ----------
    config : dict
        Numbers, as `configuration.configuration` returns it.
    table : pandas.DataFrame
        The scans that contacts are made on, as `surface_table.selected_scans` returns them.

    Raises
    ------
    ValueError
        In one line a fault, naming the key or the file.
    """
    grids: dict[str, Grid] = {}

    def read(surface: str, rows: pd.DataFrame) -> None:
        grids[surface] = surface_grid(config, surface, rows)

    refuse_all(
        partial(read, str(surface), rows) for surface, rows in table.groupby("surface", sort=False)
    )
    check_grids(config, grids)


def check_grids(config: dict[str, Any], grids: Mapping[str, Grid]) -> None:
    """Refuse what the pixels of scans do not permit.

    Parameters
    ----------
    config : dict
        Numbers, as `configuration.configuration` returns it.
    grids : mapping
        Grid of the scans of each surface.

    Raises
    ------
    ValueError
        In one line a fault, naming the key.
    """
    name, of_the_paper = config["sphere"]["surface"], config["published"] == PAPER
    if name in grids:
        _refuse_small_sphere(config, grids[name])
    on_scan = [refuse_on_scan, refuse_on_elastic_scan] if of_the_paper else [refuse_on_scan]
    on_pair = [refuse_on_pair, refuse_on_elastic_pair] if of_the_paper else [refuse_on_pair]
    sections = ("scales", "sets", "insight", "insight.scaling") if of_the_paper else ("scales",)
    masters = list(product(sections, SIDES))
    checks = [partial(limit, config, *one) for one, limit in product(grids.items(), on_scan)]
    for surface, grid in grids.items():
        if surface != name:
            sphere = grids.get(name, grid)  # A smooth sphere has the pixels of what it meets.
            checks += [partial(limit, config, surface, grid, sphere) for limit in on_pair]
            checks += [
                partial(refuse_on_master, config, section, side, surface, grid, sphere)
                for section, side in masters
            ]
    refuse_all(checks)


def _refuse_small_sphere(config: dict[str, Any], sphere: Grid) -> None:
    """Refuse a sphere that is smaller than its scans."""
    radius = config["sphere"]["radius"]
    if radius < sphere.size:
        raise ValueError(
            "config key sphere.radius: expected at least the size of its scans "
            f"({sphere.size:.6g} nm), found {radius:.6g} nm"
        )
