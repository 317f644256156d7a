"""Plastic pull-off of masters, filtered below or above cutoff wavelengths, at several loads."""

import numpy as np
import xarray as xr

from hardcontact.adhesion.force_sum import plastic_totals, pull_off_force
from hardcontact.adhesion.pull_off import WORK_OF_ADHESION, load_axis
from hardcontact.contact.bearing_area import NamedLoad, contact_pixel_count
from hardcontact.contact.geometry import ContactArray, bodies
from hardcontact.scales.filtered_masters import CONTACT_AXES, Cutoffs, forces_at_cutoffs
from hardcontact.surfaces.height_map import HeightMap

__all__ = ["FilteredContacts", "filtered_pull_off"]


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
    master: HeightMap, sphere: HeightMap | None, parameters: FilteredContacts, threads: int = 1
) -> xr.Dataset:
    """Return the plastic pull-off at every contact and load of a master, whole and filtered.

    Parameters
    ----------
    master : HeightMap
        Periodic.
    sphere : HeightMap or None
        Roughness of the sphere; None of a smooth one.
    parameters : FilteredContacts
        Filters, sphere and loads.
    threads : int
        The result does not depend on it.

    Returns
    -------
    xarray.Dataset
        ``pull_off_force`` (cutoff_wavelength, load, contact_y, contact_x) with contacts by number,
        ``unfiltered_pull_off_force`` (load, contact_y, contact_x) and ``unfiltered_wavelength``,
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
