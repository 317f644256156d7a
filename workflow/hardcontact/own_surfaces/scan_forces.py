"""Mean forces on the scans of one surface, with what is left without each part of the scans."""

from typing import NamedTuple

import numpy as np
import xarray as xr

from hardcontact.own_surfaces.scan_parts import Parts, parts_of_scans, quarters_of_contacts

__all__ = ["ScanForces", "forces_of_scans"]

CONTACTS = ["contact_y", "contact_x"]


class ScanForces(NamedTuple):
    """Mean forces of one surface, over scans, scans of the sphere and contacts.

    Attributes
    ----------
    mean : numpy.ndarray
        (rho,) in N, at the work of adhesion of the forces given.
    left_out : numpy.ndarray
        (part, rho) logarithms of the mean of all parts but one.
    parts : list of Parts
        (rho,) they correlate the more the longer the range.
    """

    mean: np.ndarray
    left_out: np.ndarray
    parts: list[Parts]


def forces_of_scans(forces: xr.DataArray, size: float, radius: float) -> ScanForces:
    """Return the mean forces of one surface and contact model.

    Parameters
    ----------
    forces : xarray.DataArray (scan, sphere_scan, rho, contact_y, contact_x)
        In N at any work of adhesion, NaN where a scan is missing.
    size : float
        Edge of a scan in nm.
    radius : float
        Of the sphere in nm.

    Returns
    -------
    ScanForces
        Of scans where there are three, otherwise of their quarters.
    """
    of_scans = forces.dropna("scan", how="all").mean("sphere_scan")
    of_scans = of_scans.transpose("scan", "rho", *CONTACTS)
    scans = np.arange(of_scans.sizes["scan"])
    quarters = quarters_of_contacts(of_scans.sizes["contact_y"], 1)
    parts = [
        parts_of_scans(scans, quarters, size, float(np.sqrt(radius * rho)))
        for rho in of_scans.rho.values
    ]
    left_out = []
    for part in range(len(parts[0].correlation)):
        kept = xr.DataArray(parts[0].of_contact != part, dims=("scan", *CONTACTS))
        left_out.append(np.log(of_scans.where(kept).mean(CONTACTS).mean("scan").values))
    mean = of_scans.mean(CONTACTS).mean("scan").values
    return ScanForces(mean, np.array(left_out), parts)
