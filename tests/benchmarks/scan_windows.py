"""Pull-off forces on mirrored windows of large random surfaces, with and without long waves.

Windows are cut out of a surface, levelled and mirrored, as the paper does with its scans.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import xarray as xr

from hardcontact.base.random import generator
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import bodies, window_pixels
from hardcontact.contact.pull_off import FORCE, mean_pull_off_of_pair
from hardcontact.surfaces.filters import filtered_series
from hardcontact.surfaces.height_map import HeightMap, level, mirror_stitch
from hardcontact.surfaces.spectrum import Floats, SpectrumFunction
from hardcontact.surfaces.substitute_scans import cut_scan
from hardcontact.surfaces.synthesis import random_surface


@dataclass(frozen=True)
class Windows:
    """Windows that are cut out of a surface, and the contacts on them; lengths in nm."""

    sizes: list[float]  #: Edges of the windows.
    per_size: int  #: Windows of every size, along the diagonal of the surface.
    ranges: list[float]  #: Ranges of adhesion.
    contact: Contact  #: Contacts of a smooth sphere; their range is not used.


def mirrored_windows(surface: HeightMap, size: float, count: int) -> Iterator[HeightMap]:
    """Yield levelled and mirrored windows of a periodic surface, along its diagonal.

    Windows have the edge `size` (nm); mirrored they are periodic over twice that size.
    """
    pixels = round(size / surface.pixel_size)
    for start in np.arange(count) * (surface.pixels // count):
        shifted = replace(surface, heights=np.roll(surface.heights, (-start, -start), (0, 1)))
        yield mirror_stitch(level(cut_scan(shifted, pixels)))


def mean_forces(surface: HeightMap, windows: Windows) -> Floats:
    """Return the plastic pull-off (rho,) in N at 1 J/m² on a periodic surface, over contacts."""
    pair = bodies(surface, None, windows.contact)
    forces = mean_pull_off_of_pair(pair, windows.contact, windows.ranges)["pull_off_force"]
    return np.asarray(forces.sel(contact_model="plastic").values)


def filtered_forces(surface: HeightMap, cutoffs: list[float], windows: Windows) -> Floats:
    """Return the mean force on a periodic surface and the ratios to it without long waves.

    The values are (1 + cutoff,): the force in N at 1 J/m² at the first range of adhesion, then the
    ratios at the cutoffs (nm, ascending). A cutoff above the period removes nothing, which does not
    show that longer waves do not matter: its ratio is NaN.
    """
    limit = surface.size * (1 + 1e-12)
    passed_cutoffs = [cutoff for cutoff in cutoffs if cutoff <= limit]
    surfaces = filtered_series(surface, "large", [None, *passed_cutoffs], surface.pixels)
    force, *filtered = (mean_forces(filtered_surface, windows)[0] for filtered_surface in surfaces)
    missing_ratios = [np.nan] * (len(cutoffs) - len(passed_cutoffs))
    return np.array([force, *(value / force for value in filtered), *missing_ratios])


@dataclass(frozen=True)
class WindowFilters:
    """Random surfaces, the windows cut out of them, and the cutoffs; lengths in nm."""

    sizes: list[float]  #: Edges of two whole surfaces; windows are cut out of the second.
    pixel_size: float
    realizations: int  #: Surfaces of each size.
    cutoffs: list[float]  #: Ascending; wavelengths above are removed.
    seed: int
    #: At one range of adhesion, with the contacts on whole surfaces. Mirrored windows hold few
    #: peaks, so that half as many contacts along a side suffice there.
    windows: Windows


def filtered_window_forces(
    name: str, density: SpectrumFunction, filters: WindowFilters
) -> xr.Dataset:
    """Return the forces on windows and whole surfaces of a spectrum, with and without long waves.

    Parameters
    ----------
    name : name of the spectrum, for its random numbers
    density : C_iso in nm⁴ as a function of the wavevector in rad/nm

    Returns
    -------
    ``pull_off_force`` (realization, map_size) in N at 1 J/m² and ``filtered_force_ratio``
    (realization, map_size, cutoff_wavelength), the force without wavelengths above the cutoff
    relative to the force with all, NaN at cutoffs above the period. Both are means over the windows
    of a surface. ``period`` (map_size) is in nm; ``mirrored`` (map_size) is 1 for windows. Map
    sizes belong to the windows first, then to the whole surfaces.
    """
    realizations = range(filters.realizations)
    means = np.array([_realization_forces(name, density, filters, k) for k in realizations])
    window_sizes, surface_sizes = filters.windows.sizes, filters.sizes
    nm, axes = {"units": "nm"}, ("realization", "map_size")
    periods = [*(2 * size for size in window_sizes), *surface_sizes]
    ratio_attributes = {
        "units": "1",
        "long_name": "force without longer waves, relative to the force with all waves",
    }
    mirrored_attributes = {
        "units": "1",
        "long_name": "1 for mirrored windows, 0 for whole surfaces",
    }
    cutoff_attributes = nm | {"long_name": "wavelength above which roughness is removed"}
    return xr.Dataset(
        {
            "pull_off_force": (axes, means[..., 0], FORCE),
            "filtered_force_ratio": (
                (*axes, "cutoff_wavelength"),
                means[..., 1:],
                ratio_attributes,
            ),
            "period": ("map_size", periods, nm | {"long_name": "longest wave of the surface"}),
            "mirrored": (
                "map_size",
                [1] * len(window_sizes) + [0] * len(surface_sizes),
                mirrored_attributes,
            ),
        },
        {
            "map_size": (
                "map_size",
                [*window_sizes, *surface_sizes],
                nm | {"long_name": "size of the mirrored windows, then of the whole surfaces"},
            ),
            "cutoff_wavelength": ("cutoff_wavelength", filters.cutoffs, cutoff_attributes),
        },
    )


def _realization_forces(
    name: str, density: SpectrumFunction, filters: WindowFilters, realization: int
) -> list[Floats]:
    """Return the mean `filtered_forces` of windows of every size, then those of whole surfaces."""
    windows, cutoffs, pixel_size = filters.windows, filters.cutoffs, filters.pixel_size
    half_as_many = replace(windows.contact, count=-(-windows.contact.count // 2))
    fewer_contacts = replace(windows, contact=half_as_many)
    surfaces = []
    for size in filters.sizes:
        rng = generator(filters.seed, name, realization, f"window edges {size:g} nm")
        pixels = window_pixels(size, pixel_size)
        surfaces.append(random_surface(rng, pixels, pixel_size, density))
    means = []
    for size in windows.sizes:
        scans = mirrored_windows(surfaces[-1], size, windows.per_size)
        forces = [filtered_forces(scan, cutoffs, fewer_contacts) for scan in scans]
        means.append(np.mean(forces, axis=0))
    return [*means, *(filtered_forces(surface, cutoffs, windows) for surface in surfaces)]
