"""Forces on a master, whole and filtered below or above every cutoff wavelength.

The side ``"small"`` removes wavelengths below the cutoffs, ``"large"`` those above.
"""

from collections.abc import Callable, Mapping
from typing import TypedDict

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hardcontact.adhesion.pull_off import (
    CONTACT_AXES,
    FORCE,
    WORK_OF_ADHESION,
    Axis,
    load_axis,
    mean_pull_off_of_pair,
    plastic_totals,
    pull_off_force,
)
from hardcontact.contact.bearing_area import NamedLoad, contact_pixel_count
from hardcontact.contact.geometry import ContactArray, bodies
from hardcontact.records.job import progress
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
    """Return the forces on a periodic master, whole and filtered at every cutoff of a side.

    `forces` takes a filtered surface and returns its forces (...) in N at 1 J/m², whose dimensions
    and coordinates, in their order, are the axes. No surface is kept while the next one is
    filtered. ``pull_off_force`` (cutoff_wavelength, ...) and ``unfiltered_pull_off_force`` (...)
    stand beside ``unfiltered_wavelength``, the end of the unfiltered spectrum in nm.
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
    """A master, filtered at several cutoffs, in an array of contacts at several loads."""

    side: str
    scales: Cutoffs
    radius: float  #: Of the sphere in nm.
    rho: float  #: Range of adhesion in nm.
    loads: list[NamedLoad]


def filtered_pull_off(
    master: HeightMap, sphere: HeightMap | None, parameters: FilteredContacts, threads: int = 1
) -> xr.Dataset:
    """Return `forces_at_cutoffs` of plastic contact, by load, contact_y and contact_x.

    The sphere is its roughness, or None of a smooth one. Contacts are numbered; the result does not
    depend on the threads.
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


class ScaledContacts(ContactArray, Cutoffs):
    """A master, filtered at several cutoffs, in all combinations of sphere, range and area.

    The contact area is the preload over the hardness.
    """

    side: str
    radii: list[float]  #: Of the spheres in nm.
    ranges: list[float]  #: Of adhesion in nm.
    hardness: float  #: Of the softer body in Pa.
    preloads: list[float]  #: In N.


def scaled_pull_off(master: HeightMap, parameters: ScaledContacts) -> xr.Dataset:
    """Return `forces_at_cutoffs` of plastic contact, meaned over contacts, by radius, area and rho.

    The sphere is smooth. Where a pixel is not small against the contact area, the area is that of
    the pixels that touch: the smallest whole number of them that carries the preload.
    ``contact_area`` (area), in nm², is that of the pixels that touch, and the coordinate area the
    preload over the hardness in nm².
    """
    nm, ranges = {"units": "nm"}, parameters["ranges"]
    loads: list[NamedLoad] = [
        {"name": f"{preload:g}", "preload": preload, "hardness": parameters["hardness"]}
        for preload in parameters["preloads"]
    ]

    def forces(surface: HeightMap) -> np.ndarray:
        pairs = (bodies(surface, None, radius, parameters) for radius in parameters["radii"])
        means = (mean_pull_off_of_pair(pair, loads, ranges)["pull_off_force"] for pair in pairs)
        return np.array([of_radius.values for of_radius in means])

    areas = np.asarray(parameters["preloads"]) / parameters["hardness"] * 1e18
    axes: dict[str, Axis] = {
        "radius": (("radius",), np.array(parameters["radii"]), nm),
        "area": (("area",), areas, {"units": "nm2", "long_name": "preload over hardness"}),
        "rho": (("rho",), np.array(ranges), nm),
    }
    pixel_size = master.size / parameters["pixels"]
    touching = [contact_pixel_count(load, pixel_size) * pixel_size**2 for load in loads]
    contact_area = ("area", touching, {"units": "nm2", "long_name": "touching pixels"})
    found = forces_at_cutoffs(master, parameters["side"], parameters, forces, axes)
    return found.assign(contact_area=contact_area)
