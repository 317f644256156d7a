"""Pull-off on mirrored windows of a large surface, with all their waves and without long ones."""

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple, TypedDict

import numpy as np
import xarray as xr

from hardcontact.adhesion.pull_off import FORCE, mean_pull_off_of_pair
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import bodies, window_pixels
from hardcontact.numbers.random import generator
from hardcontact.records.job import progress
from hardcontact.surfaces.filters import filtered_series
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.spectrum import Density, Floats
from hardcontact.surfaces.substitute_scans import substitute_scan
from hardcontact.surfaces.synthesis import random_surface
from hardcontact.surfaces.topography import level, mirror_stitch


class WindowContacts(TypedDict):
    """Windows that are cut out of a surface, and the contacts on them."""

    sizes: list[float]  #: Edges of the windows in nm.
    each: int  #: Windows of every size, along the diagonal of the surface.
    radius: float  #: Of the sphere in nm.
    window: float  #: Edge in nm of the analysis window of a contact.
    count: int  #: Contacts along an edge of the array.
    preload: float  #: In N.
    hardness: float  #: Of the softer body in Pa.
    ranges: list[float]  #: Ranges of adhesion in nm.


def window_forces(surface: HeightMap, parameters: WindowContacts) -> Floats:
    """Return the plastic pull-off of a smooth sphere on a surface and on windows cut out of it.

    The forces (scan_size, rho) in N at 1 J/m² are means over contacts and windows. The surface is
    periodic, the largest there is; the last scan size is its own, and it is not mirrored.
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


def mean_forces(surface: HeightMap, parameters: WindowContacts) -> Floats:
    """Return the plastic pull-off (rho,) in N at 1 J/m² on a periodic surface, over contacts."""
    contact = Contact(
        radius=parameters["radius"],
        preload=parameters["preload"],
        hardness=parameters["hardness"],
        window=parameters["window"],
        count=parameters["count"],
    )
    found = mean_pull_off_of_pair(bodies(surface, None, contact), [contact], parameters["ranges"])
    return np.asarray(found["pull_off_force"].values[0])


class WindowFilters(NamedTuple):
    """Random surfaces, the windows cut out of them, and what both are filtered at."""

    sizes: list[float]  #: Edges of two whole surfaces in nm; windows are cut out of the last one.
    pixel_size: float  #: In nm.
    realizations: int  #: Surfaces of each size.
    cutoffs: list[float]  #: In nm, ascending; wavelengths above are removed.
    seed: int  #: Of the surfaces.
    #: At one range of adhesion; the count is that on whole surfaces. Mirrored windows hold few
    #: peaks: half as many along an edge tell the same force there.
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
    periods = [*(2 * size for size in windows), *whole]
    over_all = {"units": "1", "long_name": "force without longer waves over that with all"}
    of_windows = {"units": "1", "long_name": "1 of mirrored windows, 0 of whole surfaces"}
    removed = nm | {"long_name": "wavelength above which roughness is removed"}
    return xr.Dataset(
        {
            "pull_off_force": (of_scan, means[..., 0], FORCE),
            "ratio": ((*of_scan, "cutoff_wavelength"), means[..., 1:], over_all),
            "period": ("edge_size", periods, nm | {"long_name": "longest wave of the surface"}),
            "mirrored": ("edge_size", [1] * len(windows) + [0] * len(whole), of_windows),
        },
        {
            "edge_size": ("edge_size", [*windows, *whole], nm | {"long_name": "edge of the scan"}),
            "cutoff_wavelength": ("cutoff_wavelength", filters.cutoffs, removed),
        },
    )


def filtered_forces(surface: HeightMap, cutoffs: list[float], contacts: WindowContacts) -> Floats:
    """Return the mean force on a periodic surface as it is, and what is left above each cutoff.

    These are (1 + cutoff,): the force in N at 1 J/m², then ratios to it. Ratios are NaN at cutoffs
    (nm, ascending) above the period, which would remove nothing: that is no sign that longer waves
    do not matter.
    """
    limit = surface.size * (1 + 1e-12)
    known = [None, *(cutoff for cutoff in cutoffs if cutoff <= limit)]
    surfaces = filtered_series(surface, "large", known, surface.pixels)
    force, *others = (mean_forces(one, contacts)[0] for one in surfaces)
    beyond = [np.nan] * (len(cutoffs) - len(others))  # the longest, as cutoffs ascend
    return np.array([force, *(other / force for other in others), *beyond])


def _of_realization(
    name: str, density: Density, filters: WindowFilters, realization: int
) -> list[Floats]:
    """Return `filtered_forces` of windows of every size, their means, then of whole surfaces."""
    contacts, cutoffs, pixel_size = filters.contacts, filters.cutoffs, filters.pixel_size
    on_windows: WindowContacts = {**contacts, "count": -(-contacts["count"] // 2)}
    whole = []
    for size in filters.sizes:
        rng = generator(filters.seed, name, realization, f"window edges {size:g} nm")
        pixels = window_pixels(size, pixel_size)
        whole.append(random_surface(rng, pixels, pixel_size, density))
    means = []
    for size in contacts["sizes"]:
        windows = mirrored_windows(whole[-1], size, contacts["each"])
        forces = [filtered_forces(one, cutoffs, on_windows) for one in windows]
        means.append(np.mean(forces, axis=0))
    return [*means, *(filtered_forces(one, cutoffs, contacts) for one in whole)]
