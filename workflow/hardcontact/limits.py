"""What the grids of the scans permit: pixels, windows, wavelengths and loads of a study."""

import math
from itertools import product
from typing import NamedTuple

import numpy as np

from hardcontact.contact import contact_pixel_count
from hardcontact.hertz import effective_modulus
from hardcontact.sphere import window_pixels

__all__ = ["Grid", "check"]

#: Pixels along an edge of any map: arrays of more than 2 GiB have not been tried.
LARGEST = 16384
#: Pixels that touch in all contacts on a scan, with their images in the window, kept at once in
#: some 24 bytes each; and in one indent, whose pixels are compared with each other.
TOUCHING, INDENTED = 2**26, 2**12
#: The most that heights of a substitute differ by among contacts (nm), and what that may be over
#: the range of adhesion: exponentials overflow beyond 700.
RELIEF, RESOLVED = 500.0, 500.0
#: The most that penetration may be over the range of adhesion, for a smooth sphere: its sums lose
#: as many digits as the exponential has.
DIGITS = 25.0
#: The most that the mean pressure of an elastic contact may be over the effective modulus: its
#: peaks are a hundred times higher, and the solver's strains are small.
PRESSURE = 0.01


class Grid(NamedTuple):
    """What all scans of a surface share: pixels along an edge; in nm their size, that of the scan
    and the most that heights differ by."""

    pixels: int
    pixel: float
    size: float
    relief: float = RELIEF


def check(config, surface, grid, sphere):
    """Refuse what the grid of a surface does not permit, alone and beside that of the sphere.

    config: numbers, as `study.configuration` returns it; grid, sphere: `Grid`, the same for the
    surface that is the sphere's. Raises ValueError naming the key.
    """
    _check_contact(config, surface, grid)
    if surface != config["sphere"]["surface"]:
        _check_pair(config, surface, grid, sphere)
        for section, side in product(("scales", "robustness"), ("small", "large")):
            _check_side(config, section, side, surface, grid, sphere)


def _loads(config, section):
    """Keys that load the contacts of a section, each with its preload and hardness."""
    preload, hardness = (config["contact"][key] for key in ("preload", "hardness"))
    yield "contact.preload", preload, hardness
    if section == "contact":
        yield "indent.preloads", max(config["indent"]["preloads"]), hardness
    if section == "robustness":
        yield from (("robustness.preloads", load, hardness) for load in config[section]["preloads"])
        yield from (("robustness.hardnesses", preload, h) for h in config[section]["hardnesses"])


def _check_contact(config, surface, grid):
    contact, radius = config["contact"], config["sphere"]["radius"]
    available = min(window_pixels(contact["window"], grid.pixel), 2 * grid.pixels) ** 2 // 4
    for key, preload, hardness in (*_loads(config, "contact"), *_loads(config, "robustness")):
        needed = contact_pixel_count(preload, hardness, grid.pixel)
        if needed > available:
            raise ValueError(
                f"config key {key}: expected a load that a quarter of the pixels of {surface}, "
                f"{available}, can carry, found one that needs {needed}"
            )
    for section in ("contact", "robustness"):
        if config[section]["count"] > 2 * grid.pixels:
            raise ValueError(
                f"config key {section}.count: expected at most the {2 * grid.pixels} pixels along "
                f"the stitched scan of {surface}, found {config[section]['count']}"
            )
    if int(config["elastic"]["window"] / grid.pixel) < 16:
        raise ValueError(
            "config key elastic.window: expected at least 16 pixels of "
            f"{surface} ({16 * grid.pixel:.4g} nm), found {config['elastic']['window']:.4g} nm"
        )
    for key, least in (
        ("adhesion.ranges", config["adhesion"]["ranges"][0]),
        ("scales.range", config["scales"]["range"]),
    ):
        reach = math.sqrt(2 * radius * least)
        if reach < 2 * grid.pixel:
            raise ValueError(
                f"config key {key}: expected an interaction radius "
                f"sqrt(2 R rho) of two pixels ({2 * grid.pixel:.4g} nm) or more on "
                f"{surface}, found {reach:.4g} nm"
            )
        _refuse_unresolved(config, key, least, surface, grid.relief, 2 * grid.size)


def _refuse_unresolved(config, key, rho, surface, relief, period):
    """A range of adhesion so short that the highest pixel cannot be weighed against a contact.

    Where the window holds a period of the surface (nm), the sphere comes as near to that pixel as
    its own curvature lets it.
    """
    if config["contact"]["window"] >= period:
        relief = min(relief, (period / 2) ** 2 / config["sphere"]["radius"])
    if rho < relief / RESOLVED:
        raise ValueError(
            f"config key {key}: expected at least {relief / RESOLVED:.3g} nm on {surface}, where "
            f"contacts lie up to some {relief:.4g} nm apart in height, found {rho:.4g} nm"
        )


