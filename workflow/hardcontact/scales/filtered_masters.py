"""Forces on a master, whole and filtered below or above every cutoff wavelength."""

from collections.abc import Callable, Mapping
from typing import TypedDict

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hardcontact.adhesion.force_sum import pull_off_force
from hardcontact.adhesion.pull_off import FORCE, WORK_OF_ADHESION, Axis, load_axis, plastic_totals
from hardcontact.contact.bearing_area import NamedLoad, contact_pixel_count
from hardcontact.contact.geometry import ContactArray, bodies
from hardcontact.records.job import progress
from hardcontact.scales.stacked_masters import CONTACT_AXES
from hardcontact.surfaces.filters import filtered_series
from hardcontact.surfaces.height_map import HeightMap


class Cutoffs(TypedDict):
    """Cutoffs in nm that a master is filtered at, and the pixels along an edge of the results."""

    pixels: int
    cutoffs: list[float]


def forces_at_cutoffs(
    master: HeightMap,
    side: str,
    scales: Cutoffs,
    forces: Callable[[HeightMap], NDArray[np.float64]],
    axes: Mapping[str, Axis],
) -> xr.Dataset:
    """Return the forces on a master, whole and filtered at every cutoff.

    Parameters
    ----------
    master : HeightMap
        Periodic.
    side : str
        ``"small"`` removes wavelengths below the cutoffs, ``"large"`` those above.
    scales : Cutoffs
        The filters.
    forces : callable
        Takes a filtered surface and returns its forces (...) in N at 1 J/m². No surface is kept
        while the next one is filtered.
    axes : mapping of str to Axis
        The dimensions of the forces, in their order, with their coordinates.

    Returns
    -------
    xarray.Dataset
        ``pull_off_force`` (cutoff_wavelength, ...), ``unfiltered_pull_off_force`` (...) and
        ``unfiltered_wavelength``, the end of the unfiltered spectrum.
    """
    cutoffs: list[float | None] = [None, *scales["cutoffs"]]
    surfaces = filtered_series(master, side, cutoffs, scales["pixels"])
    unfiltered, *filtered = progress(map(forces, surfaces), len(cutoffs), "cutoffs")
    end = 2 * master.size / scales["pixels"] if side == "small" else master.size
    nanometres = {"units": "nm", "long_name": "end of the unfiltered spectrum"}
    cutoff_axis = (("cutoff_wavelength",), np.asarray(scales["cutoffs"], float), {"units": "nm"})
    return xr.Dataset(
        {
            "unfiltered_pull_off_force": (tuple(axes), unfiltered, FORCE),
            "pull_off_force": (("cutoff_wavelength", *axes), np.array(filtered), FORCE),
            "unfiltered_wavelength": ((), end, nanometres),
        },
        {"cutoff_wavelength": cutoff_axis, **axes},
        {"work_of_adhesion": WORK_OF_ADHESION},
    )


class FilteredContacts(ContactArray):
    """A master, filtered at several cutoffs, in an array of contacts at several loads.

    The side ``"small"`` removes wavelengths below the cutoffs, ``"large"`` those above. The radius
    of the sphere and rho, the range of adhesion, are in nm.
    """

    side: str
    scales: Cutoffs
    radius: float
    rho: float
    loads: list[NamedLoad]


def filtered_pull_off(
    master: HeightMap, sphere: HeightMap | None, parameters: FilteredContacts, threads: int = 1
) -> xr.Dataset:
    """Return the plastic pull-off of a periodic master, whole and filtered, by contact and load.

    The sphere is its roughness, or None of a smooth one; the result does not depend on the threads.
    ``pull_off_force`` (cutoff_wavelength, load, contact_y, contact_x) has contacts by number,
    beside ``unfiltered_pull_off_force`` (load, contact_y, contact_x) and ``unfiltered_wavelength``,
    the end of the unfiltered spectrum.
    """
    loads, rho = parameters["loads"], parameters["rho"]

    def forces(surface: HeightMap) -> np.ndarray:
        pair = bodies(surface, sphere, parameters["radius"], parameters)
        pixel_size = pair.geometry.pixel_size
        contact_pixels = [contact_pixel_count(load, pixel_size) for load in loads]
        totals = plastic_totals(pair, contact_pixels, rho, threads)
        return pull_off_force(totals, rho, pixel_size, WORK_OF_ADHESION)

    axes = load_axis(loads)
    axes |= {axis: ((axis,), np.arange(parameters["count"]), {}) for axis in CONTACT_AXES}
    found = forces_at_cutoffs(master, parameters["side"], parameters["scales"], forces, axes)
    return found.assign_attrs(rho=rho)
