"""Plastic pull-off of masters, filtered below or above a cutoff wavelength."""

from typing import TypedDict

import numpy as np

from hardcontact.adhesion.force_sum import plastic_totals, pull_off_force
from hardcontact.adhesion.pull_off import FORCE, WORK_OF_ADHESION, contact_axes, load_axis
from hardcontact.contact.bearing_area import ContactSettings, NamedLoad, contact_pixel_count
from hardcontact.contact.geometry import ContactArray, bodies
from hardcontact.records.netcdf import Arrays
from hardcontact.scales.filtered_masters import Cutoffs, forces_at_cutoffs
from hardcontact.surfaces.filters import filtered
from hardcontact.surfaces.height_map import HeightMap

__all__ = [
    "FilteredContact",
    "FilteredContacts",
    "filtered_pull_off",
    "mean_filtered_pull_off",
]


class FilteredContact(TypedDict):
    """A master, filtered at one cutoff, in an array of contacts with a sphere.

    Attributes
    ----------
    side : str
        ``"small"`` removes wavelengths below the cutoff, ``"large"`` those above.
    cutoff : float or None
        In nm; None removes nothing.
    pixels : int
        Along an edge of the filtered surface.
    radius : float
        Of the sphere, in nm.
    rho : float
        Range of adhesion in nm.
    contact : ContactSettings
        Array of contacts and load.
    """

    side: str
    cutoff: float | None
    pixels: int
    radius: float
    rho: float
    contact: ContactSettings


class FilteredContacts(ContactArray):
    """A master, filtered at several cutoffs, in an array of contacts at several loads.

    Attributes
    ----------
    side : str
        ``"small"`` removes wavelengths below the cutoffs, ``"large"`` those above.
    scales : Cutoffs
        The filters.
    radius : float
        Of the sphere, in nm.
    rho : float
        Range of adhesion in nm.
    loads : list of NamedLoad
        Preloads and hardnesses.
    """

    side: str
    scales: Cutoffs
    radius: float
    rho: float
    loads: list[NamedLoad]


def filtered_pull_off(
    master: HeightMap, sphere: HeightMap | None, parameters: FilteredContact, threads: int = 1
) -> Arrays:
    """Return the plastic pull-off at every contact of a filtered master.

    Parameters
    ----------
    master : HeightMap
        Periodic.
    sphere : HeightMap or None
        Roughness of the sphere; None of a smooth one.
    parameters : FilteredContact
        Filter, sphere and load.
    threads : int
        The result does not depend on it.

    Returns
    -------
    Arrays
        ``pull_off_force`` (contact_y, contact_x).
    """
    side, rho = parameters["side"], parameters["rho"]
    surface = filtered(master, side, parameters["cutoff"], parameters["pixels"])
    pair = bodies(surface, sphere, parameters["radius"], parameters["contact"])
    pixel_size = pair.geometry.pixel_size
    contact_pixels = contact_pixel_count(parameters["contact"], pixel_size)
    (total,) = plastic_totals(pair, [contact_pixels], rho, threads)
    force = pull_off_force(total, rho, pixel_size, WORK_OF_ADHESION)
    return Arrays(
        {"pull_off_force": (("contact_y", "contact_x"), force, FORCE)},
        contact_axes(pair),
        {
            "work_of_adhesion": WORK_OF_ADHESION,
            "rho": rho,
            "contact_pixels": contact_pixels,
            "shortest_wavelength": 2 * pair.substrate.pixel_size,
            "longest_wavelength": pair.substrate.size,
        },
    )


def mean_filtered_pull_off(
    master: HeightMap, sphere: HeightMap | None, parameters: FilteredContacts
) -> Arrays:
    """Return the plastic pull-off of a filtered master, averaged over contacts, at several loads.

    Parameters
    ----------
    master : HeightMap
        Periodic.
    sphere : HeightMap or None
        Roughness of the sphere; None of a smooth one.
    parameters : FilteredContacts
        Filters, sphere and loads.

    Returns
    -------
    Arrays
        ``pull_off_force`` (cutoff_wavelength, load), ``unfiltered_pull_off_force`` (load) and
        ``unfiltered_wavelength``, the end of the unfiltered spectrum.
    """
    curves = forces_at_cutoffs(
        master,
        parameters["side"],
        parameters["scales"],
        lambda surface: _mean_forces(surface, sphere, parameters),
        load_axis(parameters["loads"]),
    )
    return curves._replace(attributes=curves.attributes | {"rho": parameters["rho"]})


def _mean_forces(
    surface: HeightMap, sphere: HeightMap | None, parameters: FilteredContacts
) -> np.ndarray:
    """Return the forces (load,) in N on one filtered surface, averaged over contacts."""
    rho = parameters["rho"]
    pair = bodies(surface, sphere, parameters["radius"], parameters)
    pixel_size = pair.geometry.pixel_size
    contact_pixels = [contact_pixel_count(load, pixel_size) for load in parameters["loads"]]
    totals = plastic_totals(pair, contact_pixels, rho)
    means = totals.mean(axis=(1, 2))
    return pull_off_force(means, rho, pixel_size, WORK_OF_ADHESION)
