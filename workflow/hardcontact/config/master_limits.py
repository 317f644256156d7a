"""What the scans of a surface permit of the masters that are built on them.

Memory that a master takes, and that the machine has.
"""

import math
import os
from typing import Any

import numpy as np

from hardcontact.config.limits import (
    MAP_PIXELS,
    Attraction,
    Grid,
    loads,
    refuse_contact_pixels,
    refuse_large_map,
    refuse_short_range,
    settings_of,
)

__all__ = ["machine_megabytes", "master_megabytes", "refuse_beyond_memory", "refuse_on_master"]

#: Largest penetration over the range of adhesion, for a smooth sphere: its force sums lose as many
#: digits as the exponential of this has.
PENETRATION_OVER_RANGE = 25.0


def refuse_on_master(
    config: dict[str, Any], section: str, side: str, surface: str, grid: Grid, sphere: Grid
) -> None:
    """Refuse what the masters of one side do not permit.

    Parameters
    ----------
    config : dict
        Numbers, as `configuration.configuration` returns it.
    section : {"scales", "sets", "insight", "insight.scaling"}
        Masters of the study, of the sets and of robustness, of other laws of attraction, or of
        edges that are scaled.
    side : {"small", "large"}
        The scales that are added to a scan.
    surface : str
        Id of the substrate.
    grid, sphere : Grid
        Of the scans of the substrate and of the sphere.

    Raises
    ------
    ValueError
        In one line, naming the key.
    """
    own: dict[str, Any] = settings_of(config, section)[side]
    of_side = config["scales"][side] | own
    pixels, tiles = of_side["pixels"], of_side.get("tiles", 1)
    size, needed = 2 * grid.size * tiles, 2 * grid.pixels * tiles
    if pixels < needed:
        raise ValueError(
            f"config key {section}.{side}.pixels: expected at least the {needed} of "
            f"{tiles} x {tiles} stitched scans of {surface}, found {pixels}"
        )
    refuse_beyond_memory(f"{section}.{side}.pixels", pixels, machine_megabytes())
    key, attraction = _shortest_attraction(config, section)
    refuse_short_range(config, key, attraction, surface, grid._replace(size=size / 2))
    if section in ("scales", "sets"):  # those that are computed at `scales.range` alone
        _refuse_deep_contacts(config, section, attraction.rho, grid)
    finest = size / pixels
    cutoff_pixel_size = finest if side == "small" else grid.pixel_size
    for name, limit in (("transition", grid.pixel_size), ("cutoffs", cutoff_pixel_size)):
        key = f"{section if name in own else 'scales'}.{side}.{name}"
        _refuse_short_wavelengths(key, of_side[name], surface, limit)
        _refuse_long_wavelengths(key, of_side[name], surface, f"{section}.{side}", size)
    if section == "sets" or config["scales"]["sphere_roughness"]:
        finest = min(finest, sphere.pixel_size)
        master = grid._replace(size=size / 2)
        what = f"the {side}-scale masters of {surface} and the sphere"
        refuse_large_map(what, finest, master, sphere)
    refuse_contact_pixels(config, section, surface, finest)


def _shortest_attraction(config: dict[str, Any], section: str) -> tuple[str, Attraction]:
    """Return the shortest range of a section, with its key, and the smallest sphere."""
    if section == "insight.scaling":
        scaling = settings_of(config, section)
        return f"{section}.ranges", Attraction(min(scaling["ranges"]), min(scaling["radii"]))
    return "scales.range", Attraction(config["scales"]["range"], config["sphere"]["radius"])


def refuse_beyond_memory(key: str, pixels: int, available: int) -> None:
    """Refuse a master larger than any map that this machine's memory (megabytes) cannot hold."""
    needed = master_megabytes(pixels, 0)
    if pixels > MAP_PIXELS and needed > available:
        raise ValueError(
            f"config key {key}: expected at most {MAP_PIXELS} on this machine of "
            f"{available / 1e3:.3g} GB, found {pixels}, which take {needed / 1e3:.3g} GB"
        )


def _refuse_deep_contacts(config: dict[str, Any], section: str, rho: float, grid: Grid) -> None:
    """Refuse a range of adhesion (nm) that is short beside the depth of contacts."""
    for key, load in loads(config, section):
        # On slopes near one a contact is about as deep as it is wide.
        depth = min(math.sqrt(load["preload"] / load["hardness"]) * 1e9, grid.relief)
        if rho < depth / PENETRATION_OVER_RANGE:
            raise ValueError(
                "config key scales.range: expected at least "
                f"{depth / PENETRATION_OVER_RANGE:.3g} nm, as {key} "
                f"presses the bodies some {depth:.3g} nm into each other, found {rho:.4g} nm"
            )


def _refuse_short_wavelengths(
    key: str, wavelengths: float | list[float], surface: str, pixel_size: float
) -> None:
    """Refuse wavelengths of no more than two pixels (nm)."""
    for wavelength in np.atleast_1d(wavelengths):
        # Exactly two pixels is refused with some margin, as `filters.lowpass` does.
        if not 2 * pixel_size * (1 + 1e-9) < wavelength:
            raise ValueError(
                f"config key {key}: expected on {surface} more than two pixels "
                f"({2 * pixel_size:.4g} nm), found {wavelength:.4g} nm"
            )


def _refuse_long_wavelengths(
    key: str, wavelengths: float | list[float], surface: str, master: str, size: float
) -> None:
    """Refuse wavelengths longer than the edge of a master (nm), which the message names."""
    longest = np.max(wavelengths, initial=0.0)
    if longest > size:
        raise ValueError(
            f"config key {key}: expected on {surface} at most the {size:.6g} nm of a master of "
            f"{master}, found {longest:.4g} nm"
        )


#: Bytes a pixel of a master at the peak of its synthesis and of its filters: three maps in float32,
#: or the transform of one in single precision and two maps. 13.2 were measured at 8192²
#: without the writing of the file, which may hold one more map.
BYTES_A_PIXEL = 17.0
#: Megabytes besides: Python, its packages, the scan, blocks of rows in double precision.
BESIDES = 500


def master_megabytes(pixels: int, least: int) -> int:
    """Return what a job needs that makes a master, or filters it and presses a smooth sphere on it.

    Parameters
    ----------
    pixels : int
        Along an edge.
    least : int
        Megabytes that the job is given for any smaller master.

    Returns
    -------
    int
        In units of 10^6 bytes.
    """
    return max(least, BESIDES + math.ceil(BYTES_A_PIXEL * pixels**2 / 1e6))


def machine_megabytes() -> int:
    """Return the memory of this machine in units of 10^6 bytes."""
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") // 10**6
