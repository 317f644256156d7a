"""Pull-off on mirrored windows of a large surface, with all their waves and without long ones."""

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple, TypedDict

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hardcontact.adhesion.pull_off import FORCE, mean_pull_off_of_pair
from hardcontact.contact.bearing_area import NamedLoad
from hardcontact.contact.geometry import ContactArray, bodies, window_pixels
from hardcontact.numbers.random import generator
from hardcontact.records.job import progress
from hardcontact.surfaces.filters import filtered_series
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.spectrum import Density
from hardcontact.surfaces.substitute_scans import substitute_scan
from hardcontact.surfaces.synthesis import random_surface
from hardcontact.surfaces.topography import level, mirror_stitch


class WindowContacts(TypedDict):
    """Windows that are cut out of a surface, and the contacts on them."""

    sizes: list[float]  #: Edges of the windows in nm.
    each: int  #: Windows of every size, along the diagonal of the surface.
    radius: float  #: Of the sphere in nm.
    ranges: list[float]  #: Ranges of adhesion in nm.
    window: float  #: Edge of the analysis window in nm.
    count: int  #: Contacts along an edge of the array.
    load: NamedLoad  #: Preload and hardness.


def window_forces(surface: HeightMap, parameters: WindowContacts) -> NDArray[np.float64]:
    """Return the plastic pull-off of a smooth sphere on a surface and on windows cut out of it.

    ``pull_off_force`` (scan_size, rho) in N at 1 J/m² are means over contacts and windows. The
    surface is periodic, the largest there is; the last scan size is its own, and it is not
    mirrored.
    """
    means = []
    for size in parameters["sizes"]:
        windows = mirrored_windows(surface, size, parameters["each"])
        means.append(np.mean([mean_forces(one, parameters) for one in windows], axis=0))
    return np.array([*means, mean_forces(surface, parameters)])


def mirrored_windows(surface: HeightMap, size: float, count: int) -> Iterator[HeightMap]:
    """Yield windows of a periodic surface, levelled and mirrored as the paper does with its scans.

    `count` windows of the edge `size` (nm) lie evenly along the diagonal of the surface; mirrored
    they are periodic over twice the size.
    """
    pixels = round(size / surface.pixel_size)
    for start in np.arange(count) * (surface.pixels // count):
        shifted = replace(surface, heights=np.roll(surface.heights, (-start, -start), (0, 1)))
        yield mirror_stitch(level(substitute_scan(shifted, pixels)))


def mean_forces(surface: HeightMap, parameters: WindowContacts) -> NDArray[np.float64]:
    """Return the plastic pull-off (rho,) in N at 1 J/m² on a periodic surface, over contacts."""
    array: ContactArray = {"window": parameters["window"], "count": parameters["count"]}
    pair = bodies(surface, None, parameters["radius"], array)
    found = mean_pull_off_of_pair(pair, [parameters["load"]], parameters["ranges"])
    return np.asarray(found["pull_off_force"].values[0])


class WindowFilters(NamedTuple):
    """Random surfaces, the windows cut out of them, and what both are filtered at.

    The sizes are edges of two whole surfaces in nm, the larger last; windows are cut out of that
    one. The realizations are the surfaces of each size, which the seed draws; all have pixels of
    one size in nm. The cutoffs ascend, in nm; wavelengths above are removed. The contacts are at
    one range of adhesion, their count is that on whole surfaces. Mirrored windows hold few peaks:
    half as many along an edge tell the same force there.
    """

    sizes: list[float]
    pixel_size: float
    realizations: int
    cutoffs: list[float]
    seed: int
    contacts: WindowContacts


def filtered_window_forces(name: str, density: Density, filters: WindowFilters) -> xr.Dataset:
    """Return the forces on windows and whole surfaces of a spectrum, and what long waves change.

    Windows of every size are cut out of each of the larger surfaces. The smaller whole surfaces are
    independent of these. The name of the spectrum is for its random numbers, the density is C_iso
    in nm⁴ as a function of the wavevector in rad/nm.

    ``pull_off_force`` (realization, edge_size) is in N at 1 J/m² and ``ratio`` (realization,
    edge_size, cutoff_wavelength) the force without wavelengths above the cutoff over that with all,
    NaN at cutoffs above the period; both are means over the windows of a surface. ``period``
    (edge_size) is in nm and ``mirrored`` (edge_size) 1 of windows. Edge sizes are those of windows,
    then those of the whole surfaces.
    """
    count = filters.realizations
    parts = (_of_realization(name, density, filters, one) for one in range(count))
    means = np.array(list(progress(parts, count, "realizations")))
    windows, whole = filters.contacts["sizes"], filters.sizes
    nm, of_scan = {"units": "nm"}, ("realization", "edge_size")
    long_name = "force without longer waves over that with all"
    of_windows = {"units": "1", "long_name": "1 of mirrored windows, 0 of whole surfaces"}
    return xr.Dataset(
        {
            "pull_off_force": (of_scan, means[..., 0], FORCE),
            "ratio": (
                (*of_scan, "cutoff_wavelength"),
                means[..., 1:],
                {"units": "1", "long_name": long_name},
            ),
            "period": (
                "edge_size",
                [*(2 * size for size in windows), *whole],
                nm | {"long_name": "longest wave of the surface"},
            ),
            "mirrored": ("edge_size", [1] * len(windows) + [0] * len(whole), of_windows),
        },
        {
            "edge_size": ("edge_size", [*windows, *whole], nm | {"long_name": "edge of the scan"}),
            "cutoff_wavelength": (
                "cutoff_wavelength",
                filters.cutoffs,
                nm | {"long_name": "wavelength above which roughness is removed"},
            ),
        },
    )


def filtered_forces(
    surface: HeightMap, cutoffs: list[float], contacts: WindowContacts
) -> NDArray[np.float64]:
    """Return the mean force on a periodic surface as it is, and what is left above each cutoff.

    These are (1 + cutoff,): the force in N at 1 J/m², then ratios to it. The cutoffs (nm) ascend;
    wavelengths above are removed. Ratios are NaN at cutoffs above the period, which would remove
    nothing: that is no sign that longer waves do not matter.
    """
    limit = surface.size * (1 + 1e-12)
    known = [None, *(cutoff for cutoff in cutoffs if cutoff <= limit)]
    surfaces = filtered_series(surface, "large", known, surface.pixels)
    force, *others = (mean_forces(one, contacts)[0] for one in surfaces)
    beyond = [np.nan] * (len(cutoffs) - len(others))  # the longest, as cutoffs ascend
    return np.array([force, *(other / force for other in others), *beyond])


def _of_realization(
    name: str, density: Density, filters: WindowFilters, realization: int
) -> list[NDArray[np.float64]]:
    """Return `filtered_forces` of windows of every size, their means, then of whole surfaces."""
    contacts = filters.contacts
    on_windows: WindowContacts = {**contacts, "count": -(-contacts["count"] // 2)}
    smaller, larger = (
        random_surface(
            generator(filters.seed, name, realization, f"window edges {size:g} nm"),
            window_pixels(size, filters.pixel_size),
            filters.pixel_size,
            density,
        )
        for size in filters.sizes
    )
    windows = [
        np.mean(
            [
                filtered_forces(window, filters.cutoffs, on_windows)
                for window in mirrored_windows(larger, size, contacts["each"])
            ],
            axis=0,
        )
        for size in contacts["sizes"]
    ]
    whole = [filtered_forces(one, filters.cutoffs, contacts) for one in (smaller, larger)]
    return [*windows, *whole]