def _check_pair(config, surface, grid, sphere):
    """What one scan of a substrate and one of the sphere, on common pixels, ask for."""
    contact, pixel = config["contact"], min(grid.pixel, sphere.pixel)
    window = window_pixels(contact["window"], pixel)
    if window > LARGEST:
        raise ValueError(
            f"config key contact.window: expected at most {LARGEST} pixels of {pixel:.4g} nm, on "
            f"{surface} and the sphere, found {window}"
        )
    _refuse_fine(f"{surface} and the sphere", pixel, grid, sphere)
    images = max(1, contact["window"] / (2 * grid.size)) ** 2
    for section in ("contact", "robustness"):
        _refuse_touching(config, section, surface, pixel, images)
    bodies, edge = config["elastic"], min(contact["window"], 2 * grid.size) * 1e-9
    modulus = effective_modulus(
        *(
            bodies[body][key]
            for body in ("sphere", "substrate")
            for key in ("modulus", "poisson_ratio")
        )
    )
    if contact["preload"] > PRESSURE * modulus * edge**2:
        raise ValueError(
            f"config key contact.preload: expected at most {PRESSURE * modulus * edge**2:.3g} N on "
            f"{surface}, where elastic contact is solved on {edge * 1e9:.4g} nm, "
            f"found {contact['preload']:.4g} N"
        )
    most = contact_pixel_count(max(config["indent"]["preloads"]), contact["hardness"], pixel)
    if surface == config["indent"]["surface"] and not 2 <= most <= INDENTED:
        raise ValueError(
            f"config key indent.preloads: expected 2 to {INDENTED} touching pixels of "
            f"{pixel:.4g} nm at the largest, found {most}"
        )


def _refuse_fine(what, pixel, *grids):
    """Maps that, brought to the pixels (nm) of the finest, would be too large."""
    pixels = round(max(2 * grid.size for grid in grids) / pixel)
    if pixels > LARGEST:
        raise ValueError(
            f"config keys surfaces and scan: expected at most {LARGEST} pixels along an edge of "
            f"{what} on common pixels of {pixel:.4g} nm, found {pixels}"
        )


def _refuse_touching(config, section, surface, pixel, images=1):
    """More touching pixels (size in nm), each seen `images` times, than can be kept at once."""
    counted = "robustness" if section == "robustness" else "contact"
    contacts = config[counted]["count"] ** 2
    most = int(TOUCHING / contacts / images)
    for key, preload, hardness in _loads(config, section):
        touching = contact_pixel_count(preload, hardness, pixel)
        if touching > most:
            raise ValueError(
                f"config key {key}: expected on {surface} at most {most} touching pixels of "
                f"{pixel:.4g} nm with {counted}.count = {config[counted]['count']} and "
                f"contact.window = {config['contact']['window']:.6g} nm, found {touching}"
            )


def _check_side(config, section, side, surface, grid, sphere):
    """Masters of one side, of the study (section scales) or of robustness."""
    settings, scales = config[section][side], config["scales"][side]
    tiles, key = scales.get("tiles", 1), f"config key {section}.{side}"
    size, needed = 2 * grid.size * tiles, 2 * grid.pixels * tiles
    if settings["pixels"] < needed:
        raise ValueError(
            f"{key}.pixels: expected at least the {needed} of {tiles} x {tiles} stitched scans of "
            f"{surface}, found {settings['pixels']}"
        )
    rho = config["scales"]["range"]
    _refuse_unresolved(config, "scales.range", rho, surface, grid.relief, size)
    for name, preload, hardness in _loads(config, section):
        # On slopes near one a contact is about as deep as it is wide.
        depth = min(math.sqrt(preload / hardness) * 1e9, grid.relief)
        if rho < depth / DIGITS:
            raise ValueError(
                f"config key scales.range: expected at least {depth / DIGITS:.3g} nm, for contacts "
                f"that {name} makes some {depth:.3g} nm deep, found {rho:.4g} nm"
            )
    finest = size / settings["pixels"]
    filtered = finest if side == "small" else grid.pixel
    for name, limit in (("transition", grid.pixel), ("cutoffs", filtered)):
        for wavelength in np.atleast_1d(settings.get(name, scales[name])):
            # As far from two pixels as `fourier.lowpass` asks for.
            if not 2 * limit * (1 + 1e-9) < wavelength <= size:
                raise ValueError(
                    f"{key}.{name}: expected on {surface} more than two pixels "
                    f"({2 * limit:.4g} nm) and at most the domain ({size:.6g} nm), "
                    f"found {wavelength:.4g} nm"
                )
    if section == "robustness" or config["scales"]["sphere_roughness"]:
        pixel, master = min(finest, sphere.pixel), grid._replace(size=size / 2)
        _refuse_fine(f"the {side}-scale masters of {surface} and the sphere", pixel, master, sphere)
        finest = pixel
    _refuse_touching(config, section, surface, finest)
